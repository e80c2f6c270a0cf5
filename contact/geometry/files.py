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
others              `kind`          Two or more columns y, z separated by blanks, semicolons or commas, after any lines of text.
                                    `kind`, `unit` and `side` are required. The direction of z is found from the shape.
==================  ==============  ==========================================================================================

A point less than a micrometre from the previous one is dropped, because the tangent between them would be noise. Decimal
commas are recognised where blanks or semicolons separate the columns.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from contact.errors import ContactError, ProfileWarning
from contact.geometry import formats, inspection
from contact.geometry.formats import Content, Points
from contact.geometry.inspection import FATAL, Finding
from contact.geometry.profile import SIDES, UNITS, ZEROS, Kind, Profile
from contact.geometry.smoothing import filtered, smoothed

NEAREST = 1e-6  # least distance of two points [m]
NARROWEST, WIDEST = 0.03, 0.2  # range of the width of a wheel or a rail's head [m]
LARGEST_FILE, MOST_POINTS = 20e6, 100_000  # bytes, points
_FARTHEST = 1e6  # of a point from the origin [m]; products of larger numbers overflow


@dataclass(frozen=True, eq=False)
class Inspection:
    """What `check` found. Printed, it lists the findings; `contact.plot.profile_check` draws it.

    Attributes
    ----------
    name : str
    kind : {"wheel", "rail"}
    points : ndarray, shape (n, 2)
        y, z as measured, in the right-side convention, in the order of the rows [m].
    findings : tuple of contact.geometry.inspection.Finding
    profile : Profile or None
        The profile that `read` gives; None if the points are no curve.
    """

    name: str
    kind: Kind
    points: Points
    findings: tuple[Finding, ...]
    profile: Profile | None

    def __str__(self) -> str:
        head = f"{self.name}: {self.kind}, {len(self.points)} points"
        return "\n".join(
            [head, *(f"  {finding}" for finding in self.findings)] if self.findings else [f"{head}, nothing found"]
        )


def read(path: str | PathLike[str], **options: Any) -> Profile:
    """Return the profile in a file. See `contact.geometry.profile.read`."""
    found = inspect(path, **options)
    for finding in found.findings:
        if found.profile is None and finding.fault in FATAL:
            raise ContactError(f"path = {str(path)!r}: {finding}")
    for finding in found.findings:
        warnings.warn(f"{Path(path).name}: {finding}", ProfileWarning, stacklevel=3)
    assert found.profile is not None
    return found.profile


def inspect(
    path: str | PathLike[str],
    *,
    kind: Kind | None = None,
    unit: str | None = None,
    side: str | None = None,
    zero: str | None = None,
    repair: bool = False,
    smoothing: float | None = None,
    wavelength: float | None = None,
) -> Inspection:
    """Return the points of a file, what is wrong with them, and their profile. See `contact.geometry.profile.check`."""
    path = Path(path)
    for name, value, allowed in (
        ("unit", unit, UNITS),
        ("side", side, SIDES),
        ("zero", zero, ZEROS),
        ("kind", kind, ("wheel", "rail")),
    ):
        if value is not None and value not in allowed:
            raise ContactError(f"{name} = {value!r} is none of {', '.join(map(repr, allowed))}")
    if smoothing is not None and wavelength is not None:
        raise ContactError(f"smoothing = {smoothing:g} and wavelength = {wavelength:g} exclude each other")
    known = formats.FORMATS.get(path.suffix.lower(), formats.COLUMNS)
    if kind is not None and known.kind not in (None, kind):
        raise ContactError(f"kind = {kind!r}, but {path.name!r} is a file of a {known.kind}")
    lines = _lines(path)
    kind = known.kind or kind
    if kind is None:
        raise ContactError(f"kind = None: {path.name!r} does not say its kind; give 'wheel' or 'rail'")
    if not known.complete:
        for name, value, allowed in (("unit", unit, UNITS), ("side", side, SIDES)):
            if value is None:
                raise ContactError(
                    f"{name} = None: {path.name!r} does not say its {name}; give one of {', '.join(map(repr, allowed))}"
                )
    content = known.read(
        lines, path, side or ("" if known.read in (formats.miniprof, formats.miniprof_sections) else "right")
    )
    scale = UNITS[unit] if unit else content.unit or 1.0
    if len(content.points) > MOST_POINTS:
        raise ContactError(f"path = {str(path)!r} holds {len(content.points)} points; allowed: {MOST_POINTS}")
    measured = content.points * scale
    if not (np.abs(measured) < _FARTHEST).all():
        raise ContactError(f"path = {str(path)!r}: a point is not within {_FARTHEST:g} m")
    disorder = inspection.order(measured)
    fatal = bool(disorder) and not repair
    points = _placed(inspection.repaired(measured) if disorder and repair else measured, content, kind, path, zero)
    findings = [*disorder]
    result = None
    if not fatal:
        findings += inspection.shape(points, content.resolution * scale)
        curve = inspection.repaired(points) if repair else points
        _plausible(curve, kind, path)
        findings += inspection.place(curve, kind)
        result = _profile(curve, kind, path.stem, smoothing, wavelength)
        cured = {inspection.Fault.NOISE} if smoothing or wavelength else set()
        cured |= {*FATAL, inspection.Fault.ZIGZAG, inspection.Fault.SPIKE} if repair else set()
        findings = [finding for finding in findings if finding.fault not in cured]
    return Inspection(path.name, kind, points, tuple(findings), result)


def inspect_profile(given: Profile) -> Inspection:
    """Return what is wrong with the points of a profile."""
    points = np.column_stack((given.y, given.z))
    findings = inspection.order(points) or [*inspection.shape(points), *inspection.place(points, given.kind)]
    return Inspection(given.name or given.kind, given.kind, points, tuple(findings), given)


def read_folder(
    folder: str | PathLike[str], pattern: str = "*", *, skip: bool = False, **options: Any
) -> dict[str, Profile]:
    """Return file name → profile for the files of a folder. See `contact.geometry.profile.read_folder`."""
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
            warnings.warn(f"left out: {error}", ProfileWarning, stacklevel=3)
    return found


def _lines(path: Path) -> Sequence[str]:
    """Return the lines of a file. Raise a ContactError if it is missing, too large, or no regular file."""
    try:
        found = path.exists()
    except OSError as error:  # a name that is too long
        raise ContactError(f"path = {str(path)[:200]!r} cannot be read: {error.strerror}") from None
    if not found:
        raise ContactError(f"path = {str(path)!r} is missing: there is no such file in {str(path.absolute().parent)!r}")
    if path.is_dir():
        raise ContactError(f"path = {str(path)!r} is a folder; profile.read_folder reads all its files")
    if not path.is_file():  # reading a named pipe would wait for ever
        raise ContactError(f"path = {str(path)!r} is not a regular file")
    size = path.stat().st_size
    if size > LARGEST_FILE:
        raise ContactError(
            f"path = {str(path)!r} holds {1e-6 * size:.0f} MB; a profile has some hundred kB, "
            f"allowed: {1e-6 * LARGEST_FILE:.0f} MB"
        )
    try:
        return path.read_text(encoding="latin-1").splitlines()
    except OSError as error:
        raise ContactError(f"path = {str(path)!r} cannot be read: {error.strerror}") from None


def _placed(points: Points, content: Content, kind: Kind, path: Path, zero: str | None) -> Points:
    """Return the points [m] from the gauge or flange side to the field side, with z down, about the zero of this library."""
    if not content.downwards:
        points = _downwards(points, kind)
    outwards = _is_outwards(points, kind) if content.outwards is None else content.outwards
    points = points - [content.datum, 0.0]
    points = points if outwards else points * [-1.0, 1.0]
    points = _ordered(points)
    if len(points) < 4:
        raise ContactError(f"path = {str(path)!r} holds {len(points)} distinct points; at least 4 make a profile")
    if (
        zero is None
        and kind == "wheel"
        and path.suffix.lower() in (".whl", ".mpt")
        and points[:, 0].min() > -0.5 * inspection.FLANGE_BACK
    ):
        zero = "flange_back"
    if zero == "flange_back":
        if kind == "rail":
            raise ContactError(f"zero = 'flange_back': {path.name!r} holds a rail; allowed: 'file', 'shape'")
        return points - [inspection.FLANGE_BACK, 0.0]
    return points - _origin(points, kind, path) if zero == "shape" else points


def _origin(points: Points, kind: Kind, path: Path) -> Points:
    """Return the place (y, z) in the points that should be the zero, from the shape."""
    y, z = points.T
    if kind == "rail":
        top = z.min()
        gauge = np.flatnonzero((z > top + 0.014) & (np.arange(z.size) < np.argmin(z)))
        if not gauge.size:
            raise ContactError(f"zero = 'shape': the gauge side of {path.name!r} does not reach 14 mm below the top")
        return np.array([y[gauge[-1]] + inspection.CROWN_FROM_GAUGE, top])
    if not inspection.has_flange(points) or y[np.argmax(z)] == y.max():
        raise ContactError(f"zero = 'shape': the wheel in {path.name!r} has no flange to find the tape circle from")
    tape = y[np.argmax(z)] + inspection.TIP_FROM_TAPE
    outside = y > y[np.argmax(z)]
    return np.array([tape, np.interp(tape, y[outside], z[outside])])


def _profile(points: Points, kind: Kind, name: str, smoothing: float | None, wavelength: float | None) -> Profile:
    y, z = points.T
    angle = None
    if smoothing is not None:
        y, z, angle = smoothed(y, z, smoothing)
    elif wavelength is not None:
        y, z, angle = filtered(y, z, wavelength)
    return Profile(kind, y, z, angle, name)  # type: ignore[arg-type]


def _plausible(points: Points, kind: Kind, path: Path) -> None:
    """Raise a ContactError for a profile with an implausible width or with the flange on the wrong side."""
    y, z = points.T
    width = y.max() - y.min()
    if not NARROWEST <= width <= WIDEST:
        raise ContactError(
            f"path = {str(path)!r}: the profile is {width:g} m wide, outside the range [{NARROWEST:g}, {WIDEST:g}] of wheels "
            f"and rails; set unit to 'm' or 'mm'"
        )
    deepest = np.argmax(z)
    if kind == "wheel" and inspection.has_flange(points) and y[deepest] > y.mean():
        raise ContactError(
            f"path = {str(path)!r}: the flange lies on the field side, at y = {y[deepest]:g} m; set side to the other side"
        )


def _downwards(points: Points, kind: Kind) -> Points:
    """Return the points with z down. A rail is highest inside. A wheel is lowest at its flange, far below the median."""
    z = points[:, 1]
    if kind == "rail":
        down = z[0] + z[-1] > 2.0 * np.median(z)
    else:
        down = z.max() - np.median(z) > np.median(z) - z[_tread(points)].min()
    return points if down else points * [1.0, -1.0]


def _tread(points: Points) -> slice:
    """Return the slice without the outermost tenths, which contain chamfers and flange backs."""
    n = len(points)
    return slice(n // 10, n - n // 10)


def _is_outwards(points: Points, kind: Kind) -> bool:
    """Return whether y points to the field side. The flange's tip and the deeper side of a rail belong at low y."""
    y, z = points[np.argsort(points[:, 0])].T
    return bool(y[np.argmax(z)] < 0.5 * (y[0] + y[-1]) if kind == "wheel" else z[0] > z[-1])


def _ordered(points: Points) -> Points:
    """Return the points from the end with low y to the other, without points that nearly coincide with the previous one."""
    if len(points) > 1 and points[0, 0] > points[-1, 0]:
        points = points[::-1]
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > NEAREST:
            kept.append(point)
    return np.array(kept)
