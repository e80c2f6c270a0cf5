"""Arrays of the kernels with their shapes: one list for Python and for the memory block of an FMU.

Every function here lays arrays in `block`, from the float64 with index `end` on, and returns them with the new end. In
Python the block is a numpy array. In compiled code it is a pointer, and nothing is read or written. So the same list
allocates a Python workspace and places the arrays in the memory of an FMU instance.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from llvmlite import ir
from numba import carray, types
from numba.core.errors import TypingError
from numba.extending import intrinsic, overload, register_jitable

from contact.kernels.families import Families
from contact.kernels.kalker import N_TABLE
from contact.kernels.layout import (
    CASE,
    CONTACT,
    DAMAGE,
    DAMAGE_PARAMETERS,
    LEDGER,
    LOBE,
    MAX_LOBES,
    MAX_PATCHES,
    MOTION,
    N_BIN_ROWS,
    N_DAMAGE_FIELDS,
    N_ELEMENT_ROWS,
    N_FIELD_ROWS,
    N_LINE_ROWS,
    N_PROFILE_ROWS,
    N_SAMPLE_ROWS,
    N_SEP_ROWS,
    N_STRIP_ROWS,
    N_VECTOR_ROWS,
    PATCH,
    RESULT,
    TOTAL,
)
from contact.kernels.normal.between_panels import PROBES
from contact.kernels.normal.descent import FEWEST, MOST, N_LAYERS
from contact.kernels.normal.influence import MOST_TABULATED, N_COLUMNS
from contact.kernels.normal.strip_halfspace import MEM_LN_A
from contact.kernels.tangential.lanes import LANES, N_LANE_ROWS, TRACE_WIDTH

#: Number of strips of the normal problem that a search solves to find the height of a wheel under a load.
SEARCH_STRIPS = 30
#: Number of float64 in a cache line. Vectors that extend over two lines cost a sixth of the time of the march.
_LINE = 8

Array = Any  # an ndarray in Python; numba infers the rest


class Samples(NamedTuple):
    """Samples of a separation: the rows of `contact.Separation`, all of the same length."""

    y: Array
    g: Array
    A: Array
    x_c: Array
    tilt: Array


class Across(NamedTuple):
    """Positions of strips across a patch, on [-1, 1], and their weights: Fejér's first rule."""

    nodes: Array
    weights: Array


class Rule(NamedTuple):
    """Positions of strips and elements in a patch, and tables that follow from them. Constant for a resolution, read-only."""

    across: Across
    elements: Array
    cosines: Array
    cosine_logs: Array
    columns: Array
    descent: Array
    probes: Array
    spread: Array


class Tables(NamedTuple):
    """Interpolated functions, read-only.

    They are Kalker's coefficients for one Poisson's ratio, the influence of strips on the centre line and anywhere, and
    the creep forces of the half space.
    """

    kalker: Array
    centre: Array
    plane: Array
    creep: Array


class Space(NamedTuple):
    """Scratch arrays of the normal and the tangential methods.

    `memory` is the start for the next call. `case` is a copy that a kernel may change.
    """

    grid: Array
    vectors: Array
    logs: Array
    matrix: Array
    lu: Array
    memory: Array
    lanes: Array
    trace: Array
    case: Array


class Arrays(NamedTuple):
    """Arrays of a workspace. Their types are the same for all methods, so a method is compiled once."""

    rule: Rule
    tables: Tables
    space: Space
    strips: Array
    fields: Array


class Workspace(NamedTuple):
    """Everything that `pipeline.solve_case` needs besides the problem. The type of `families` chooses the kernels."""

    families: Families
    rule: Rule
    tables: Tables
    space: Space
    strips: Array
    fields: Array


class Search(NamedTuple):
    """Arrays of a contact search.

    The input is `wheel`, `rail`, `motion` and the sample positions `grid`. The output is `patches` and `separations`.
    `case`, `across`, `work`, `strips` and `result` are those of the normal problem under a load. The others are
    scratch.
    """

    wheel: Array
    rail: Array
    motion: Array
    grid: Array
    patches: Array
    separations: Array
    line: Array
    placed: Array
    lobes: Array
    wheel_plane: Array
    rail_plane: Array
    case: Array
    across: Across
    work: Array
    strips: Array
    result: Array


class Ledger(NamedTuple):
    """Bins over both profiles in which damage is accumulated. Without bins nothing is entered.

    `wheel` and `rail` are rows y, z of the whole profiles, with the arc length of each point. `rates` and `edges` are
    scratch.
    """

    wheel: Array
    wheel_arc: Array
    rail: Array
    rail_arc: Array
    settings: Array
    rates: Array
    edges: Array
    bins: Array


class Bench(NamedTuple):
    """All arrays of one pair.

    `search`, `own` and `damage_parameters` hold sizes and constants. `case` holds methods, material and friction.
    `patch_case` holds the same for the current patch. `memory` is the start for the next call: the number of patches,
    then one piece for each of MAX_PATCHES. `contacts` and `total` are the results. `ledger` accumulates damage.
    """

    search: Search
    own: Workspace
    case: Array
    patch_case: Array
    result: Array
    memory: Array
    damage_parameters: Array
    damage_fields: Array
    damage: Array
    contacts: Array
    total: Array
    ledger: Ledger


class Size(NamedTuple):
    """Sizes of a workspace: strips per patch, elements per strip, largest number of samples of a separation.

    `interacting` is 1 for methods whose strips interact. `with_fields` is 1 if fields are wanted.
    """

    n_strips: int
    n_elements: int
    n_samples: int
    interacting: int
    with_fields: int


@intrinsic
def ahead(typing_context, pointer, count):
    """Return the pointer advanced by `count` float64 values."""
    if pointer != types.CPointer(types.float64):
        raise TypingError("a block in compiled code is a pointer to float64")

    def generate(context, builder, signature, arguments):
        base, offset = arguments
        return builder.gep(base, [offset], source_etype=ir.DoubleType())

    return pointer(pointer, types.int64), generate


@intrinsic
def _untyped(typing_context, pointer):
    """Return the pointer as a void pointer, which `carray` requires for records."""

    def generate(context, builder, signature, arguments):
        return builder.bitcast(arguments[0], context.get_value_type(types.voidptr))

    return types.voidptr(pointer), generate


def vector(block: Array, end: int, n: int) -> tuple[Array, int]:
    """Return a vector of `n` float64, laid in `block`, and the new end."""
    return block[end : end + n], end + n


def matrix(block: Array, end: int, rows: int, columns: int) -> tuple[Array, int]:
    """Return a matrix of float64, laid in `block`, and the new end."""
    return block[end : end + rows * columns].reshape(rows, columns), end + rows * columns


def cube(block: Array, end: int, layers: int, rows: int, columns: int) -> tuple[Array, int]:
    """Return a three-dimensional array of float64, laid in `block`, and the new end."""
    size = layers * rows * columns
    return block[end : end + size].reshape(layers, rows, columns), end + size


def records(block: Array, end: int, n: int, dtype: Any) -> tuple[Array, int]:
    """Return `n` records, laid in `block`, and the new end."""
    size = n * (dtype.itemsize // 8)
    return block[end : end + size].view(dtype), end + size


@overload(vector)
def _vector(block, end, n):
    return lambda block, end, n: (carray(ahead(block, end), (n,)), end + n)


@overload(matrix)
def _matrix(block, end, rows, columns):
    return lambda block, end, rows, columns: (carray(ahead(block, end), (rows, columns)), end + rows * columns)


@overload(cube)
def _cube(block, end, layers, rows, columns):
    def lay(block, end, layers, rows, columns):
        return carray(ahead(block, end), (layers, rows, columns)), end + layers * rows * columns

    return lay


@overload(records)
def _records(block, end, n, dtype):
    words = dtype.dtype.size // 8
    return lambda block, end, n, dtype: (carray(_untyped(ahead(block, end)), (n,), dtype), end + n * words)


@register_jitable
def next_line(end: int) -> int:
    """Return the first index from `end` on at which a cache line begins. The block itself begins at one."""
    return (end + _LINE - 1) // _LINE * _LINE


@register_jitable
def memory_size(size: Size) -> int:
    """Return the number of float64 that a normal method keeps from one call to the next."""
    return MEM_LN_A + (MAX_PATCHES * size.n_strips if size.interacting else 1)


@register_jitable
def lay_across(block: Array, end: int, n_strips: int) -> tuple[Across, int]:
    """Return the arrays for positions and weights of strips across a patch, and the new end."""
    nodes, end = vector(block, end, n_strips)
    weights, end = vector(block, end, n_strips)
    return Across(nodes, weights), end


@register_jitable
def lay_rule(block: Array, end: int, size: Size) -> tuple[Rule, int]:
    """Return the arrays of the rule of a resolution, and the new end."""
    n = size.n_strips
    across, end = lay_across(block, end, n)
    elements, end = matrix(block, end, N_ELEMENT_ROWS, size.n_elements)
    cosines, end = vector(block, end, n + 1)
    cosine_logs, end = matrix(block, end, n, n + 1)
    tabulated = size.interacting != 0 and n <= MOST_TABULATED  # else the table of columns is not used
    columns, end = cube(block, end, N_COLUMNS if tabulated else 1, n if tabulated else 1, n if tabulated else 1)
    descending = size.interacting != 0 and FEWEST <= n <= MOST
    descent, end = cube(block, end, N_LAYERS if descending else 1, n if descending else 1, n if descending else 1)
    probes, end = vector(block, end, PROBES)
    spread, end = matrix(block, end, PROBES, n)
    return Rule(across, elements, cosines, cosine_logs, columns, descent, probes, spread), end


@register_jitable
def lay_kalker(block: Array, end: int) -> tuple[Array, int]:
    """Return the table of Kalker's coefficients for one Poisson's ratio, and the new end."""
    return matrix(block, end, N_TABLE, 8)


@register_jitable
def lay_space(block: Array, end: int, size: Size, memory: Array) -> tuple[Space, int]:
    """Return the scratch arrays of a workspace around `memory`, which has the size `memory_size`, and the new end."""
    capacity = MAX_PATCHES * size.n_strips if size.interacting else 1
    grid, end = matrix(block, end, N_SAMPLE_ROWS, size.n_samples)
    vectors, end = matrix(block, end, N_VECTOR_ROWS, capacity)
    logs, end = matrix(block, end, MAX_PATCHES * PROBES if size.interacting else 1, capacity + MAX_PATCHES)
    influence, end = matrix(block, end, capacity, capacity)
    lu, end = matrix(block, end, capacity, capacity)
    lanes, end = vector(block, next_line(end), N_LANE_ROWS * LANES)
    trace, end = matrix(block, end, size.n_elements, TRACE_WIDTH)
    case, end = records(block, end, 1, CASE)
    return Space(grid, vectors, logs, influence, lu, memory, lanes, trace, case), end


@register_jitable
def lay_strips_and_fields(block: Array, end: int, size: Size) -> tuple[Array, Array, int]:
    """Return strips and fields of a solution, and the new end. Without fields one row of them serves all strips."""
    capacity = MAX_PATCHES * size.n_strips
    strips, end = matrix(block, end, N_STRIP_ROWS, capacity)
    fields, end = cube(block, end, N_FIELD_ROWS, capacity if size.with_fields else 1, size.n_elements)
    return strips, fields, end


@register_jitable
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
    separations, end = cube(block, end, MAX_PATCHES, N_SEP_ROWS, n_samples)
    line, end = matrix(block, end, N_LINE_ROWS, n_wheel)
    placed, end = matrix(block, end, N_PROFILE_ROWS, n_rail)
    lobes, end = records(block, end, MAX_LOBES, LOBE)
    wheel_plane, end = matrix(block, end, N_LINE_ROWS, n_wheel)
    rail_plane, end = matrix(block, end, N_PROFILE_ROWS, n_rail)
    case, end = records(block, end, 1, CASE)
    across, end = lay_across(block, end, SEARCH_STRIPS)
    work, end = matrix(block, end, N_SAMPLE_ROWS, n_samples)
    strips, end = matrix(block, end, N_STRIP_ROWS, MAX_PATCHES * SEARCH_STRIPS)
    result, end = records(block, end, 1, RESULT)
    search = Search(
        wheel, rail, motion, grid, patches, separations, line, placed, lobes, wheel_plane, rail_plane,
        case, across, work, strips, result,
    )  # fmt: skip
    return search, end


@register_jitable
def lay_ledger(block: Array, end: int, wheel: Array, rail: Array, bins: Array, n_strips: int) -> tuple[Ledger, int]:
    """Return a ledger around the rows of the profiles and the bins, and the new end."""
    capacity = MAX_PATCHES * n_strips
    wheel_arc, end = vector(block, end, wheel.shape[1])
    rail_arc, end = vector(block, end, rail.shape[1])
    settings, end = records(block, end, 1, LEDGER)
    rates, end = matrix(block, end, N_BIN_ROWS, capacity)
    edges, end = matrix(block, end, 2, capacity)
    return Ledger(wheel, wheel_arc, rail, rail_arc, settings, rates, edges, bins), end


@register_jitable
def lay_bench(
    block: Array, end: int, size: Size, memory: Array, search: Search, own: Workspace, ledger: Ledger
) -> tuple[Bench, int]:
    """Return the arrays of a pair around its search, its workspace and its ledger, and the new end."""
    case, end = records(block, end, 1, CASE)
    patch_case, end = records(block, end, 1, CASE)
    result, end = records(block, end, 1, RESULT)
    parameters, end = records(block, end, 1, DAMAGE_PARAMETERS)
    damage_fields, end = cube(block, end, N_DAMAGE_FIELDS, MAX_PATCHES * size.n_strips, size.n_elements)
    damage, end = records(block, end, 1, DAMAGE)
    contacts, end = records(block, end, MAX_PATCHES, CONTACT)
    total, end = records(block, end, 1, TOTAL)
    bench = Bench(
        search, own, case, patch_case, result, memory, parameters, damage_fields, damage, contacts, total, ledger
    )
    return bench, end
