"""What numbers wheels and rails have. Every entry doubts its arguments here, with the same limits and the same words.

A doubtful value is allowed and gives a `contact.errors.PlausibilityWarning`. Shapes of profiles are judged by
`contact.geometry.inspection.misplaced`, for arrays as for files.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.errors import ModelWarning, doubt, warn
from contact.kernels.tangential.table import LOG_ASPECT_MAX, LOG_ASPECT_MIN


class Usual(NamedTuple):
    """Largest and smallest usual magnitude of a value other than zero, and what is usual or the unit."""

    largest: float
    hint: str
    least: float = 0.0


_CREEPAGE = Usual(0.1, "a rolling wheel has less than 0.02 (20 per mille); is it in per mille?")
_TURNED = Usual(0.05, "a wheelset has less than 0.03 rad; the unit is rad")
_DRIFT = Usual(2.0, "a wheelset moves aside or up and down by less than 0.5 m/s; the unit is m/s")
_TURNS = Usual(3.0, "a wheelset rolls and yaws by less than 0.5 rad/s; the unit is rad/s")
_LOAD = "a wheel carries 20 to 150 kN; the unit is N"
#: Usual values under the names of the arguments. A patch has any share of a wheel's load, but hardly as few newtons as a wheel
#: has kilonewtons.
USUAL = {
    "load": Usual(5e6, f"{_LOAD}; is it in kN?", 200.0),
    "approach": Usual(5e-3, "a wheel and a rail approach by about 1e-4 m; the unit is m"),
    "creepage.longitudinal": _CREEPAGE,
    "creepage.lateral": _CREEPAGE,
    "creepage.spin": Usual(20.0, "a flange has about 2; the unit is 1/m"),
    "friction": Usual(1.0, "steel on steel has 0.05 to 0.6"),
    "speed": Usual(170.0, "the fastest train ran 160 m/s; is it in km/h?"),
    "A": Usual(200.0, "a wheel has 1/(2 radius), 1.1 for a radius of 0.46 m; the unit is 1/m", 0.02),
    "extent of y": Usual(1.0, "a wheel or a rail's head is less than 0.2 m wide; the unit is m"),
    "shear_modulus": Usual(1e13, "steel has 8.2e10; the unit is Pa", 1e7),
    "pressure_limit": Usual(math.inf, "rail steel has about 1.5e9; the unit is Pa", 1e7),
    "pose.y": Usual(0.015, "a flange touches at about 0.007 m; the unit is m"),
    "pose.roll": _TURNED,
    "pose.yaw": _TURNED,
    **dict.fromkeys(("velocity.y", "velocity.z"), _DRIFT),
    **dict.fromkeys(("velocity.roll", "velocity.yaw"), _TURNS),
    # of a wheel that is driven or braked
    "slip": Usual(
        0.45, "a rolling wheel has less than 0.02; spin is negative when rolling forward, about -forward/radius"
    ),
    "wheel load": Usual(5e6, _LOAD, 1e3),
}


def doubt_value(name: str, value: float, called: str = "") -> bool:
    """Warn of a value that is not usual for `name`, a key of `USUAL`, under the name `called`. Return whether it warned."""
    usual = USUAL[name]
    return doubt(called or name, value, usual.largest, usual.hint, least=usual.least)


def doubt_values(name: str, values: NDArray[Any], called: str = "") -> bool:
    """As `doubt_value`, of an array: one warning, of the first unusual value with its place, and their number."""
    size, usual = np.abs(values), USUAL[name]
    unusual = (size > usual.largest) | ((size > 0.0) & (size < usual.least))
    if not unusual.any():
        return False
    where = tuple(map(int, np.unravel_index(int(np.argmax(unusual)), values.shape)))
    called = called or (f"{name}[{', '.join(map(str, where))}]" if where else name)
    hint = f"{usual.hint} ({np.count_nonzero(unusual)} of {values.size} values)" if where else usual.hint
    return doubt(called, float(values[where]), usual.largest, hint, least=usual.least)


#: Coupling of unlike bodies above which it is not neglected in silence [-].
_COUPLED = 1e-3


def doubt_alike(coupling: float) -> None:
    """Warn of unlike bodies with this coupling (`contact.Material`), which methods on strips take as alike."""
    if abs(coupling) > _COUPLED:
        warn(
            f"material.coupling = {coupling:.3g}: methods on strips take both bodies as alike. On the unlike pairs compared "
            "with CONTACT forces were up to 0.08 of friction times load off, and the creepage of free rolling up to 1.2e-4 "
            "(other_contacts.md); normal = tangential = 'halfspace' takes the coupling into account",
            ModelWarning,
        )


def doubt_combined(coupling: float) -> None:
    """Warn of stresses below the surface of unlike bodies with the combined Poisson's ratio."""
    if abs(coupling) > _COUPLED:
        warn(
            f"material.coupling = {coupling:.3g}: the stresses of both bodies are those for the combined Poisson's ratio; "
            "give poisson_ratio of the body",
            ModelWarning,
        )


def _once(told: set[str], reason: str, text: str) -> None:
    """Warn for a reason that is not yet in `told`, the reasons for which an object has warned.

    The text has a number that changes from call to call, so Python would show it at every call of a loop.
    """
    if reason not in told:
        warn(text, ModelWarning)
        told.add(reason)


def about_bend(largest: float) -> str:
    """Return what strips leave out where the contact angle changes by more than `largest` [rad] over a patch."""
    return (
        f"the contact angle changes by more than {math.degrees(largest):.0f} degrees over the patch, which strips take as "
        "plane: a lateral force of the pressure of up to 0.1 of the load is left out, and creep forces change by 0.03 of "
        "friction times load in the median. A conformal surface has both, but the influence numbers of a plane: 0.02 to 0.06 "
        "of friction times load in the median (limits.md)"
    )


def about_gap(limit: float) -> str:
    """Return what a `gap_error` above `limit` means."""
    return (
        f"the pressure leaves gaps or overlaps inside the patch, or surfaces are no parabolas along x; above {limit:g} the "
        "largest pressure may be more than 5 % wrong (limits.md)"
    )


def about_beyond(largest: float) -> str:
    """Return what is wrong where more than a share `largest` of the load is on shapes beyond the table of the method."""
    return (
        f"more than {largest:g} of the load is on shapes with a/b beyond {math.exp(LOG_ASPECT_MIN):.3g} to "
        f"{math.exp(LOG_ASPECT_MAX):.3g}, the ends of the half space's table of creep forces ('fastrip_mapped', 'table'), "
        "or beyond 0.02 to 50, those of Kalker's coefficients (other methods), which count for them: "
        "forces may be more than 0.01 of friction times load off, above 50 more than 0.1 (limits.md)"
    )


#: Of a force that was found [N]: a fall of the wheel through its rail by a millimetre has 4e6.
USUAL_N = Usual(1e6, "a wheel carries 20 to 150 kN; do wheel and rail overlap by millimetres?")


def doubt_normal_force(force: float, told: set[str], called: str = "N") -> None:
    """Warn of a force [N] that was found for a given height or approach and that no wheel carries."""
    if force > USUAL_N.largest and called not in told:
        told.add(called)
        doubt(called, force, USUAL_N.largest, USUAL_N.hint)


def doubt_beyond(beyond: float, largest: float, told: set[str]) -> None:
    """Warn of a share `beyond` of the load, above `largest`, on shapes beyond the table of creep forces."""
    if beyond > largest:
        _once(told, "beyond", f"beyond = {beyond:.2g}: {about_beyond(largest)}")


def doubt_strips(bend: float, largest: float, conformal: bool, told: set[str]) -> None:
    """Warn of a patch over which the contact angle changes by `bend` [rad], more than `largest`, solved on strips."""
    if bend > largest:
        limit = f"{math.degrees(largest):.0f}°"
        _once(
            told,
            "bent, conformal" if conformal else "bent",
            f"the contact angle changes by {math.degrees(bend):.0f}° over the patch. "
            + (
                f"Above {limit} strips with conformal = True, which have the influence numbers of a plane, are 0.02 to 0.06 "
                "of friction times load off in the median, 0.27 at most, and 15 % in the largest pressure (limits.md); "
                "normal = tangential = 'halfspace' has those of the bent surface"
                if conformal
                else f"It is solved as plane. Above {limit} a lateral force of the pressure of up to 0.1 of the load is left "
                "out, and creep forces change by 0.03 of friction times load in the median (limits.md); "
                "conformal = True has both"
            ),
        )


def doubt_gap(gap_error: float, limit: float, told: set[str], reason: str = "gap") -> None:
    """Warn of a `gap_error` above the limit of its method."""
    if gap_error > limit:
        _once(
            told,
            reason,
            f"gap_error = {gap_error:.2g}: the pressure leaves gaps or overlaps inside the patch, or surfaces are no parabolas "
            f"along x. Above {limit:g} the largest pressure may be more than 5 % wrong (limits.md); normal = tangential = "
            "'halfspace' solves the patch, HalfspacePair the surfaces",
        )


def doubt_rows(fit_error: float, limit: float, told: set[str]) -> None:
    """Warn of a separation whose parabolas along x are by more than the limit of `gap_error` off what a search found."""
    if fit_error > limit:
        _once(
            told,
            "rows",
            f"the wheel's rows along x are no parabolas, as the separation takes them: their slope is {fit_error:.2g} off. "
            f"Above {limit:g} the largest pressure may be more than 5 % wrong, and creep forces by 0.02 of friction times load "
            "(limits.md); HalfspacePair of a SurfacePair takes the surfaces as they are",
        )


_CASE = ("load", "approach", "creepage.longitudinal", "creepage.lateral", "creepage.spin", "friction", "speed")
_LARGEST = tuple(USUAL[name].largest for name in _CASE)
_LEAST_LOAD = USUAL["load"].least


def doubt_case(
    load: float | None,
    approach: float | None,
    creepage: tuple[float, float, float],
    friction: float,
    speed: float,
    doubted: set[str] | None = None,
) -> None:
    """Warn of arguments of `contact.solve` that no wheel on a rail has and whose names are not among the `doubted` ones."""
    most_load, most_approach, longitudinal, lateral, spin, most_friction, fastest = _LARGEST
    if (  # this is asked at every call of a solver, so all at once
        (not load or _LEAST_LOAD <= load <= most_load)
        and (not approach or approach <= most_approach)
        and abs(creepage[0]) <= longitudinal
        and abs(creepage[1]) <= lateral
        and abs(creepage[2]) <= spin
        and friction <= most_friction
        and speed <= fastest
    ):
        return
    doubted = set() if doubted is None else doubted
    for name, value in zip(_CASE, (load, approach, *creepage, friction, speed), strict=True):
        if value is not None and name not in doubted and doubt_value(name, value):
            doubted.add(name)
