"""The standard profiles by name, and the simplest shapes: a cone and an arc. `contact.geometry.standard` has their numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from contact.errors import ContactError, ratio, require_number, suggestion
from contact.geometry import outline, standard
from contact.geometry.outline import Arc, Segment, sloped
from contact.geometry.shape import Kind, Profile

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


def has_inclination(name: str) -> bool:
    """Return whether the standard profile with this name is a rail that can be inclined."""
    return _known(name, None) in standard.RAILS


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


def _profile(kind: Kind, segments: Iterable[Segment], name: str) -> Profile:
    return Profile(kind, *outline.sample(segments), name)


def angle_of(inclination: float | str) -> float:
    """Return the angle [rad] of an inclination, 0 ... 0.1 or "1/40"."""
    return math.atan(require_number("inclination", ratio("inclination", inclination), 0.0, 0.1))


def _inclined(name: str, inclination: float | str) -> Profile:
    """Return a rail of EN 13674-1, inclined towards the track's centre."""
    return _profile("rail", standard.RAILS[name].outline(), name).rotated(-angle_of(inclination))


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
