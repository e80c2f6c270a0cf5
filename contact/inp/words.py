"""Words and numbers of CONTACT's input files."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

from contact.errors import ContactError
from contact.inp.fields import Field, Now
from contact.reading.text import lines_of

#: CONTACT reads this many characters of a line.
LINE_LENGTH = 256
#: Longest file that is read [bytes].
LARGEST_FILE = 500_000_000
#: A number with a decimal comma, among the numbers with which a line begins.
_COMMA = re.compile(r"[\d\s.,+-]*?(?<![\d.,])([+-]?\d+),(\d+)(?![\w.,+-])")
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[eEdDqQ]([+-]?\d+)|([+-]\d+))?")


def split(line: str) -> list[str]:
    """Return the words of a line. Blanks, tabs, commas and = separate; % begins a comment outside of '…'."""
    words, word, quoted = [], "", False
    for character in line[:LINE_LENGTH]:
        quoted ^= character == "'"
        if character == "%" and not quoted:
            break
        character = " " if character == "," else character
        if character in " \t=\r" and not quoted:
            if word:
                words.append(word)
            word = ""
        else:
            word += character
    return [*words, word] if word else words


def real(word: str) -> float:
    """Return a real number; `.1-07` is 0.1e-7. A ValueError if it is none."""
    match = _NUMBER.fullmatch(word)
    if match is None or len(match[2] or match[3] or "") > 5:
        raise ValueError(word)
    value = float(f"{match[1]}e{int(match[2] or match[3] or 0)}")
    if not math.isfinite(value):
        raise ValueError(word)
    return value


def angle(word: str) -> float:
    """Return an angle [rad]. A last character d means degrees, r or none radians."""
    if word[-1] in "dD":
        return real(word[:-1]) * math.pi / 180.0
    return real(word[:-1] if word[-1] in "rR" else word)


def integer(word: str) -> int:
    """Return an integer, which may be written as a real number like 1.0."""
    if re.fullmatch(r"[+-]?\d{1,18}", word):
        return int(word)
    if (value := real(word)) != int(value):
        raise ValueError(word)
    return int(value)


def quoted(word: str) -> str:
    """Return the name inside single quotes, with / between folders."""
    if len(word) < 3 or word[0] != "'" or word[-1] != "'":
        raise ValueError(word)
    return word[1:-1].replace("\\", "/")


CONVERT: dict[str, Callable[[str], Any]] = {"i": integer, "d": real, "a": angle, "s": quoted}


class Lines:
    """The lines of a file, read word by word. Empty lines and comments are skipped."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lines = lines_of(path, "path", LARGEST_FILE)
        #: Number of the line that was read last.
        self.number = 0
        #: Numbers that stood behind the last value of their line or have a comma inside, for `notes` of a case.
        self.doubted: list[str] = []
        self._rest: list[str] = []
        self._last = ""

    def refuse(self, message: str, line: int | None = None) -> NoReturn:
        """Raise a ContactError that names file and line, that of the last word by default."""
        raise ContactError(f"{self.path}, line {self.number if line is None else line}: {message}")

    def new_group(self) -> None:
        """Skip the rest of the line: a label, or numbers that are told."""
        if self._rest and _NUMBER.fullmatch(self._rest[0]):
            self.doubted.append(f"line {self.number}: {self._rest[0]} behind {self._last} is not read")
        self._rest = []

    def _next(self, name: str) -> None:
        while self.number < len(self._lines):
            line = self._lines[self.number]
            self.number += 1
            if line.split("%")[0].strip():
                self._rest = split(line)
                if self._rest:
                    if "," in line and (comma := _COMMA.match(line)):
                        self.doubted.append(
                            f"line {self.number}: {comma[1]},{comma[2]} is read as {comma[1]} and {comma[2]}"
                        )
                    return
        self.refuse(f"the file ends where {name} is expected; MODULE 0 is missing")

    def take(self, field: Field, now: Now) -> tuple[bool, Any]:
        """Return whether the field is there, and its value in SI units."""
        if field.optional:
            if not self._rest:
                return False, None
            try:
                value = CONVERT[field.kind](self._rest[0])
            except ValueError:
                self._rest = []  # a label: the group ends here
                return False, None
        else:
            while not self._rest:
                self._next(field.name)
            try:
                value = CONVERT[field.kind](self._rest[0])
            except ValueError:
                hint = "; % begins a comment" if self._rest[0][0] in "#!;/*" else ""
                self.refuse(f"{field.name} = {self._rest[0]!r} is outside the allowed range, {field.allowed}{hint}")
        self._rest, self._last = self._rest[1:], field.name
        if isinstance(value, str):
            return True, value
        if not (field.low < value if field.above else field.low <= value) or value > field.high:
            self.refuse(f"{field.name} = {value:g} is outside the allowed range, {field.allowed}")
        return True, value if field.kind == "i" else value * field.scale(now)

    def array(self, name: str, count: int, factors: tuple[float, ...], kind: str = "d") -> tuple[float, ...]:
        """Return `count` numbers in SI units. `factors` are used in turn."""
        values: list[float] = []
        self.new_group()
        while len(values) < count:
            self._next(name)
            words, self._rest = self._rest[: count - len(values)], self._rest[count - len(values) :]
            for word in words:
                try:
                    number = CONVERT[kind](word)
                except ValueError:
                    self.refuse(f"{name}({len(values) + 1}) = {word!r} is no number; {count} numbers are needed")
                values.append(float(number) * factors[len(values) % len(factors)])
        self._last = name
        self.new_group()
        return tuple(values)

    @property
    def left(self) -> int:
        """Number of lines with content that have not been read."""
        return sum(bool(line.split("%")[0].strip()) for line in self._lines[self.number :])
