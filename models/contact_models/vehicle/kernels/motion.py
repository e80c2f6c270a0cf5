"""Kernels that advance a vehicle: a leapfrog with implicit rails and spins, and the balance of energy (vehicle.md, 5)."""

from __future__ import annotations

from contact.core import entry, kernel
from contact.kernels.arrays import Motions, Numbers, Search
from .elements import pull
from .frames import carried, drift, gyrate, lay_frames, speed_at
from .layout import BEYOND, FARTHEST, Axis, Body, Book, Model, Scratch, State, TrackFrame, TrackRow
from .wheel_arrays import WheelArrays
from .wheels import add_wheel_forces, advance_rails, count, fill_inputs, rail_energy, solve_contacts

#: A normal force above this multiple of the static one is an impact.
_IMPACT = 2.0
#: A little above Kalker's longitudinal coefficient [N] of a wheel under this load [N] (docs/check/coupling.md).
_CREEP, _UNDER = 12e6, 54.5e3
#: Largest share of a difference of slip that ends in half a step for which creep is implicit.
_MOST_IMPLICIT = 1.0


@kernel
def _inertia(body, j):
    return body.mass if j < 3 else body.inertia[j - 3]


@kernel
def _hold(model, state, speed, scratch, h):
    """Set the velocities of held coordinates; return the work of what holds them over the last step [J]."""
    work = 0.0
    for i in range(model.bodies.size):
        body = model.bodies[i]
        for j in range(6):
            if body.held[j] != 0:
                before = state.u[i, j]
                now = carried(scratch.frames[i], body, state.q[i], speed, j)
                work += 0.5 * (now + before) * (_inertia(body, j) * (now - before) - h * scratch.forces[i, j])
                state.u[i, j] = now
    return work


@kernel
def _load(model, state, motions, h, scratch):
    """Fill the generalised forces of all bodies at the present state, with those of the contacts."""
    scratch.forces[:] = 0.0
    scratch.power[:] = 0.0
    gyrate(scratch.frames, model.bodies, state.u, scratch.forces)
    pull(model, state, h, scratch)
    for i in range(model.bodies.size):
        body, frame = model.bodies[i], scratch.frames[i]
        scratch.forces[i, Axis.Y] += body.mass * 9.81 * frame[TrackFrame.SIN_CANT]
        scratch.forces[i, Axis.Z] += body.mass * 9.81 * frame[TrackFrame.COS_CANT]
        if body.wheelset != 0:
            scratch.forces[i, Axis.PITCH] -= body.torque
    add_wheel_forces(model, state, motions, scratch)


@kernel
def kinetic_energy(model, state):
    """Return the kinetic energy of all bodies [J]."""
    energy = 0.0
    for i in range(model.bodies.size):
        for j in range(6):
            energy += 0.5 * _inertia(model.bodies[i], j) * state.u[i, j] ** 2
    return energy


@kernel
def _weigh(model, state, elastic, work, books):
    """Enter the stored energy half a step before the present positions, and what the balance has lost so far."""
    in_rails, _ = rail_energy(model, state)
    stored = kinetic_energy(model, state) + in_rails + 0.5 * (elastic + books[Book.ELASTIC])
    books[Book.ELASTIC] = elastic
    books[Book.DRIVE] += work
    if books[Book.STEPS] < 2.0:  # the first step has no elastic energy before it
        books[Book.STORED_FIRST] = stored
        books[Book.WEIGHT], books[Book.DRIVE], books[Book.TORQUE], books[Book.DAMPER] = 0.0, 0.0, 0.0, 0.0
        books[Book.DISSIPATED] = 0.0
    books[Book.STORED] = stored
    gained = books[Book.WEIGHT] + books[Book.DRIVE] + books[Book.TORQUE]
    spent = books[Book.DAMPER] + books[Book.DISSIPATED]
    books[Book.RESIDUAL] = gained - spent - (stored - books[Book.STORED_FIRST])


@kernel
def _kick(model, state, scratch, h):
    """Advance the velocities by `h` [s] and enter the works of gravity and torques, with the mean velocity."""
    books = state.books
    for i in range(model.bodies.size):
        body, frame = model.bodies[i], scratch.frames[i]
        for j in range(6):
            before = state.u[i, j]
            if body.held[j] == 0:
                state.u[i, j] += h * scratch.forces[i, j] / _inertia(body, j)
            mean = 0.5 * (before + state.u[i, j])
            if j == Axis.Y:
                books[Book.WEIGHT] += h * body.mass * 9.81 * frame[TrackFrame.SIN_CANT] * mean
            elif j == Axis.Z:
                books[Book.WEIGHT] += h * body.mass * 9.81 * frame[TrackFrame.COS_CANT] * mean
            elif j == Axis.PITCH and body.wheelset != 0:
                books[Book.TORQUE] -= h * body.torque * mean


@entry
def spin_rate(body: Body, radius: float, speed: float) -> float:
    """Return half the rate at which creep ends a difference of the spin of a wheelset from rolling [1/s], f r²/(I V)."""
    return _CREEP * (body.load / _UNDER) ** (2.0 / 3.0) * radius * radius / (body.inertia[1] * speed)


@kernel
def _steady(model, state, motions, scratch, h):
    """Make longitudinal creep implicit, and keep by how much the velocities of the wheelsets grow.

    The contacts were solved for velocities that grow as in the last step. Where the slip of an axle grows otherwise, a
    longitudinal force at its wheels, with the stiffness of creep, answers the difference.
    """
    for axle in range(model.wheelsets.size):
        i = model.wheelsets[axle]
        body, gain, forces, radius = model.bodies[i], state.gains[axle], scratch.forces[i], motions[2 * axle].radius
        if body.held[Axis.PITCH] == 0:
            inverse, grown = radius * radius / body.inertia[1], radius * forces[Axis.PITCH] / body.inertia[1]
            expected = radius * gain[Axis.PITCH]
            if body.held[Axis.X] == 0:
                inverse += 1.0 / body.mass
                grown += forces[Axis.X] / body.mass
                expected += gain[Axis.X]
            speed = max(abs(state.u[i, Axis.X]), motions[2 * axle].slowest)
            rate = spin_rate(body, radius, speed) * inverse * body.inertia[1] / (radius * radius)
            share = min(h * rate, _MOST_IMPLICIT)
            answer = -share / (1.0 + share) * (h * grown - expected) / (h * inverse)
            forces[Axis.X] += answer
            forces[Axis.PITCH] += radius * answer
        for j in range(6):
            gain[j] = h * forces[j] / _inertia(body, j) if body.held[j] == 0 else 0.0


@entry
def place(model: Model, state: State, motions: Motions, heights: Numbers, start: float, speed: float) -> None:
    """Put the vehicle, all of whose state is zero, at rest in its nominal place at `start` [m], rolling at `speed` [m/s].

    `heights` are the coordinates z of its wheelsets [m].
    """
    state.books[Book.DISTANCE] = start
    for i in range(model.bodies.size):
        state.u[i, Axis.X] = speed
    for axle in range(model.wheelsets.size):
        i = model.wheelsets[axle]
        state.loads[axle, 0], state.loads[axle, 1] = model.bodies[i].load, model.bodies[i].load
        state.q[i, Axis.Z] = heights[axle]
        state.u[i, Axis.PITCH] = -speed / motions[2 * axle].radius


@entry
def has_ended(model: Model, state: State) -> bool:
    """Return whether the vehicle has reached the end of the track, or has no finite place."""
    s, places = state.books[Book.DISTANCE], model.track[TrackRow.PLACE]
    return not places[0] <= s <= places[-1] - BEYOND


@entry
def is_near_track(state: State) -> bool:
    """Return whether all bodies are within `FARTHEST` of their places, with finite velocities."""
    q, total = state.q, state.q.sum() + state.u.sum() + state.rails.sum()
    farthest = 0.0
    for i in range(q.shape[0]):
        for j in (Axis.Y, Axis.Z, Axis.ROLL, Axis.YAW):
            farthest = max(farthest, abs(q[i, j]))
    return farthest <= FARTHEST and total - total == 0.0


@entry
def prepare_contacts(model: Model, state: State, motions: Motions, scratch: Scratch, speed: float) -> None:
    """Fill the frames and the inputs of every contact at the present state (`scratch.given`, `scratch.seats`)."""
    s = state.books[Book.DISTANCE]
    lay_frames(model, s, speed, scratch.frames)
    fill_inputs(model, state, s, motions, scratch)


@entry
def move(model: Model, state: State, motions: Motions, scratch: Scratch, h: float, speed: float) -> None:
    """Advance by `h` [s] after `prepare_contacts`, with the forces of the contacts in `scratch.wheels`."""
    books = state.books
    work = _hold(model, state, speed, scratch, h)
    _load(model, state, motions, h, scratch)
    count(model, state, scratch.wheels, _IMPACT)
    _, in_rails = rail_energy(model, state)
    _weigh(model, state, scratch.power[2] + in_rails, work, books)
    books[Book.DAMPER] += h * scratch.power[0]
    books[Book.DISSIPATED] += h * scratch.power[1]
    _steady(model, state, motions, scratch, h)
    _kick(model, state, scratch, h)
    drift(scratch.frames, model.bodies, state.q, state.u, speed, h)
    books[Book.DAMPER] += advance_rails(model, state, scratch.wheels, h)
    books[Book.DISTANCE] += h * speed
    books[Book.TIME] += h
    books[Book.STEPS] += 1.0


@kernel
def step(model, state, wheel_arrays, scratch, h):
    """Advance by `h` [s]; return 0 or the code of `solve_contacts`. Forces in `scratch` are those before the step."""
    speed = speed_at(model.track, state.books[Book.DISTANCE])
    prepare_contacts(model, state, wheel_arrays.motions, scratch, speed)
    failed = solve_contacts(wheel_arrays, scratch)
    if failed < 0:
        return failed
    move(model, state, wheel_arrays.motions, scratch, h, speed)
    return 0


@entry
def advance(
    model: Model, state: State, wheel_arrays: WheelArrays[Search], scratch: Scratch, h: float, steps: int
) -> int:
    """Advance by `steps` steps of `h` [s]; return 0 or the code of `solve_contacts` at the step that failed."""
    for _ in range(steps):
        failed = step(model, state, wheel_arrays, scratch, h)
        if failed < 0:
            return failed
    return 0
