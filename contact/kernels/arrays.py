"""What kernels receive: named groups of arrays. `contact.kernels.memory` states their shapes."""

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

    y: Numbers
    g: Numbers
    A: Numbers
    x_c: Numbers
    tilt: Numbers


@group
class Across(NamedTuple):
    """Positions of strips across a patch, on [-1, 1], and their weights: Fejér's first rule."""

    nodes: Numbers
    weights: Numbers


@group
class Rule(NamedTuple):
    """Positions of strips and elements in a patch, and tables that follow from them. Constant for a resolution, read-only."""

    across: Across
    elements: Matrix
    cosines: Numbers
    cosine_logs: Matrix
    columns: Cube
    descent: Cube
    factors: Cube
    probes: Numbers
    spread: Matrix


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

    grid: Matrix
    turned: Matrix
    vectors: Matrix
    logs: Matrix
    matrix: Matrix
    lu: Matrix
    iteration: Iterations
    iterates: Matrix
    memory: Numbers
    lanes: Numbers
    trace: Matrix
    case: Cases
    tangent: Matrix


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
    case: Cases
    result: Results
    search: ForceSearches
    row: Cube
    slopes: Matrix


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

    wheel: Matrix
    rail: Matrix
    motion: Motions
    grid: Numbers
    patches: Patches
    separations: Cube
    line: Matrix
    placed: Matrix
    lobes: Lobes
    wheel_plane: Matrix
    rail_plane: Matrix
    case: Cases
    across: Across
    work: Matrix
    strips: Matrix
    result: Results


@group
class Sheet(NamedTuple):
    """A surface that changes along its first coordinate u: the arrays of `contact.geometry.surfaces.sheet.SplineSheet`.

    `runs` are the first path of each slice and the end. `period` is that of u, 0 for none; without it the surface is
    constant beyond its slices, and `fold` is the middle of the full turn in which a wheel's slices lie, `NaN` for a rail.
    `deviation` has the rows u, value and slope of what is added to z.
    """

    u: Numbers
    nodes: Cube
    runs: Matrix
    period: Numbers
    deviation: Matrix


@group
class SurfaceSearch(NamedTuple):
    """Arrays of a contact search over surfaces. Members that `Search` also has are the same.

    `motion` is followed by that of the last search, whose grids serve again if only z and velocities differ.
    `coarse` is a grid over all of the wheel, `rough` and `fine` are grids over the regions in which the bodies are close,
    `boxes` their places. `section` and `column` are scratch, `h` and `x` the gap of a patch, row by row.
    """

    wheel: Sheet
    rail: Sheet
    motion: Motions
    patches: Patches
    separations: Cube
    lobes: Lobes
    section: Matrix
    column: Matrix
    coarse: Cube
    rough: Cube
    fine: Cube
    boxes: Matrix
    stack: Numbers
    h: Matrix
    x: Matrix
    case: Cases
    across: Across
    work: Matrix
    strips: Matrix
    result: Results


@group
class Ledger(NamedTuple):
    """Bins over both profiles in which damage is accumulated. Without bins nothing is entered.

    `wheel` and `rail` are rows y, z of the whole profiles, with the arc length of each point. `rates` and `edges` are
    scratch.
    """

    wheel: Matrix
    wheel_arc: Numbers
    rail: Matrix
    rail_arc: Numbers
    settings: Settings
    rates: Matrix
    edges: Matrix
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
    case: Cases
    patch_case: Cases
    result: Results
    memory: Numbers
    damage_parameters: Parameters
    damage_fields: Cube
    damage: Damages
    contacts: Contacts
    total: Totals
    ledger: Ledger
    rail: Springs
    roots: Roots
    moved: Givens
    given: Givens
    offset: Offsets
    displaced: Givens


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
    start: Numbers
    patches: Patches
    middle: Numbers
    forces: Numbers
    by_creep: Cube
    creeps: Cube
    row: Cube
    tangents: Cube
    linear: Numbers
    sides: Numbers
    jacobian: Matrix


class Size(NamedTuple):
    """Sizes of a workspace: strips per patch, elements per strip, largest number of samples of a separation.

    `interacting` is 1 for methods whose strips interact. `with_fields` is 1 if fields are wanted.
    """

    n_strips: int
    n_elements: int
    n_samples: int
    interacting: int
    with_fields: int
