"""A contact that rolls towards -x, as one that rolls forwards in a mirror across the track, x to -x."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.halfspace import Gap, GridSolution
from contact.halfspace.lattice import CurvedGap
from contact.halfspace.state import State
from contact.inputs.creepage import Creepage


def of_gap(gap: Gap) -> Gap:
    """Return the mirror image of a gap."""
    x, h = -gap.x[::-1], gap.h[:, ::-1]
    return CurvedGap(x, gap.y, h, gap.place, gap.tilt) if isinstance(gap, CurvedGap) else Gap(x, gap.y, h)


def of_creepage(creepage: Creepage) -> Creepage:
    """Return the creepages in the mirror."""
    return Creepage(-creepage.longitudinal, creepage.lateral, -creepage.spin)


def of_vectors(field: Array) -> Array:
    """Return the mirror image of a field of vectors, shape (2, ny, nx)."""
    return np.stack((-field[0][:, ::-1], field[1][:, ::-1]))


def of_state(state: State) -> State:
    """Return the mirror image of what a step leaves."""
    p, mu, tau = (field[:, ::-1] for field in (state.p, state.mu, state.tau))
    return State(of_vectors(state.traction), p, mu, tau, of_vectors(state.shear))


def of_solution(found: GridSolution) -> GridSolution:
    """Return the mirror image of a solution. Its first elements stay those at the leading edge."""
    x, y, p = found.grid
    layer: Any = found.layer
    if layer is not None:
        layer = replace(layer, ux=-layer.ux)
    return replace(
        found,
        Fx=-found.Fx,
        Mz=-found.Mz,
        x=-found.x,
        qx=-found.qx,
        sx=-found.sx,
        strips=replace(found.strips, x_c=-found.strips.x_c),
        grid=(-x[::-1], y, p[:, ::-1]),
        creepage=of_creepage(found.creepage),
        layer=layer,
    )
