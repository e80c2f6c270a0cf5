"""Native Vehicle: `models.vehicle.kernels` between the entries of the native WheelRailPair, with whose objects it is linked.

The parameters of the pair have the same value references in both FMUs. There is one workspace of the pair for each side; what
a wheel's contact remembers is copied into it before the wheel is solved.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numba import carray, types

from contact import Status
from contact.kernels.block import ahead, matrix, next_line, vector
from contact.kernels.geometry.prepare import rail_origin, turn
from contact.kernels.records import GIVEN
from contact.kernels.rows import N_PROFILE_ROWS
from fmu_src.native import wheel_rail_pair as pair
from fmu_src.native.component import SIGNATURES, Component, Resource
from fmu_src.native.memory import Doubles, compiled, numbers_of
from fmu_src.native.vehicle_parts import ENDED, LOST, arrays, has_ended, is_finite, layout_of, track_after, write_motion
from fmu_src.native.wires import references
from fmu_src.tables import wheel_rail_pair as pair_table
from fmu_src.tables.vehicle import TOTALS, TRACK, WHEEL, table
from fmu_src.track import MAGIC, ROWS
from fmu_src.variables import Causality, Table
from models.vehicle.assembly import Assembly
from models.vehicle.kernels import motion
from models.vehicle.kernels.layout import ELASTIC, Book


def _entry_of_pair(name: str) -> Any:
    """Return an entry of the native WheelRailPair as a function that kernels call."""
    result, arguments = SIGNATURES[name]
    return types.ExternalFunction(name, result(*arguments, Doubles))


_pair_memory, _pair_size = _entry_of_pair("model_memory"), _entry_of_pair("model_size")
_pair_prepare, _pair_outputs = _entry_of_pair("model_prepare"), _entry_of_pair("model_outputs")
_N_TOTALS, _N_GIVEN = len(TOTALS), GIVEN.itemsize // 8
_POSITION, _BY_LOAD = (pair_table.LOAD_KIND.number(name) for name in ("Position", "NormalForce"))
_WORST_STATUS = max(int(status) for status in Status)


def component(vehicle: str, inclination: float) -> Component:
    """Return the FMU of a vehicle. `inclination` is the default of `rail.inclination` (tangent)."""
    interface, (made, constants), of_pair = table(vehicle, inclination), arrays(vehicle), pair.component(inclination)
    ended = max(of_pair.failures) + 1
    return Component(
        table=interface,
        entries=lambda: _entries(interface, of_pair.table, made, ended),
        data=lambda: (*constants, np.array([scalar.first for scalar in of_pair.table.scalars], float)),
        resources=(*of_pair.resources, Resource(TRACK, MAGIC, ROWS)),
        warnings=of_pair.warnings,
        failures={**of_pair.failures, ended: ENDED, ended + 1: f"{LOST}: resolution.step is too long"},
        prefix="vehicle",
        exchange=False,
    )


class Contacts(NamedTuple):
    """What solves the contacts: the pair's values and workspace for each side, and what the contact of each wheel remembers."""

    values: Any  # shape (2, values)
    memories: Any  # shape (wheels, size of a memory)
    totals: Any  # shape (totals, wheels)
    heights: Any  # of the wheelsets at the start
    work: Any  # pointer to all working memory
    values_at: Any  # place of the values in it, of the workspaces, and their size
    works_at: Any
    size: Any


class Wires(NamedTuple):
    """Value references: of the vehicle and of the pair, of what is copied from the pair, and of the rates of the totals."""

    at: Any
    its: Any
    copied: Any  # shape (outputs, 2): of the pair, and of the first wheel
    rates: Any  # shape (totals, 2)
    alone: Any  # whether a total has one rate, not the product of two


def _wires(interface: Table, of_pair: Table) -> Wires:
    copied = [(of_pair.span[name].start, interface.span[row].start) for row, name in WHEEL.items()]
    rates = [[of_pair.span[rate].start for rate in (*rates, *rates)][:2] for _, _, rates in TOTALS.values()]
    return Wires(
        references(interface),
        references(of_pair),
        np.array(copied),
        np.array(rates),
        np.array([len(r) == 1 for _, _, r in TOTALS.values()]),
    )


def _layer(made: Assembly, n_its: int) -> Callable[..., Any]:
    """Return a compiled function that lays out the memory; the pair has `n_its` values."""
    layout, n_axles = layout_of(made), made.wheelsets.size
    arrange, kept, n_wheels = layout.arrange, layout.kept, 2 * n_axles

    @compiled
    def lay(values, work, given):
        """Return the vehicle, its contacts, the place of the turned rail and the total size in numbers."""
        resources = given.resources
        memory, size = _pair_memory(values, resources), next_line(_pair_size(values, resources))
        track, n_track = track_after(resources, 2)
        totals, end = matrix(work, kept, _N_TOTALS, n_wheels)
        memories, end = matrix(work, end, n_wheels, memory)
        parts, end = arrange(work, end, track, n_track, given.data)
        heights, values_at = vector(work, end, n_axles)
        of_sides, end = matrix(work, values_at, 2, n_its)
        n_wheel = int(carray(resources, (1,))[0])
        n_rail = int(carray(ahead(resources, 1 + N_PROFILE_ROWS * n_wheel), (1,))[0])
        turned, end = matrix(work, end, N_PROFILE_ROWS, n_rail)
        works_at = next_line(end)
        contacts = Contacts(of_sides, memories, totals, heights, work, values_at, works_at, size)
        return parts, contacts, turned, works_at + 2 * size

    return lay


def _preparer(its: Any, n_its: int, n_parameters: int) -> Callable[..., Any]:
    """Return a compiled function that prepares the pair of each side. `its` are the pair's value references."""
    sides = np.array([pair_table.SIDE.number(name) for name in ("Right", "Left")], float)

    @compiled
    def prepare_pairs(v, contacts, given):
        """Fill values and workspaces of both sides; return 0 or the pair's code."""
        start = carray(given.data[-1], (n_its,))
        for side in range(2):
            values = contacts.values[side]
            for i in range(n_its):
                values[i] = v[i] if i < n_parameters else start[i]
            values[its.side], values[its.load_kind] = sides[side], _POSITION
            code = _pair_prepare(
                ahead(contacts.work, contacts.values_at + side * n_its),
                ahead(contacts.work, contacts.works_at + side * contacts.size),
                given.resources,
            )
            if code > 0:
                return code
        return 0

    return prepare_pairs


@compiled
def _solve(contacts, w, resources):
    """Solve the contact of wheel `w` for the values of its side; return the pair's code."""
    side, memory = w % 2, contacts.memories[w]
    values_at = contacts.values_at + side * contacts.values.shape[1]
    work_at = contacts.works_at + side * contacts.size
    its_memory, _ = vector(contacts.work, work_at, memory.size)
    for i in range(memory.size):
        its_memory[i] = memory[i]
    code = _pair_outputs(ahead(contacts.work, values_at), ahead(contacts.work, work_at), 0.0, resources)
    for i in range(memory.size):
        memory[i] = its_memory[i]
    return code


def _placer(at: Any, its: Any) -> Callable[..., Any]:
    """Return a compiled function that places the vehicle on its rails."""

    @compiled
    def begin(v, parts, contacts, resources):
        """Return 0 or the code of a contact that has no answer."""
        model, speed = parts.model, v[at.speed]
        for w in range(contacts.memories.shape[0]):
            values, axle = contacts.values[w % 2], w // 2
            for i in range(_N_GIVEN):
                values[its.pose_y + i] = 0.0
            values[its.velocity_x], values[its.velocity_spin] = speed, -speed / v[at.wheel_radius]
            values[its.friction_coefficient] = v[at.friction_coefficient]
            values[its.load_kind], values[its.load_normal_force] = _BY_LOAD, model.bodies[model.wheelsets[axle]].load
            code = _solve(contacts, w, resources)
            values[its.load_kind] = _POSITION
            if code > _WORST_STATUS:
                return code
            contacts.heights[axle] = 0.5 * values[its.wheelset_z] + (contacts.heights[axle] if w % 2 == 1 else 0.0)
        contacts.memories[:] = 0.0
        motion.place(model, parts.state, parts.motions, contacts.heights, v[at.initial_distance], speed)
        parts.begun[0] = 1.0
        return 0

    return begin


def _taker(its: Any, copied: Any) -> Callable[..., Any]:
    """Return a compiled function that takes over what the pair has found for a wheel."""

    @compiled
    def take(v, values, wheel, w):
        """Enter what the contact of wheel `w` does to the vehicle, and write its outputs."""
        wheel.longitudinal, wheel.lateral = values[its.force_x], values[its.force_y]
        wheel.vertical = -values[its.force_z]
        wheel.moment_x, wheel.moment_y = values[its.moment_x], values[its.moment_y]
        wheel.moment_z, wheel.T_gamma = values[its.moment_z], values[its.damage_T_gamma]
        wheel.status = values[its.status]
        wheel.normal, wheel.dissipation, wheel.elastic = 0.0, 0.0, 0.0
        for k in range(int(values[its.patches_count])):
            n = values[its.patch_n + k]
            wheel.normal += n
            wheel.elastic += ELASTIC * n * values[its.patch_approach + k]
            wheel.dissipation -= (
                values[its.patch_fx + k] * values[its.patch_longitudinal + k]
                + values[its.patch_fy + k] * values[its.patch_lateral + k]
                + values[its.patch_mz + k] * values[its.patch_spin + k]
            )
        for i in range(copied.shape[0]):
            v[copied[i, 1] + w] = values[copied[i, 0]]

    return take


def _presser(wires: Wires) -> Callable[..., Any]:
    """Return a compiled function that solves all contacts."""
    its, rates, alone = wires.its, wires.rates, wires.alone
    take = _taker(its, wires.copied)

    @compiled
    def press(v, parts, contacts, h, resources):
        """Solve all contacts, add up their totals over `h` [s]; return the worst status or the code of a failure."""
        worst = 0
        for w in range(contacts.memories.shape[0]):
            values = contacts.values[w % 2]
            numbers = carray(numbers_of(parts.scratch.given[w : w + 1]), (_N_GIVEN,))
            for i in range(_N_GIVEN):
                values[its.pose_y + i] = numbers[i]
            values[its.friction_coefficient] = parts.scratch.seats[w].friction
            code = _solve(contacts, w, resources)
            if code > _WORST_STATUS:
                return code
            worst = max(worst, code)
            take(v, values, parts.scratch.wheels[w], w)
            for i in range(_N_TOTALS):
                rate = values[rates[i, 0]]
                contacts.totals[i, w] += h * (rate if alone[i] else rate * values[rates[i, 1]])
        return worst

    return press


def _advancer(at: Any, press: Callable[..., Any], ended: int) -> Callable[..., Any]:
    """Return a compiled function that moves the vehicle. The failures are numbered from `ended` on."""

    @compiled
    def advance(v, parts, contacts, h, resources):
        """Advance by `h` [s] in even steps; return a status or the number of a failure."""
        model, state, scratch, motions, speed = parts.model, parts.state, parts.scratch, parts.motions, v[at.speed]
        steps = max(math.ceil(min(h / v[at.resolution_step], 1e9) - 1e-6), 1)
        step, code = h / steps, 0
        for _ in range(steps):
            if has_ended(parts):
                return ended
            motion.ask(model, state, motions, scratch, speed)
            code = press(v, parts, contacts, step, resources)
            if code > _WORST_STATUS:
                return code
            if h > 0.0:
                motion.move(model, state, motions, scratch, step, speed)
            if not is_finite(parts):
                return ended + 1
        return code

    return advance


def _reporter(interface: Table, at: Any, n_wheels: int) -> Callable[..., Any]:
    """Return a compiled function that writes the outputs of the vehicle."""
    total_at = interface.span[f"wheel[].total.{next(iter(TOTALS))}"].start

    @compiled
    def report(v, parts, contacts):
        write_motion(v, at.distance, at.body_x, parts)
        books = parts.state.books
        v[at.energy_dissipated], v[at.energy_residual] = books[Book.DISSIPATED], books[Book.RESIDUAL]
        v[at.impacts], v[at.lifted] = books[Book.IMPACTS], books[Book.LIFTED]
        for w in range(n_wheels):
            wheel = parts.scratch.wheels[w]
            v[at.wheel_force_x + w], v[at.wheel_force_y + w] = wheel.longitudinal, wheel.lateral
            v[at.wheel_force_z + w] = -wheel.vertical
            for i in range(_N_TOTALS):
                v[total_at + n_wheels * i + w] = contacts.totals[i, w]

    return report


def _entries(interface: Table, of_pair: Table, made: Assembly, ended: int) -> dict[str, Callable[..., Any]]:
    """Return `Component.entries`. The data are those of `vehicle_parts.arrays`, then the pair's start values."""
    n_parameters = sum(s.row.causality is Causality.PARAMETER for s in of_pair.scalars)
    if [s.name for s in interface.scalars[:n_parameters]] != [s.name for s in of_pair.scalars[:n_parameters]]:
        raise ValueError("the parameters of the pair must come first, with its value references")
    wires, layout = _wires(interface, of_pair), layout_of(made)
    at, its, fill = wires.at, wires.its, layout.fill
    n_values, n_wheels, n_its = (
        len(interface.scalars),
        2 * made.wheelsets.size,
        of_pair.span[pair_table.ACCUMULATED[0]].start,
    )
    kept = layout.kept + _N_TOTALS * n_wheels
    lay, prepare_pairs, begin = _layer(made, n_its), _preparer(its, n_its, n_parameters), _placer(at, its)
    advance, report = _advancer(at, _presser(wires), ended), _reporter(interface, at, n_wheels)

    def model_memory(values, given):
        return kept + n_wheels * _pair_memory(values, given.resources)

    def model_size(values, given):
        return lay(values, values, given)[3]

    def model_prepare(values, work, given):
        v = carray(values, (n_values,))
        parts, contacts, turned, _ = lay(values, work, given)
        code = prepare_pairs(v, contacts, given)
        if code > 0:
            return code
        at_rail = 2 + N_PROFILE_ROWS * int(carray(given.resources, (1,))[0])
        turn(carray(ahead(given.resources, at_rail), turned.shape), -math.atan(v[at.rail_inclination]), turned)
        origin_y, origin_z, _ = rail_origin(turned, v[at.track_gauge], v[at.track_gauge_point])
        fill(parts, given.data, v[at.wheel_radius], origin_y, origin_z)
        return 0

    def model_outputs(values, work, h, given):
        v = carray(values, (n_values,))
        parts, contacts, _, _ = lay(values, work, given)
        parts.model.surface[0], parts.model.surface[1] = v[at.friction_coefficient], v[at.friction_kinetic]
        if parts.begun[0] == 0.0:
            code = begin(v, parts, contacts, given.resources)
            if code > _WORST_STATUS:
                return code
        code = advance(v, parts, contacts, h, given.resources)
        if code <= _WORST_STATUS:
            report(v, parts, contacts)
        return code

    def model_difference(values, reference, given):
        return 1e-6

    called_by_c = (model_memory, model_size, model_prepare, model_outputs, model_difference)
    return {function.__name__: function for function in called_by_c}
