"""Solve the contact on a grid: NORM or the pressure of another method, then TANG."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.case import set_surface
from contact.creepage import Creepage
from contact.errors import ContactError
from contact.friction import Friction
from contact.halfspace.bent import Bent
from contact.halfspace.gap import Division, Gap, lay, least, overlap
from contact.halfspace.heat import heat_up
from contact.halfspace.norm import Normal, norm
from contact.halfspace.solution import GridSolution, assemble
from contact.halfspace.tang import Tangential, tang
from contact.halfspace.third_body import Sheared, ThirdBody, solve_layer
from contact.halfspace.unlike import Coupling
from contact.kernels.friction import of_bodies
from contact.kernels.records import CASE
from contact.material import Material
from contact.separation import Separation
from contact.solution import Solution, Status

Array = NDArray[np.float64]

#: Elements on which the approach under a load is estimated, and the largest number of steps of that estimate.
_COARSE, _MAX_STEPS = Division(20, 20), 40
#: Iteration of friction that depends on local slip velocity or temperature: largest number of steps, relaxation factor,
#: tolerance over mu.
_MAX_FALLS, _FALL_SHARE, _FALL_TOLERANCE = 60, 0.5, 1e-3
#: Alternation of normal and tangential problem for unlike bodies: largest number of turns, change of the pressure over its
#: maximum at the end, and tolerance of the normal problem.
_MAX_TURNS, _TURN_TOLERANCE, _FINE = 40, 1e-6, 1e-7
#: The grid covers the overlap at this multiple of the estimated approach.
_ROOM = 1.02


class Pressed:
    """A solved normal problem on a grid, on which the tangential problem is solved for any creepage.

    Parameters
    ----------
    x, y, p : pressure [Pa], shape (ny, nx), at the centres `x`, `y` [m] of the elements
    bent : the separation whose curved surface is the contact surface; None for the plane
    material, friction, speed, progress : as in `contact.solve`
    record : approach, stiffness, iterations, status and normal method of the normal problem
    again : callable
        Solves the normal problem again for a traction that opens the gap by a field [m], from a pressure. Only for unlike
        bodies; without it the pressure does not follow the traction.
    """

    def __init__(
        self,
        x: Array,
        y: Array,
        p: Array,
        record: PressedRecord,
        *,
        bent: Separation | None,
        material: Material,
        friction: Friction,
        speed: float,
        progress: Callable[[int, float], None] | None,
        layer: ThirdBody | None = None,
        again: Callable[[Array, Array], Normal] | None = None,
    ) -> None:
        self.x, self.y, self.p, self.record, self.bent = x, y, p, record, bent
        self.material, self.friction, self.speed, self.progress = material, friction, speed, progress
        self._again, self._layer = again, layer
        self._sheared: Sheared | None = None
        self._last: Tangential | None = None

    def roll(self, creepage: Creepage) -> GridSolution:
        """Return the solution for a creepage, by TANG. It starts from pressure and traction of the last call."""
        rows = Bent.plane(creepage, self.y) if self.bent is None else Bent.of(self.bent, creepage, self.y)
        if self.material.coupling == 0.0 or not self.p.any():
            rolling, coefficient = self._tangential(creepage, rows, None)
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
            approach=record.approach,
            stiffness=record.stiffness,
            iterations=record.iterations + rolling.iterations,
            status=record.status if kept else Status.NOT_CONVERGED,
            creepage=creepage,
            friction=coefficient,
            material=self.material,
            speed=self.speed,
            normal=record.normal,
            tangential="halfspace",
            layer=self._sheared,
        )

    def _tangential(self, creepage: Creepage, rows: Bent, added: Array | None) -> tuple[Tangential, float]:
        """Return the tangential solution on the present pressure, and the coefficient of friction."""
        start = None if self._last is None else (self._last.qx, self._last.qy)
        if self._layer is None:
            self._last, coefficient = _roll(self, creepage, rows, start, added)
        else:
            coefficient = self._shear(self._layer, creepage, rows, start, added)
        return self._last, coefficient  # type: ignore[return-value]

    def _shear(
        self, layer: ThirdBody, creepage: Creepage, rows: Bent, start: tuple[Array, Array] | None, added: Array | None
    ) -> float:
        """Solve with a third body; keep the solution and its state, and return the coefficient of friction."""
        mu = float(self.friction.coefficient(self.speed * math.hypot(creepage.longitudinal, creepage.lateral)))
        factor = self.friction.factor(self.y)[:, None] if self.friction.gauge_factor != 1.0 else 1.0
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
        self._last, self._sheared = solve_layer(layer, mu * factor * self.p, steps, solve)
        return mu

    def _alternate(self, creepage: Creepage, rows: Bent) -> tuple[Tangential, float, bool]:
        """Solve both problems of unlike bodies in turn until neither changes (Panagiotopoulos).

        A change that grows is halved. Return the tangential solution, the coefficient of friction and whether it converged.
        """
        coupling = Coupling(self.p.shape, float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0]), self.material)
        last, share = math.inf, 1.0
        for _ in range(_MAX_TURNS):
            rolling, coefficient = self._tangential(creepage, rows, coupling.slip(self.p))
            if self._again is None:
                return rolling, coefficient, rolling.converged
            found = self._again(coupling.opening(rolling.qx, rolling.qy), self.p)
            change = float(np.abs(found.p - self.p).max() / found.p.max())
            if change <= _TURN_TOLERANCE:
                return rolling, coefficient, rolling.converged and found.converged
            share = 0.5 * share if change > last else share
            self.p, last = self.p + share * (found.p - self.p), change
            self.record = self.record._replace(approach=found.approach, stiffness=found.stiffness)
        return rolling, coefficient, False


class PressedRecord(NamedTuple):
    """What a solution records of its normal problem; approach [m], stiffness [N/m]."""

    approach: float
    stiffness: float
    iterations: int
    status: Status
    normal: str


def press_gap(
    gap: Separation | Gap,
    division: Division,
    *,
    load: float | None,
    approach: float | None,
    friction: Friction,
    material: Material,
    speed: float,
    conformal: bool,
    layer: ThirdBody | None,
    progress: Callable[[int, float], None] | None,
) -> Pressed:
    """Return the normal problem of a gap, solved by NORM. Arguments as in `contact.solve`."""
    grid = gap if isinstance(gap, Gap) else grid_of(gap, load, approach, material, division)
    if grid is None:
        x = y = np.arange(2.0)
        found = Normal(np.zeros((2, 2)), least(gap) if approach is None else approach, 0.0, 0, True)
    else:
        x, y = grid.x, grid.y
        found = norm(grid.h, grid.dx, grid.dy, material, load=load, approach=approach)
    status = status_of(gap, found.p, y, found.converged)
    record = PressedRecord(found.approach, found.stiffness, found.iterations, status, "halfspace")

    def again(opening: Array, p: Array) -> Normal:
        assert grid is not None
        h = grid.h + opening
        return norm(h, grid.dx, grid.dy, material, load=load, approach=approach, tolerance=_FINE, start=p)

    return Pressed(
        x,
        y,
        found.p,
        record,
        bent=gap if conformal and isinstance(gap, Separation) else None,
        material=material,
        friction=friction,
        speed=speed,
        progress=progress,
        layer=layer,
        again=again,
    )


def press_solution(
    first: Solution,
    bent: Separation | None,
    friction: Friction,
    division: Division,
    layer: ThirdBody | None,
    progress: Callable[[int, float], None] | None,
) -> Pressed:
    """Return the normal problem of a solution with contact: its pressure, N, approach and normal stiffness.

    `bent` is the separation whose curved surface is the contact surface; None for the plane.
    """
    low, high = float(first.patch_edges.min()), float(first.patch_edges.max())
    back, front = ((first.strips.x_c + sign * first.strips.a) for sign in (-1.0, 1.0))
    x, y = division.centres((float(back.min()), float(front.max()), low, high))
    p = first.pressure(x[None, :], y[:, None])
    total = p.sum() * (x[1] - x[0]) * (y[1] - y[0])
    if not total > 0.0:
        raise ContactError(f"{division} leaves no element inside the patch")
    p *= first.N / total
    status = Status.OK if first.status is Status.SATURATED else first.status
    record = PressedRecord(first.approach, first.normal_stiffness, first.iterations, status, first.normal)
    return Pressed(
        x,
        y,
        p,
        record,
        bent=bent,
        material=first.material,
        friction=friction,
        speed=first.speed,
        progress=progress,
        layer=layer,
    )


def _roll(
    pressed: Pressed, creepage: Creepage, rows: Bent, start: tuple[Array, Array] | None, added: Array | None
) -> tuple[Tangential, float]:
    """Return the solution by TANG with a friction law, and the largest coefficient of friction [-].

    If friction depends on the local slip velocity or the temperature, TANG is solved repeatedly, each time with the
    coefficients from the previous slip. The first solution has the full coefficient. Only a share of each change is applied,
    because several solutions and oscillation between them are possible. For a given slip, the temperature is that of the
    reduced friction (`heat`).
    """
    p, x, y, friction, speed = pressed.p, pressed.x, pressed.y, pressed.friction, pressed.speed
    material, progress = pressed.material, pressed.progress
    surface = np.zeros(1, CASE)
    set_surface(surface, friction, speed)
    case = surface[0]
    factor = of_bodies(case) * (friction.factor(y)[:, None] if friction.gauge_factor != 1.0 else np.ones((1, 1)))
    local, hot = friction.velocity != "global" and friction.law != "coulomb", friction.hot_factor < 1.0
    mu = friction.static
    if not local:
        mu = float(friction.coefficient(speed * math.hypot(creepage.longitudinal, creepage.lateral)))
    if not (local or hot):
        return tang(p, x, y, rows, mu * factor, material, start=start, added=added, progress=progress), mu
    field = np.full(p.shape, mu)
    rolling = tang(p, x, y, rows, field * factor, material, start=start, added=added, progress=progress)
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
        rolling = tang(p, x, y, rows, field * factor, material, start=start, added=added, progress=progress)
        if abs(change * (p > 0.0)).max() <= _FALL_TOLERANCE * mu:
            return rolling, mu
    return replace(rolling, converged=False), mu


def status_of(gap: Separation | Gap, p: Array, y: Array, converged: bool) -> Status:
    """Return NO_CONTACT, OUT_OF_RANGE if contact reaches the end of the data, NOT_CONVERGED or OK."""
    touching = p > 0.0
    if not touching.any():
        return Status.NO_CONTACT
    half = 0.5 * (y[1] - y[0])
    if isinstance(gap, Gap):
        beyond = touching[[0, -1]].any() or touching[:, [0, -1]].any()
    else:
        beyond = (touching[0].any() and y[0] - half <= gap.y[0]) or (touching[-1].any() and y[-1] + half >= gap.y[-1])
    if beyond:
        return Status.OUT_OF_RANGE
    return Status.OK if converged else Status.NOT_CONVERGED


def grid_of(
    separation: Separation,
    load: float | None,
    approach: float | None,
    material: Material,
    division: Division,
) -> Gap | None:
    """Return the gap on elements over the undeformed overlap, which contains the contact; None without overlap."""
    if approach is None:
        assert load is not None
        if load <= 0.0:
            return None
        touch = least(separation)
        approach = touch + _ROOM * _estimate(separation, touch, load, material)
    box = overlap(separation, approach)
    if box is None:
        return None
    x, y = division.centres(box)
    inside = (y >= separation.y[0]) & (y <= separation.y[-1])
    return lay(separation, x, y[inside])


def _estimate(separation: Separation, touch: float, load: float, material: Material) -> float:
    """Return the approach beyond `touch` [m] under a load, by Newton's iteration on a coarse grid over the overlap."""
    depth = 1e-3 * float(np.ptp(separation.y))
    for _ in range(_MAX_STEPS):
        box = overlap(separation, touch + depth)
        if box is None:
            depth *= 4.0
            continue
        grid = lay(separation, *_COARSE.centres(box))
        found = norm(grid.h, grid.dx, grid.dy, material, approach=touch + depth, tolerance=1e-4)
        N = float(found.p.sum()) * grid.dx * grid.dy
        if abs(N / load - 1.0) < 1e-5:
            break
        # power law with the load and stiffness found: N ~ depth^(k depth/N); the exponent is 3/2 in Hertz contact
        power = max(found.stiffness * depth / N, 0.5) if N > 0.0 else 1.5
        depth *= min(max((load / max(N, 1e-3 * load)) ** (1.0 / power), 0.1), 10.0)
    return depth
