"""What numbers wheels and rails have. Every entry doubts its arguments here, with the same limits and the same words.

A doubtful value is allowed and gives a `contact.errors.PlausibilityWarning`. Shapes of profiles are judged by
`contact.geometry.inspection.misplaced`, for arrays as for files.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.errors import ModelWarning, doubt, warn
from contact.inputs.creepage import Creepage


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
    "shift": Usual(1e-3, "bodies in contact slide after some micrometres; the unit is m"),
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
    "wheel radius": Usual(0.7, "a railway wheel has 0.15 to 0.65 m; is it the diameter?"),
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


def doubt_rolling(
    amount: Mapping[str, float], motion: Creepage, distance: float, friction: float, speed: float, doubted: set[str]
) -> None:
    """As `doubt_case`, of a step of `contact.Transient`. Where the distance is 0 the motion is a shift [m]."""
    vector = motion.longitudinal, motion.lateral, motion.spin
    rolls = distance > 0.0
    doubt_case(amount.get("load"), amount.get("approach"), vector if rolls else (0.0,) * 3, friction, speed, doubted)
    if not rolls and "shift" not in doubted and doubt_value("shift", max(abs(vector[0]), abs(vector[1]))):
        doubted.add("shift")
