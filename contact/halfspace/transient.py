"""Shift and transient rolling, step by step, on the element-wise half space (other_contacts.md).

A step moves the contact by the distance D and the bodies against each other. The shift of the surfaces against each other
in the step is, over D (Kalker 1990),

    s(x) = w(x + D/6) + [C q(x) - C q'(x + D)]/D,

with the traction q' before the step. Coulomb's law holds for s as in steady rolling (`contact.halfspace.newton`). The
operator C is symmetric here. A particle that enters the contact within the step, because D is longer than an element, has
only the share (x_lead - x)/D of the rigid slip, and the displacement at x_lead, one element ahead of the leading one.

In a pure shift the contact does not move: s(x) = W + C q(x) - C q'(x) in metres.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.creepage import Creepage
from contact.errors import ContactError, require_number, require_pair
from contact.friction import Friction, as_friction
from contact.halfspace import influence as half_space
from contact.halfspace import zones
from contact.halfspace.bent import Bent
from contact.halfspace.gap import Division, Gap
from contact.halfspace.influence import Influence, Transfer, fast_length
from contact.halfspace.newton import Newton, Operator
from contact.halfspace.norm import Normal, norm
from contact.halfspace.solution import GridSolution, assemble
from contact.halfspace.solve import grid_of, status_of
from contact.halfspace.tang import OFFSET, Tangential, rigid_slip
from contact.material import STEEL, Material
from contact.ownership import OwnsArrays, one_thread
from contact.separation import Separation

#: A step that Newton's iteration does not solve from the last traction is led there in this number of parts.
_PARTS = 5
#: Residual of a step.
_TOLERANCE = 1e-7


class Transient(OwnsArrays):
    """A contact that is shifted and rolled in steps, with its traction.

    It serves one thread. A copy, by `copy.copy` or a pickle, continues from the same traction.

    Parameters
    ----------
    separation : Separation or contact.halfspace.Gap
        Undeformed gap.
    load : float
        Normal force [N], positive. A step may have a smaller one.
    friction : float or contact.friction.Friction
        Coefficient mu ≥ 0 [-], or a law over the global velocity.
    material : Material
    speed : float
        Rolling speed V [m/s] ≥ 0; it only scales velocities and powers, and friction laws.
    spacing : float or (float, float)
        Size (dx, dy) of the elements [m]. Default: 40 × 40 elements over the undeformed overlap of a separation.

    Attributes
    ----------
    distance : float
        Distance rolled since the start [m].

    Raises
    ------
    ContactError
        For arguments outside their range.

    Examples
    --------
    >>> import contact
    >>> contact_patch = contact.Transient(contact.Separation.hertzian(1.1, 0.8), load=80e3, spacing=0.5e-3)
    >>> held = contact_patch.shift(longitudinal=-5e-6)
    >>> rolled = [contact_patch.roll(contact.Creepage(1e-3), distance=0.5e-3) for _ in range(20)]
    >>> held.Fx > 0.0 > rolled[-1].Fx
    True
    """

    def __init__(
        self,
        separation: Separation | Gap,
        *,
        load: float,
        friction: float | Friction = 0.3,
        material: Material = STEEL,
        speed: float = 20.0,
        spacing: float | tuple[float, float] | None = None,
        progress: Callable[[int, float], None] | None = None,
    ) -> None:
        if not isinstance(separation, Separation | Gap):
            raise ContactError(f"separation = {separation!r} is not a contact.Separation")
        self._load = require_number("load", load, 0.0, open_minimum=True)
        self.friction, self.material = as_friction(friction), material
        law = self.friction
        if (law.velocity != "global" and law.law != "coulomb") or law.hot_factor < 1.0:
            raise ContactError(
                "friction: a step takes one coefficient; allowed: a law over the global velocity, not hot"
            )
        if material.coupling != 0.0:
            raise ContactError(f"material.coupling = {material.coupling:g}: a step takes like bodies; allowed: 0")
        self.speed, self._progress = require_number("speed", speed, 0.0), progress
        division = Division(40, 40, None if spacing is None else require_pair("spacing", spacing))
        grid = separation if isinstance(separation, Gap) else grid_of(separation, load, None, material, division)
        assert grid is not None  # there is a load
        self._gap, self._grid = separation, grid
        self._traction = np.zeros((2, *grid.h.shape))
        self._normal = norm(grid.h, grid.dx, grid.dy, material, load=load)
        self.distance = 0.0

    def _kept(self) -> Any:
        return self._traction, self._normal, self.distance

    def _keep(self, kept: Any) -> None:
        self._traction, self._normal, self.distance = kept

    @one_thread
    def shift(
        self, longitudinal: float = 0.0, lateral: float = 0.0, rotation: float = 0.0, *, load: float | None = None
    ) -> GridSolution:
        """Shift the wheel against the rail without rolling, and return the solution.

        Parameters
        ----------
        longitudinal, lateral : float
            Rigid shift of the wheel against the rail at the origin [m].
        rotation : float
            About the normal [rad].
        load : float
            Normal force of this and the following steps [N], 0 to that of the constructor.

        Returns
        -------
        GridSolution
            `sx`, `sy` are the distances slipped [m], `power_per_metre` is the work of friction in this step [J].
        """
        numbers = (("longitudinal", longitudinal), ("lateral", lateral), ("rotation", rotation))
        moved = Creepage(*(require_number(name, value) for name, value in numbers))
        return self._step(moved, 0.0, load, self.friction.static)

    @one_thread
    def roll(self, creepage: Creepage, *, distance: float, load: float | None = None) -> GridSolution:
        """Roll by `distance` [m], and return the solution.

        Parameters
        ----------
        creepage : Creepage
            Wheel minus rail over V, constant in the step.
        distance : float
            Rolled in this step [m], positive. The error of a step is of first order in the distance; one to two elements are
            usual. Much shorter steps bring wiggles of the traction from element to element.
        load : float
            Normal force of this and the following steps [N], 0 to that of the constructor.

        Returns
        -------
        GridSolution
            `sx`, `sy` are the slip velocities over V, averaged over the step.
        """
        if not isinstance(creepage, Creepage):
            raise ContactError(f"creepage = {creepage!r} is not a contact.Creepage")
        step = require_number("distance", distance, 0.0, open_minimum=True)
        velocity = self.speed * math.hypot(creepage.longitudinal, creepage.lateral)
        solution = self._step(creepage, step, load, float(self.friction.coefficient(velocity)))
        self.distance += step
        return solution

    @property
    def displacement(self) -> tuple[Array, Array]:
        """Elastic displacement of the wheel's surface against the rail's along x and y [m], on the fields of `grid`."""
        ux, uy = self._influence.times(self._transfer(0.0), self._traction)
        return ux, uy

    @property
    def grid(self) -> tuple[Array, Array]:
        """Centres x, y of all elements [m]."""
        return self._grid.x, self._grid.y

    @cached_property
    def _influence(self) -> Influence:
        return Influence(self._grid.h.shape, self._grid.dx, self._grid.dy, self.material)

    def _transfer(self, ahead: float) -> Transfer:
        """Return the transfer functions of the displacement at x + `ahead` [m]."""
        h, grid = self._influence, self._grid
        columns = ahead / grid.dx
        if columns == 0.0 or math.isclose(columns, 1.0, rel_tol=1e-9):
            factor = 1.0 if columns == 0.0 else h.ahead
            return h.xx * factor, h.yy * factor, h.xy * factor
        ny, nx = grid.h.shape
        padded = fast_length(2 * ny), fast_length(2 * nx + 2)
        X = np.fft.fftfreq(padded[1], 1.0 / padded[1]) * grid.dx + ahead
        Y = np.fft.fftfreq(padded[0], 1.0 / padded[0]) * grid.dy
        numbers = half_space.tangential(X, Y[:, None], grid.dx, grid.dy, self.material)
        xx, yy, xy = (np.fft.rfft2(field) for field in numbers)
        return xx, yy, xy

    def _step(self, motion: Creepage, distance: float, load: float | None, mu: float) -> GridSolution:
        """Return the solution of one step; `distance` 0 is a shift, then everything is in metres instead of over V."""
        grid = self._grid
        if load is not None:
            self._press(load)
        p = self._normal.p
        factor = self.friction.factor(grid.y)[:, None] if self.friction.gauge_factor != 1.0 else 1.0
        bound, rows = mu * factor * p, Bent.plane(motion, grid.y)
        w, per_metre = rigid_slip(grid.x, rows, OFFSET * distance), 1.0 / distance if distance > 0.0 else 1.0
        before, reach = self._before(p, distance)
        w = reach * w - per_metre * before
        found = self._coulomb(bound, w, per_metre)
        self._traction = np.stack((found.qx, found.qy))
        return assemble(
            grid.x,
            grid.y,
            p,
            found,
            rows,
            approach=self._normal.approach,
            stiffness=self._normal.stiffness,
            iterations=self._normal.iterations + found.iterations,
            status=status_of(self._gap, p, grid.y, self._normal.converged and found.converged),
            creepage=motion,
            friction=mu,
            material=self.material,
            speed=self.speed,
            normal="halfspace",
            tangential="halfspace",
        )

    def _press(self, load: float) -> None:
        """Solve the normal problem for another load."""
        require_number("load", load, 0.0, self._load)
        if load == 0.0:
            self._normal = Normal(np.zeros(self._grid.h.shape), float(self._grid.h.min()), 0.0, 0, True)
        else:
            self._normal = norm(self._grid.h, self._grid.dx, self._grid.dy, self.material, load=load)

    def _before(self, p: Array, distance: float) -> tuple[Array, Array]:
        """Return the displacement of each particle before the step [m], and its share of the rigid slip [-]."""
        before = self._influence.times(self._transfer(distance), self._traction)
        reach = np.ones(p.shape)
        dx = self._grid.dx
        if distance <= dx * (1.0 + 1e-9):
            return before, reach
        here = self._influence.times(
            self._transfer(dx), self._traction
        )  # at x + dx, so column j has the displacement of j + 1
        for i, row in enumerate(p):
            touching = np.flatnonzero(row > 0.0)
            if touching.size:
                lead = int(touching[-1])
                room = (lead + 1 - np.arange(row.size)) * dx
                entered = (room < distance) & (room > 0.0)
                reach[i, entered] = room[entered] / distance
                before[:, i, entered] = here[:, i, lead][:, None]
        return before, reach

    def _coulomb(self, bound: Array, w: Array, per_metre: float) -> Tangential:
        """Return the tangential solution for the rigid slip `w`, with what was there before the step."""
        shape, h = bound.shape, self._influence
        if not bound.any():
            zero = np.zeros(shape)
            return Tangential(zero, zero, zero, zero, np.zeros(shape, dtype=bool), 0, 0, 0.0, True)
        newton = Newton(bound, h, _TOLERANCE, self._progress)
        own = float(half_space.tangential(0.0, 0.0, self._grid.dx, self._grid.dy, self.material)[0]) * per_metre
        newton.operator = Operator((h.xx * per_metre, h.yy * per_metre, h.xy * per_metre), own, 1.0 / per_metre, 0.0)
        q, residual = newton.solve(self._traction, w)
        if residual > _TOLERANCE:
            rest = self._influence.times(
                newton.operator.transfer, self._traction
            )  # w = -rest is where the last traction stays
            q = self._traction
            for part in range(1, _PARTS + 1):
                q, residual = newton.solve(q, -rest + (w + rest) * (part / _PARTS))
        s = newton.slip(q, w)
        zones.settle(q, s, newton.zone, bound)
        stick = newton.zone == zones.STICK
        converged = residual <= _TOLERANCE
        return Tangential(q[0], q[1], s[0], s[1], stick, newton.iterations, newton.products, residual, converged)
