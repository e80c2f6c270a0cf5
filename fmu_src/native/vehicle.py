"""Native Vehicle: `models.vehicle.kernels` between the entries of the native WheelRailPair, with whose objects it is linked.

The parameters of the pair have the same value references in both FMUs. There is one workspace of the pair for each side; what
a wheel's contact remembers is copied into it before the wheel is solved.
"""

from __future__ import annotations

import math
from collections import namedtuple
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
from fmu_src.tables import wheel_rail_pair as pair_table
from fmu_src.tables.vehicle import TOTALS, TRACK, WHEEL, table
from fmu_src.track import MAGIC, ROWS
from fmu_src.variables import Causality, Table, identifier
from models.vehicle.assembly import Assembly
from models.vehicle.kernels import motion
from models.vehicle.kernels.layout import ELASTIC, Book


def _entry_of_pair(name: str) -> Any:
    """Return an entry of the native WheelRailPair as a function that kernels call."""
    result, arguments = SIGNATURES[name]
    return types.ExternalFunction(name, result(*arguments, Doubles))


_pair_memory, _pair_size = _entry_of_pair("model_memory"), _entry_of_pair("model_size")
_pair_prepare, _pair_outputs = _entry_of_pair("model_prepare"), _entry_of_pair("model_outputs")
_N_TOTALS = len(TOTALS)


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
    at, its = (
        namedtuple("References", [identifier(name) for name in table.span])(*(s.start for s in table.span.values()))
        for table in (interface, of_pair)
    )
    copied = [(of_pair.span[name].start, interface.span[row].start) for row, name in WHEEL.items()]
    rates = [[of_pair.span[rate].start for rate in (*rates, *rates)][:2] for _, _, rates in TOTALS.values()]
    return Wires(at, its, np.array(copied), np.array(rates), np.array([len(r) == 1 for _, _, r in TOTALS.values()]))


class Functions(NamedTuple):
    """Compiled functions of the contacts."""

    lay: Callable[..., Any]
    fill: Callable[..., Any]
    begin: Callable[..., Any]
    press: Callable[..., Any]


def _functions(wires: Wires, of_pair: Table, made: Assembly) -> Functions:
    at, its, copied, rates, alone = wires
    layout = layout_of(made)
    arrange, kept = layout.arrange, layout.kept
    n_its = of_pair.span[pair_table.ACCUMULATED[0]].start
    n_parameters = sum(s.row.causality is Causality.PARAMETER for s in of_pair.scalars)
    n_axles, n_given = made.wheelsets.size, GIVEN.itemsize // 8
    n_wheels = 2 * n_axles
    position, by_load = (pair_table.LOAD_KIND.number(name) for name in ("Position", "NormalForce"))
    sides = np.array([pair_table.SIDE.number(name) for name in ("Right", "Left")], float)
    worst_status = max(int(status) for status in Status)

    @compiled
    def lay(values, work, resources, constants):
        """Return the vehicle, its contacts, the place of the turned rail and the total size in numbers."""
        memory, size = _pair_memory(values, resources), next_line(_pair_size(values, resources))
        track, n_track = track_after(resources, 2)
        totals, end = matrix(work, kept, _N_TOTALS, n_wheels)
        memories, end = matrix(work, end, n_wheels, memory)
        parts, end = arrange(work, end, track, n_track, constants)
        heights, values_at = vector(work, end, n_axles)
        of_sides, end = matrix(work, values_at, 2, n_its)
        n_wheel = int(carray(resources, (1,))[0])
        n_rail = int(carray(ahead(resources, 1 + N_PROFILE_ROWS * n_wheel), (1,))[0])
        turned, end = matrix(work, end, N_PROFILE_ROWS, n_rail)
        works_at = next_line(end)
        contacts = Contacts(of_sides, memories, totals, heights, work, values_at, works_at, size)
        return parts, contacts, turned, works_at + 2 * size

    @compiled
    def prepare_pairs(v, contacts, first, resources):
        """Fill values and workspaces of both sides; return 0 or the pair's code."""
        start = carray(first, (n_its,))
        for side in range(2):
            values = contacts.values[side]
            for i in range(n_its):
                values[i] = v[i] if i < n_parameters else start[i]
            values[its.side], values[its.load_kind] = sides[side], position
            code = _pair_prepare(
                ahead(contacts.work, contacts.values_at + side * n_its),
                ahead(contacts.work, contacts.works_at + side * contacts.size),
                resources,
            )
            if code > 0:
                return code
        return 0

    @compiled
    def solve(contacts, w, resources):
        """Solve the contact of wheel `w` for the values of its side; return the pair's code."""
        side, memory = w % 2, contacts.memories[w]
        work_at = contacts.works_at + side * contacts.size
        its_memory, _ = vector(contacts.work, work_at, memory.size)
        for i in range(memory.size):
            its_memory[i] = memory[i]
        code = _pair_outputs(
            ahead(contacts.work, contacts.values_at + side * n_its), ahead(contacts.work, work_at), 0.0, resources
        )
        for i in range(memory.size):
            memory[i] = its_memory[i]
        return code

    @compiled
    def begin(v, parts, contacts, resources):
        """Place the vehicle on its rails; return 0 or the code of a contact that has no answer."""
        model, speed = parts.model, v[at.speed]
        for w in range(n_wheels):
            values, axle = contacts.values[w % 2], w // 2
            for i in range(n_given):
                values[its.pose_y + i] = 0.0
            values[its.velocity_x], values[its.velocity_spin] = speed, -speed / v[at.wheel_radius]
            values[its.friction_coefficient] = v[at.friction_coefficient]
            values[its.load_kind], values[its.load_normal_force] = by_load, model.bodies[model.wheelsets[axle]].load
            code = solve(contacts, w, resources)
            values[its.load_kind] = position
            if code > worst_status:
                return code
            contacts.heights[axle] = 0.5 * values[its.wheelset_z] + (contacts.heights[axle] if w % 2 == 1 else 0.0)
        contacts.memories[:] = 0.0
        motion.place(model, parts.state, parts.motions, contacts.heights, v[at.initial_distance], speed)
        parts.begun[0] = 1.0
        return 0

    @compiled
    def take(v, values, wheel, w):
        """Enter what the contact of wheel `w` does to the vehicle, and write its outputs."""
        wheel.longitudinal, wheel.lateral, wheel.vertical = (
            values[its.force_x],
            values[its.force_y],
            -values[its.force_z],
        )
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

    @compiled
    def press(v, parts, contacts, h, resources):
        """Solve all contacts, add up their totals over `h` [s]; return the worst status or the code of a failure."""
        worst = 0
        for w in range(n_wheels):
            values = contacts.values[w % 2]
            numbers = carray(numbers_of(parts.scratch.given[w : w + 1]), (n_given,))
            for i in range(n_given):
                values[its.pose_y + i] = numbers[i]
            values[its.friction_coefficient] = parts.scratch.seats[w].friction
            code = solve(contacts, w, resources)
            if code > worst_status:
                return code
            worst = max(worst, code)
            take(v, values, parts.scratch.wheels[w], w)
            for i in range(_N_TOTALS):
                rate = values[rates[i, 0]]
                contacts.totals[i, w] += h * (rate if alone[i] else rate * values[rates[i, 1]])
        return worst

    return Functions(lay, prepare_pairs, begin, press)


def _entries(interface: Table, of_pair: Table, made: Assembly, ended: int) -> dict[str, Callable[..., Any]]:
    """Return `Component.entries`. The data arguments are those of `vehicle_parts.arrays`, and the pair's start values."""
    n_parameters = sum(s.row.causality is Causality.PARAMETER for s in of_pair.scalars)
    if [s.name for s in interface.scalars[:n_parameters]] != [s.name for s in of_pair.scalars[:n_parameters]]:
        raise ValueError("the parameters of the pair must come first, with its value references")
    wires, layout = _wires(interface, of_pair), layout_of(made)
    lay, prepare_pairs, begin, press = _functions(wires, of_pair, made)
    at, fill = wires.at, layout.fill
    n_values, n_wheels = len(interface.scalars), 2 * made.wheelsets.size
    kept = layout.kept + _N_TOTALS * n_wheels
    total_at = interface.span[f"wheel[].total.{next(iter(TOTALS))}"].start
    worst_status = max(int(status) for status in Status)

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
            if code > worst_status:
                return code
            if h > 0.0:
                motion.move(model, state, motions, scratch, step, speed)
            if not is_finite(parts):
                return ended + 1
        return code

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

    def model_memory(values, resources, bodies, links, elements, table, wheelsets, rail, first):
        return kept + n_wheels * _pair_memory(values, resources)

    def model_size(values, resources, bodies, links, elements, table, wheelsets, rail, first):
        return lay(values, values, resources, (bodies, links, elements, table, wheelsets, rail))[3]

    def model_prepare(values, work, resources, bodies, links, elements, table, wheelsets, rail, first):
        v = carray(values, (n_values,))
        constants = (bodies, links, elements, table, wheelsets, rail)
        parts, contacts, turned, _ = lay(values, work, resources, constants)
        code = prepare_pairs(v, contacts, first, resources)
        if code > 0:
            return code
        at_rail = 2 + N_PROFILE_ROWS * int(carray(resources, (1,))[0])
        turn(carray(ahead(resources, at_rail), turned.shape), -math.atan(v[at.rail_inclination]), turned)
        origin_y, origin_z, _ = rail_origin(turned, v[at.track_gauge], v[at.track_gauge_point])
        fill(parts, links, v[at.wheel_radius], origin_y, origin_z)
        return 0

    def model_start(values, work, resources, bodies, links, elements, table, wheelsets, rail, first):
        return 0

    def model_outputs(values, work, h, resources, bodies, links, elements, table, wheelsets, rail, first):
        v = carray(values, (n_values,))
        constants = (bodies, links, elements, table, wheelsets, rail)
        parts, contacts, _, _ = lay(values, work, resources, constants)
        parts.model.surface[0], parts.model.surface[1] = v[at.friction_coefficient], v[at.friction_kinetic]
        if parts.begun[0] == 0.0:
            code = begin(v, parts, contacts, resources)
            if code > worst_status:
                return code
        code = advance(v, parts, contacts, h, resources)
        if code <= worst_status:
            report(v, parts, contacts)
        return code

    def model_lazy(values, work, resources, bodies, links, elements, table, wheelsets, rail, first):
        return 0

    def model_difference(values, reference, resources, bodies, links, elements, table, wheelsets, rail, first):
        return 1e-6

    def model_field(values, work, k, resources, bodies, links, elements, table, wheelsets, rail, first):
        return 0

    called_by_c = (
        model_memory, model_size, model_prepare, model_start, model_outputs, model_lazy, model_difference, model_field
    )  # fmt: skip
    return {function.__name__: function for function in called_by_c}
