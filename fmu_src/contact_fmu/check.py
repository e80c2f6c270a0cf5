"""`contact fmu-check`: compare what a tool wrote with the validation set of an FMU."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
import typer

from contact.arrays import Array
from contact.cli.output import reported, stop
from contact.errors import ContactError
from contact.reading.columns import Dialect, number

#: A unit in brackets after a name; an index has no letters.
_UNIT = re.compile(r"\s*[\[(][^\[\]()]*[A-Za-z%°][^\[\]()]*[\])]$")


class Found(NamedTuple):
    """Lines of a comparison, and whether the result is that of the reference."""

    lines: list[str]
    agrees: bool


@reported
def fmu_check(
    result: Annotated[Path, typer.Argument(help="Text file that the tool wrote: a heading, then a row for each time.")],
    *,
    reference: Annotated[
        Path | None, typer.Option(help="Folder of the validation set. Default: that of the result.")
    ] = None,
) -> None:
    """Compare the result of a tool with the validation set of an FMU. The exit status is 1 if they differ.

    Columns may be in any order, with prefixes such as "fmu." and units in brackets.

    Example:  contact fmu-check result.csv --reference validation/native/fmi2/cs/WheelRailPair
    """
    found = compare(result, reference or result.parent)
    for line in found.lines:
        typer.echo(line)
    if not found.agrees:
        stop(f"{result.name} is not the reference", 1)


def compare(result: Path, folder: Path) -> Found:
    """Compare a result with the validation set in a folder.

    Raises
    ------
    ContactError
        If one of them cannot be read, or the result has other times.
    """
    (path,) = _one(folder)
    time, reference = read(path)
    with (folder / "tolerances.csv").open(encoding="utf-8", newline="") as rows_of_file:
        tolerances = dict(csv.reader(rows_of_file))
    more = path.with_name(path.name.replace("_ref.csv", "_arrays.csv"))
    arrays = read(more)[1] if more.is_file() else {}
    there, columns = read(result)
    rows = _rows(result, there, time)
    lines, wrong, missing, without, equal = [], 0, [], 0, 0
    for name, wanted in {**reference, **arrays}.items():
        column = _column(name, columns, result)
        if column is None and name in arrays:
            without += 1
            continue
        if column is None:
            missing.append(name)
            continue
        values = columns[column][rows]
        if not np.isfinite(values).all():
            lines.append(f"{name}: no number at {time[int(np.argmin(np.isfinite(values)))]:g} s; not compared")
            wrong += 1
            continue
        allowed = float(tolerances[name])
        if (difference := np.abs(values - wanted)).max() <= allowed:
            equal += 1
            continue
        at, wrong = int(np.argmax(difference)), wrong + 1
        why = _reason(values, wanted, allowed)
        lines.append(f"{name}: {values[at]:g} at {time[at]:g} s for {wanted[at]:g}, tolerance {allowed:.2g}{why}")
    if missing:
        lines.append(f"missing: {', '.join(missing)}")
    if without:
        lines.append(f"not compared: {without} elements of arrays, of which {result.name} has no columns")
    lines.append(f"{equal} of {len(reference) + len(arrays) - without} outputs agree with {path}")
    return Found(lines, not wrong and not missing)


def _one(folder: Path) -> list[Path]:
    found = sorted(folder.glob("*_ref.csv")) if folder.is_dir() else []
    if len(found) != 1 or not (folder / "tolerances.csv").is_file():
        raise ContactError(f"--reference {folder} is no validation set: it needs one file …_ref.csv and tolerances.csv")
    return found


def read(path: Path) -> tuple[Array, dict[str, Array]]:
    """Return the times and the columns of a text file.

    The separator is a comma, semicolon or tab; with the last two the decimal sign may be a comma.

    Raises
    ------
    ContactError
        If it is no such file.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ContactError(f"{path.name} cannot be read: {error}") from None
    lines = [line for line in text.splitlines() if line.strip()]
    if len(lines) < 3:
        raise ContactError(f"{path.name} has {len(lines)} lines; a heading and at least two rows are needed")
    separator = next((sign for sign in "\t;" if sign in lines[0]), ",")
    dialect = Dialect(separator, comma=separator != ",")
    heading = [
        re.sub(r"\s*[\[(][^\[\]()]*[A-Za-z/%°^*. ]+[^\[\]()]*[\])]\s*$", "", c.strip()) for c in dialect.cells(lines[0])
    ]
    table = []
    for k, line in enumerate(lines[1:], 2):
        cells = dialect.cells(line)
        if len(cells) != len(heading):
            raise ContactError(f"{path.name}, line {k}: {len(cells)} values under {len(heading)} names")
        table.append([number(cell, dialect.comma) for cell in cells])
    names = [re.sub(r"^.*[./:|\\]", "", name).strip().lower() for name in heading]
    if "time" not in names and "t" not in names:
        raise ContactError(f"{path.name} has no column time; its columns: {', '.join(heading[:8])} …")
    at = names.index("time") if "time" in names else names.index("t")
    rows = np.array(table, dtype=np.float64)  # None, of what is no number, is NaN
    if not np.isfinite(rows[:, at]).all():
        raise ContactError(f"{path.name}: a time is no number")
    return rows[:, at], {name: rows[:, k] for k, name in enumerate(heading) if k != at}


def _rows(path: Path, there: Array, time: Array) -> Array:
    """Return the rows of the result at the times of the reference, of several the last one."""
    step = time[1] - time[0]
    near = 1e-3 * step + 2.0**-23 * np.abs(time)
    rows = np.searchsorted(there, time + near, side="right") - 1
    if np.any(np.diff(there) < 0.0):
        raise ContactError(f"{path.name}: the times do not increase")
    lacking = (rows < 0) | (np.abs(there[rows] - time) > near)
    if lacking.any():
        raise ContactError(
            f"{path.name} has other times: {np.count_nonzero(lacking)} of {len(time)} are missing, the first at "
            f"{time[int(np.argmax(lacking))]:g} s. It has {len(there)} rows from {there[0]:g} to {there[-1]:g} s, the "
            f"reference one every {step:g} s from {time[0]:g} to {time[-1]:g} s. Write the outputs at these times; nothing "
            "was compared"
        )
    return rows


def _plain(name: str) -> str:
    return re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")


def _column(name: str, columns: dict[str, Array], path: Path) -> str | None:
    """Return the column of an output: with its name, with a prefix, or with other signs in place of dots and brackets."""
    if name in columns:
        return name
    ends = [one for one in columns if re.search(rf"[./:|\\]{re.escape(name)}$", one)]
    ends = ends or [one for one in columns if _plain(one) == _plain(name)]
    ends = ends or [one for one in columns if _plain(one).endswith(f"_{_plain(name)}")]
    if len(ends) > 1:
        shortest = sorted(ends, key=len)
        if len(shortest[0]) == len(shortest[1]):
            raise ContactError(f"{path.name}: {name} may be {' or '.join(shortest[:2])}; leave only one of them")
        ends = shortest
    return ends[0] if ends else None


def _reason(values: Array, wanted: Array, allowed: float) -> str:
    """Return what the difference looks like, if it is one of those that wrong imports make."""
    if np.abs(values + wanted).max() <= allowed:
        return "; the sign is the other one"
    for shift, words in ((1, "later"), (-1, "earlier")):
        if np.abs(np.roll(values, -shift) - wanted)[2:-2].max(initial=0.0) <= allowed:
            return f"; the same one step {words}: outputs or inputs are taken at the other end of a step"
    for factor in (1e3, 1e-3):
        if np.abs(values * factor - wanted).max() <= allowed:
            return f"; times {factor:g} it agrees: another unit"
    return ""
