"""`Pressed`, a solved normal problem on which TANG is solved for any creepage, with friction laws, unlike bodies and layers."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.friction import Friction
from contact.halfspace.bent import Bent, Surface
from contact.halfspace.curved import BentCoupling
from contact.halfspace.driven import GivenForces
from contact.halfspace.heat import heat_up
from contact.halfspace.norm import Normal
from contact.halfspace.solution import GridSolution, PressedRecord, assemble
from contact.halfspace.tang import OFFSET, Tangential, prepare, tang
from contact.halfspace.third_body import Sheared, ThirdBody, solve_layer
from contact.halfspace.unlike import Coupling
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material
from contact.instance.case import set_surface
from contact.kernels.friction import of_bodies
from contact.kernels.records import CASE
from contact.results import Status

#: Iteration of friction that depends on local slip velocity or temperature: largest number of steps, relaxation factor,
#: tolerance over mu.
_MAX_FALLS, _FALL_SHARE, _FALL_TOLERANCE = 60, 0.5, 1e-3
#: Alternation of normal and tangential problem for unlike bodies: largest number of turns, and change of the pressure over
#: its maximum at the end.
_MAX_TURNS, _TURN_TOLERANCE = 40, 1e-6
#: Tolerance of the traction at the end, and that of the first turn. In between it is this share of the last change. That of
#: the pressure is a hundredth, at least 1e-7.
_FINE, _LOOSE, _SHARE_OF_CHANGE = 1e-6, 0.03, 0.05


class Pressed:
    """A solved normal problem on a grid, on which the tangential problem is solved for any creepage.

    Parameters
    ----------
    x, y, p : pressure [Pa], shape (ny, nx), at the centres `x`, `y` [m] of the elements; `y` along the surface
    surface : the curved surface in which the bodies touch; None for the plane
    material, friction, speed, progress : as in `contact.solve`
    record : approach, stiffness, iterations, status and normal method of the normal problem
    again : callable
        Solves the normal problem again for a traction that opens the gap by a field [m], from a pressure, with the part of
        the load that the traction bears [N], to a relative tolerance. Without it the pressure keeps its shape.
    load : normal force [N]; None if the approach is given
    """

    def __init__(
        self,
        x: Array,
        y: Array,
        p: Array,
        record: PressedRecord,
        *,
        surface: Surface | None,
        material: Material,
        friction: Friction,
        speed: float,
        progress: Callable[[int, float], None] | None,
        layer: ThirdBody | None = None,
        again: Callable[[Array, Array, float, float], Normal] | None = None,
        load: float | None = None,
    ) -> None:
        self.x, self.y, self.p, self.record, self.surface = x, y, p, record, surface
        self.material, self.friction, self.speed, self.progress = material, friction, speed, progress
        self._again, self.layer, self.load = again, layer, load
        self._sheared: Sheared | None = None
        #: Traction of the last call of `roll` [Pa].
        self.traction: tuple[Array, Array] | None = None

    def roll(self, creepage: Creepage) -> GridSolution:
        """Return the solution for a creepage, by TANG. It starts from pressure and traction of the last call."""
        rows = Bent.plane(creepage, self.y) if self.surface is None else self.surface.rows(creepage, self.y)
        if (self.material.coupling == 0.0 and self.surface is None) or not self.p.any():
            rolling, coefficient = self._tangential(creepage, rows, None, _FINE)
            converged = rolling.converged
        else:
            rolling, coefficient, converged = self._alternate(creepage, rows)
        record = self.record
        kept = converged or record.status in (Status.OUT_OF_RANGE, Status.NO_CONTACT)
        return assemble(
            self.x,
            self.y,
            self.p,
            rolling,
            rows,
            record if kept else record._replace(status=Status.NOT_CONVERGED),
            creepage=creepage,
            friction=coefficient,
            material=self.material,
            speed=self.speed,
            layer=self._sheared,
            surface=self.surface,
        )

    def creepage_for(self, force: tuple[float | None, float | None], start: Creepage) -> Creepage:
        """Return the creepage under the given forces [N], and let the next call of `roll` start from its traction.

        It is exact for like bodies, a plane, no plastic layer and a coefficient of friction that does not depend on slip.
        Otherwise it is an estimate. It is `start` if none is found. Where a force is None, the creepage of `start` is kept.
        """
        unknown = [k for k in (0, 1) if force[k] is not None]
        bound = self._coefficient(start) * self.factor() * self.p
        area = float((self.x[1] - self.x[0]) * (self.y[1] - self.y[0]))
        wanted = np.array([f for f in force if f is not None]) / area
        if self.surface is not None or math.sqrt(float(wanted @ wanted)) >= float(bound.sum()):
            return start
        known = [0.0 if k in unknown else v for k, v in enumerate((start.longitudinal, start.lateral))]
        rows = Bent.plane(Creepage(known[0], known[1], start.spin), self.y)
        added = np.sum([c.slip(self.p, bound, bound) for c in self._couplings()], axis=0) if self._couplings() else None
        layer = 0.0 if self.layer is None else self.layer.flexibility
        ground = self.p, self.x, self.y, rows, bound, self.material
        rolling, w, window = prepare(*ground, OFFSET, added, layer, _FINE, self.progress)
        found = GivenForces(rolling, w, unknown, wanted).solve(np.zeros(len(unknown)))
        if found is None:
            return start
        for k, value in zip(unknown, found[0], strict=True):
            known[k] = float(value)
        traction = np.zeros((2, *self.p.shape))
        traction[:, *window] = found[1]
        self.traction = traction[0], traction[1]
        return Creepage(known[0], known[1], start.spin)

    def _coefficient(self, creepage: Creepage) -> float:
        """Return the coefficient of friction at a creepage; the static one if it depends on the slip of each place."""
        if self.friction.velocity != "global" and self.friction.law != "coulomb":
            return self.friction.static
        return float(self.friction.coefficient(self.speed * math.hypot(creepage.longitudinal, creepage.lateral)))

    def factor(self) -> Array:
        """Return the factor on the coefficient of friction of each row, shape (ny, 1) or (1, 1)."""
        friction = self.friction
        y = self.y if self.surface is None else self.surface.across(self.y)
        return friction.factor(y)[:, None] if friction.gauge_factor != 1.0 else np.ones((1, 1))

    def _tangential(
        self, creepage: Creepage, rows: Bent, added: Array | None, tolerance: float
    ) -> tuple[Tangential, float]:
        """Return the tangential solution on the present pressure, and the coefficient of friction."""
        if self.layer is None:
            found, coefficient = _roll(self, creepage, rows, self.traction, added, tolerance)
        else:
            found, coefficient = self._shear(self.layer, creepage, rows, self.traction, added)
        self.traction = found.qx, found.qy
        return found, coefficient

    def _shear(
        self, layer: ThirdBody, creepage: Creepage, rows: Bent, start: tuple[Array, Array] | None, added: Array | None
    ) -> tuple[Tangential, float]:
        """Return the solution with a third body and the coefficient of friction. Keep the state of the layer."""
        mu, factor = self._coefficient(creepage), self.factor()
        touching = np.where(self.p > 0.0, self.p, 1.0)

        def solve(bound: Array) -> Tangential:
            nonlocal start
            found = tang(
                self.p,
                self.x,
                self.y,
                rows,
                bound / touching,
                self.material,
                start=start,
                added=added,
                layer=layer.flexibility,
                progress=self.progress,
            )
            start = found.qx, found.qy
            return found

        steps = float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0])
        found, self._sheared = solve_layer(layer, mu * factor * self.p, steps, solve)
        return found, mu

    def _alternate(self, creepage: Creepage, rows: Bent) -> tuple[Tangential, float, bool]:
        """Solve both problems of unlike bodies or on a bent surface in turn until neither changes (Panagiotopoulos).

        Both are solved roughly at first. A change that grows is halved. Return the tangential solution, the coefficient of
        friction and whether it converged.
        """
        couplings = self._couplings()
        last, share = math.inf, 1.0
        qx = qy = np.zeros(self.p.shape)
        if self.traction is not None:
            qx, qy = self.traction
        for _ in range(_MAX_TURNS):
            before, tolerance = (qx, qy), min(max(_SHARE_OF_CHANGE * last, _FINE), _LOOSE)
            added = np.sum([c.slip(self.p, qx, qy) for c in couplings], axis=0)
            rolling, coefficient = self._tangential(creepage, rows, added, tolerance)
            qx, qy = rolling.qx, rolling.qy
            found = self._follow(
                np.sum([c.opening(qx, qy) for c in couplings], axis=0), rows, qy, max(0.01 * tolerance, 1e-7)
            )
            change = float(np.abs(found.p - self.p).max() / found.p.max())
            if self.surface is not None:  # the slip depends on the traction too
                moved = max(float(np.abs(new - old).max()) for new, old in zip((qx, qy), before, strict=True))
                change = max(change, moved / float(self.p.max()))
            if change <= _TURN_TOLERANCE and tolerance == _FINE:
                return rolling, coefficient, rolling.converged and found.converged
            share = 0.5 * share if change > last else share
            self.p, last = self.p + share * (found.p - self.p), change
            self.record = self.record._replace(approach=found.approach, stiffness=found.stiffness)
        return rolling, coefficient, False

    def _follow(self, opening: Array, rows: Bent, qy: Array, tolerance: float) -> Normal:
        """Return the pressure under a traction that opens the gap by `opening` [m] and bears a part of the load."""
        sine = (rows.tilt / np.sqrt(1.0 + rows.tilt**2))[:, None]
        area = float((self.x[1] - self.x[0]) * (self.y[1] - self.y[0]))
        borne = -float((sine * qy).sum()) * area
        if self._again is not None:
            return self._again(opening, self.p, borne, tolerance)
        scale = 1.0
        if self.load is not None:
            scale = (self.load - borne) / (float((self.p / np.sqrt(1.0 + rows.tilt**2)[:, None]).sum()) * area)
        return Normal(scale * self.p, self.record.approach, self.record.stiffness, 0, True)

    def _couplings(self) -> list[Coupling | BentCoupling]:
        """Return what couples pressure and traction."""
        size = self.p.shape, float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0]), self.material
        found: list[Coupling | BentCoupling] = [Coupling(*size)] if self.material.coupling != 0.0 else []
        if self.surface is not None:
            found.append(BentCoupling(*size, self.surface.angle(self.y)))
        return found


def _roll(
    pressed: Pressed,
    creepage: Creepage,
    rows: Bent,
    start: tuple[Array, Array] | None,
    added: Array | None,
    tolerance: float,
) -> tuple[Tangential, float]:
    """Return the solution by TANG with a friction law, and the largest coefficient of friction [-].

    If friction depends on the local slip velocity or the temperature, TANG is solved repeatedly, each time with the
    coefficients from the previous slip. The first solution has the full coefficient. Only a share of each change is applied,
    because several solutions and oscillation between them are possible. For a given slip, the temperature is that of the
    reduced friction (`heat`).
    """
    p, x, y, friction, speed = pressed.p, pressed.x, pressed.y, pressed.friction, pressed.speed
    to: dict[str, Any] = {"added": added, "tolerance": tolerance, "progress": pressed.progress}
    surface = np.zeros(1, CASE)
    set_surface(surface, friction, speed)
    case = surface[0]
    factor = of_bodies(case) * (friction.factor(rows.y)[:, None] if friction.gauge_factor != 1.0 else np.ones((1, 1)))
    local, hot = friction.velocity != "global" and friction.law != "coulomb", friction.hot_factor < 1.0
    mu = friction.static
    if not local:
        mu = float(friction.coefficient(speed * math.hypot(creepage.longitudinal, creepage.lateral)))
    if not (local or hot):
        return tang(p, x, y, rows, mu * factor, pressed.material, start=start, **to), mu
    field = np.full(p.shape, mu)
    rolling = tang(p, x, y, rows, field * factor, pressed.material, start=start, **to)
    for _ in range(_MAX_FALLS):
        slip, wanted = np.hypot(rolling.sx, rolling.sy), np.full(p.shape, mu)
        if local:
            wanted = np.minimum(friction.coefficient(speed * slip), mu)
        if friction.velocity == "greatest":  # particles enter at the leading edge, x = max
            wanted = np.minimum.accumulate(wanted[:, ::-1], axis=1)[:, ::-1]
        if hot:
            heat_up(case, factor * p * slip, x[1] - x[0], wanted)
        change = wanted - field
        field = field + _FALL_SHARE * change
        start = rolling.qx, rolling.qy
        rolling = tang(p, x, y, rows, field * factor, pressed.material, start=start, **to)
        if abs(change * (p > 0.0)).max() <= _FALL_TOLERANCE * mu:
            return rolling, mu
    return replace(rolling, converged=False), mu
