"""Read an input file of CONTACT."""

from __future__ import annotations

import os
from itertools import pairwise
from pathlib import Path
from typing import Any

from contact.errors import warn
from contact.inp.case import Case
from contact.inp.controls import WORDS, Digit
from contact.inp.fields import Array, Block, Field, Group, i, maybe
from contact.inp.subsurface import SUBSURFACE, SUBSURFACE_TYPES
from contact.inp.table import BLOCKS, OF_FRICTION, POTENTIAL
from contact.inp.words import Lines

_MODULE = Group((i("MODULE"), maybe(i("REID", 0, 999), 0), maybe(i("CPID", 1, 9), 1)))
_WORD_NAMES = ("PBTNFS", "LDCMZE", "HGIAOWR")
_DAMPING = maybe(i("M2"), 1)
#: Digits that keep what a case before has given, with a name that shows whether there is something.
_KEPT = {"L": ("LAW", (1,)), "C3": ("INFLUENCE", (0, 1))}
#: What a case must have, by module: digit that reads it, and name.
_NEEDED = {
    1: (
        ("D", "DX"),
        ("Z", "GAUGHT"),
        ("Z", "RFNAME"),
        ("Z", "DYRAIL"),
        ("E", "FBDIST"),
        ("E", "WFNAME"),
        ("E", "Y_WS"),
    ),
    3: (("D", "MX"),),
}
_MOST_BLOCKS = 10


def read(path: str | os.PathLike[str]) -> list[Case]:
    """Read an input file of CONTACT 25.1 (`.inp`), modules 1 and 3.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    list of Case
        In the order of the file. Each has all numbers that are in force, by CONTACT's names and in SI units.

    Raises
    ------
    ContactError
        For a file that cannot be read, or does not follow the format: it names file, line, name, value and what is allowed.

    Warns
    -----
    PlausibilityWarning
        For digits that a first case changes, and numbers that stand behind the last value of their line or have a comma
        inside: CONTACT takes a decimal comma for a blank, so that all values behind it move by one. For lines behind MODULE 0.
    """
    cases = _Reader(Path(path)).cases()
    if noted := [case for case in cases if case.notes]:
        more = sum(len(case.notes) for case in noted) - 1
        warn(f"{noted[0].place}: {noted[0].notes[0]}" + (f", and {more} more; Case.notes has all" if more else ""))
    return cases


class _Reader:
    def __init__(self, file: Path) -> None:
        self.file, self.lines = file, Lines(file)
        self.memory: dict[tuple[int, int, int], tuple[dict[str, Any], dict[str, int]]] = {}
        self.count: dict[tuple[int, int], int] = {}
        self.seen: set[tuple[int, int, int]] = set()

    def cases(self) -> list[Case]:
        found: list[Case] = []
        while True:
            now: dict[str, Any] = {}
            self.group(_MODULE, now, {})
            module = now["MODULE"]
            if module == 0:
                if left := self.lines.left:
                    warn(
                        f"{self.file}, line {self.lines.number}: MODULE 0 ends the file; lines behind it are not read: {left}"
                    )
                return found
            if module not in BLOCKS:
                self.lines.refuse(f"MODULE = {module} is outside the allowed range, {{0, 1, 3}}")
            element, problem = now["REID"], now["CPID"] if module == 3 else 1
            while True:
                case = self.case(module, element, problem)
                found.append(case)
                if case.digits["R"] in (1, 3):
                    break

    def case(self, module: int, element: int, problem: int) -> Case:
        """Read one case."""
        key = module, element, problem
        values, at = (dict(each) for each in self.memory.get(key, ({}, {})))
        line = second = 0
        digits: dict[str, int] = {}
        for k, word in enumerate(WORDS):
            used = word[1:] if k == 0 and module == 3 else word
            self.control(used, _WORD_NAMES[k] if module == 3 else _long_name(word), digits, module, k == 1)
            line = line or self.lines.number
            second = self.lines.number if k == 1 else second
        self.between(digits)
        first, notes = key not in self.seen, []
        self.seen.add(key)
        if first:
            for letter, to in (("P", 2), ("I", 0)):
                if digits[letter] != to:
                    notes.append(f"{letter} = {digits[letter]} becomes {to}: it is the first case")
                    digits[letter] = to
        if module == 1 and digits["C3"] == 0:
            notes.append("C = 0 becomes 1")
            digits["C3"] = 1
        for letter, (name, keep) in _KEPT.items():
            if digits[letter] in keep and name not in values:
                self.lines.refuse(f"{letter} = {digits[letter]} keeps what no case before has given", second)
        if digits["L"] == 1 and values["ROWS"] != digits["V"]:
            self.lines.refuse(
                f"V = {digits['V']} with L = 1; allowed: {values['ROWS']}, as when the law was given", second
            )
        if digits["S"] in (1, 2) and "SUBS" not in values:
            self.lines.refuse(f"S = {digits['S']} keeps points that no case before has given")
        now: dict[str, Any] = {**values, **digits}
        if module == 3:
            self.reset(digits, now)
        fresh: dict[str, int] = {}
        for block in BLOCKS[module]:
            self.block(block, now, fresh)
        values = {name: value for name, value in now.items() if name not in digits}
        at.update(fresh)
        self.check(module, digits, values)
        notes += self.lines.doubted
        self.lines.doubted = []
        self.memory[key] = values, at
        shared = (0, 0) if element == 0 else (element, problem)
        number = self.count[shared] = self.count.get(shared, 0) + 1
        return Case(
            number, module, element, problem, digits, values, at, frozenset(fresh), self.file, line, tuple(notes)
        )

    def control(self, word: tuple[Digit, ...], name: str, digits: dict[str, int], module: int, damping: bool) -> None:
        """Read a control word: digits from the right, missing ones are 0."""
        fields = (Field(name, "i"), _DAMPING) if damping else (Field(name, "i"),)
        now: dict[str, Any] = {}
        self.group(Group(fields), now, {})
        number = now[name]
        if number < 0:
            self.lines.refuse(f"{name} = {number}; allowed: digits without a sign")
        for digit in reversed(word):
            number, value = divmod(number, 10)
            allowed = digit.values(module)
            if value not in allowed:
                choice = ", ".join(map(str, allowed))
                self.lines.refuse(f"{digit.letter} = {value} ({digit.name} in {now[name]}); allowed: {choice}")
            digits[digit.letter] = value
        if number:
            self.lines.refuse(f"{name} = {now[name]} has too many digits; allowed: {len(word)}")
        if damping:
            digits["WEIGHTING"], digits["M2"] = divmod(now["M2"], 10)
            if digits["M2"] not in (0, 1, 2) or digits["WEIGHTING"] not in (0, 1, 2):
                self.lines.refuse(f"M2 = {now['M2']}; allowed: 0, 1, 2, with 10 or 20 added")

    def between(self, digits: dict[str, int]) -> None:
        """Refuse digits that contradict each other."""
        for wrong, what in (
            (digits["H"] and digits["T"] != 3, f"H = {digits['H']} with T = {digits['T']}; allowed with T = 3"),
            (digits["L"] == 6 and not digits["H"], "L = 6 with H = 0; allowed: H = 1, 3"),
            (
                digits["F"] and digits["F"] < 3 and "C1" in digits and not digits["N"],
                "F = 1 with N = 0; allowed: N = 1",
            ),
        ):
            if wrong:
                self.lines.refuse(what)

    def reset(self, digits: dict[str, int], now: dict[str, Any]) -> None:
        """Forget what module 3 does not keep."""
        geometry = ("PLANFORM", "NPATCH", "XYLIM", "FAC") if digits["Z"] >= 2 else ()
        slip = () if digits["E"] in (1, 9) else ("EXRHS",)
        for name in (*geometry, *slip, "PEN", "FN", "CKSI", "CETA", "FXREL", "FYREL"):
            now.pop(name, None)

    def block(self, block: Block, now: dict[str, Any], fresh: dict[str, int]) -> None:
        """Read a block if it is there."""
        if not block.when(now):
            return
        if isinstance(block, Group):
            if any(name == "LAW" for name, _ in block.kept):
                for name in OF_FRICTION:
                    now.pop(name, None)
            if block.repeat is None:
                self.group(block, now, fresh)
            else:
                self.repeated(block, now, fresh, block.repeat(now))
            for name, value in block.kept:
                now[name] = value(now)
                fresh[name] = self.lines.number
            if any(field.name == "MX" for field in block.fields):
                kept = {name for name, _ in POTENTIAL[now["IPOTCN"]]}
                for row in POTENTIAL.values():
                    for name, _ in row:
                        if name not in kept:
                            now.pop(name, None)
        elif isinstance(block, Array):
            count = block.count(now)
            if block.name == "UDB" and now["IBASE"] not in (1, 2, 3, 9):
                self.lines.refuse(f"IBASE = {now['IBASE']}; allowed: 1, 2, 3, 9")
            now[block.name] = self.lines.array(block.name, count, block.factors(now), block.kind)
            fresh[block.name] = self.lines.number
        else:
            now["SUBS"] = self.subsurface()
            fresh["SUBS"] = self.lines.number

    def group(self, group: Group, now: dict[str, Any], fresh: dict[str, int]) -> None:
        """Read one group of values into `now`, and their lines into `fresh`."""
        self.lines.new_group()
        if group.fields[0].name == "IPOTCN":
            now.pop("IPOTCN", None)
        for field in group.fields:
            if not field.when(now):
                continue
            there, value = self.lines.take(field, now)
            if not there:
                value = field.default(now) if callable(field.default) else field.default
            if field.kind == "s":
                value = Path(os.path.normpath(self.file.parent / str(value)))
            now[field.name] = value
            fresh[field.name] = self.lines.number
            if field.name == "SPINYO" and not there and now["SPINXO"]:
                self.lines.doubted.append(f"line {self.lines.number}: SPINXO without SPINYO is not read")
                now["SPINXO"] = 0.0
            if field.name == "FKIN" and now["L"] == 0 and abs(value - now["FSTAT"]) > 1e-3 * now["FSTAT"]:
                self.lines.refuse(f"FKIN = {value:g} with L = 0; allowed: FSTAT = {now['FSTAT']:g}")
            if field.name == "IPOTCN" and value not in POTENTIAL:
                self.lines.refuse(f"IPOTCN = {value}; allowed: {', '.join(map(str, POTENTIAL))}")
        self.lines.new_group()

    def repeated(self, group: Group, now: dict[str, Any], fresh: dict[str, int], count: int) -> None:
        """Read a group `count` times; each name gets a tuple."""
        rows: list[dict[str, Any]] = []
        for _ in range(count):
            one = dict(now) if not rows else {**now, **rows[-1]}
            read: dict[str, int] = {}
            self.group(group, one, read)
            fresh.update(read)
            rows.append({name: one[name] for name in read})
        for name in rows[0]:
            now[name] = tuple(row[name] for row in rows)
        for name in ("ALPHA", "SVF"):
            column = now[name] if any(field.name == name for field in group.fields) else ()
            if any(b <= a for a, b in pairwise(column)):
                self.lines.refuse(f"{name} = {column} does not increase")

    def subsurface(self) -> tuple[dict[str, Any], ...]:
        """Read blocks of points below the surface."""
        blocks: list[dict[str, Any]] = []
        while True:
            block: dict[str, Any] = {}
            self.group(Group((i("ISUBS"),)), block, {})
            kind = block["ISUBS"]
            if kind <= 0:
                return tuple(blocks)
            if kind not in SUBSURFACE_TYPES:
                self.lines.refuse(f"ISUBS = {kind}; allowed: 0 or {', '.join(map(str, SUBSURFACE_TYPES))}")
            if len(blocks) == _MOST_BLOCKS:
                self.lines.refuse(f"more than {_MOST_BLOCKS} blocks of points below the surface")
            for part in SUBSURFACE:
                self.block(part, block, {})
            blocks.append(block)

    def check(self, module: int, digits: dict[str, int], values: dict[str, Any]) -> None:
        """Refuse a case that lacks something."""
        for letter, name in _NEEDED[module]:
            if name not in values:
                self.lines.refuse(f"{letter} = {digits[letter]} keeps what no case before has given: {name}")
        if module == 3 and values["IPOTCN"] > 0 and "UDB" not in values:
            self.lines.refuse(f"Z = {digits['Z']} keeps what no case before has given: the gap")


def _long_name(word: tuple[Digit, ...]) -> str:
    return "".join(digit.letter[0] for digit in word).replace("X", "", 1)
