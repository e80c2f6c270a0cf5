"""A driven or braked wheel: the spin that answers a given force or torque (given_forces.md)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from contact.errors import ContactError, require_number
from contact.geometry.records import Pose, Velocity
from contact.given_force import rising_root
from contact.pair.wheel_rail import PairSolution, WheelRailPair
from contact.solution import Status

#: Largest error of the force over the vertical force; a larger one, up to `_LEFT`, is accepted if the force jumps.
_TOLERANCE, _LEFT = 1e-5, 1e-3
#: The spin is searched up to this share of that of free rolling, on both sides.
_REACH = 0.5
#: Kalker's C11 of a circle, roughly; it only scales the first step.
_C11 = 4.0


@dataclass(frozen=True, slots=True, eq=False)
class Driven:
    """A wheel under a given force or torque.

    Attributes
    ----------
    solution : forces at `spin`; its status is UNREACHABLE if no spin gives the force
    spin : rotation about the axle [rad/s], negative when rolling forward
    """

    solution: PairSolution
    spin: float


def drive(
    pair: WheelRailPair,
    pose: Pose,
    velocity: Velocity,
    *,
    force: float | None = None,
    torque: float | None = None,
    **options: Any,
) -> Driven:
    """Return the solution of a pair at the spin that gives a force or a torque.

    Parameters
    ----------
    pair : WheelRailPair
    pose, velocity
        As in `WheelRailPair.solve`. `velocity.spin` is where the search starts; `velocity.forward` must be positive.
    force : float
        Longitudinal force on the wheelset [N], positive when driving; instead of `torque`.
    torque : float
        Drive torque about the axle [N m], positive when driving: the moment of the contact about y.
    options
        Further arguments of `WheelRailPair.solve`: load, vertical, penetration, friction, irregularity, rail.

    Returns
    -------
    Driven
        With status UNREACHABLE, the solution has the largest slip that was tried, half of free rolling.

    Raises
    ------
    ContactError
        For arguments outside their range, unless exactly one of force and torque is given, and as `WheelRailPair.solve`.
    """
    if (force is None) == (torque is None):
        raise ContactError(f"exactly one of force and torque is needed; force = {force}, torque = {torque}")
    require_number("velocity.forward", velocity.forward, 0.0, open_minimum=True)
    radius = pair.pair.nominal_radius
    arm = 1.0 if torque is None else radius
    wanted = require_number("force", force) if torque is None else require_number("torque", torque)
    free = -velocity.forward / radius
    start = free if velocity.spin is None else velocity.spin
    solution = pair.solve(pose, replace(velocity, spin=start), **options)
    if not solution.contacts:
        return Driven(solution, start)
    spin = start

    def residual(at: float) -> float:
        nonlocal solution, spin
        if at != spin:
            solution, spin = pair.solve(pose, replace(velocity, spin=at), **options), at
        made = float(solution.force[0]) if torque is None else float(solution.moment[1])
        left = wanted - made  # a slower wheel, whose spin is larger, pulls less
        return 0.0 if abs(left) <= _TOLERANCE * arm * max(abs(solution.Q), 1.0) else left

    stiffness = _C11 * pair.bench.case[0]["G"] * solution.area / math.pi  # force per creepage
    slope = arm * float(stiffness) * radius / velocity.forward
    ends = start - _REACH * abs(free), start + _REACH * abs(free)
    root = rising_root(residual, start, slope, ends, shortest=1e-12 * abs(free))
    if abs(root.residual) > _LEFT * arm * max(abs(solution.Q), 1.0):
        status = Status.UNREACHABLE if root.beyond else Status.NOT_CONVERGED
        solution = replace(solution, status=status)
    return Driven(solution, spin)
