"""One step of a contact in time: normal and tangential problem with what the step finds, iterated together.

The tangential problem of a step is Newton's iteration with active sets (`contact.halfspace.newton`), with creepages that
answer given forces (`contact.halfspace.driven`). What depends on its result follows in turns: friction over the local slip,
the yield stress of a layer, and the pressure between unlike bodies. A change that grows is halved.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.halfspace import influence as half_space
from contact.halfspace import zones
from contact.halfspace.bent import Bent
from contact.halfspace.driven import driven, followed
from contact.halfspace.influence import Influence, Transfer, fast_length
from contact.halfspace.local_law import LocalLaw
from contact.halfspace.newton import Newton, Operator
from contact.halfspace.norm import Normal
from contact.halfspace.state import State
from contact.halfspace.tang import OFFSET, Rolling, Tangential, frictionless, rigid_slip
from contact.halfspace.third_body import FLOOR, LEAST, Sheared, ThirdBody, from_the_front, hardened
from contact.halfspace.unlike import Coupling
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material

#: Residual of a step.
_TOLERANCE = 1e-7
#: Turns: their largest number, and the change of coefficient, yield stress or pressure over its scale at which they end.
_MOST_TURNS, _MOST_FALLS, _TURN_TOLERANCE, _FALL_TOLERANCE = 60, 200, 1e-6, 1e-5
#: Least share of a change of friction.
_LEAST_FALL = 0.02


class Outcome(NamedTuple):
    """Normal and tangential solution of a step, its creepage, the state of the layer, and whether the turns came to rest."""

    normal: Normal
    tangential: Tangential
    creepage: Creepage
    sheared: Sheared | None
    state: State
    converged: bool


class Stepper:
    """The half space under a grid, a law of friction and a layer: what steps need.

    Parameters
    ----------
    x, y : centres of the elements [m]
    material, layer : bodies and what is between them
    law : friction of each element
    speed : rolling speed [m/s]
    turns : largest number of turns between pressure and traction of unlike bodies; with 1 the traction does not change the
        pressure
    """

    def __init__(
        self,
        x: Array,
        y: Array,
        material: Material,
        layer: ThirdBody | None,
        law: LocalLaw,
        speed: float,
        turns: int,
        progress: Callable[[int, float], None] | None,
    ) -> None:
        self.x, self.y, self.material, self.layer, self.law, self.speed = x, y, material, layer, law, speed
        self.dx, self.dy = float(x[1] - x[0]), float(y[1] - y[0])
        self.shape = y.size, x.size
        self.soft = 0.0 if layer is None else layer.flexibility
        self.influence = Influence(self.shape, self.dx, self.dy, material, self.soft)
        self.coupling = Coupling(self.shape, self.dx, self.dy, material) if material.coupling != 0.0 else None
        self._turns, self.progress = turns, progress
        #: Rigid slip of each element besides that of the motion, shape (2, ny, nx).
        self.slip: Array | float = 0.0

    def fresh(self) -> State:
        """Return the state of a contact that has not been touched."""
        zero = np.zeros(self.shape)
        static = np.broadcast_to(self.law.static, self.shape).copy()
        tau = np.full(self.shape, math.inf if self.layer is None else self.layer.yield_stress)
        return State(np.zeros((2, *self.shape)), zero, static, tau, np.zeros((2, *self.shape)))

    def solve(
        self,
        state: State,
        motion: Creepage,
        distance: float,
        press: Callable[[Array | None, Array | None], Normal],
        factor: Array | float,
        mu: float | None,
        force: tuple[float | None, float | None],
        sliding: bool = False,
    ) -> Outcome:
        """Return the outcome of a step.

        `distance` [m] is 0 for a shift and infinite for steady rolling. `press` returns the normal solution for an opening of
        the gap by traction [m], from a pressure. `factor` is that of each row on the friction. `mu` is the coefficient of
        friction, None for that of each element. `force` are given forces on the wheel [N], None where `motion` is given.
        With `sliding` the search for friction that falls starts from fast sliding.
        """
        steady, before = math.isinf(distance), self._moved(state, distance)
        normal = press(None, None)
        field = np.broadcast_to(self.law.static if mu is None else np.float64(mu), self.shape).copy()
        local = mu is None and not self.law.constant
        if local and not steady and self.law.memory_distance > 0.0:
            field = before.mu.copy()
        elif local and sliding:
            field = self.law.at(np.full(self.shape, 1e9))
        tau = before.tau if self.layer is not None and not steady else self.fresh().tau
        plastic = self.layer is not None and self.layer.yield_stress < math.inf
        q, u, share, last, p = state.traction, np.zeros(2), 1.0, math.inf, normal.p
        converged, velocity = False, self.speed if distance > 0.0 else 1.0
        tau_before, shear, fall, before_it = tau, before.shear, 0.5, field
        for turn in range(_MOST_FALLS if local else _MOST_TURNS):
            limit = np.minimum(field * factor, 1e300) * p
            found, u = self._tangential(q, state, p, motion, distance, np.minimum(limit, tau), force, u)
            q = np.stack((found.qx, found.qy))
            slip = np.hypot(found.sx, found.sy)
            change = 0.0
            if local:
                touching, time = p > 0.0, self._time(distance)
                wanted = (
                    self.law.along_rows(velocity * slip, touching, self._time(self.dx), self._warm(found))
                    if steady
                    else self.law.followed(velocity * slip, before.mu, time)
                )
                difference = np.where(touching, wanted - field, 0.0)
                change = float(np.abs(difference).max() / max(float(field.max()), 1e-300))
            if plastic:
                assert self.layer is not None
                shift = slip * (self.dx if steady else distance if distance > 0.0 else 1.0)
                if steady:
                    new_tau, part = hardened(self.layer, limit, shift)
                else:
                    new_tau, part = _yielded(self.layer, tau_before, limit, shift)
                if self.layer.hardening != 0.0:
                    there = limit > 0.0
                    change = max(change, float(np.abs(new_tau - tau)[there].max(initial=0.0)) / self.layer.yield_stress)
            if self.coupling is not None and turn + 1 < self._turns:
                pressed = press(self.coupling.opening(*q), p)
                change = max(change, float(np.abs(pressed.p - p).max() / max(float(p.max()), 1e-300)))
            if change <= (_FALL_TOLERANCE if local else _TURN_TOLERANCE):
                converged = True
                break
            if local:
                # falling friction drives itself on to a stable slip, so only a change that turns back is halved
                turned = turn > 0 and float((difference * before_it).sum()) < 0.0
                fall = max(0.7 * fall if turned else min(1.1 * fall, 1.0), _LEAST_FALL)
                field, before_it = field + fall * difference, difference
            share = 0.5 * share if change > last else share
            last = change
            if plastic and self.layer is not None and self.layer.hardening != 0.0:
                tau = tau + share * (new_tau - tau)
            if self.coupling is not None and turn + 1 < self._turns:
                p, normal = p + share * (pressed.p - p), pressed
        sheared = None
        if self.layer is not None:
            found, sheared, tau, shear = self._sheared(
                found, limit, distance, plastic, locals().get("part"), tau, before
            )
        kept = State(q, p, np.where(p > 0.0, field, self.fresh().mu), tau, shear)
        given = [motion.longitudinal, motion.lateral]
        for k in (0, 1):
            given[k] = float(u[k]) if force[k] is not None else given[k]
        return Outcome(replace(normal, p=p), found, Creepage(given[0], given[1], motion.spin), sheared, kept, converged)

    def _warm(self, found: Tangential) -> Array | None:
        """Return what the temperature adds to the coefficient of friction of each element [-]."""
        if self.law.warmth is None:
            return None
        heat = -(found.qx * found.sx + found.qy * found.sy) * self.speed
        return self.law.warmth.added(self.law.warmth.rise(np.maximum(heat, 0.0), self.dx, max(self.speed, 1e-300)))

    def _time(self, distance: float) -> float:
        return 1.0 if distance == 0.0 else distance / max(self.speed, 1e-300)

    def _sheared(
        self,
        found: Tangential,
        limit: Array,
        distance: float,
        plastic: bool,
        part: Array | None,
        tau: Array,
        before: State,
    ) -> tuple[Tangential, Sheared, Array, Array]:
        """Return the tangential solution with the slip that the layer has not taken, and the state of the layer."""
        steady = math.isinf(distance)
        step = self.dx if steady else distance if distance > 0.0 else 1.0
        if not plastic or part is None:
            part = np.zeros(self.shape)
        slip = np.hypot(found.sx, found.sy)
        taken = np.where(slip > 0.0, part / (step * np.where(slip > 0.0, slip, 1.0)), 0.0)
        layer = taken * np.stack((found.sx, found.sy))
        change = -step * layer  # the plastic shear opposes the slip that it replaces
        if steady:
            shear = np.stack([from_the_front(component, limit) for component in change])
        else:
            shear = np.where(limit > 0.0, before.shear + change, 0.0)
        power = -float((found.qx * layer[0] + found.qy * layer[1]).sum()) * self.dx * self.dy
        fresh = self.fresh().tau
        tau = np.where(limit > 0.0, tau, fresh)
        sheared = Sheared(np.where(limit > 0.0, tau, 0.0), shear[0], shear[1], part > 0.0, power)
        left = 1.0 - taken
        return replace(found, sx=left * found.sx, sy=left * found.sy), sheared, tau, shear

    def _moved(self, state: State, distance: float) -> State:
        """Return coefficient, yield stress and plastic shear of the particles that are now at each element."""
        fresh = self.fresh()
        if math.isinf(distance):
            return fresh
        columns = distance / self.dx

        def at(field: Array, new: Array) -> Array:
            known = np.where(state.p > 0.0, field, new)
            if columns == 0.0:
                return known
            whole = math.floor(columns + 1e-9)
            rest = max(columns - whole, 0.0)
            wide = np.concatenate((known, np.repeat(new[:, -1:], whole + 2, axis=1)), axis=1)
            n = known.shape[1]
            first = wide[:, whole : whole + n]
            return first if rest < 1e-9 else (1.0 - rest) * first + rest * wide[:, whole + 1 : whole + 1 + n]

        shear = np.stack([at(state.shear[k], fresh.shear[k]) for k in (0, 1)])
        tau = fresh.tau if math.isinf(fresh.tau[0, 0]) else at(state.tau, fresh.tau)
        return State(state.traction, state.p, at(state.mu, fresh.mu), tau, shear)

    def _tangential(
        self,
        q: Array,
        state: State,
        p: Array,
        motion: Creepage,
        distance: float,
        bound: Array,
        force: tuple[float | None, float | None],
        u: Array,
    ) -> tuple[Tangential, Array]:
        """Return the tangential solution and the creepages, those that were found and 0."""
        unknown = [k for k in (0, 1) if force[k] is not None]
        known = [0.0 if k in unknown else v for k, v in enumerate((motion.longitudinal, motion.lateral))]
        rows = Bent.plane(Creepage(known[0], known[1], motion.spin), self.y)
        if frictionless(bound, self.material):
            zero = np.zeros(self.shape)
            rigid = rigid_slip(self.x, rows, 0.0) * (p > 0.0)
            slipping = np.zeros(self.shape, dtype=bool)
            return Tangential(zero, zero, rigid[0], rigid[1], slipping, 0, 0, 0.0, True), np.zeros(2)
        q = np.where(bound > 0.0, q, 0.0)  # what has left the contact has no traction
        if math.isinf(distance):
            newton, w = self._steady(bound, rows, p)
        else:
            newton, w = self._in_time(bound, rows, p, state, distance)
        if unknown:
            area = self.dx * self.dy
            wanted = np.array([force[k] for k in unknown], dtype=np.float64) / area
            found = driven(newton, w, unknown, wanted, u[unknown], q)
            if found is None:
                zero, stick = np.zeros(self.shape), np.zeros(self.shape, dtype=bool)
                return Tangential(zero, zero, zero, zero, stick, newton.iterations, newton.products, 1.0, False), u
            u = np.zeros(2)
            u[unknown] = found[0]
            w = w.copy()
            w[unknown] += found[0][:, None, None]
            q = found[1]
            residual = newton.tolerance
        elif isinstance(newton, Rolling):
            q, residual = newton.steady(q, w)
        else:
            q, residual = followed(newton, q, w)
        s = newton.slip(q, w)
        zones.settle(q, s, newton.zone, newton.bound)
        stick = newton.zone == zones.STICK
        converged = residual <= newton.tolerance
        return Tangential(q[0], q[1], s[0], s[1], stick, newton.iterations, newton.products, residual, converged), u

    def _steady(self, bound: Array, rows: Bent, p: Array) -> tuple[Newton, Array]:
        w = rigid_slip(self.x, rows, OFFSET * self.dx) + self.slip
        if self.coupling is not None:
            w = w + self.coupling.slip(p, p, p)
        steps = self.dx, self.dy
        return Rolling(bound, steps, self.material, self.soft, _TOLERANCE, self.progress), w

    def _in_time(self, bound: Array, rows: Bent, p: Array, state: State, distance: float) -> tuple[Newton, Array]:
        per_metre = 1.0 / distance if distance > 0.0 else 1.0
        before, reach = self.before(state, p, distance)
        w = reach * (rigid_slip(self.x, rows, OFFSET * distance) + self.slip) - per_metre * before
        if self.coupling is not None:
            w = w + per_metre * (self.coupling.displacement(p) - self.coupling.displacement(state.p, distance))
        h = self.influence
        newton = Newton(bound, h, _TOLERANCE, self.progress)
        own = float(half_space.tangential(0.0, 0.0, self.dx, self.dy, self.material)[0]) * per_metre
        own += self.soft * per_metre
        newton.operator = Operator((h.xx * per_metre, h.yy * per_metre, h.xy * per_metre), own, 1.0 / per_metre, 0.0)
        return newton, w

    def before(self, state: State, p: Array, distance: float) -> tuple[Array, Array]:
        """Return the displacement of each particle before the step [m], and its share of the rigid slip [-]."""
        before = self.displaced(state.traction, distance)
        reach = np.ones(p.shape)
        dx = self.dx
        if distance <= dx * (1.0 + 1e-9):
            return before, reach
        here = self.displaced(state.traction, dx)  # at x + dx, so column j has the displacement of j + 1
        for i, row in enumerate(p):
            touching = np.flatnonzero(row > 0.0)
            if touching.size:
                lead = int(touching[-1])
                room = (lead + 1 - np.arange(row.size)) * dx
                entered = (room < distance) & (room > 0.0)
                reach[i, entered] = room[entered] / distance
                before[:, i, entered] = here[:, i, lead][:, None]
        return before, reach

    def displaced(self, traction: Array, ahead: float) -> Array:
        """Return the displacement of the surfaces at x + `ahead` [m] by a traction [Pa], shape (2, ny, nx) [m]."""
        u = self.influence.times(self._transfer(ahead), traction)
        columns = ahead / self.dx
        if self.soft > 0.0 and not _whole(columns):
            floor = math.floor(columns)
            wide = np.pad(traction, ((0, 0), (0, 0), (0, floor + 2)))
            n = traction.shape[2]
            rest = columns - floor
            u = u + self.soft * (
                (1.0 - rest) * wide[..., floor : floor + n] + rest * wide[..., floor + 1 : floor + 1 + n]
            )
        return u

    def _transfer(self, ahead: float) -> Transfer:
        """Return the transfer functions of the displacement at x + `ahead` [m]."""
        h, columns = self.influence, ahead / self.dx
        if columns == 0.0 or math.isclose(columns, 1.0, rel_tol=1e-9):
            factor = 1.0 if columns == 0.0 else h.ahead
            return h.xx * factor, h.yy * factor, h.xy * factor
        ny, nx = self.shape
        padded = fast_length(2 * ny), fast_length(2 * nx + 2)
        X = np.fft.fftfreq(padded[1], 1.0 / padded[1]) * self.dx + ahead
        Y = np.fft.fftfreq(padded[0], 1.0 / padded[0]) * self.dy
        numbers = half_space.tangential(X, Y[:, None], self.dx, self.dy, self.material)
        xx, yy, xy = (np.fft.rfft2(field) for field in numbers)
        return xx, yy, xy


def _whole(columns: float) -> bool:
    return columns == 0.0 or math.isclose(columns, 1.0, rel_tol=1e-9)


def _yielded(body: ThirdBody, before: Array, limit: Array, shift: Array) -> tuple[Array, Array]:
    """Return tau_c [Pa] after a step and the plastic part [m] of the `shift` of each element."""
    floor = np.maximum(before, FLOOR * body.yield_stress)
    part = np.where((floor < limit) & (limit > 0.0), shift, 0.0)
    if body.hardening > 0.0:  # until the layer is as strong as friction; the rest is slip
        part = np.minimum(part, np.maximum(limit - floor, 0.0) / body.hardening)
    return np.maximum(floor + body.hardening * part, LEAST * body.yield_stress), part
