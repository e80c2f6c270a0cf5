"""Measure the largest stable communication steps of a wheelset and its two contacts.

Three motions of a wheelset are damped by creep forces that depend on their velocity: lateral motion, yaw and spin. `alone` is
the largest step at which an explicit integration of one of them with forces held over a step does not grow, on the true
contacts. `together` is that of the vehicle of this package with all its motions.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact_models.vehicle.coupling import ANSWER, QUESTION, OpenVehicle
from contact_models.vehicle.kernels.layout import Axis
from contact_models.wheelset.master import Scheme
from contact_models.wheelset.system import python_contacts, scenario, simulation

#: Largest stable z = c h/m of  m dv/dt = -c v  with the force held over a step.
EXPLICIT: dict[Scheme, float] = {"jacobi": 1.0, "gauss_seidel": 2.0}
STEPS = 90
LONGEST = 20e-3  # [s] limit of the steps, since longer ones do not resolve the motion itself
_SLOW = 1e-6  # share of the speed at the start
_HALF_BASE = 0.75  # [m]
_CALM = 0.5  # share of the static load by which normal forces of a stable run vary at most


class CoupledMode(NamedTuple):
    """A motion that is damped by the creep forces: m dv/dt = -c v, with the velocity v at the contacts."""

    name: str
    mass: float
    damping: float
    force: Callable[[float], float]


@functools.cache
def modes(speed: float) -> tuple[CoupledMode, ...]:
    """Return lateral motion, yaw and spin at a speed [m/s]."""
    given = scenario(speed)
    (axle,), radius = given.vehicle.wheelsets, given.vehicle.radius
    contacts = python_contacts(given)
    rest = OpenVehicle(simulation(given, 0.0)).ask()

    def answer(name: str, change: float) -> Array:
        moved = rest.copy()
        moved[:, QUESTION.index(f"velocity.{name}")] += change
        return np.sum([c.answer(q, 0.0, 0.0) for c, q in zip(contacts, moved, strict=True)], axis=0)

    def mode(name: str, mass: float, velocity: str, arm: float, force: str) -> CoupledMode:
        column, still = list(ANSWER).index(force), answer(velocity, 0.0)

        def damped(v: float) -> float:
            return float(answer(velocity, v / arm)[column] - still[column]) / arm

        small = _SLOW * speed
        return CoupledMode(name, mass, (damped(-small) - damped(small)) / (2.0 * small), damped)

    return (
        mode("lateral", axle.mass, "y", 1.0, "force.y"),
        mode("yaw", axle.inertia[2] / _HALF_BASE**2, "yaw", _HALF_BASE, "moment.z"),
        mode("spin", axle.inertia[1] / radius**2, "spin", radius, "moment.y"),
    )


def grows(mode: CoupledMode, h: float, scheme: Scheme, speed: float) -> bool:
    """Return whether the velocity of one motion grows with forces held over steps of `h` [s]."""
    v = first = _SLOW * speed
    late = mode.force(v)
    for _ in range(STEPS):
        now = mode.force(v)
        v += h * (now if scheme == "gauss_seidel" else late) / mode.mass
        late = now
    return abs(v) > first


def calm(h: float, scheme: Scheme, speed: float) -> bool:
    """Return whether the vehicle of this package runs with steps of `h` [s] without impacts."""
    given = scenario(speed)
    whole = simulation(given, 1e-3)
    opened, contacts = OpenVehicle(whole), python_contacts(given)
    load = float(whole.model.bodies["load"][whole.model.wheelsets[0]])
    furthest = 0.0
    try:
        for _ in range(2 * STEPS):
            opened.run(contacts, h, 1, parallel=scheme == "jacobi")
            furthest = max(furthest, float(np.abs(whole.wheels["vertical"] / load - 1.0).max()))
    except ContactError:  # a wheel has left its rail
        return False
    spin = whole.state.u[whole.model.wheelsets[0], Axis.PITCH]
    return furthest < _CALM and bool(np.isfinite(spin))


def largest(test: Callable[[float], bool], start: float, tolerance: float = 0.01) -> float:
    """Return the largest h up to LONGEST that passes, inf if all pass, by doubling from `start` and bisection.

    `start` must pass.
    """
    low, high = start, 1.3 * start
    if not test(low):
        raise ValueError(f"the start h = {low:g} s does not pass")
    while test(high):
        if high >= LONGEST:
            return np.inf
        low, high = high, min(1.3 * high, LONGEST)
    while high - low > tolerance * low:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if test(middle) else (low, middle)
    return low


@functools.cache
def alone(speed: float, scheme: Scheme, name: str) -> float:
    """Return the largest stable step [s] of one motion."""
    (mode,) = (each for each in modes(speed) if each.name == name)
    return largest(lambda h: not grows(mode, h, scheme, speed), 0.5 * mode.mass / mode.damping)


@functools.cache
def together(speed: float, scheme: Scheme) -> float:
    """Return the largest step [s] at which the vehicle of this package is calm, to 10 %."""
    return largest(lambda h: calm(h, scheme, speed), 1e-5, tolerance=0.1)
