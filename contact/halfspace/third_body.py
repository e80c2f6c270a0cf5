"""A thin layer between the bodies that shears elastically and yields, with hardening (other_contacts.md).

The layer's elastic shear adds flexibility·q to the tangential displacement. It yields where |q| reaches

    tau_c = yield_stress + hardening·(plastic shear since the particle entered the contact).

Coulomb's law with the bound min(mu p, tau_c) is solved as usual. Its slip is plastic shear of the layer where tau_c < mu p,
and slip elsewhere. With hardening, tau_c follows from this shear along each row, and both are repeated until they agree.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.errors import require_number
from contact.halfspace import linear
from contact.halfspace.tang import Tangential
from contact.inputs.material import Material
from contact.results import Strips

#: Elements along a strip for linear theory.
_COARSE = 16
#: Share of the first yield stress that an element has at least when it begins to yield. Within one element it softens on, as in
#: CONTACT, here to no less than `LEAST` of that stress.
FLOOR, LEAST = 0.1, 1e-6
#: Iteration with hardening: largest number of steps, and change of tau_c over the yield stress at its end.
_MAX_STEPS, _TOLERANCE = 60, 1e-6


@dataclass(frozen=True, slots=True)
class ThirdBody:
    """A layer between wheel and rail, for the tangential method "halfspace".

    Parameters
    ----------
    flexibility : float
        Thickness over shear modulus of the layer [m/Pa] ≥ 0.
    yield_stress : float
        Shear stress at which fresh material yields [Pa], positive; infinite without plasticity.
    hardening : float
        Rise of the yield stress per plastic shear displacement [Pa/m]; negative if the layer softens, to about a tenth.

    Raises
    ------
    ContactError
        For a number outside its range.

    Examples
    --------
    >>> import contact
    >>> layer = contact.ThirdBody(flexibility=4e-14)
    >>> free = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(), load=80e3)
    >>> 0.0 < layer.slope(free.strips, free.material) < 1.0  # creep curves start less steeply
    True
    """

    flexibility: float = 0.0
    yield_stress: float = math.inf
    hardening: float = 0.0

    def __post_init__(self) -> None:
        require_number("layer.flexibility", self.flexibility, 0.0)
        if self.yield_stress != math.inf:
            require_number("layer.yield_stress", self.yield_stress, 0.0, open_minimum=True)
        require_number("layer.hardening", self.hardening)

    def slope(self, strips: Strips, material: Material) -> float:
        """Return the creep stiffness with this layer over that without it [-], for `Friction(slope=…)` of fast methods.

        Both flexibilities are in series: that of linear theory on the patch, and that of the layer alone, ∑ 2a² dy over the
        flexibility. On 0.15 mm elements the half space with the layer is within 3 % of this (other_contacts.md).
        """
        alone = -float(linear.slopes(strips, material, _COARSE)[0, 0])
        moment = float((2.0 * strips.a**2 * strips.dy).sum())
        return moment / (moment + alone * self.flexibility)


@dataclass(frozen=True, slots=True, eq=False)
class Sheared:
    """State of the layer; arrays have the shape of the solution's fields.

    Attributes
    ----------
    yield_stress : tau_c [Pa]
    ux, uy : plastic shear displacement since the particle entered, wheel against rail [m]
    plastic : True where the layer yields
    power_per_metre : plastic work per metre rolled [N]
    """

    yield_stress: Array
    ux: Array
    uy: Array
    plastic: NDArray[np.bool_]
    power_per_metre: float

    def __post_init__(self) -> None:
        for field in (self.yield_stress, self.ux, self.uy, self.plastic):
            field.setflags(write=False)

    def part(self, box: tuple[NDArray[np.int64], ...]) -> Sheared:
        """Return the state on a part of the grid."""
        return Sheared(self.yield_stress[box], self.ux[box], self.uy[box], self.plastic[box], self.power_per_metre)


def solve_layer(
    body: ThirdBody, limit: Array, steps: tuple[float, float], solve: Callable[[Array], Tangential]
) -> tuple[Tangential, Sheared]:
    """Return the tangential solution and the state of the layer.

    `limit` is friction times pressure [Pa], `steps` the size of an element [m]. `solve` returns the solution for a bound of
    the traction [Pa].
    """
    tau = np.full(limit.shape, body.yield_stress)
    last, share = math.inf, 1.0
    for _ in range(_MAX_STEPS):
        found = solve(np.minimum(limit, tau))
        shift = steps[0] * np.hypot(found.sx, found.sy)
        wanted, plastic = hardened(body, limit, shift)
        if body.hardening == 0.0 or body.yield_stress == math.inf:
            break
        change = float(np.abs(wanted - tau)[limit > 0.0].max(initial=0.0)) / body.yield_stress
        if change <= _TOLERANCE:
            break
        share = 0.5 * share if change > last else share
        tau, last = tau + share * (wanted - tau), change
    else:
        found = replace(found, converged=False)
    left = 1.0 - plastic / np.where(shift > 0.0, shift, 1.0)
    sheared = (1.0 - left) * np.stack((found.sx, found.sy))  # over V
    # u(x) = u(x + dx) - dx·slip: the plastic shear opposes the slip that it replaces
    ux, uy = (-steps[0] * from_the_front(component, limit) for component in sheared)
    power = -float((found.qx * sheared[0] + found.qy * sheared[1]).sum()) * steps[0] * steps[1]
    state = Sheared(np.where(limit > 0.0, wanted, 0.0), ux, uy, plastic > 0.0, power)
    return replace(found, sx=left * found.sx, sy=left * found.sy), state


def hardened(body: ThirdBody, limit: Array, shift: Array) -> tuple[Array, Array]:
    """Return tau_c [Pa] and the plastic part [m] of the `shift` of each element, row by row from the leading edge."""
    tau, plastic = np.full(limit.shape, body.yield_stress), np.zeros(limit.shape)
    if body.yield_stress == math.inf:
        return tau, plastic
    before = np.full(limit.shape[0], body.yield_stress)
    for j in range(limit.shape[1] - 1, -1, -1):
        touching = limit[:, j] > 0.0
        before = np.where(touching, before, body.yield_stress)
        part = np.where(before < limit[:, j], shift[:, j], 0.0)
        if body.hardening > 0.0:  # until the layer is as strong as friction; the rest is slip
            part = np.minimum(part, np.maximum(limit[:, j] - before, 0.0) / body.hardening)
        tau[:, j], plastic[:, j] = np.maximum(before + body.hardening * part, LEAST * body.yield_stress), part
        before = np.maximum(tau[:, j], FLOOR * body.yield_stress)
    return tau, plastic


def from_the_front(field: Array, limit: Array) -> Array:
    """Return the sum of a field over the elements from the leading edge to each element; outside the contact 0."""
    total = np.zeros(field.shape)
    for j in range(field.shape[1] - 1, -1, -1):
        ahead = total[:, j + 1] if j + 1 < field.shape[1] else 0.0
        total[:, j] = np.where(limit[:, j] > 0.0, ahead + field[:, j], 0.0)
    return total
