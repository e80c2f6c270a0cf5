"""Read profile files, check what was measured, and put the points into the right-side convention.

==================  ==============  ==========================================================================================
suffix              kind            content of the file, and assumptions
==================  ==============  ==========================================================================================
.prw .prr           wheel, rail     Simpack. Unit and steps of the header are applied. The result is taken as the right side
                                    with z down, unless `side` is given.
.whl .ban           wheel, rail     MiniProf, in millimetres. The direction of z and the side of the flange or gauge corner are
                                    found from the shape. A wheel measured from the back of its flange is moved by 70 mm.
.mpt                `kind`          MiniProf with sections, otherwise as before. `kind` is required.
.whe .rai           wheel, rail     VAMPIRE, both sides in one file. `side` selects one; default right.
.wheel .rail        wheel, rail     GENSYS (KPF), in millimetres, y towards the track's centre.
.dxf                `kind`          Drawing: lines, arcs, polylines and splines, joined where they meet (needs ezdxf).
.xlsx               `kind`          Workbook: columns as below (needs openpyxl).
others              `kind`          Two or more columns y, z separated by blanks, tabs, semicolons, commas or bars, below some
                                    lines of text. `kind`, `unit` and `side` are required. The direction of z is found from
                                    the shape.
==================  ==============  ==========================================================================================

Decimal commas are recognised where another sign separates the columns. `contact.reading` reads the text:
encodings, typographic signs, remarks, headings. False and missing rows are left out and told.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np

from contact.errors import ContactError, ProfileWarning, require_flag, require_number
from contact.geometry import drawings, formats, inspection
from contact.geometry.inspection import FATAL, Fault
from contact.geometry.judgement import Inspection as Inspection
from contact.geometry.judgement import inspect_profile, judged
from contact.geometry.shape import Kind, Profile
from contact.reading.text import LARGEST_FILE as LARGEST_FILE
from contact.reading.text import require_file

Unit = Literal["m", "mm", "cm", "inch"]
Side = Literal["right", "left"]
Zero = Literal["file", "flange_back", "shape"]
UNITS: dict[str, float] = inspection.UNITS
KINDS, SIDES, ZEROS = ("wheel", "rail"), ("right", "left"), ("file", "flange_back", "shape")
MOST_POINTS = 100_000
READERS = formats.FORMATS | {
    ".dxf": formats.Format(drawings.dxf, complete=False, choices=("section",)),
    ".xlsx": formats.Format(drawings.xlsx, complete=False, choices=("columns", "rows", "section")),
}
_FARTHEST = 1e6  # of a point from the origin [m]; products of larger numbers overflow


def read(
    path: str | PathLike[str],
    *,
    kind: Kind | None = None,
    unit: Unit | None = None,
    side: Side | None = None,
    zero: Zero | float | None = None,
    scale: float = 1.0,
    columns: Sequence[int] | None = None,
    rows: Sequence[int] | None = None,
    section: int | str | None = None,
    repair: bool = False,
    smoothing: float | None = None,
    wavelength: float | None = None,
) -> Profile:
    """Return the profile in a file, in the right-side convention.

    Scenarios have these options in their table `profiles`, the command line as ``--profile-unit`` and so on.

    Parameters
    ----------
    path : path-like
        File; its suffix tells the format.
    kind : {"wheel", "rail"}, optional
        Required for plain columns; otherwise it must agree with the suffix.
    unit : {"m", "mm", "cm", "inch"}, optional
        Unit of length. Required for plain columns; otherwise it replaces the format's own unit.
    side : {"right", "left"}, optional
        Side that the file shows, seen from behind with y to the right. A left side is mirrored. Required for plain columns.
    zero : {"file", "flange_back", "shape"} or float, optional
        Where y = 0, z = 0 lies. "file": where the file has it, which for wheels must be the tape circle. "flange_back": y of
        a wheel counts from the back of its flange, 70 mm from the tape circle. A number: as before, at this distance [m].
        "shape": found from the shape. A wheel's tape circle lies 55 mm outside the flange's tip, on the tread; a rail's zero
        36 mm outside its gauge face, at the height of its top. Default "file", for MiniProf wheels measured from the back of
        the flange "flange_back". The gauge of the track places a rail, wherever its zero is.
    scale : float
        Scale of a model, 0.01 to 2, like 0.2 for a roller rig of 1:5. The profile keeps the size of the file. The lengths
        above and those of the checks are multiplied by it.
    columns : tuple of int, optional
        Columns of y and z, from 1. By default the first two, or the two after a column that counts the rows.
    rows : tuple of int, optional
        First and last line that is read, from 1; 0 as the last is the end.
    section : int or "joined", optional
        For files with several lists of points (.mpt, .dxf, .xlsx): the number of one, from 1, or all joined end to end.
    repair : bool
        Sort rows, keep one of several scans, drop points that step back and spikes.
    smoothing : float, optional
        Noise of the measurement [m], root mean square, to be removed by a smoothing spline (needs scipy). By default the
        curve goes through every point.
    wavelength : float, optional
        Instead of `smoothing`: waves of this length along the profile [m] are halved, shorter ones are removed and longer ones
        are kept (needs scipy).

    Returns
    -------
    Profile

    Raises
    ------
    ContactError
        If the file is missing, cannot be read, holds no profile or contradicts `kind`; for missing or unknown arguments; for
        a line with digits that is no point; for a profile narrower than 1 mm or wider than 200 mm, as from a wrong unit; for
        the shape of the other kind, a wheel with a flange as "rail" or a rail's head as "wheel"; for a wheel with its flange
        on the field side; for rows that are not in order, and several scans, without `repair`; for files above 20 MB.

    Warns
    -----
    ProfileWarning
        For rows and parts that were left out, spikes, gaps, kinks, back steps, noise that spoils the tangents, and offsets
        of height and side. `check` returns all of them.

    Notes
    -----
    False and missing rows (NaN, empty cells, 0 0, -999 -999 beside the profile) are always left out. The outline of a whole
    rail is cut to its head.

    The contact depends on tangents and curvatures, which are far noisier than points. An example is S1002 with points
    0.25 mm apart and 2 µm of noise. Without smoothing the root mean square errors are 9.6 mrad and 62 1/m. With
    ``smoothing=2e-6`` they are 1.6 mrad and 3.9 1/m, with half of it 6.4 mrad and 36 1/m, with twice as much 3.6 mrad and
    5.4 1/m; in the last case the points are 3.5 µm off.
    """
    found = inspect(
        path, kind=kind, unit=unit, side=side, zero=zero, scale=scale, columns=columns, rows=rows, section=section,
        repair=repair, smoothing=smoothing, wavelength=wavelength,
    )  # fmt: skip
    for finding in found.findings:
        if found.profile is None and finding.fault in (*FATAL, Fault.OUTLINE):
            raise ContactError(f"path = {str(path)!r}: {finding}")
    for finding in found.findings:
        warnings.warn(f"{Path(path).name}: {finding}", ProfileWarning, stacklevel=2)
    assert found.profile is not None
    return found.profile


def check(given: Profile | str | PathLike[str], **options: Any) -> Inspection:
    """Return what is wrong with a profile or a profile file: spikes, gaps, kinks, scans, noise, offsets.

    Print the result to see the findings, each with the option of `read` that cures it. `contact.plot.profile_check` draws it,
    as ``contact check FILE --out check.png`` does on the command line.

    Parameters
    ----------
    given : Profile or path-like
    **options
        As for `read`, for a file.

    Returns
    -------
    Inspection

    Raises
    ------
    ContactError
        As `read`, except for points that are no curve: then the result has no profile.
    """
    return inspect_profile(given) if isinstance(given, Profile) else inspect(given, **options)


def inspect(
    path: str | PathLike[str],
    *,
    kind: Kind | None = None,
    unit: Unit | None = None,
    side: Side | None = None,
    zero: Zero | float | None = None,
    scale: float = 1.0,
    columns: Sequence[int] | None = None,
    rows: Sequence[int] | None = None,
    section: int | str | None = None,
    repair: bool = False,
    smoothing: float | None = None,
    wavelength: float | None = None,
) -> Inspection:
    """Return the points of a file, what is wrong with them, and their profile. The options are those of `read`."""
    path = Path(path)
    datum = _as_zero(zero)
    for name, value, allowed in (
        ("unit", unit, UNITS),
        ("side", side, SIDES),
        ("kind", kind, KINDS),
    ):
        if value is not None and value not in allowed:
            raise ContactError(f"{name} = {value!r} is none of {', '.join(map(repr, allowed))}")
    if smoothing is not None and wavelength is not None:
        raise ContactError(f"smoothing = {smoothing:g} and wavelength = {wavelength:g} exclude each other")
    scale, repair = require_number("scale", scale, 0.01, 2.0), require_flag("repair", repair)
    choice = formats.as_choice(side or "", columns, rows, section)
    known = READERS.get(path.suffix.lower(), formats.COLUMNS)
    if kind is not None and known.kind not in (None, kind):
        raise ContactError(f"kind = {kind!r}, but {path.name!r} is a file of a {known.kind}")
    for name in ("columns", "rows", "section"):
        if (value := getattr(choice, name)) is not None and name not in known.choices:
            raise ContactError(f"{name} = {value!r}: a file like {path.name!r} has no choice of {name}")
    if path.is_dir():
        raise ContactError(f"path = {str(path)!r} is a folder; profile.read_folder reads all its files")
    require_file(path)
    kind = known.kind or kind
    needed = (("kind", kind, KINDS), *(() if known.complete else (("unit", unit, UNITS), ("side", side, SIDES))))
    unknown = {name: allowed for name, value, allowed in needed if value is None}
    if kind is None or unknown:
        raise ContactError(
            f"{', '.join(f'{name} = None' for name in unknown)}: {path.name!r} does not say its {', '.join(unknown)}; give "
            + ", ".join(f"{name} {' or '.join(map(repr, allowed))}" for name, allowed in unknown.items())
        )
    content = known.read(path, choice)
    size = UNITS[unit] if unit else content.unit or 1.0
    if unit:  # the user says it, not the format
        content = replace(content, unit=None, told=drawings.own_unit(content.told, unit))
    if not 0 < len(content.points) <= MOST_POINTS:
        raise ContactError(f"path = {str(path)!r} holds {len(content.points)} points; allowed: 1 to {MOST_POINTS}")
    measured = content.points * size
    if not (np.abs(measured) < _FARTHEST).all():
        raise ContactError(f"path = {str(path)!r}: a point is not within {_FARTHEST:g} m")
    return judged(measured, content, kind, path, size, datum, scale, repair, smoothing, wavelength)


def _as_zero(zero: Any) -> str | float | None:
    """Return the option `zero`: None, one of `ZEROS`, or a distance [m], also from the text of a command line."""
    if zero is None or zero in ZEROS:
        return zero
    try:
        distance = float(zero)
    except (TypeError, ValueError):
        raise ContactError(f"zero = {zero!r} is none of {', '.join(map(repr, ZEROS))}, and no distance in m") from None
    return require_number("zero", distance, 1e-3, 0.2)


def read_folder(
    folder: str | PathLike[str], pattern: str = "*", *, skip: bool = False, **options: Any
) -> dict[str, Profile]:
    """Return file name → profile for the files of a folder, in alphabetical order.

    Parameters
    ----------
    folder : path-like
    pattern : str
        Files to read, like ``"*.whl"``.
    skip : bool
        Leave out files that cannot be read, with a warning. Otherwise the first of them raises the error.
    **options
        As for `read`.

    Raises
    ------
    ContactError
        If there is no such folder or no such file in it, and as `read`.
    """
    place = Path(folder)
    if not place.is_dir():
        raise ContactError(f"folder = {str(folder)!r} {'is no folder' if place.exists() else 'is missing'}")
    paths = sorted(path for path in place.glob(pattern) if path.is_file() and not path.name.startswith("."))
    if not paths:
        raise ContactError(f"folder = {str(folder)!r} holds no file {pattern!r}")
    found = {}
    for path in paths:
        try:
            found[path.name] = read(path, **options)
        except ContactError as error:
            if not skip:
                raise
            warnings.warn(f"left out: {error}", ProfileWarning, stacklevel=2)
    return found
