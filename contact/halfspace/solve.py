"""Solve the contact on a grid: NORM or the pressure of another method, then TANG."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.halfspace.bent import Surface
from contact.halfspace.gap import Division, Gap, lay, least, overlap
from contact.halfspace.norm import Normal, norm
from contact.halfspace.pressed import Pressed
from contact.halfspace.solution import PressedRecord
from contact.inputs.material import Material
from contact.inputs.separation import Separation
from contact.results import Solution, Status

#: Elements on which the approach under a load is estimated, and the largest number of steps of that estimate.
_COARSE, _MAX_STEPS = Division(20, 20), 40
#: The grid covers the overlap at this multiple of the estimated approach, which is that of a plane half space.
_ROOM, _ROOM_BENT = 1.02, 1.1


def press_gap(
    made: Callable[..., Pressed],
    gap: Separation | Gap,
    division: Division,
    *,
    load: float | None,
    approach: float | None,
    material: Material,
    conformal: bool,
) -> Pressed:
    """Return the normal problem of a gap, solved by NORM. Arguments as for `contact.solve`; `made` has the others."""
    surface = Surface.of(gap) if conformal and isinstance(gap, Separation) else None
    flat = gap if surface is None or isinstance(gap, Gap) else surface.unrolled()
    grid = flat if isinstance(flat, Gap) else grid_of(flat, load, approach, material, division, surface is not None)
    tilt = None if surface is None or grid is None else surface.angle(grid.y)
    cosine = 1.0 if tilt is None else np.cos(tilt)[:, None]
    if grid is None:
        x = y = np.arange(2.0)
        found = Normal(np.zeros((2, 2)), least(flat) if approach is None else approach, 0.0, 0, True)
    else:
        x, y = grid.x, grid.y
        found = norm(grid.h, grid.dx, grid.dy, material, load=load, approach=approach, tilt=tilt)
    status = status_of(flat, found.p, y, found.converged)
    record = PressedRecord(found.approach, found.stiffness, found.iterations, status)

    def again(opening: Array, p: Array, borne: float, tolerance: float) -> Normal:
        assert grid is not None
        h = grid.h + opening
        rest = None if load is None else load - borne
        to: dict[str, Any] = {"load": rest, "approach": approach, "tolerance": tolerance}
        new = norm(h, grid.dx, grid.dy, material, start=cosine * p, tilt=tilt, **to)
        return replace(new, p=new.p / cosine)

    return made(x, y, found.p / cosine, record, surface=surface, again=again)


def press_solution(
    made: Callable[..., Pressed], first: Solution, surface: Surface | None, division: Division
) -> Pressed:
    """Return the normal problem of a solution with contact: its pressure, N, approach and normal stiffness.

    `surface` is the curved surface in which the bodies touch; None for the plane. `made` is as for `press_gap`.
    """
    low, high = float(first.patch_edges.min()), float(first.patch_edges.max())
    if surface is not None:
        low, high = (float(surface.along(y)) for y in (low, high))
    back, front = ((first.strips.x_c + sign * first.strips.a) for sign in (-1.0, 1.0))
    x, y = division.centres((float(back.min()), float(front.max()), low, high))
    place, cosine = (y, 1.0) if surface is None else (surface.across(y), np.cos(surface.angle(y))[:, None])
    p = first.pressure(x[None, :], place[:, None])
    total = (p * cosine).sum() * (x[1] - x[0]) * (y[1] - y[0])
    if not total > 0.0:
        raise ContactError(f"{division} leaves no element inside the patch")
    p *= first.N / total
    status = Status.OK if first.status is Status.SATURATED else first.status
    record = PressedRecord(first.approach, first.normal_stiffness, first.iterations, status, first.normal)
    return made(x, y, p, record, surface=surface)


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
    bent: bool = False,
) -> Gap | None:
    """Return the gap on elements over the undeformed overlap, which contains the contact; None without overlap."""
    if approach is None:
        assert load is not None
        if load <= 0.0:
            return None
        touch = least(separation)
        approach = touch + (_ROOM_BENT if bent else _ROOM) * _estimate(separation, touch, load, material)
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
