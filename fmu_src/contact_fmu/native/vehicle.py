"""Native Vehicle: `contact_models.vehicle.kernels` between the entries of the native WheelRailPair, with which it is linked.

The parameters of the pair have the same value references in both FMUs. There is one workspace of the pair for each side; what
a wheel's contact remembers is copied into it before the wheel is solved. Most steps solve no contact: `between` follows the
last solution, as in a run.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numba import carray, types

from contact import Status
from contact.compile.pointers import TYPES, Doubles, integers_of, numbers_of
from contact.core import arranging, group
from contact.kernels.block import ahead, matrix, next_line, records, vector
from contact.kernels.geometry.prepare import rail_origin, turn
from contact.kernels.records import CONTACT, GIVEN, MAX_PATCHES
from contact.kernels.rows import N_PROFILE_ROWS
from contact_models.vehicle.kernels import motion
from contact_models.vehicle.kernels.between import (
    TOLERANCE,
    count_around,
    expect,
    keep_solution,
    lay_last,
    take_expected,
)
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.kernels.wheels import report_wheel, share_of_stick
from ..rows import identifier
from ..tables import wheel_rail_pair as pair_table
from ..tables.vehicle import TOTALS, WHEEL, table
from ..variables import Causality
from .component import SIGNATURES, places
from .failures import Failure
from .vehicle_parts import arrange, fill, lay_kept, track_after, write_motion
from .wheel_rail_pair import layout_of
from .wires import references


def _entry_of_pair(name: str) -> Any:
    """Return an entry of the native WheelRailPair as a function that kernels call."""
    result, arguments = SIGNATURES[name]
    return types.ExternalFunction(f"pair_{name}", TYPES[result](*(TYPES[kind] for kind in arguments), Doubles, Doubles))


_pair_memory, _pair_size = _entry_of_pair("memory"), _entry_of_pair("size")
_pair_prepare, _pair_outputs = _entry_of_pair("prepare"), _entry_of_pair("outputs")
_arrange_pair = layout_of(pair_table.table()).arrange
_N_TOTALS, _N_GIVEN = len(TOTALS), GIVEN.itemsize // 8
_POSITION, _BY_LOAD = (pair_table.LOAD_KIND.number(name) for name in ("Position", "NormalForce"))
_WORST_STATUS = max(int(status) for status in Status)


_TABLE, _PAIR = table("manchester"), pair_table.table()  # the rows of a vehicle of whatever size; those of the pair
_AT, _ITS = places(_TABLE), references(_PAIR)
_N_PLACES = len(_AT)
_N_ITS = _PAIR.span[pair_table.ACCUMULATED[0]].start
_N_PARAMETERS = sum(s.row.causality is Causality.PARAMETER for s in _PAIR.scalars)
if [s.name for s in _TABLE.scalars[:_N_PARAMETERS]] != [s.name for s in _PAIR.scalars[:_N_PARAMETERS]]:
    raise ValueError("the parameters of the pair must come first, with its value references")
_STARTS = np.array([scalar.first for scalar in _PAIR.scalars[:_N_ITS]], float)
_SIDES = np.array([pair_table.SIDE.number(name) for name in ("Right", "Left")], float)
#: Outputs of the pair that are copied: value reference of the pair, and position in `places` of the vehicle's row.
_COPIED = np.array([(_PAIR.span[name].start, _AT.names.index(identifier(row))) for row, name in WHEEL.items()])
#: Numbers of the totals that the pair has a rate of, and its value reference; numbers of those that are summed at every step.
_RATES = np.array([(i, _PAIR.span[rate].start) for i, (_, _, rate) in enumerate(TOTALS.values()) if rate])
_ENERGY, _T_GAMMA = (list(TOTALS).index(name) for name in ("energy", "T_gamma"))
_TOTAL_AT = _AT.names.index(identifier(f"wheel[].total.{next(iter(TOTALS))}"))


@group
class Contacts(NamedTuple):
    """What solves the contacts: the pair's values and workspace for each side, and what the contact of each wheel remembers."""

    values: Any  # shape (2, values)
    memories: Any  # shape (wheels, size of a memory)
    totals: Any  # shape (totals, wheels)
    last: Any
    patches: Any  # of the last solution, MAX_PATCHES for each wheel
    sticks: Any  # share of their area that sticks
    heights: Any  # of the wheelsets at the start
    work: Any  # pointer to all working memory
    values_at: Any  # place of the values in it, of the workspaces, and their size
    works_at: Any
    size: Any


@arranging
def _places(given):
    """Return the record `places`, as an array of one."""
    return records(given.own, 0, 1, _AT)[0]


@arranging
def _starts(given):
    """Return the record as an array."""
    return carray(integers_of(_places(given)), (_N_PLACES,))


@arranging
def _lay(values, work, given):
    """Return the vehicle, its contacts, the place of the turned rail, the size of what carries over, and the total size."""
    resources, at = given.resources, _places(given)[0]
    n_wheels = 2 * at.n_axles
    memory, size = _pair_memory(values, resources, given.own), next_line(_pair_size(values, resources, given.own))
    track, n_track = track_after(resources, 2)
    begun, state, scratch, end = lay_kept(work, at)
    totals, end = matrix(work, end, _N_TOTALS, n_wheels)
    memories, end = matrix(work, end, n_wheels, memory)
    last, end = lay_last(work, end, n_wheels)
    patches, end = records(work, end, MAX_PATCHES * n_wheels, CONTACT)
    sticks, kept = vector(work, end, n_wheels)
    parts, end = arrange(work, kept, begun, state, scratch, track, n_track, given.own, _N_PLACES, at)
    heights, values_at = vector(work, end, at.n_axles)
    of_sides, end = matrix(work, values_at, 2, _N_ITS)
    n_wheel = int(carray(resources, (1,))[0])
    n_rail = int(carray(ahead(resources, 1 + N_PROFILE_ROWS * n_wheel), (1,))[0])
    turned, end = matrix(work, end, N_PROFILE_ROWS, n_rail)
    works_at = next_line(end)
    contacts = Contacts(of_sides, memories, totals, last, patches, sticks, heights, work, values_at, works_at, size)
    return parts, contacts, turned, kept, works_at + 2 * size


@arranging
def _prepare_pairs(v, contacts, given):
    """Fill values and workspaces of both sides; return 0 or the pair's code."""
    for side in range(2):
        values = contacts.values[side]
        for i in range(_N_ITS):
            values[i] = v[i] if i < _N_PARAMETERS else _STARTS[i]
        values[_ITS.side], values[_ITS.load_kind] = _SIDES[side], _POSITION
        code = _pair_prepare(
            ahead(contacts.work, contacts.values_at + side * _N_ITS),
            ahead(contacts.work, contacts.works_at + side * contacts.size),
            given.resources,
            given.own,
        )
        if code > 0:
            return code
    return 0


@arranging
def _of_side(contacts, w):
    """Return pointers to the values and to the workspace of the side of wheel `w`."""
    values_at = contacts.values_at + w % 2 * contacts.values.shape[1]
    return ahead(contacts.work, values_at), ahead(contacts.work, contacts.works_at + w % 2 * contacts.size)


@arranging
def _arrays_of_side(contacts, side, given):
    """Return the arrays of the pair in the workspace of a side."""
    values, work = _of_side(contacts, side)
    return _arrange_pair(carray(values, (_N_ITS,)), work, given)[0]


@arranging
def _solve(contacts, w, given):
    """Solve the contact of wheel `w` for the values of its side; return the pair's code."""
    memory = contacts.memories[w]
    values, work = _of_side(contacts, w)
    its_memory, _ = vector(work, 0, memory.size)
    for i in range(memory.size):
        its_memory[i] = memory[i]
    code = _pair_outputs(values, work, 0.0, given.resources, given.own)
    for i in range(memory.size):
        memory[i] = its_memory[i]
    return code


@arranging
def _begin(v, at, parts, contacts, given):
    """Return 0 or the code of a contact that has no answer."""
    model, speed = parts.model, v[at.speed]
    for w in range(contacts.memories.shape[0]):
        values, axle = contacts.values[w % 2], w // 2
        for i in range(_N_GIVEN):
            values[_ITS.pose_y + i] = 0.0
        values[_ITS.velocity_x], values[_ITS.velocity_spin] = speed, -speed / v[at.wheel_radius]
        values[_ITS.friction_coefficient] = v[at.friction_coefficient]
        values[_ITS.load_kind], values[_ITS.load_normal_force] = _BY_LOAD, model.bodies[model.wheelsets[axle]].load
        code = _solve(contacts, w, given)
        values[_ITS.load_kind] = _POSITION
        if code > _WORST_STATUS:
            return code
        contacts.heights[axle] = 0.5 * values[_ITS.wheelset_z] + (contacts.heights[axle] if w % 2 == 1 else 0.0)
    contacts.memories[:] = 0.0
    motion.place(model, parts.state, parts.motions, contacts.heights, v[at.initial_distance], speed)
    parts.begun[0] = 1.0
    return 0


@arranging
def _n_patches(wheel):
    """Return the number of patches of a wheel. A host can write anything into a state."""
    return int(wheel.patches) if 0.0 < wheel.patches <= MAX_PATCHES else 0


@arranging
def _follow(v, starts, parts, contacts, w, arrays, h, given):
    """Fill the forces of wheel `w` as `wheels.follow_wheel`; return its status or the code of a failure.

    With h = 0 its contact is solved. `arrays` are those of its side.
    """
    last, wheel, values = contacts.last, parts.scratch.wheels[w], contacts.values[w % 2]
    patches = contacts.patches[w * MAX_PATCHES : (w + 1) * MAX_PATCHES]
    asked, here, paced = parts.scratch.given[w], parts.scratch.seats[w], last.limits[0] > 1.0 and h > 0.0
    near, n_before, counted = False, _n_patches(wheel), h
    if paced:
        near = expect(last, w, asked, here.friction, arrays, patches, contacts.sticks[w], n_before)
        if near and take_expected(last, w, h, wheel):
            return int(wheel.status) if 0.0 <= wheel.status <= _WORST_STATUS else 0
        counted = count_around(last, w, h)
    numbers = carray(numbers_of(parts.scratch.given[w : w + 1]), (_N_GIVEN,))
    for i in range(_N_GIVEN):
        values[_ITS.pose_y + i] = numbers[i]
    values[_ITS.friction_coefficient], values[_ITS.friction_kinetic] = here.friction, here.kinetic
    code = _solve(contacts, w, given)
    if code > _WORST_STATUS:
        return code
    n = int(arrays.total[0].n_patches)
    report_wheel(arrays, n, wheel)
    if paced:
        keep_solution(last, w, asked, wheel, near and n == n_before)
        for k in range(MAX_PATCHES):
            patches[k] = arrays.contacts[k]
        contacts.sticks[w] = share_of_stick(arrays.total[0])
    for i in range(_COPIED.shape[0]):
        v[starts[_COPIED[i, 1]] + w] = values[_COPIED[i, 0]]
    for i in range(_RATES.shape[0]):
        contacts.totals[_RATES[i, 0], w] += counted * abs(asked.vx) * values[_RATES[i, 1]]
    return code


@arranging
def _press(v, parts, contacts, right, left, h, given):
    """Fill the forces of all wheels, add up their totals over `h` [s]; return the worst status or the code of a failure.

    `right` and `left` are the arrays of both sides.
    """
    worst, starts = 0, _starts(given)
    for w in range(contacts.memories.shape[0]):
        code = _follow(v, starts, parts, contacts, w, left if w % 2 == 1 else right, h, given)
        if code > _WORST_STATUS:
            return code
        worst = max(worst, code)
        wheel, speed = parts.scratch.wheels[w], abs(parts.scratch.given[w].vx)
        contacts.totals[_ENERGY, w] += h * max(speed, parts.motions[w].slowest) * wheel.dissipation
        contacts.totals[_T_GAMMA, w] += h * speed * wheel.T_gamma
    return worst


@arranging
def _advance(v, at, parts, contacts, h, given):
    """Advance by `h` [s] in even steps; return a status or the number of a failure."""
    model, state, scratch, motions, speed = parts.model, parts.state, parts.scratch, parts.motions, v[at.speed]
    steps = max(math.ceil(min(h / v[at.resolution_step], 1e9) - 1e-6), 1)
    step, code = h / steps, 0
    right = _arrays_of_side(contacts, 0, given)
    left = _arrays_of_side(contacts, 1, given)
    for _ in range(steps):
        if motion.has_ended(parts.model, parts.state):
            return Failure.ENDED
        motion.prepare_contacts(model, state, motions, scratch, speed)
        code = _press(v, parts, contacts, right, left, step, given)
        if code > _WORST_STATUS:
            return code
        if h > 0.0:
            motion.move(model, state, motions, scratch, step, speed)
        if not motion.is_near_track(parts.state):
            return Failure.LOST
    return code


@arranging
def _report(v, at, parts, contacts, total_at):
    write_motion(v, at.distance, at.body_x, parts)
    books = parts.state.books
    v[at.energy_dissipated], v[at.energy_residual] = books[Book.DISSIPATED], books[Book.RESIDUAL]
    v[at.impacts], v[at.lifted] = books[Book.IMPACTS], books[Book.LIFTED]
    for w in range(2 * at.n_axles):
        wheel = parts.scratch.wheels[w]
        v[at.wheel_force_x + w], v[at.wheel_force_y + w] = wheel.longitudinal, wheel.lateral
        v[at.wheel_force_z + w] = -wheel.vertical
        # what the last solution gave for these is that of its step
        v[at.wheel_Q + w], v[at.wheel_Y + w] = wheel.vertical, wheel.lateral if w % 2 == 1 else -wheel.lateral
        v[at.wheel_Y_over_Q + w] = v[at.wheel_Y + w] / wheel.vertical if wheel.vertical > 0.0 else 0.0
        v[at.wheel_damage_T_gamma + w] = wheel.T_gamma
        for i in range(_N_TOTALS):
            v[total_at + 2 * at.n_axles * i + w] = contacts.totals[i, w]


def model_memory(values, given):
    return _lay(values, values, given)[3]


def model_size(values, given):
    return _lay(values, values, given)[4]


def model_prepare(values, work, given):
    at = _places(given)[0]
    v = carray(values, (at.n_values,))
    parts, contacts, turned, _, _ = _lay(values, work, given)
    code = _prepare_pairs(v, contacts, given)
    if code > 0:
        return code
    at_rail = 2 + N_PROFILE_ROWS * int(carray(given.resources, (1,))[0])
    turn(carray(ahead(given.resources, at_rail), turned.shape), -math.atan(v[at.rail_inclination]), turned)
    origin_y, origin_z, _ = rail_origin(turned, v[at.track_gauge], v[at.track_gauge_point])
    fill(parts, origin_y, origin_z, v[at.reference_speed])
    return 0


def model_outputs(values, work, h, given):
    at = _places(given)[0]
    v = carray(values, (at.n_values,))
    parts, contacts, _, _, _ = _lay(values, work, given)
    parts.model.surface[0], parts.model.surface[1] = v[at.friction_coefficient], v[at.friction_kinetic]
    contacts.last.limits[0], contacts.last.limits[1] = v[at.resolution_pace], TOLERANCE
    for w in range(contacts.memories.shape[0]):
        contacts.last.loads[w] = parts.model.bodies[parts.model.wheelsets[w // 2]].load
    if parts.begun[0] == 0.0:
        code = _begin(v, at, parts, contacts, given)
        if code > _WORST_STATUS:
            return code
    code = _advance(v, at, parts, contacts, h, given)
    if code <= _WORST_STATUS:
        _report(v, at, parts, contacts, _starts(given)[_TOTAL_AT])
    return code


def model_difference(values, reference, given):
    return 1e-6


def entries() -> dict[str, Any]:
    """Return the functions of this kind (`kinds`), for vehicles of any size."""
    called_by_c = (model_memory, model_size, model_prepare, model_outputs, model_difference)
    return {function.__name__: function for function in called_by_c}
