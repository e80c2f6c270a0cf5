"""What kernels receive: named groups of arrays. `contact.kernels.memory` states their shapes."""

from __future__ import annotations

from typing import Any, NamedTuple

from contact.kernels.families import Families

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

    `memory` is the start for the next call. `case` is a copy that a kernel may change. `turned` is the separation in the
    orientation in which interacting strips are solved.
    """

    grid: Array
    turned: Array
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


class Sheet(NamedTuple):
    """A surface that changes along its first coordinate u: the arrays of `contact.geometry.surfaces.sheet.Sheet`.

    `runs` are the first path of each slice and the end. `period` is that of u, 0 for none; without it the surface is
    constant beyond its slices, and `fold` is the middle of the full turn in which a wheel's slices lie, `NaN` for a rail.
    `deviation` has the rows u, value and slope of what is added to z.
    """

    u: Array
    nodes: Array
    runs: Array
    period: Array
    deviation: Array


class SurfaceSearch(NamedTuple):
    """Arrays of a contact search over surfaces. Members that `Search` also has are the same.

    `motion` is followed by that of the last search, whose grids serve again if only z and velocities differ.
    `coarse` is a grid over all of the wheel, `rough` and `fine` are grids over the regions in which the bodies are close,
    `boxes` their places. `section` and `column` are scratch, `h` and `x` the gap of a patch, row by row.
    """

    wheel: Sheet
    rail: Sheet
    motion: Array
    patches: Array
    separations: Array
    lobes: Array
    section: Array
    column: Array
    coarse: Array
    rough: Array
    fine: Array
    boxes: Array
    stack: Array
    h: Array
    x: Array
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
    then one piece for each of MAX_PATCHES, then the deflection of the rail. `rail` holds its springs, `roots` and `moved`
    are for the search of the deflection. `offset` is the displacement of the wheel against its
    wheelset, `displaced` the motion with it. `contacts` and `total` are the results. `ledger` accumulates damage.
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
    rail: Array
    roots: Array
    moved: Array
    offset: Array
    displaced: Array


class Size(NamedTuple):
    """Sizes of a workspace: strips per patch, elements per strip, largest number of samples of a separation.

    `interacting` is 1 for methods whose strips interact. `with_fields` is 1 if fields are wanted.
    """

    n_strips: int
    n_elements: int
    n_samples: int
    interacting: int
    with_fields: int
