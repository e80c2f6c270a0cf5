"""Numbers in lines of text: separators, decimal commas, quotes, D exponents, remarks, headings, missing values.

`rows_of` gives the points of profiles, `table` the named columns of signals and series.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.reading.beside import second_profile
from contact.reading.text import lines_of

LARGEST_SERIES = 200e6  # bytes
_SHOWN = 60  # letters of a line in a message
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdDqQ][+-]?\d+)?")
_MISSING = re.compile(
    r"|[-*?.]+|[+-]?(?:nan|inf|infinity)|-?nan\(.*\)|[+-]?1\.#\w+|n/?a|null|none|nil|missing|#[\w/]+[!?]?",
    re.IGNORECASE,
)
#: A cell that a number may be meant by.
_NEARLY = re.compile(r"[+-]?[.,']?\d\S*")
_DATE = re.compile(r"\d{1,4}([-./])\d{1,2}\1\d{1,4}.*|\d{1,2}:\d{2}.*|\d{1,2}\.?-?[A-Za-z]{3,9}-?\.?\d{2,4}")
#: What begins a remark; not the # of spreadsheets' #N/A and of 1.#QNAN.
_REMARK = re.compile(r"[!%]|(?<!1\.)#(?!(?:N/A|NV|NUM|DIV/0|VALUE|REF|WERT|NAME|NULL|ZAHL|BEZUG)\b)")
_QUOTED = re.compile(r'\s*"([^"]*)"\s*')
_EXPONENT = re.compile(r"(?<=[\d.])[eEdDqQ](?=[+-]?\d)")
_DECIMAL = re.compile(r"\d*[.,]\d")


def number(word: str, comma: bool = False) -> float | None:
    """Return the number in a cell; NaN if its value is missing or not finite; None if it is no number."""
    word = word.strip()
    plain_word = word.replace(",", ".") if comma and "." not in word and word.count(",") == 1 else word
    if _NUMBER.fullmatch(plain_word):
        value = float(re.sub("[dDqQ]", "e", plain_word))
        return value if math.isfinite(value) else math.nan
    return math.nan if _MISSING.fullmatch(word) else None


class Dialect(NamedTuple):
    """How the cells of a row are separated, and whether a decimal comma is used."""

    separator: str
    comma: bool = False

    def cells(self, text: str) -> list[str]:
        """Return the cells of a line."""
        if self.separator == r"\|":
            text = text.strip().strip("|")
        elif self.separator == r"\s+":
            text = text.strip()
        elif '"' in text:
            return [found.strip().strip('"').strip() for found in _split_quoted(text, self.separator)]
        return [cell.strip().strip('"').strip() for cell in re.split(self.separator, text.strip(" "))]


_DIALECTS = (
    Dialect("\t"),
    Dialect("\t", True),
    Dialect(";"),
    Dialect(";", True),
    Dialect(r"\|"),
    Dialect(r"\|", True),
    Dialect(r",\s+", True),
    Dialect(","),
    Dialect(r"\s+"),
    Dialect(r"\s+", True),
)
#: Any separator, even in one row; a decimal comma would be one too.
_MIXED = Dialect(r"\s*[,;\s]\s*")


def _split_quoted(text: str, separator: str) -> list[str]:
    """Split at separators outside quotes."""
    found, start, inside = [], 0, False
    for place in re.finditer(f'"|{separator}', text):
        if place[0] == '"':
            inside = not inside
        elif not inside:
            found.append(text[start : place.start()])
            start = place.end()
    return [*found, text[start:]]


def dialect_of(texts: Sequence[str], columns: Sequence[int] = (0, 1)) -> Dialect:
    """Return the dialect in which most rows have numbers in the `columns`."""
    sample = texts if len(texts) <= 400 else [*texts[:100], *texts[100 :: max(1, len(texts) // 300)]]

    whole = "\n".join(sample)

    def score(dialect: Dialect) -> tuple[int, int]:
        separated = max(columns) == 0 or re.search(dialect.separator, whole)
        if not separated or (dialect.comma and "," not in whole):  # the same without a decimal comma comes first
            return 0, 0
        rows = [[number(cell, dialect.comma) for cell in dialect.cells(text)] for text in sample]
        good = [
            row
            for row in rows
            if len(row) > max(columns) and all(row[k] is not None and row[k] == row[k] for k in columns)
        ]
        return len(good), sum(all(value is not None for value in row) for row in good)

    scores = {dialect: score(dialect) for dialect in _DIALECTS}
    best = max(_DIALECTS, key=scores.__getitem__)  # of equals the first
    few = 2 * scores[best][0]
    return _MIXED if few < len(sample) and score(_MIXED)[0] > few else best


def without_remark(line: str, quotes: bool) -> str:
    """Return a line without its remark, which #, ! or % begins; and a quote too, if `quotes` says so or it has no partner."""
    place = _REMARK.search(line)
    line = line[: place.start()] if place else line
    if '"' in line and (quotes or line.count('"') % 2):
        line = line.split('"')[0]
    if (whole := _QUOTED.fullmatch(line)) and not quotes:  # the whole row in quotes
        line = whole[1]
    return line.strip(" ")


@dataclass(frozen=True)
class Rows:
    """Rows of two numbers, in the order of the file.

    Attributes
    ----------
    values : ndarray, shape (n, 2)
        NaN where a value is missing.
    lines : list of (int, str)
        Their numbers and texts in the file.
    told : tuple of (str, str)
        What was left out of the file or chosen in it, and the option that chooses otherwise.
    """

    values: Array
    lines: list[tuple[int, str]]
    told: tuple[tuple[str, str], ...] = ()


class Line(NamedTuple):
    """A line: its number, its text without remark, and what it holds.

    `values` are the two of a row, NaN where one is missing; None if the line is no row. `words` says whether words follow
    them, `numbers` counts the cells with numbers, `nearly` says that both cells of a point may be meant as numbers.
    """

    number: int
    text: str
    values: tuple[float, float] | None = None
    words: bool = False
    numbers: int = 0
    nearly: bool = False

    @property
    def whole(self) -> bool:
        """Whether both values are there."""
        return self.values is not None and self.values == self.values and all(map(math.isfinite, self.values))


_MOST_ROWS, _MOST_LINES = 8, 10  # of numbers above the last words of a heading, and of words with two numbers or more


def rows_of(
    numbered: Iterable[tuple[int, str]],
    where: str,
    *,
    quotes: bool = False,
    heading: bool = True,
    columns: tuple[int, int] | None = None,
    needed: int = 2,
) -> Rows:
    """Return the rows of numbers in some lines.

    Parameters
    ----------
    numbered : iterable of (int, str)
        Numbers and texts of the lines.
    where : str
        Beginning of messages, like "path = 'a.txt'".
    quotes : bool
        Whether a quote begins a remark, as in files of MiniProf and Simpack.
    heading : bool
        Whether lines of text may stand above the rows.
    columns : tuple of int, optional
        Columns of y and z, from 1. By default the first two, or the next two after an index.
    needed : int
        Least number of cells in a row.

    Raises
    ------
    ContactError
        For lines with digits that are neither a row nor part of a heading; the message has number and content of the line.
    """
    given = [(k, bare) for k, line in numbered if (bare := without_remark(line, quotes)).strip() or not line.strip()]
    told: list[tuple[str, str]] = []
    texts = [text for _, text in given if any(map(str.isdigit, text))]
    chosen = (0, 1) if columns is None else (columns[0] - 1, columns[1] - 1)
    dialect = dialect_of(texts, chosen)
    if columns is None and _counted(texts, dialect):
        chosen = (1, 2)
        told.append(
            ("the first column counts the rows; y and z were read from columns 2 and 3", "columns=(2, 3) says so")
        )
    some = [[number(cell, dialect.comma) for cell in dialect.cells(text)] for text in texts[:: len(texts) // 400 + 1]]
    if columns is None and not quotes and (other := second_profile(some, chosen)):
        seen = "columns {} and {} may be a second profile; y and z were read from columns {} and {}"
        told.append((seen.format(*other, chosen[0] + 1, chosen[1] + 1), f"columns={other}"))
    lines = [_line(k, text, dialect, chosen) for k, text in given]
    if not any(line.whole for line in lines):
        first = next((line for line in lines if any(map(str.isdigit, line.text))), None)
        seen = f"; the first line with digits is line {first.number}: {_short(first.text)!r}" if first else ""
        raise ContactError(f"{where} holds no columns of numbers{seen}")
    start = _start(lines, where) if heading else 0
    above = [line for line in lines[:start] if line.values is not None and not line.words]
    if above:
        which = ", ".join(str(line.number) for line in above)
        words = f"the words in line {lines[start - 1].number}"
        seen = f"the numbers in line {which}, like {_short(above[0].text)!r}, stand above {words}"
        told.append((seen, "they were left out as part of the heading; rows=(first, last) chooses lines"))
    kept = []
    for line in lines[start:]:
        if line.values is not None:
            _require_clear_commas(line, dialect, where)
            if needed > 2 and len(dialect.cells(line.text)) < needed:
                raise ContactError(f"{where}, line {line.number}: {_short(line.text)!r} is not a point y, z")
            kept.append(line)
        elif line.text:
            raise ContactError(f"{where}, line {line.number}: {_short(line.text)!r} is not a point y, z")
    values = np.array([line.values for line in kept], dtype=np.float64).reshape(-1, 2)
    return Rows(values, [(line.number, _short(line.text)) for line in kept], tuple(told))


def _line(k: int, text: str, dialect: Dialect, columns: tuple[int, int]) -> Line:
    cells = dialect.cells(text)
    if not any(cells):
        return Line(k, "")
    values = [number(cell, dialect.comma) for cell in cells]
    y, z = (values[c] if c < len(cells) else math.nan for c in columns)
    numbers = sum(value is not None and math.isfinite(value) for value in values)
    if y is not None and z is not None:
        return Line(k, text, (y, z), any(value is None for value in values), numbers)
    there = [cells[c] if c < len(cells) else "" for c in columns]
    nearly = all(_NEARLY.fullmatch(cell) and not _DATE.fullmatch(cell) for cell in there)
    return Line(k, text, None, True, numbers, nearly or _of_decimals(text))


def _of_decimals(text: str) -> bool:
    """Return whether a line without letters has two decimal points or more: numbers run together, or in brackets."""
    bare = _EXPONENT.sub("", text.strip())
    return not (any(map(str.isalpha, bare)) or _DATE.fullmatch(bare)) and len(_DECIMAL.findall(bare)) > 1


def _start(lines: list[Line], where: str) -> int:
    """Return the index of the first line below the heading."""
    start = above = 0
    left = sum(line.whole for line in lines)
    wordy = []
    for i, line in enumerate(lines):
        if line.whole:
            above, left = above + 1, left - 1
            if above > _MOST_ROWS:
                break
        elif line.values is None and line.text:
            if left < max(4, above + 1):
                break
            if line.nearly:
                raise ContactError(f"{where}, line {line.number}: {_short(line.text)!r} is not a point y, z")
            start = i + 1
            wordy += [line] if line.numbers > 1 else []
            if len(wordy) > _MOST_LINES:
                seen = f"line {wordy[0].number}: {_short(wordy[0].text)!r}"
                raise ContactError(f"{where}, {seen} and {len(wordy) - 1} more lines with numbers are not points y, z")
        elif not above and line.text and (line.numbers == 1 or not any(map(str.isalnum, line.text))):
            start = i + 1  # a single number, or a ruled line
    above = 0
    for i in range(start, len(lines) - 1):  # numbers with words above an empty line, as in old files of MiniProf
        above += lines[i].whole
        if above > _MOST_ROWS:
            break
        if lines[i].whole and lines[i].words and not lines[i + 1].text:
            start = i + 2
    return start


def _counted(texts: Sequence[str], dialect: Dialect) -> bool:
    """Return whether the first of at least three columns counts the rows, and the second runs along a profile."""
    rows = [cells for text in texts if len(cells := dialect.cells(text)) > 2 and cells[0].isdigit()]
    if len(rows) < max(8, 0.9 * len(texts) - 4):
        return False
    step = np.diff([int(cells[0]) for cells in rows[:100_000] if len(cells[0]) < 10])
    along = [value for cells in rows if (value := number(cells[1], dialect.comma)) is not None and value == value]
    third = [number(cells[2], dialect.comma) is not None for cells in rows]
    forwards = np.sign(np.diff(along))
    return bool(
        step.size and np.median(step) == 1 and np.mean(step == 1) > 0.9 and np.mean(third) > 0.9
        and int(rows[0][0]) in (0, 1) and abs(forwards.mean()) > 0.8
    )  # fmt: skip


def _require_clear_commas(line: Line, dialect: Dialect, where: str) -> None:
    """Raise a ContactError for a row like 1,5,2,5, which may be two or four numbers."""
    word = line.text.strip(", ")
    if dialect.separator == "," and word.count(",") in (3, 5) and re.fullmatch(r"[+-]?\d+(,[+-]?\d+)+", word):
        raise ContactError(
            f"{where}, line {line.number}: {_short(line.text)!r}: commas may be decimal or separate columns; separate the "
            f"columns by semicolons or blanks"
        )


def _short(text: str) -> str:
    return text.strip()[:_SHOWN]


class Table(NamedTuple):
    """Columns of numbers below a line of names. `names` is empty if the first line holds numbers."""

    names: list[str]
    values: Array


def table(path: str | PathLike[str], name: str = "path") -> Table:
    """Return the columns of numbers in a file: a line of names, then lines of as many numbers.

    Blanks, tabs, semicolons or commas separate the columns. Lines that begin with # are remarks.

    Raises
    ------
    ContactError
        If the file cannot be read, for a name that stands twice, and for a row with other than one number for each name. The
        message has number and content of the line.
    """
    where = f"{name} = {str(path)!r}"
    given = lines_of(path, name, LARGEST_SERIES)
    lines = [(k, line) for k, line in enumerate(given, 1) if line.strip() and line.strip()[0] != "#"]
    if not lines:
        raise ContactError(f"{where} holds no columns of numbers")
    body = [line for _, line in lines[1:]] or [lines[0][1]]
    dialect = _dialect_of_table(lines[0][1], body[:400])
    head = dialect.cells(lines[0][1])
    names = head if any(number(cell, dialect.comma) is None for cell in head) else []
    twice = next((name for name in names if name and names.count(name) > 1), "")
    if twice:
        raise ContactError(f"{where}, line {lines[0][0]}: the name {twice!r} stands over {names.count(twice)} columns")
    if (quick := _quickly([line for _, line in lines[1 if names else 0 :]], dialect, len(head))) is not None:
        return Table(names, quick)
    rows = []
    for k, line in lines[1:] if names else lines:
        cells = dialect.cells(line)
        if len(cells) != len(head):
            kind = "names" if names else "columns"
            raise ContactError(f"{where}, line {k}: {_short(line)!r} has {len(cells)} values for {len(head)} {kind}")
        values = [number(cell, dialect.comma) for cell in cells]
        for column, value in enumerate(values):
            if value is None or value != value:
                which = names[column] if names else f"column {column + 1}"
                raise ContactError(f"{where}, line {k}: {which} = {cells[column][:_SHOWN]!r} is not a finite number")
        rows.append(values)
    return Table(names, np.array(rows, dtype=np.float64).reshape(len(rows), len(head)))


def _quickly(lines: Sequence[str], dialect: Dialect, n: int) -> Array | None:
    """Return the numbers in lines of plain numbers, which long series have; None if they are not all of that kind."""
    signs = {"\t": "\t", ";": ";", ",": ",", r"\s+": None}
    if dialect.comma or dialect.separator not in signs or not lines:
        return None
    try:
        found = np.loadtxt(lines, delimiter=signs[dialect.separator], ndmin=2, comments=None)
    except ValueError:
        return None
    return found if found.shape == (len(lines), n) and np.isfinite(found).all() else None


def _dialect_of_table(head: str, body: Sequence[str]) -> Dialect:
    """Return the dialect in which most lines have a number for each cell of the first line."""

    def score(dialect: Dialect) -> int:
        rows = [dialect.cells(line) for line in body] if (n := len(dialect.cells(head))) > 1 else []
        return sum(len(row) == n and all(number(cell, dialect.comma) is not None for cell in row) for row in rows)

    best = max(_DIALECTS, key=score)
    if score(best):
        return best
    return Dialect(next((sign for sign in "\t;," if sign in head), r"\s+"))
