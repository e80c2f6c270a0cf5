"""A driven or braked wheel: the rotation about the axle that gives a force or a torque (given_forces.md)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from contact.errors import ContactError, require_number
from contact.geometry.records import Velocity
from contact.given_force import rising_root
from contact.pair.solution import PairSolution
from contact.results import Status

#: Largest error of the force over the vertical force; a larger one, up to `_LEFT`, is accepted if the force jumps.
_TOLERANCE, _LEFT = 1e-5, 1e-3
#: The spin is searched up to this share of that of free rolling, on both sides.
_REACH = 0.5
#: Kalker's C11 of a circle, roughly; it only scales the first step.
_C11 = 4.0


def drive(
    solve: Callable[[Velocity], PairSolution],
    velocity: Velocity,
    radius: float,
    shear_modulus: float,
    force: float | None,
    torque: float | None,
    pull: Callable[[PairSolution], float] | None = None,
) -> PairSolution:
    """Return the solution at the rotation that gives a longitudinal force [N] or a torque about the axle [N m].

    `solve` solves the pair at a velocity; `radius` is the nominal radius [m], `pull`
    gives the force that is meant. The status is UNREACHABLE if no rotation up
    to half of free rolling gives the force; the solution is then the last that was tried.

    Raises
    ------
    ContactError
        For arguments outside their range, unless exactly one of force and torque is given, and as `solve`.
    """
    if (force is None) == (torque is None):
        raise ContactError(f"exactly one of force and torque is needed; force = {force}, torque = {torque}")
    require_number("velocity.forward", velocity.forward, 0.0, open_minimum=True)
    arm = 1.0 if torque is None else radius
    wanted = require_number("force", force) if torque is None else require_number("torque", torque)
    free = -velocity.forward / radius
    start = free if velocity.spin is None else velocity.spin
    found = solve(replace(velocity, spin=start))
    if not found.contacts:
        return found

    def residual(spin: float) -> float:
        nonlocal found
        if spin != found.spin:
            found = solve(replace(velocity, spin=spin))
        made = (float(found.force[0]) if pull is None else pull(found)) if torque is None else float(found.moment[1])
        left = wanted - made  # a slower wheel, whose spin is larger, pulls less
        return 0.0 if abs(left) <= _TOLERANCE * arm * max(abs(found.Q), 1.0) else left

    slope = arm * _C11 * shear_modulus * found.area / math.pi * radius / velocity.forward
    ends = start - _REACH * abs(free), start + _REACH * abs(free)
    root = rising_root(residual, start, slope, ends, shortest=1e-12 * abs(free))
    if abs(root.residual) > _LEFT * arm * max(abs(found.Q), 1.0):
        return replace(found, status=Status.UNREACHABLE if root.beyond else Status.NOT_CONVERGED)
    return found
