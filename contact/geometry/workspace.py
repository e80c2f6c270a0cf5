"""The arrays that a contact search reads and writes, allocated once by their owner: a pair or an FMU instance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact import quadrature
from contact._layout import MAX_PATCHES, N_CASE, N_RES, N_STRIP_ROWS
from contact.geometry.layout import MAX_LOBES, N_LINE_ROWS, N_LOBE, N_MOTION, N_PATCH, N_SEP_ROWS
from contact.normal.analyn import N_WORK_ROWS

Array = NDArray[np.float64]

#: Strips of the normal solution by which a wheel under a load finds its height.
N_STRIPS = 30


class Search(NamedTuple):
    """Curves of wheel and rail, `motion` and sample positions to be set; patches and separations to be read; scratch.

    `case`, `nodes` … `result` are those of the normal problem under a load.
    """

    wheel: Array
    rail: Array
    motion: Array
    grid: Array
    patches: Array
    separations: Array
    line: Array
    placed: Array
    lobe: Array
    wheel_plane: Array
    rail_plane: Array
    case: Array
    nodes: Array
    weights: Array
    work: Array
    strips: Array
    result: Array


def allocate(wheel: Array, rail: Array, grid: Array, n_samples: int) -> Search:
    """Allocate what a search needs with these curves, for separations at the positions `grid` or, if empty, anywhere."""
    n_wheel, n_rail = wheel.shape[1], rail.shape[1]
    return Search(
        wheel=wheel,
        rail=rail,
        motion=np.zeros(N_MOTION),
        grid=grid,
        patches=np.zeros((MAX_PATCHES, N_PATCH)),
        separations=np.zeros((MAX_PATCHES, N_SEP_ROWS, n_samples)),
        line=np.zeros((N_LINE_ROWS, n_wheel)),
        placed=np.zeros((3, n_rail)),
        lobe=np.zeros((MAX_LOBES, N_LOBE)),
        wheel_plane=np.zeros((N_LINE_ROWS, n_wheel)),
        rail_plane=np.zeros((3, n_rail)),
        case=np.zeros(N_CASE),
        nodes=quadrature.fejer(N_STRIPS)[0],
        weights=quadrature.fejer(N_STRIPS)[1],
        work=np.zeros((N_WORK_ROWS, n_samples)),
        strips=np.zeros((N_STRIP_ROWS, MAX_PATCHES * N_STRIPS)),
        result=np.zeros(N_RES),
    )
