"""Wheel and rail profiles: the record, the standard shapes and their sampling.

Convention (right wheel and right rail, seen from behind): y to the field side, z down, in metres. A wheel has its tape
circle at y = 0, z = 0 and its flange at negative y. A rail has its gauge corner at negative y. The left side is the mirror
image and uses the same record.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, ratio, require_number, suggestion
from contact.geometry import outline, standard
from contact.geometry.outline import SPACING, Arc, Segment, sloped, spline_slopes

if TYPE_CHECKING:
    from contact.geometry.files import Inspection

__all__ = [
    "SPACING", "Kind", "Profile", "check", "cone", "load", "named", "names", "rail_60e1", "rail_arc", "read", "read_folder",
    "s1002",
]  # fmt: skip

Array = NDArray[np.float64]
Kind = Literal["wheel", "rail"]
Unit = Literal["m", "mm"]
Side = Literal["right", "left"]
Zero = Literal["file", "flange_back", "shape"]
UNITS: dict[str, float] = {"m": 1.0, "mm": 1e-3}
SIDES, ZEROS = ("right", "left"), ("file", "flange_back", "shape")


@dataclass(frozen=True, eq=False)
class Profile:
    """Outline of a wheel or a rail as points with their tangent angles.

    Parameters
    ----------
    kind : {"wheel", "rail"}
    y, z : array_like, shape (n,), n >= 4
        Points from the gauge or flange side to the field side [m]; y to the field side, z down.
    angle : array_like, shape (n,), optional
        Angle of the tangent, tan(angle) = dz/dy [rad]. Default: the tangents of a cubic spline over the chord length.
    name : str
        Name in plots and messages.

    Raises
    ------
    ContactError
        For wrong shapes, values that are not finite, fewer than four points, or coincident neighbours.
    """

    kind: Kind
    y: Array
    z: Array
    angle: Array = field(default=None, repr=False)  # type: ignore[arg-type]
    name: str = ""

    def __post_init__(self) -> None:
        if self.kind not in ("wheel", "rail"):
            raise ContactError(f"profile.kind = {self.kind!r} is neither 'wheel' nor 'rail'")
        y, z = _points("y", self.y), _points("z", self.z)
        if y.size != z.size or y.size < 4:
            raise ContactError(
                f"profile has {y.size} values of y and {z.size} of z; equally many, at least 4, are needed"
            )
        chord = np.hypot(np.diff(y), np.diff(z))
        if not (chord > 0.0).all():
            i = int(np.argmin(chord))
            raise ContactError(f"profile points {i} and {i + 1} coincide at y = {y[i]:g} m")
        angle = _spline_angles(y, z, chord) if self.angle is None else _points("angle", self.angle)
        if angle.size != y.size:
            raise ContactError(f"profile has {angle.size} angles for {y.size} points")
        for name, array in (("y", y), ("z", z), ("angle", angle)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def rotated(self, roll: float) -> Profile:
        """Return the profile rotated about the x axis through its origin by `roll` [rad], positive from y towards z."""
        c, s = math.cos(require_number("roll", roll, -1.0, 1.0)), math.sin(roll)
        return Profile(self.kind, c * self.y - s * self.z, s * self.y + c * self.z, self.angle + roll, self.name)

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        return f"Profile({self.kind!r}, {name}{self.y.size} points, y = {self.y[0]:g} … {self.y[-1]:g} m)"


def _points(name: str, values: object) -> Array:
    """Return a finite one-dimensional float64 copy."""
    try:
        array = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ContactError(f"profile.{name} is not an array of numbers") from None
    if array.ndim != 1 or not np.isfinite(array).all():
        raise ContactError(f"profile.{name} must be one-dimensional and finite; its shape is {array.shape}")
    return array


def _spline_angles(y: Array, z: Array, chord: Array) -> Array:
    """Return tangent angles [rad] of the C² cubic spline (y, z) over the chord length. The end segments are parabolas."""
    u = np.concatenate(([0.0], np.cumsum(chord)))
    return np.unwrap(np.arctan2(spline_slopes(u, z), spline_slopes(u, y)))


#: Name → outline of the wheels of EN 15302, and name of its rail.
_WHEELS_15302 = {f"EN 15302 {letter}": outlined for letter, outlined in standard.WHEELS_15302.items()}
_RAIL_A = "EN 15302 rail A"
#: Alternative name → name.
ALIASES = {alias: name for name, head in standard.RAILS.items() for alias in head.aliases} | {"rail A": _RAIL_A}
ALIASES |= {f"wheel {letter}": f"EN 15302 {letter}" for letter in standard.WHEELS_15302}

STANDARD_INCLINATION, STANDARD_HEIGHT, STANDARD_THICKNESS = 1.0 / 40.0, 28e-3, 32.5e-3


def names(kind: Kind | None = None) -> tuple[str, ...]:
    """Return the names of the standard profiles for `named`, of one kind or of both."""
    wheels, rails = (*standard.TREADS, *_WHEELS_15302), (*standard.RAILS, _RAIL_A)
    return {"wheel": wheels, "rail": rails}.get(kind, wheels + rails)  # type: ignore[arg-type]


def named(
    name: str,
    *,
    kind: Kind | None = None,
    inclination: float | str | None = None,
    flange_height: float | None = None,
    flange_thickness: float | None = None,
) -> Profile:
    """Return the standard profile with this name.

    Parameters
    ----------
    name : str
        One of `names()`, or an old name (UIC60, UIC54, S54, S49, BS113A, SBB I). Case, blanks and hyphens are ignored, and
        1:40 means 1/40.
    kind : {"wheel", "rail"}, optional
        Accept only profiles of this kind.
    inclination : float or str, optional
        For rails: tangent of the angle between the rail's axis and the vertical, 0 ... 0.1, or "1:40"; default 1:40. Not
        for rail A of EN 15302, which the standard draws with an inclination of 1:20.
    flange_height, flange_thickness : float, optional
        For wheels of EN 13715 [m]: height 0.028 ... 0.032, default 0.028; thickness 0.0285 ... 0.0325, default 0.0325 (the
        only one for EPS).

    Returns
    -------
    Profile

    Raises
    ------
    ContactError
        For an unknown name, or an option that this profile does not have.

    Notes
    -----
    The origin of a rail is the crown's point on its axis; that of a wheel is its tape circle. 60E1, S1002 and the wheels
    and the rail of EN 15302 were seen in two sources each, all other numbers in one transcription of the standard
    (`contact.geometry.standard`, constants.md 12.2 and 14).
    """
    known = _known(name, kind)
    given = {"inclination": inclination, "flange_height": flange_height, "flange_thickness": flange_thickness}
    has = {"inclination"} if known in standard.RAILS else {"flange_height", "flange_thickness"}
    for option, value in given.items():
        if value is not None and (option not in has or known in (*_WHEELS_15302, _RAIL_A)):
            raise ContactError(f"{option} = {value!r}: the profile {known} has no {option}")
    if known in standard.RAILS:
        return _inclined(known, STANDARD_INCLINATION if inclination is None else inclination)
    if known in standard.TREADS:
        return _wheel(
            known,
            STANDARD_HEIGHT if flange_height is None else flange_height,
            STANDARD_THICKNESS if flange_thickness is None else flange_thickness,
        )
    if known == _RAIL_A:
        return _profile("rail", standard.RAIL_A, known)
    return _profile("wheel", _WHEELS_15302[known], known)


def s1002(flange_height: float = STANDARD_HEIGHT, flange_thickness: float = STANDARD_THICKNESS) -> Profile:
    """Return wheel S1002 (EN 13715, UIC 510-2) from the flange's inner side to y = 60 mm.

    Flange height and thickness are as for `named`. The inner face of the flange is cut off where it becomes steeper than 70°
    (theory.md 9.1, sections A to H).
    """
    return _wheel("S1002", flange_height, flange_thickness)


#: Source of the tangent points of `rail_60e1` → name of the rail.
BREAKPOINTS = {"EN 13674": "60E1", "UIC 519": "60E1 UIC 519"}


def rail_60e1(inclination: float | str = STANDARD_INCLINATION, breakpoints: str = "EN 13674") -> Profile:
    """Return rail 60E1 (UIC 60): arcs R300, R80, R13 and flanks 1:20, inclined towards the track's centre.

    Parameters
    ----------
    inclination : float or str
        Tangent of the angle between the rail's axis and the vertical, 0 ... 0.1, or "1:40".
    breakpoints : {"EN 13674", "UIC 519"}
        Positions where R300 meets R80 and R80 meets R13. "EN 13674": the full widths 20.456 and 52.053 mm of EN 13674-1.
        "UIC 519": 10.5 and 25.988 mm on each side of the axis, as in EN 15302 and the Manchester contact benchmark.

    Notes
    -----
    The origin is the crown's point on the rail axis (theory.md 9.2, a chain of tangents).
    """
    if breakpoints not in BREAKPOINTS:
        raise ContactError(f"breakpoints = {breakpoints!r} is none of {', '.join(map(repr, BREAKPOINTS))}")
    return _inclined(BREAKPOINTS[breakpoints], inclination)


def cone(conicity: float, half_width: float = 0.06) -> Profile:
    """Return a conical wheel without flange, with `conicity` 0 ... 0.5 [-], over the tape circle ± `half_width` [m]."""
    require_number("conicity", conicity, 0.0, 0.5)
    require_number("half_width", half_width, 1e-3, 0.2)
    w = 1e3 * half_width
    return _profile("wheel", [sloped(-w, w, 0.0, -conicity)], f"cone {conicity:g}")


def rail_arc(radius: float, half_width: float = 0.03) -> Profile:
    """Return a rail that is one circular arc of `radius` [m] with its crown at the origin, within ± `half_width` [m]."""
    require_number("radius", radius, 1e-3, 100.0)
    require_number("half_width", half_width, 1e-3, 0.99 * radius)
    r, w = 1e3 * radius, 1e3 * half_width
    return _profile("rail", [Arc(-w, w, r, 0.0, r)], f"arc {radius:g} m")


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
    """Return the profile in a file, in the right-side convention. `contact.geometry.files` lists the formats.

    Scenarios have these options in their table `profiles`, the command line as ``--profile-unit`` and so on.

    Parameters
    ----------
    path : path-like
        File; its suffix tells the format.
    kind : {"wheel", "rail"}, optional
        Required for plain columns; otherwise it must agree with the suffix.
    unit : {"m", "mm"}, optional
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
        a profile narrower than 30 mm or wider than 200 mm, as from a wrong unit; for a wheel with its flange on the field
        side; for rows that are not in order, and several scans, without `repair`; for files above 20 MB.

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
    from contact.geometry import files

    return files.read(
        path, kind=kind, unit=unit, side=side, zero=zero, repair=repair, smoothing=smoothing, wavelength=wavelength
    )


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
    contact.geometry.files.Inspection

    Raises
    ------
    ContactError
        As `read`, except for points that are no curve: then the result has no profile.
    """
    from contact.geometry import files

    return files.inspect_profile(given) if isinstance(given, Profile) else files.inspect(given, **options)


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
    from contact.geometry import files

    return files.read_folder(folder, pattern, skip=skip, **options)


def load(name: str, kind: Kind, *, inclination: float | str | None = None, **options: Any) -> Profile:
    """Return the profile in the file `name`, or the standard profile with this name.

    The name of a standard profile is for `named`, with `inclination` if it is a rail; the other options are ignored. Any
    other `name` with a point or a slash, or of an existing file, is a file for `read` with the options.

    Raises
    ------
    ContactError
        As `read` and `named`. Also for an inclination of a rail from a file, which already has its inclination.
    """
    rail_inclination = inclination if kind == "rail" else None
    is_file = Path(name).is_file() or (("." in name or "/" in name or "\\" in name) and not is_standard(name))
    if not is_file:
        return named(name, kind=kind, inclination=rail_inclination)
    if rail_inclination is not None:
        raise ContactError(f"inclination = {inclination}: the rail in the file {name!r} is taken as it lies there")
    return read(name, kind=kind, **options)


def _profile(kind: Kind, segments: Iterable[Segment], name: str) -> Profile:
    return Profile(kind, *outline.sample(segments), name)


def _inclined(name: str, inclination: float | str) -> Profile:
    """Return a rail of EN 13674-1, inclined towards the track's centre."""
    inclination = require_number("inclination", ratio("inclination", inclination), 0.0, 0.1)
    return _profile("rail", standard.RAILS[name].outline(), name).rotated(-math.atan(inclination))


def _wheel(name: str, height: float, thickness: float) -> Profile:
    """Return a wheel of EN 13715. Height and thickness of the flange are in metres."""
    tread = standard.TREADS[name]
    height = 1e3 * require_number("flange_height", height, 28e-3, 32e-3)
    thinnest, thickest = (round(1e-3 * bound, 6) for bound in tread.thickness)
    thickness = 1e3 * require_number("flange_thickness", thickness, thinnest, thickest)
    return _profile("wheel", tread.outline(height, thickness), name)


def is_standard(name: str) -> bool:
    """Return whether `named` knows this name."""
    return _key(name) in {_key(known) for known in (*names(), *ALIASES)}


def _known(name: str, kind: Kind | None) -> str:
    """Return the name as in `names`. Raise a ContactError if it is unknown."""
    among = names(kind)
    keys = {_key(known): known for known in among}
    keys |= {_key(alias): known for alias, known in ALIASES.items() if known in among}
    standard_name = keys.get(_key(str(name)))
    if standard_name is None:
        close = suggestion(name, (*among, *ALIASES))
        raise ContactError(
            f"{kind or 'name'} = {name!r} is no profile of the standards{close}; they are {', '.join(among)}"
        )
    return standard_name


def _key(name: str) -> str:
    return re.sub(r"[^a-z0-9/]", "", name.lower().replace(":", "/"))
