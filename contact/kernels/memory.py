"""Shapes of all arrays of the kernels: one list for Python and for the memory block of an FMU.

Every function lays arrays in `block`, from the float64 with index `end` on, and returns them with the new end
(`contact.kernels.block`).
"""

from __future__ import annotations

from contact.core import shared
from contact.kernels.arrays import (
    Across,
    Array,
    DerivativeArrays,
    Ledger,
    PairArrays,
    Rule,
    Search,
    Sheet,
    Size,
    SolverArrays,
    Space,
    SurfaceSearch,
    Workspace,
)
from contact.kernels.block import cube, matrix, next_line, records, vector
from contact.kernels.jacobian import COLUMNS, ROWS
from contact.kernels.kalker import N_TABLE
from contact.kernels.normal import factors
from contact.kernels.normal.between_panels import PROBES
from contact.kernels.normal.descent import FEWEST, MOST, N_LAYERS
from contact.kernels.normal.influence import MOST_TABULATED, N_COLUMNS
from contact.kernels.normal.start import MEM_LN_A
from contact.kernels.records import (
    CASE,
    CONTACT,
    DAMAGE,
    DAMAGE_PARAMETERS,
    ELASTIC_RAIL,
    GIVEN,
    LEDGER,
    LOBE,
    MAX_LOBES,
    MAX_PATCHES,
    MOTION,
    PATCH,
    RESULT,
    TOTAL,
    WHEEL_OFFSET,
)
from contact.kernels.rows import (
    MOST_ITERATES,
    N_LINE_ROWS,
    N_PROFILE_ROWS,
    N_VECTOR_ROWS,
    Bin,
    Box,
    Cell,
    DamageField,
    Element,
    Field,
    Iterate,
    Moved,
    Node,
    Over,
    Sample,
    Section,
    Sep,
    Strip,
    Tangent,
)
from contact.kernels.searches import FORCE_SEARCH, ITERATION, ROOT
from contact.kernels.tangential.lanes import LANES, N_LANE_ROWS, TRACE_WIDTH

#: Rows of the derivatives of a pair, and what the forces of a patch are derived by (`pair_jacobian`).
PAIR_ROWS, CREEPS = 8, 5

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
def tangent_shape(n: int, interacting: int) -> tuple[int, int]:
    """Return the shape of the tangent of a patch with `n` strips."""
    if interacting != 0 and FEWEST <= n <= MOST:
        return 4 * n + len(Tangent), n
    return 1, 1


@shared
def lay_across(block: Array, end: int, n_strips: int) -> tuple[Across, int]:
    """Return the arrays for positions and weights of strips across a patch, and the new end."""
    nodes, end = vector(block, end, n_strips)
    weights, end = vector(block, end, n_strips)
    return Across(nodes, weights), end


@shared
def lay_rule(block: Array, end: int, size: Size) -> tuple[Rule, int]:
    """Return the arrays of the rule of a resolution, and the new end."""
    n = size.n_strips
    across, end = lay_across(block, end, n)
    elements, end = matrix(block, end, len(Element), size.n_elements)
    cosines, end = vector(block, end, n + 1)
    cosine_logs, end = matrix(block, end, n, n + 1)
    tabulated = size.interacting != 0 and n <= MOST_TABULATED  # else the table of columns is not used
    columns, end = cube(block, end, N_COLUMNS if tabulated else 1, n if tabulated else 1, n if tabulated else 1)
    descending = size.interacting != 0 and FEWEST <= n <= MOST
    descent, end = cube(block, end, N_LAYERS if descending else 1, n if descending else 1, n if descending else 1)
    factored = tabulated and n >= factors.LEAST
    of_strips, end = cube(
        block, end, factors.N_LAYERS if factored else 1, factors.N_FACTORS if factored else 1, n if factored else 1
    )
    probes, end = vector(block, end, PROBES)
    spread, end = matrix(block, end, PROBES, n)
    return Rule(across, elements, cosines, cosine_logs, columns, descent, of_strips, probes, spread), end


@shared
def lay_kalker(block: Array, end: int) -> tuple[Array, int]:
    """Return the table of Kalker's coefficients for one Poisson's ratio, and the new end."""
    return matrix(block, end, N_TABLE, 8)


@shared
def lay_space(block: Array, end: int, size: Size, memory: Array) -> tuple[Space, int]:
    """Return the scratch arrays of a workspace around `memory`, which has the size `memory_size`, and the new end."""
    capacity = MAX_PATCHES * size.n_strips if size.interacting else 1
    grid, end = matrix(block, end, len(Sample), size.n_samples)
    turned, end = matrix(block, end, len(Sep), size.n_samples if size.interacting else 1)
    vectors, end = matrix(block, end, N_VECTOR_ROWS, MAX_PATCHES * size.n_strips)
    logs, end = matrix(block, end, MAX_PATCHES * PROBES if size.interacting else 1, capacity + MAX_PATCHES)
    influence, end = matrix(block, end, capacity, capacity)
    lu, end = matrix(block, end, capacity, capacity)
    iteration, end = records(block, end, 1, ITERATION)
    n_iterates = MOST_ITERATES if size.interacting else 1
    iterates, end = matrix(block, end, n_iterates, Iterate.ENDS + 2 * MAX_PATCHES)
    lanes, end = vector(block, next_line(end), N_LANE_ROWS * LANES)
    trace, end = matrix(block, end, size.n_elements, TRACE_WIDTH)
    case, end = records(block, end, 1, CASE)
    rows, columns = tangent_shape(size.n_strips, size.interacting)
    tangent, end = matrix(block, end, rows, columns)
    return Space(
        grid, turned, vectors, logs, influence, lu, iteration, iterates, memory, lanes, trace, case, tangent
    ), end


@shared
def lay_strips_and_fields(block: Array, end: int, size: Size) -> tuple[Array, Array, int]:
    """Return strips and fields of a solution, and the new end. Without fields one row of them serves all strips."""
    capacity = MAX_PATCHES * size.n_strips
    strips, end = matrix(block, end, len(Strip), capacity)
    fields, end = cube(block, end, len(Field), capacity if size.with_fields else 1, size.n_elements)
    return strips, fields, end


@shared
def lay_solver(block: Array, end: int, size: Size, workspace: Workspace) -> tuple[SolverArrays, int]:
    """Return the arrays of a contact that is solved again and again around its workspace, and the new end."""
    case, end = records(block, end, 2, CASE)
    result, end = records(block, end, 2, RESULT)
    search, end = records(block, end, 1, FORCE_SEARCH)
    row, end = cube(block, end, len(Field), 1, size.n_elements)
    slopes, end = matrix(block, end, ROWS, COLUMNS)
    return SolverArrays(workspace, case, result, search, row, slopes), end


@shared
def lay_search(
    block: Array, end: int, n_wheel: int, n_rail: int, prescribed: int, n_samples: int
) -> tuple[Search, int]:
    """Return the arrays of a contact search for curves of `n_wheel` and `n_rail` nodes, and the new end.

    `prescribed` is the number of samples at given positions: all or none.
    """
    wheel, end = matrix(block, end, N_PROFILE_ROWS, n_wheel)
    rail, end = matrix(block, end, N_PROFILE_ROWS, n_rail)
    motion, end = records(block, end, 1, MOTION)
    grid, end = vector(block, end, prescribed)
    patches, end = records(block, end, MAX_PATCHES, PATCH)
    separations, end = cube(block, end, MAX_PATCHES, len(Sep), n_samples)
    line, end = matrix(block, end, N_LINE_ROWS, n_wheel)
    placed, end = matrix(block, end, N_PROFILE_ROWS, n_rail)
    lobes, end = records(block, end, MAX_LOBES, LOBE)
    wheel_plane, end = matrix(block, end, N_LINE_ROWS, n_wheel)
    rail_plane, end = matrix(block, end, N_PROFILE_ROWS, n_rail)
    case, end = records(block, end, 1, CASE)
    across, end = lay_across(block, end, SEARCH_STRIPS)
    work, end = matrix(block, end, len(Sample), n_samples)
    strips, end = matrix(block, end, len(Strip), MAX_PATCHES * SEARCH_STRIPS)
    result, end = records(block, end, 1, RESULT)
    search = Search(
        wheel, rail, motion, grid, patches, separations, line, placed, lobes, wheel_plane, rail_plane,
        case, across, work, strips, result,
    )  # fmt: skip
    return search, end


@shared
def lay_sheet(block: Array, end: int, n_slices: int, n_paths: int, n_deviation: int) -> tuple[Sheet, int]:
    """Return the arrays of a surface, and the new end."""
    u, end = vector(block, end, n_slices)
    nodes, end = cube(block, end, n_slices, 2 * len(Node), n_paths)
    runs, end = matrix(block, end, n_slices, 2)
    period, end = vector(block, end, 2)
    deviation, end = matrix(block, end, 3, n_deviation)
    return Sheet(u, nodes, runs, period, deviation), end


@shared
def lay_surface_search(block: Array, end: int, wheel: Sheet, rail: Sheet, n_samples: int) -> tuple[SurfaceSearch, int]:
    """Return the arrays of a contact search over two surfaces, and the new end."""
    motion, end = records(block, end, 2, MOTION)
    patches, end = records(block, end, MAX_PATCHES, PATCH)
    separations, end = cube(block, end, MAX_PATCHES, len(Sep), n_samples)
    lobes, end = records(block, end, MAX_LOBES, LOBE)
    section, end = matrix(block, end, len(Section), max(wheel.nodes.shape[2], rail.nodes.shape[2]))
    column, end = matrix(block, end, len(Over), max(COARSE_ROWS, FINE_ROWS, n_samples))
    coarse, end = cube(block, end, 2, COARSE_ROWS, COARSE_COLUMNS)
    rough, end = cube(block, end, GRIDS * len(Cell), FINE_ROWS, FINE_COLUMNS)
    fine, end = cube(block, end, GRIDS * len(Cell), FINE_ROWS, FINE_COLUMNS)
    boxes, end = matrix(block, end, 2 * GRIDS + 1, len(Box))
    stack, end = vector(block, end, COARSE_ROWS * COARSE_COLUMNS)
    h, end = matrix(block, end, n_samples, PATCH_COLUMNS)
    x, end = matrix(block, end, n_samples, PATCH_COLUMNS)
    case, end = records(block, end, 1, CASE)
    across, end = lay_across(block, end, SEARCH_STRIPS)
    work, end = matrix(block, end, len(Sample), n_samples)
    strips, end = matrix(block, end, len(Strip), MAX_PATCHES * SEARCH_STRIPS)
    result, end = records(block, end, 1, RESULT)
    search = SurfaceSearch(
        wheel, rail, motion, patches, separations, lobes, section, column, coarse, rough, fine, boxes, stack, h, x,
        case, across, work, strips, result,
    )  # fmt: skip
    return search, end


@shared
def lay_ledger(block: Array, end: int, wheel: Array, rail: Array, bins: Array, n_strips: int) -> tuple[Ledger, int]:
    """Return a ledger around the rows of the profiles and the bins, and the new end."""
    capacity = MAX_PATCHES * n_strips
    wheel_arc, end = vector(block, end, wheel.shape[1])
    rail_arc, end = vector(block, end, rail.shape[1])
    settings, end = records(block, end, 1, LEDGER)
    rates, end = matrix(block, end, len(Bin), capacity)
    edges, end = matrix(block, end, 2, capacity)
    return Ledger(wheel, wheel_arc, rail, rail_arc, settings, rates, edges, bins), end


@shared
def pair_memory_size(piece: int) -> int:
    """Return the size of the memory of a pair whose patches have `piece` numbers each, see `PairArrays`."""
    return 1 + MAX_PATCHES * piece + 2


@shared
def lay_pair(
    block: Array, end: int, size: Size, memory: Array, search: Search, workspace: Workspace, ledger: Ledger
) -> tuple[PairArrays, int]:
    """Return the arrays of a pair around its search, its workspace and its ledger, and the new end."""
    case, end = records(block, end, 1, CASE)
    patch_case, end = records(block, end, 1, CASE)
    result, end = records(block, end, 1, RESULT)
    parameters, end = records(block, end, 1, DAMAGE_PARAMETERS)
    damage_fields, end = cube(block, end, len(DamageField), MAX_PATCHES * size.n_strips, size.n_elements)
    damage, end = records(block, end, 1, DAMAGE)
    contacts, end = records(block, end, MAX_PATCHES, CONTACT)
    total, end = records(block, end, 1, TOTAL)
    rail, end = records(block, end, 1, ELASTIC_RAIL)
    roots, end = records(block, end, 3, ROOT)
    moved, end = records(block, end, 1, GIVEN)
    given, end = records(block, end, 1, GIVEN)
    offset, end = records(block, end, 1, WHEEL_OFFSET)
    displaced, end = records(block, end, 1, GIVEN)
    arrays = PairArrays(
        search, workspace, case, patch_case, result, memory, parameters, damage_fields, damage, contacts, total, ledger,
        rail, roots, moved, given, offset, displaced,
    )  # fmt: skip
    return arrays, end


@shared
def lay_near_search(block: Array, end: int, size: Size, search: Search) -> tuple[Search, int]:
    """Return the arrays of a search of neighbouring poses, in the scratch of `search`, and the new end."""
    motion, end = records(block, end, 1, MOTION)
    patches, end = records(block, end, MAX_PATCHES, PATCH)
    separations, end = cube(block, end, MAX_PATCHES, len(Sep), size.n_samples)
    near = Search(
        search.wheel, search.rail, motion, search.grid, patches, separations, search.line, search.placed, search.lobes,
        search.wheel_plane, search.rail_plane, search.case, search.across, search.work, search.strips, search.result,
    )  # fmt: skip
    return near, end


@shared
def lay_derivatives(
    block: Array, end: int, size: Size, near: Search, arrays: PairArrays
) -> tuple[DerivativeArrays, int]:
    """Return the arrays for the derivatives of a pair, whose neighbours are found by the search `near`, and the new end."""
    memory, end = vector(block, end, arrays.memory.size)
    case, end = records(block, end, 2, CASE)
    patch_case, end = records(block, end, 1, CASE)
    result, end = records(block, end, 2, RESULT)
    contacts, end = records(block, end, MAX_PATCHES, CONTACT)
    total, end = records(block, end, 1, TOTAL)
    numbers, _ = vector(block, end, Moved.RAIL_ROLL_RATE + 1)
    given, end = records(block, end, 1, GIVEN)
    beside = PairArrays(
        near, arrays.workspace, case, patch_case, result, memory, arrays.damage_parameters, arrays.damage_fields, arrays.damage,
        contacts, total, arrays.ledger, arrays.rail, arrays.roots, arrays.moved, given, arrays.offset, arrays.displaced,
    )  # fmt: skip
    start, end = vector(block, end, arrays.memory.size)
    patches, end = records(block, end, MAX_PATCHES, PATCH)
    middle, end = vector(block, end, PAIR_ROWS)
    forces, end = vector(block, end, PAIR_ROWS)
    by_creep, end = cube(block, end, MAX_PATCHES, CREEPS, PAIR_ROWS)
    creeps, end = cube(block, end, MAX_PATCHES, CREEPS, len(Moved))
    row, end = cube(block, end, len(Field), 1, size.n_elements)
    rows, columns = tangent_shape(size.n_strips, size.interacting)
    tangents, end = cube(block, end, MAX_PATCHES, rows, columns)
    linear, end = vector(block, end, MAX_PATCHES)
    sides, end = vector(block, end, len(Moved))
    jacobian, end = matrix(block, end, PAIR_ROWS, len(Moved))
    derivatives = DerivativeArrays(
        beside, numbers, start, patches, middle, forces, by_creep, creeps, row, tangents, linear, sides, jacobian
    )
    return derivatives, end
