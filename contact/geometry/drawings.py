"""Profiles in drawings (.dxf, by ezdxf) and workbooks (.xlsx, by openpyxl)."""

from __future__ import annotations

import datetime
import itertools
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from contact.errors import ContactError, optional
from contact.geometry.formats import Choice, Content, chosen, points_in
from contact.geometry.inspection import Fault, Finding, Points
from contact.reading.text import content

#: Of a drawing's extent: distance of points on long lines, what is long, chords off arcs, distance of ends that meet.
_SPACING, _LONG, _CHORD, _TOGETHER = 1 / 400, 1 / 30, 1e-6, 1e-4
_OWN = {1: "inch", 4: "mm", 5: "cm", 6: "m"}  # $INSUNITS of DXF


def dxf(path: Path, choice: Choice) -> Content:
    """DXF: lines, arcs, circles, ellipses, polylines and splines, joined where their ends meet.

    A drawing of several such lines has one chosen by `section`, the longest first.
    """
    ezdxf = optional("ezdxf", "DXF drawings need", "dxf")
    try:
        drawing = ezdxf.readfile(path)
    except (OSError, ezdxf.DXFError, ValueError, TypeError, KeyError, IndexError, StopIteration) as error:
        raise ContactError(f"path = {str(path)!r} is no DXF drawing: {error}") from None
    entities = list(_entities(drawing.modelspace()))
    ends = [_flat(entity, None) for entity in entities]
    if not any(map(len, ends)):
        raise ContactError(f"path = {str(path)!r} holds no lines, arcs, polylines or splines in its model space")
    extent = float(np.hypot(*np.ptp(np.concatenate(ends)[:, :2], axis=0)))
    if (rise := max(float(np.ptp(end[:, 2])) for end in ends if len(end))) > _TOGETHER * extent:
        raise ContactError(
            f"path = {str(path)!r} has lines that rise by {rise:.4g} out of the x-y plane of the drawing, from which y and z "
            "of the profile are read; turn them into this plane"
        )
    pieces = [found[:, :2] for entity in entities if len(found := _flat(entity, _CHORD * extent)) > 1]
    lines = sorted(_joined(pieces, _TOGETHER * extent), key=_length, reverse=True)
    told: tuple[Finding, ...] = ()
    if own := _OWN.get(int(drawing.header.get("$INSUNITS", 0))):
        seen = f"the drawing says that its unit is {own}"
        told = (Finding(Fault.FILE, seen, f"unit={own!r} reads it so", np.empty((0, 2))),)
    parts = []
    for line in lines:
        fine = _refined(line, _SPACING * float(np.hypot(*np.ptp(line, axis=0))))
        width, height = np.ptp(line, axis=0)
        parts.append((f"line {width:.4g} wide and {height:.4g} high", Content(fine, outwards=choice.side != "left")))
    return replace(chosen(parts, path, choice), told=told)


def own_unit(told: Iterable[Finding], unit: str | None) -> tuple[Finding, ...]:
    """Return the findings without that of a drawing's own unit, if it is the one given."""
    return tuple(finding for finding in told if finding.cure != f"unit={unit!r} reads it so")


def _entities(space: Any) -> Iterator[Any]:
    """Yield lines, arcs and splines; blocks and polylines as what they are made of."""
    for entity in space:
        if entity.dxftype() in ("INSERT", "LWPOLYLINE", "POLYLINE"):
            yield from _entities(entity.virtual_entities())
        elif entity.dxftype() in ("LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"):
            yield entity


def _flat(entity: Any, chord: float | None) -> Points:
    """Return points x, y, z of an entity, off its arcs by at most `chord`; a few points without it."""
    kind = entity.dxftype()
    if kind == "LINE":
        points = [entity.dxf.start, entity.dxf.end]
    elif kind == "SPLINE":
        tool = entity.construction_tool()
        points = list(tool.approximate(40) if chord is None else tool.flattening(chord, segments=16))
    elif kind == "ELLIPSE":
        points = list(entity.flattening(chord or 0.01 * entity.dxf.major_axis.magnitude))
    else:
        points = list(entity.flattening(chord or 0.01 * entity.dxf.radius))
    return np.array([tuple(point) for point in points], dtype=np.float64).reshape(-1, 3)


def _joined(pieces: list[Points], near: float) -> list[Points]:
    """Return the pieces joined end to end where their ends are `near` each other."""
    found, left = [], list(pieces)
    while left:
        line, grown = left.pop(0), True
        while grown:
            grown = False
            for k, piece in enumerate(left):
                for turned in (piece, piece[::-1]):
                    if np.hypot(*(turned[0] - line[-1])) <= near:
                        line, grown = np.concatenate((line, turned[1:])), True
                    elif np.hypot(*(turned[-1] - line[0])) <= near:
                        line, grown = np.concatenate((turned[:-1], line)), True
                    if grown:
                        break
                if grown:
                    del left[k]
                    break
        found.append(line)
    return found


def _length(points: Points) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _refined(points: Points, spacing: float) -> Points:
    """Return the points with others on long straight lines, which are no chords of arcs or curves."""
    parts = [points[:1]]
    for a, b in itertools.pairwise(points):
        length = float(np.hypot(*(b - a)))
        n = int(np.ceil(length / spacing)) if length > _LONG / _SPACING * spacing else 1
        parts.append(a + (b - a) * (np.arange(1, n + 1) / n)[:, None])
    return np.concatenate(parts)


def xlsx(path: Path, choice: Choice) -> Content:
    """Workbooks: the rows of a sheet as those of a file of columns. `section` is the number of the sheet with numbers."""
    openpyxl = optional("openpyxl", "workbooks need", "xlsx")
    if not content(path).startswith(b"PK"):
        raise ContactError(f"path = {str(path)!r} is no .xlsx workbook")
    try:
        book = openpyxl.load_workbook(path, read_only=True, data_only=True)
        sheets = [
            (sheet.title, [_cells(row) for row in sheet.iter_rows(values_only=True)]) for sheet in book.worksheets
        ]
        book.close()
    except (zipfile.BadZipFile, OSError, KeyError, ValueError, TypeError, AttributeError, SyntaxError) as error:
        raise ContactError(f"path = {str(path)!r} is no .xlsx workbook: {error}") from None
    first, last = choice.rows or (1, 0)
    parts = []
    for title, rows in sheets:
        if choice.columns is None:
            empty = min((next((k for k, cell in enumerate(row) if cell), 99) for row in rows if any(row)), default=0)
            rows = [row[empty:] for row in rows]
        lines = [(k, "\t".join(row)) for k, row in enumerate(rows, 1) if k >= first and (not last or k <= last)]
        if any(sum(map(str.isdigit, line)) > 1 for _, line in lines):
            points, told = points_in(lines, path, choice)
            parts.append((f"sheet {title!r}", Content(points, outwards=choice.side != "left", told=told)))
    if not parts:
        raise ContactError(f"path = {str(path)!r} holds no columns of numbers")
    return chosen(parts, path, choice)


def _cells(row: Iterable[Any]) -> list[str]:
    """Return the cells of a row as texts. Numbers keep all digits."""
    return [
        "" if cell is None
        else repr(cell) if isinstance(cell, int | float) and not isinstance(cell, bool)
        else cell.isoformat() if isinstance(cell, datetime.date | datetime.time)
        else str(cell).replace("\t", " ").replace("\n", " ")
        for cell in row
    ]  # fmt: skip
