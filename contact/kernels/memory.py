"""Where the arrays of the kernels lie: one list for Python and for the memory block of an FMU.

Every function lays arrays in `block`, from the float64 with index `end` on, and returns them with the new end
(`contact.kernels.block`).
"""

from __future__ import annotations

from contact.core import shared
from contact.kernels import arrays
from contact.kernels.arrays import Array, DerivativeArrays, PairArrays, Search, Size
from contact.kernels.block import cube, layout, matrix, vector
from contact.kernels.jacobian import COLUMNS, ROWS
from contact.kernels.normal import descent, factors, influence
from contact.kernels.normal.between_panels import PROBES
from contact.kernels.normal.start import MEM_LN_A
from contact.kernels.records import GIVEN, MAX_PATCHES
from contact.kernels.rows import Field, Strip, Tangent
from contact.kernels.tangential import lanes

#: Rows of the derivatives of a pair, and what the forces of a patch are derived by (`pair_jacobian`).
PAIR_ROWS, CREEPS = 8, 5
_N_GIVEN = GIVEN.itemsize // 8

#: Number of strips of the normal problem that a search solves to find the height of a wheel under a load.
SEARCH_STRIPS = 30

#: Grids of a search over surfaces: rows and most columns of the coarse one, number, rows and columns of the others, and
#: columns of the samples of a patch.
COARSE_ROWS, COARSE_COLUMNS, GRIDS, FINE_ROWS, FINE_COLUMNS, PATCH_COLUMNS = 101, 151, 6, 29, 21, 19


@shared
def memory_size(size: Size) -> int:
    """Return the number of float64 that a normal method keeps from one call to the next."""
    return MEM_LN_A + (2 * MAX_PATCHES * size.n_strips if size.interacting else 1)


@shared
def pair_memory_size(piece: int) -> int:
    """Return the size of the memory of a pair whose patches have `piece` numbers each, see `PairArrays`."""
    return 1 + MAX_PATCHES * piece + 2


@shared
def coupled(size: Size) -> int:
    """Return the number of strips that interact with each other, at most."""
    return MAX_PATCHES * size.n_strips if size.interacting else 1


@shared
def columns_shape(size: Size) -> tuple[int, int, int]:
    """Return the shape of the table of columns, which only a resolution that is not too fine uses."""
    n = size.n_strips
    return (influence.N_COLUMNS, n, n) if size.interacting != 0 and n <= influence.MOST_TABULATED else (1, 1, 1)


@shared
def descent_shape(size: Size) -> tuple[int, int, int]:
    """Return the shape of the table of `normal.descent`."""
    n = size.n_strips
    used = size.interacting != 0 and descent.FEWEST <= n <= descent.MOST
    return (descent.N_LAYERS, n, n) if used else (1, 1, 1)


@shared
def factors_shape(size: Size) -> tuple[int, int, int]:
    """Return the shape of the table of `normal.factors`."""
    n = size.n_strips
    used = size.interacting != 0 and factors.LEAST <= n <= influence.MOST_TABULATED
    return (factors.N_LAYERS, factors.N_FACTORS, n) if used else (1, 1, 1)


@shared
def tangent_shape(n: int, interacting: int) -> tuple[int, int]:
    """Return the shape of the tangent of a patch with `n` strips."""
    if interacting != 0 and descent.FEWEST <= n <= descent.MOST:
        return 4 * n + len(Tangent), n
    return 1, 1


_NAMES = {**vars(lanes), **globals(), "ROWS": ROWS, "COLUMNS": COLUMNS, "PROBES": PROBES}
lay_samples = layout(arrays.Samples, "n", _NAMES)
lay_across = layout(arrays.Across, "n_strips", _NAMES)
lay_rule = layout(arrays.Rule, "size", _NAMES)
lay_space = layout(arrays.Space, "size, memory", _NAMES)
lay_solver = layout(arrays.SolverArrays, "size, workspace", _NAMES)
lay_search = layout(Search, "n_wheel, n_rail, prescribed, n_samples", _NAMES)
lay_sheet = layout(arrays.Sheet, "n_slices, n_paths, n_deviation", _NAMES)
lay_surface_search = layout(arrays.SurfaceSearch, "wheel, rail, n_samples", _NAMES)
lay_ledger = layout(arrays.Ledger, "wheel, rail, bins, n_strips", _NAMES)
lay_pair = layout(PairArrays, "size, memory, search, workspace, ledger", _NAMES)
#: A search of neighbouring poses in the scratch of another one.
lay_near_search = layout(Search, "n_samples, search", _NAMES, of="search", new=("motion", "patches", "separations"))
_lay_neighbour = layout(
    PairArrays,
    "arrays, search",
    _NAMES,
    of="arrays",
    new=("case", "patch_case", "result", "memory", "contacts", "total", "given"),
    case="2",
    result="2",
    memory="arrays.memory.size",
)
_lay_derivatives = layout(DerivativeArrays, "size, neighbour, numbers", _NAMES)


@shared
def lay_strips_and_fields(block: Array, end: int, size: Size) -> tuple[Array, Array, int]:
    """Return strips and fields of a solution, and the new end. Without fields one row of them serves all strips."""
    capacity = MAX_PATCHES * size.n_strips
    strips, end = matrix(block, end, len(Strip), capacity)
    fields, end = cube(block, end, len(Field), capacity if size.with_fields else 1, size.n_elements)
    return strips, fields, end


@shared
def lay_derivatives(block: Array, end: int, size: Size, near: Search, pair: PairArrays) -> tuple[DerivativeArrays, int]:
    """Return the arrays for the derivatives of a pair, whose neighbours are found by the search `near`, and the new end."""
    neighbour, end = _lay_neighbour(block, end, pair, near)
    # the motion asked of a neighbour, which was laid last, number by number
    numbers, _ = vector(block, end - _N_GIVEN, _N_GIVEN)
    return _lay_derivatives(block, end, size, neighbour, numbers)
