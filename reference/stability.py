"""Measure the largest stable communication step of the coupled wheelset, and find the motion that limits it.

A run starts slightly off the centre. It is unstable if the sixth differences of the velocities have grown after 90 steps. Sixth
differences show what alternates from step to step and hide the slow motion. The iterated scheme is unstable if the forces agree
in less than nine of ten steps. Bisection finds the largest stable step.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from contact.errors import ContactError
from contact_models.wheelset import master
from contact_models.wheelset.components import DirectContact, DirectWheelset, direct
from contact_models.wheelset.model import WheelsetModel
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import CREEPAGE

EXPLICIT = {
    "jacobi": 1.0,
    "gauss_seidel": 2.0,
}  # largest stable z = c h/m of  m dv/dt = -c v  with the force held over a step
OFFSET = {
    "jacobi": 1e-5,
    "gauss_seidel": 1e-5,
    "iterated": 1e-3,
}  # [m] initial offset: growth needs room below saturation
STEPS, ORDER, EARLY, LATE = 90, 6, 5, 20
LONGEST = 20e-3  # [s] limit of the steps, since longer ones do not resolve the motion itself
HELD = 1e9  # [kg m²] inertia of an axle whose spin cannot change


class CoupledMode(NamedTuple):
    """A motion that is damped by the creep forces: m dv/dt = -c v."""

    name: str
    mass: float
    damping: float


def modes(p: WheelsetParameters) -> list[CoupledMode]:
    """Return lateral motion, yaw and spin with c = 2 f/V, slopes f of the contact at rest and masses at the contact."""
    wheelset, contact = DirectWheelset(WheelsetModel(replace(p, lateral=0.0))), DirectContact(p)
    f11, f22 = (slope(contact, wheelset.read("right.problem"), axis) for axis in range(2))
    _, base, radius, _ = wheelset.read("right.frame")
    return [
        CoupledMode("lateral", p.mass, 2.0 * f22 / p.speed),
        CoupledMode("yaw", p.yaw_inertia / base**2, 2.0 * f11 / p.speed),
        CoupledMode("spin", p.spin_inertia / radius**2, 2.0 * f11 / p.speed),
    ]


def slope(contact: DirectContact, problem: np.ndarray, axis: int, creepage: float = 1e-6) -> float:
    """Return the slope f [N] of the longitudinal (0) or lateral (1) creep force at the creepages of the problem."""
    forces = []
    for sign in (1.0, -1.0):
        moved = problem.copy()
        moved[CREEPAGE.start + axis] += sign * creepage
        contact.write("problem", moved)
        contact.step(0.0, 0.0)
        forces.append(contact.read("reaction")[axis])
    return (forces[1] - forces[0]) / (2.0 * creepage)


def coupled(p: WheelsetParameters, h: float, duration: float, scheme: str) -> master.History:
    wheelset, contacts = direct(p)
    return master.run(wheelset, contacts, speed=p.speed, step=h, duration=duration, scheme=scheme)


def alternation(history: master.History) -> np.ndarray:
    """Return differences of lateral, yaw and spin velocity at the contacts [m/s], shape (3, n - ORDER)."""
    velocities = (history["lateral_velocity"], 0.75 * history["yaw_rate"], 0.46 * history["spin"])
    return np.abs(np.diff(velocities, ORDER, axis=1))


def stable(p: WheelsetParameters, h: float, scheme: str) -> bool:
    try:
        history = coupled(replace(p, lateral=OFFSET[scheme]), h, STEPS * h, scheme)
    except ContactError:  # the wheelset has left the rails
        return False
    if scheme == "iterated":
        return bool((history.rounds <= master.MOST_ROUNDS).mean() >= 0.9)
    size = alternation(history).max(axis=0)
    return bool(size[-LATE:].max() <= 2.0 * size[:EARLY].max())


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
def measured(speed: float, scheme: str, spins: bool = True) -> tuple[float, str]:
    """Return the largest stable step [s] and the motion that grows above it."""
    p = WheelsetParameters(speed=speed) if spins else WheelsetParameters(speed=speed, spin_inertia=HELD)
    limit = min(m.mass / m.damping for m in modes(p))
    h = largest(lambda h: stable(p, h, scheme), 0.5 * limit)
    if np.isinf(h) or scheme == "iterated":
        return h, ""
    above = alternation(coupled(replace(p, lateral=OFFSET[scheme]), 1.05 * h, STEPS * h, scheme))[:, -LATE:].max(axis=1)
    return h, modes(p)[int(np.argmax(above))].name
