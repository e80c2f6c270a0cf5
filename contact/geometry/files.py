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

Decimal commas are recognised where blanks or semicolons separate the columns.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np

from contact.errors import ContactError, ProfileWarning
from contact.geometry import formats, inspection
from contact.geometry.formats import Points
from contact.geometry.inspection import FATAL, Finding
from contact.geometry.placing import placed, require_plausible
from contact.geometry.shape import Kind, Profile
from contact.geometry.smoothing import filtered, smoothed

Unit = Literal["m", "mm", "inch"]
Side = Literal["right", "left"]
Zero = Literal["file", "flange_back", "shape"]
UNITS: dict[str, float] = inspection.UNITS
KINDS, SIDES, ZEROS = ("wheel", "rail"), ("right", "left"), ("file", "flange_back", "shape")
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
    repaired : tuple of contact.geometry.inspection.Finding
        What `repair` has cured.
    dropped : int
        Number of points of the file that `repair` has left out.
    """

    name: str
    kind: Kind
    points: Points
    findings: tuple[Finding, ...]
    profile: Profile | None
    repaired: tuple[Finding, ...] = ()
    dropped: int = 0

    @property
    def told(self) -> list[str]:
        """What was found, and what was repaired, a line each."""
        return [*map(str, self.findings), *([self.profile.note] if self.profile and self.profile.note else [])]

    def __str__(self) -> str:
        head = f"{self.name}: {self.kind}, {len(self.points)} points"
        return "\n".join([head, *(f"  {line}" for line in self.told)] if self.told else [f"{head}, nothing found"])


def read(
    path: str | PathLike[str],
    *,
    kind: Kind | None = None,
    unit: Unit | None = None,
    side: Side | None = None,
    zero: Zero | None = None,
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
    unit : {"m", "mm", "inch"}, optional
        Unit of length. Required for plain columns; otherwise it replaces the format's own unit.
    side : {"right", "left"}, optional
        Side that the file shows, seen from behind with y to the right. A left side is mirrored. Required for plain columns.
    zero : {"file", "flange_back", "shape"}, optional
        Where y = 0, z = 0 lies. "file": where the file has it, which for wheels must be the tape circle. "flange_back": y of
        a wheel counts from the back of its flange, 70 mm from the tape circle. "shape": found from the shape. A wheel's
        tape circle lies 55 mm outside the flange's tip, on the tread; a rail's zero 36 mm outside its gauge face, at the
        height of its top. Default "file", for MiniProf wheels measured from the back of the flange "flange_back". The gauge
        of the track places a rail, wherever its zero is.
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
        a profile narrower than 30 mm or wider than 200 mm, as from a wrong unit; for the shape of the other kind, a wheel
        with a flange as "rail" or a rail's head as "wheel"; for a wheel with its flange on the field side; for rows that are
        not in order, and several scans, without `repair`; for files above 20 MB.

    Warns
    -----
    ProfileWarning
        For spikes, gaps, kinks, back steps, noise that spoils the tangents, and offsets of height and side. `check` returns
        all of them.

    Notes
    -----
    The contact depends on tangents and curvatures, which are far noisier than points. An example is S1002 with points
    0.25 mm apart and 2 µm of noise. Without smoothing the root mean square errors are 9.6 mrad and 62 1/m. With
    ``smoothing=2e-6`` they are 1.6 mrad and 3.9 1/m, with half of it 6.4 mrad and 36 1/m, with twice as much 3.6 mrad and
    5.4 1/m; in the last case the points are 3.5 µm off.
    """
    found = inspect(
        path, kind=kind, unit=unit, side=side, zero=zero, repair=repair, smoothing=smoothing, wavelength=wavelength
    )
    for finding in found.findings:
        if found.profile is None and finding.fault in FATAL:
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
    zero: Zero | None = None,
    repair: bool = False,
    smoothing: float | None = None,
    wavelength: float | None = None,
) -> Inspection:
    """Return the points of a file, what is wrong with them, and their profile. The options are those of `read`."""
    path = Path(path)
    for name, value, allowed in (
        ("unit", unit, UNITS),
        ("side", side, SIDES),
        ("zero", zero, ZEROS),
        ("kind", kind, KINDS),
    ):
        if value is not None and value not in allowed:
            raise ContactError(f"{name} = {value!r} is none of {', '.join(map(repr, allowed))}")
    if smoothing is not None and wavelength is not None:
        raise ContactError(f"smoothing = {smoothing:g} and wavelength = {wavelength:g} exclude each other")
    known = formats.FORMATS.get(path.suffix.lower(), formats.COLUMNS)
    if kind is not None and known.kind not in (None, kind):
        raise ContactError(f"kind = {kind!r}, but {path.name!r} is a file of a {known.kind}")
    lines = lines_of(path)
    kind = known.kind or kind
    needed = (("kind", kind, KINDS), *(() if known.complete else (("unit", unit, UNITS), ("side", side, SIDES))))
    unknown = {name: allowed for name, value, allowed in needed if value is None}
    if kind is None or unknown:
        raise ContactError(
            f"{', '.join(f'{name} = None' for name in unknown)}: {path.name!r} does not say its {', '.join(unknown)}; give "
            + ", ".join(f"{name} {' or '.join(map(repr, allowed))}" for name, allowed in unknown.items())
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
    points = placed(inspection.repaired(measured) if disorder and repair else measured, content, kind, path, zero)
    findings, dropped = [*disorder], 0
    cured: set[inspection.Fault] = set()
    if not fatal:
        findings += inspection.shape(points, content.resolution * scale)
        curve = inspection.repaired(points) if repair else points
        require_plausible(curve, kind, path, scale)
        findings += inspection.place(curve, kind)
        if repair:
            cured, dropped = {*FATAL, inspection.Fault.ZIGZAG, inspection.Fault.SPIKE}, len(measured) - len(curve)
        repaired = tuple(finding for finding in findings if finding.fault in cured)
        if repair and disorder:  # spikes were dropped before the points were placed
            hidden = inspection.shape(inspection.in_order(measured))
            repaired += tuple(replace(finding, at=points[:0]) for finding in hidden if finding.fault in cured)
        result = _profile(curve, kind, path.stem, smoothing, wavelength, _note(repaired, dropped, len(measured)))
        cured |= {inspection.Fault.NOISE} if smoothing or wavelength else set()
        findings = [finding for finding in findings if finding.fault not in cured]
        return Inspection(path.name, kind, points, tuple(findings), result, repaired, dropped)
    return Inspection(path.name, kind, points, tuple(findings), None)


def inspect_profile(given: Profile) -> Inspection:
    """Return what is wrong with the points of a profile."""
    points = np.column_stack((given.y, given.z))
    findings = inspection.order(points) or [*inspection.shape(points), *inspection.place(points, given.kind)]
    return Inspection(given.name or given.kind, given.kind, points, tuple(findings), given)


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


def lines_of(path: Path) -> Sequence[str]:
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


def _note(repaired: tuple[Finding, ...], dropped: int, rows: int) -> str:
    """Return what a repair has done, for messages and captions; empty if nothing."""
    if not repaired:
        return ""
    faults = ", ".join(finding.fault.value for finding in repaired)
    return (
        f"repair dropped {dropped} of {rows} points ({faults})"
        if dropped
        else f"repair put the rows in order ({faults})"
    )


def _profile(
    points: Points, kind: Kind, name: str, smoothing: float | None, wavelength: float | None, note: str
) -> Profile:
    y, z = points.T
    angle = None
    if smoothing is not None:
        y, z, angle = smoothed(y, z, smoothing)
    elif wavelength is not None:
        y, z, angle = filtered(y, z, wavelength)
    return Profile(kind, y, z, angle, name, note)  # type: ignore[arg-type]
