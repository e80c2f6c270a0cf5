"""What kernels receive: named groups of arrays.

The text in an annotation is the shape of an array, or the arguments of the layout of a group, in the names of
`contact.kernels.memory`. Arrays lie in memory in the sequence of the members. A member without a text is laid elsewhere.
"""

from __future__ import annotations

from typing import Annotated, Any, Generic, NamedTuple, TypeVar

import numpy as np

from contact.core import Shape, group
from contact.kernels import records, searches

Array = Any  # an ndarray of any shape
Numbers = Annotated[Any, Shape(np.float64, 1)]
Matrix = Annotated[Any, Shape(np.float64, 2)]
Cube = Annotated[Any, Shape(np.float64, 3)]
Flags = Annotated[Any, Shape(np.bool_, 2)]
FourD = Annotated[Any, Shape(np.float64, 4)]
FiveD = Annotated[Any, Shape(np.float64, 5)]
Integers = Annotated[Any, Shape(np.int64, 1)]
#: Beside a shape: the array begins at a line of the cache.
ON_LINE = "line"

#: Arrays of records (`contact.kernels.records`), and single records.
Cases = Annotated[Any, Shape(records.CASE, 1)]
Case = Annotated[Any, Shape(records.CASE, 0)]
Results = Annotated[Any, Shape(records.RESULT, 1)]
Result = Annotated[Any, Shape(records.RESULT, 0)]
Givens = Annotated[Any, Shape(records.GIVEN, 1)]
Given = Annotated[Any, Shape(records.GIVEN, 0)]
Motions = Annotated[Any, Shape(records.MOTION, 1)]
Motion = Annotated[Any, Shape(records.MOTION, 0)]
Patches = Annotated[Any, Shape(records.PATCH, 1)]
Patch = Annotated[Any, Shape(records.PATCH, 0)]
Lobes = Annotated[Any, Shape(records.LOBE, 1)]
Contacts = Annotated[Any, Shape(records.CONTACT, 1)]
Contact = Annotated[Any, Shape(records.CONTACT, 0)]
Totals = Annotated[Any, Shape(records.TOTAL, 1)]
Total = Annotated[Any, Shape(records.TOTAL, 0)]
Damages = Annotated[Any, Shape(records.DAMAGE, 1)]
Damage = Annotated[Any, Shape(records.DAMAGE, 0)]
Parameters = Annotated[Any, Shape(records.DAMAGE_PARAMETERS, 1)]
DamageParameters = Annotated[Any, Shape(records.DAMAGE_PARAMETERS, 0)]
Settings = Annotated[Any, Shape(records.LEDGER, 1)]
Setting = Annotated[Any, Shape(records.LEDGER, 0)]
Roots = Annotated[Any, Shape(searches.ROOT, 1)]
Root = Annotated[Any, Shape(searches.ROOT, 0)]
ForceSearches = Annotated[Any, Shape(searches.FORCE_SEARCH, 1)]
ForceSearch = Annotated[Any, Shape(searches.FORCE_SEARCH, 0)]
Iterations = Annotated[Any, Shape(searches.ITERATION, 1)]
Springs = Annotated[Any, Shape(records.ELASTIC_RAIL, 1)]
Offsets = Annotated[Any, Shape(records.WHEEL_OFFSET, 1)]


@group
class Samples(NamedTuple):
    """Samples of a separation: the rows of `contact.Separation`, all of the same length."""

    y: Annotated[Numbers, "n"]
    g: Annotated[Numbers, "n"]
    A: Annotated[Numbers, "n"]
    x_c: Annotated[Numbers, "n"]
    tilt: Annotated[Numbers, "n"]


@group
class Across(NamedTuple):
    """Positions of strips across a patch, on [-1, 1], and their weights: Fejér's first rule."""

    nodes: Annotated[Numbers, "n_strips"]
    weights: Annotated[Numbers, "n_strips"]


@group
class Rule(NamedTuple):
    """Positions of strips and elements in a patch, and tables that follow from them. Constant for a resolution, read-only."""

    across: Annotated[Across, "size.n_strips"]
    elements: Annotated[Matrix, "len(Element), size.n_elements"]
    cosines: Annotated[Numbers, "size.n_strips + 1"]
    cosine_logs: Annotated[Matrix, "size.n_strips, size.n_strips + 1"]
    columns: Annotated[Cube, "*columns_shape(size)"]
    descent: Annotated[Cube, "*descent_shape(size)"]
    factors: Annotated[Cube, "*factors_shape(size)"]
    probes: Annotated[Numbers, "PROBES"]
    spread: Annotated[Matrix, "PROBES, size.n_strips"]


@group
class Tables(NamedTuple):
    """Interpolated functions, read-only.

    They are Kalker's coefficients for one Poisson's ratio, the influence of strips on the centre line and anywhere, and
    the creep forces of the half space.
    """

    kalker: Matrix
    centre: Matrix
    plane: Matrix
    creep: FiveD


@group
class Space(NamedTuple):
    """Scratch arrays of the normal and the tangential methods.

    `memory` is the start for the next call. `case` is a copy that a kernel may change. `turned` is the separation in the
    orientation in which interacting strips are solved. `iteration` is the state of their iteration, `iterates` has a row for
    each step of it. `tangent` says how they follow a small change (`normal.tangent`).
    """

    grid: Annotated[Matrix, "len(Sample), size.n_samples"]
    turned: Annotated[Matrix, "len(Sep), size.n_samples if size.interacting else 1"]
    vectors: Annotated[Matrix, "N_VECTOR_ROWS, MAX_PATCHES * size.n_strips"]
    logs: Annotated[
        Matrix, "MAX_PATCHES * max(size.n_strips, PROBES) if size.interacting else 1, coupled(size) + MAX_PATCHES"
    ]
    matrix: Annotated[Matrix, "coupled(size), coupled(size)"]
    lu: Annotated[Matrix, "coupled(size), coupled(size)"]
    iteration: Annotated[Iterations, "1"]
    iterates: Annotated[Matrix, "MOST_ITERATES if size.interacting else 1, Iterate.ENDS + 2 * MAX_PATCHES"]
    memory: Numbers
    lanes: Annotated[Numbers, "N_LANE_ROWS * LANES", ON_LINE]
    trace: Annotated[Matrix, "size.n_elements, TRACE_WIDTH"]
    case: Annotated[Cases, "1"]
    tangent: Annotated[Matrix, "*tangent_shape(size.n_strips, size.interacting)"]


@group
class Workspace(NamedTuple):
    """Everything that `pipeline.solve_case` needs besides the problem."""

    rule: Rule
    tables: Tables
    space: Space
    strips: Matrix
    fields: Cube


@group
class SolverArrays(NamedTuple):
    """All arrays of one contact that is solved again and again. `case` and `result` have a second, scratch record.

    `search` is that of a given force, `row` a single row of fields, for forces alone, `slopes` are the derivatives
    (`contact.kernels.jacobian`).
    """

    workspace: Workspace
    case: Annotated[Cases, "2"]
    result: Annotated[Results, "2"]
    search: Annotated[ForceSearches, "1"]
    row: Annotated[Cube, "len(Field), 1, size.n_elements"]
    slopes: Annotated[Matrix, "ROWS, COLUMNS"]


@group
class PatchStrips(NamedTuple):
    """Rows of `strips` of one patch."""

    y: Numbers
    x_c: Numbers
    a: Numbers
    p0: Numbers


@group
class PatchFields(NamedTuple):
    """Rows of `fields` of one patch, shape (strips, elements)."""

    x: Matrix
    p: Matrix
    qx: Matrix
    qy: Matrix


@group
class LoadGrid(NamedTuple):
    """Uniform pressure and traction on the wheel [Pa], shape (ny, nx), on equal rectangles with the centres x, y [m]."""

    x: Numbers
    y: Numbers
    p: Matrix
    qx: Matrix
    qy: Matrix


@group
class Search(NamedTuple):
    """Arrays of a contact search.

    The input is `wheel`, `rail`, `motion` and the sample positions `grid`. The output is `patches` and `separations`.
    `case`, `across`, `work`, `strips` and `result` are those of the normal problem under a load. The others are
    scratch.
    """

    wheel: Annotated[Matrix, "N_PROFILE_ROWS, n_wheel"]
    rail: Annotated[Matrix, "N_PROFILE_ROWS, n_rail"]
    motion: Annotated[Motions, "1"]
    grid: Annotated[Numbers, "prescribed"]
    patches: Annotated[Patches, "MAX_PATCHES"]
    separations: Annotated[Cube, "MAX_PATCHES, len(Sep), n_samples"]
    line: Annotated[Matrix, "N_LINE_ROWS, n_wheel"]
    placed: Annotated[Matrix, "N_PROFILE_ROWS, n_rail"]
    lobes: Annotated[Lobes, "MAX_LOBES"]
    wheel_plane: Annotated[Matrix, "N_LINE_ROWS, n_wheel"]
    rail_plane: Annotated[Matrix, "N_PROFILE_ROWS, n_rail"]
    case: Annotated[Cases, "1"]
    across: Annotated[Across, "SEARCH_STRIPS"]
    work: Annotated[Matrix, "len(Sample), n_samples"]
    strips: Annotated[Matrix, "len(Strip), MAX_PATCHES * SEARCH_STRIPS"]
    result: Annotated[Results, "1"]


@group
class Sheet(NamedTuple):
    """A surface that changes along its first coordinate u: the arrays of `contact.geometry.surfaces.sheet.SplineSheet`.

    `runs` are the first path of each slice and the end. `period` is that of u, 0 for none; without it the surface is
    constant beyond its slices, and `fold` is the middle of the full turn in which a wheel's slices lie, `NaN` for a rail.
    `deviation` has the rows u, value and slope of what is added to z.
    """

    u: Annotated[Numbers, "n_slices"]
    nodes: Annotated[Cube, "n_slices, 2 * len(Node), n_paths"]
    runs: Annotated[Matrix, "n_slices, 2"]
    period: Annotated[Numbers, "2"]
    deviation: Annotated[Matrix, "3, n_deviation"]


@group
class SurfaceSearch(NamedTuple):
    """Arrays of a contact search over surfaces. Members that `Search` also has are the same.

    `motion` is followed by that of the last search, whose grids serve again if only z and velocities differ.
    `coarse` is a grid over all of the wheel, `rough` and `fine` are grids over the regions in which the bodies are close,
    `boxes` their places. `section` and `column` are scratch, `h` and `x` the gap of a patch, row by row.
    """

    wheel: Sheet
    rail: Sheet
    motion: Annotated[Motions, "2"]
    patches: Annotated[Patches, "MAX_PATCHES"]
    separations: Annotated[Cube, "MAX_PATCHES, len(Sep), n_samples"]
    lobes: Annotated[Lobes, "MAX_LOBES"]
    section: Annotated[Matrix, "len(Section), max(wheel.nodes.shape[2], rail.nodes.shape[2])"]
    column: Annotated[Matrix, "len(Over), max(COARSE_ROWS, FINE_ROWS, n_samples)"]
    coarse: Annotated[Cube, "2, COARSE_ROWS, COARSE_COLUMNS"]
    rough: Annotated[Cube, "GRIDS * len(Cell), FINE_ROWS, FINE_COLUMNS"]
    fine: Annotated[Cube, "GRIDS * len(Cell), FINE_ROWS, FINE_COLUMNS"]
    boxes: Annotated[Matrix, "2 * GRIDS + 1, len(Box)"]
    stack: Annotated[Numbers, "COARSE_ROWS * COARSE_COLUMNS"]
    h: Annotated[Matrix, "n_samples, PATCH_COLUMNS"]
    x: Annotated[Matrix, "n_samples, PATCH_COLUMNS"]
    case: Annotated[Cases, "1"]
    across: Annotated[Across, "SEARCH_STRIPS"]
    work: Annotated[Matrix, "len(Sample), n_samples"]
    strips: Annotated[Matrix, "len(Strip), MAX_PATCHES * SEARCH_STRIPS"]
    result: Annotated[Results, "1"]


@group
class Ledger(NamedTuple):
    """Bins over both profiles in which damage is accumulated. Without bins nothing is entered.

    `wheel` and `rail` are rows y, z of the whole profiles, with the arc length of each point. `rates` and `edges` are
    scratch.
    """

    wheel: Matrix
    wheel_arc: Annotated[Numbers, "wheel.shape[1]"]
    rail: Matrix
    rail_arc: Annotated[Numbers, "rail.shape[1]"]
    settings: Annotated[Settings, "1"]
    rates: Annotated[Matrix, "len(Bin), MAX_PATCHES * n_strips"]
    edges: Annotated[Matrix, "2, MAX_PATCHES * n_strips"]
    bins: Cube


Kind = TypeVar("Kind", Search, SurfaceSearch)


@group
class PairArrays(NamedTuple, Generic[Kind]):
    """All arrays of one pair.

    `search`, `workspace` and `damage_parameters` hold sizes and constants. `case` holds methods, material and friction.
    `patch_case` holds the same for the current patch. `memory` is the start for the next call: the number of patches,
    then one piece for each of MAX_PATCHES, then the deflection of the rail. `rail` holds its springs, `roots` and `moved`
    are for the search of the deflection, the last root for that of the height. `given` is the motion that is asked for,
    `offset` the displacement of the wheel against its wheelset, `displaced` the motion with it. `contacts` and `total` are the
    results. `ledger` accumulates damage.
    """

    search: Kind
    workspace: Workspace
    case: Annotated[Cases, "1"]
    patch_case: Annotated[Cases, "1"]
    result: Annotated[Results, "1"]
    memory: Numbers
    damage_parameters: Annotated[Parameters, "1"]
    damage_fields: Annotated[Cube, "len(DamageField), MAX_PATCHES * size.n_strips, size.n_elements"]
    damage: Annotated[Damages, "1"]
    contacts: Annotated[Contacts, "MAX_PATCHES"]
    total: Annotated[Totals, "1"]
    ledger: Ledger
    rail: Annotated[Springs, "1"]
    roots: Annotated[Roots, "3"]
    moved: Annotated[Givens, "1"]
    given: Annotated[Givens, "1"]
    offset: Annotated[Offsets, "1"]
    displaced: Annotated[Givens, "1"]


@group
class DerivativeArrays(NamedTuple, Generic[Kind]):
    """What the derivatives of a pair need besides its own arrays (`pair_jacobian`).

    `neighbour` solves neighbouring problems in the scratch of the pair. `numbers` are the members of its record
    `given`. `start`, `patches` and `middle` are warm start, patches and forces of the middle one, `forces` those of the last
    one. `by_creep[patch, creep]` are derivatives of the forces by the creepages, `creeps[patch, creep]` those of the creepages
    by the motion. `row` is a single row of fields. `tangents` are those of the patches that are `linear`, which is 1 or 0.
    `sides` says for each column on which side of the pose it is a derivative (`pair_jacobian.BOTH_SIDES` and others).
    """

    neighbour: PairArrays[Kind]
    numbers: Numbers
    start: Annotated[Numbers, "neighbour.memory.size"]
    patches: Annotated[Patches, "MAX_PATCHES"]
    middle: Annotated[Numbers, "PAIR_ROWS"]
    forces: Annotated[Numbers, "PAIR_ROWS"]
    by_creep: Annotated[Cube, "MAX_PATCHES, CREEPS, PAIR_ROWS"]
    creeps: Annotated[Cube, "MAX_PATCHES, CREEPS, len(Moved)"]
    row: Annotated[Cube, "len(Field), 1, size.n_elements"]
    tangents: Annotated[Cube, "MAX_PATCHES, *tangent_shape(size.n_strips, size.interacting)"]
    linear: Annotated[Numbers, "MAX_PATCHES"]
    sides: Annotated[Numbers, "len(Moved)"]
    jacobian: Annotated[Matrix, "PAIR_ROWS, len(Moved)"]


class Size(NamedTuple):
    """Sizes of a workspace: strips per patch, elements per strip, largest number of samples of a separation.

    `interacting` is 1 for methods whose strips interact. `with_fields` is 1 if fields are wanted.
    """

    n_strips: int
    n_elements: int
    n_samples: int
    interacting: int
    with_fields: int
