"""Linear behaviour of a vehicle: frequencies, damping and the linear critical speed, from its own kernels.

A step of 1 µs from a displaced state gives the accelerations there, so the state matrix is that of the simulated vehicle. Its
contacts are solved once. At the displaced states their forces follow from the derivatives of that solution
(`contact.kernels.pair_jacobian`), or, with an amplitude, from a solution of each state.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array, brief
from contact.core import pack
from contact.errors import ContactError
from .kernels import motion
from .kernels.frames import speed_at
from .kernels.layout import Axis, Model, Scratch, State
from .simulation import Simulation

_INSTANT = 1e-6  # step from which the accelerations are taken [s]
#: Displacement at which the rest is linear but for round-off [m], [rad], [m/s], [rad/s].
_SMALL = 1e-4
#: Members of WHEEL: force and moment.
_LOADS = ("longitudinal", "lateral", "vertical", "moment_x", "moment_y", "moment_z")
#: Growth that may be noise of the differences [1/s]: slow motions of a wheelset with soft springs decay with 0.003 to 0.01 1/s.
NOISE = 0.02


@dataclass(frozen=True, eq=False)
class Mode:
    """A mode of a vehicle.

    Attributes
    ----------
    frequency : damped frequency [Hz]; 0 for a motion that does not oscillate
    damping : damping ratio [-]; negative for a motion that grows
    growth : real part of the eigenvalue [1/s]
    shape : complex displacement of each of the free coordinates (`names`)
    """

    frequency: float
    damping: float
    growth: float
    shape: NDArray[np.complex128]

    __repr__ = brief


def coordinates(simulation: Simulation, held: tuple[str, ...] = ()) -> list[tuple[int, int]]:
    """Return body and axis of all free coordinates. Bodies in `held` do not move. The spin of a wheelset has no angle."""
    return [
        (i, int(axis))
        for i, body in enumerate(simulation.model.bodies)
        if simulation.names[i] not in held
        for axis in Axis
        if not body["held"][axis] and not (body["wheelset"] and axis == Axis.PITCH)
    ]


def state_matrix(
    simulation: Simulation, amplitude: float = 0.0, held: tuple[str, ...] = (), step: float | None = None
) -> Array:
    """Return the state matrix of the coordinates and velocities about the present state.

    The spins of the wheelsets follow the other velocities. The rails are part of it if they have a mass.

    Parameters
    ----------
    simulation : Simulation
        On straight ideal track, at rest in its nominal place.
    amplitude : float
        0 for the derivatives of the contacts. Else their secants between displacements of this size [m], [rad] to both
        sides; velocities are displaced by ten times as much per second.
    held : tuple of str
        Names of bodies that do not move.
    step : float, optional
        Step of a run [s]: the matrix times the step is then the change of the state in a step, and the state has the growth of
        the wheelsets' velocities in the step before.
    """
    free = coordinates(simulation, held)
    state = simulation.state
    moving: list[tuple[Array, tuple[int, ...]]] = [(array, at) for array in (state.q, state.u) for at in free]
    for number, i in enumerate(simulation.model.wheelsets):
        if simulation.names[i] in held:
            continue
        moving.append((state.u, (int(i), int(Axis.PITCH))))
        if simulation.model.rail[0] > 0.0:
            moving.extend((state.rails, (number, side, k)) for side in range(2) for k in range(4))
        if step is not None:
            moving.extend(
                (state.gains, (number, axis)) for axis in range(6) if not simulation.model.bodies[i]["held"][axis]
            )
    step = step or _INSTANT
    kept = [array.copy() for array in state]
    advance = partial(simulation.advance, step) if amplitude > 0.0 else _linear_step(simulation, step)

    def restore() -> None:
        for array, before in zip(state, kept, strict=True):
            array[:] = before
        simulation.wheel_arrays.last.ages[:] = 0  # contacts are solved at every displaced state

    def rates() -> Array:
        before = np.array([array[at] for array, at in moving])
        advance()
        return (np.array([array[at] for array, at in moving]) - before) / step

    columns = []
    for array, at in moving:
        ends = []
        size = _size(simulation, array, at, amplitude) if amplitude > 0.0 else _SMALL
        for sign in (1.0, -1.0):
            restore()
            array[at] += sign * size
            ends.append(rates())
        columns.append((ends[0] - ends[1]) / (2.0 * size))
    restore()
    return np.array(columns).T


def _linear_step(simulation: Simulation, step: float) -> Callable[[], None]:
    """Return what advances the vehicle by a step, with contacts that are linear about the present state."""
    forces, jacobians = simulation.derive_contacts()
    model, scratch = simulation.model, simulation.scratch
    arrays = pack(Model, model), pack(State, simulation.state), simulation.wheel_arrays.motions, pack(Scratch, scratch)
    speed = float(speed_at(model.track, simulation.distance))
    given, wheels = scratch.given.view(np.float64).reshape(len(forces), -1), scratch.wheels
    middle = given.copy()

    def advance() -> None:
        motion.prepare_contacts(*arrays, speed)
        now = forces + np.einsum("wij,wj->wi", jacobians, given - middle)
        now[:, 2] *= -1.0  # the vertical force is that on the rail
        for name, values in zip(_LOADS, now.T, strict=True):
            wheels[name] = values
        motion.move(*arrays, step, speed)

    return advance


def _size(simulation: Simulation, array: Array, at: tuple[int, ...], amplitude: float) -> float:
    """Return the displacement of a coordinate. What presses wheels on rails is displaced less, for the contact is stiff."""
    if array is simulation.state.u:
        return 10.0 * amplitude
    if array is simulation.state.rails:
        return amplitude * (0.1 if at[2] > 1 else 0.01)
    pressing = simulation.model.bodies[at[0]]["wheelset"] and at[1] in (Axis.Z, Axis.ROLL)
    return amplitude * (0.01 if pressing else 1.0)


def modes(simulation: Simulation, amplitude: float = 0.0, held: tuple[str, ...] = ()) -> list[Mode]:
    """Return the modes of a vehicle, slowest first. Each conjugate pair appears once."""
    matrix = state_matrix(simulation, amplitude, held)
    values, vectors = np.linalg.eig(matrix)
    n = len(coordinates(simulation, held))
    found = []
    for value, vector in zip(values, vectors.T, strict=True):
        if value.imag >= 0.0:
            size = abs(value)
            found.append(
                Mode(value.imag / (2.0 * math.pi), -value.real / size if size > 0.0 else 1.0, value.real, vector[:n])
            )
    return sorted(found, key=lambda mode: (mode.frequency, mode.growth))


def amplification(simulation: Simulation, step: float) -> float:
    """Return the largest factor by which a small motion grows in a step of `step` [s]. It is near 1 in a stable integration."""
    matrix = state_matrix(simulation, step=step)
    return float(np.abs(np.linalg.eigvals(np.eye(len(matrix)) + step * matrix)).max())


def growth(simulation: Simulation, amplitude: float = 0.0) -> float:
    """Return the largest real part of the eigenvalues of motions that oscillate [1/s]; negative if all decay."""
    return max(mode.growth for mode in modes(simulation, amplitude) if mode.frequency > 0.05)


def critical_speed(
    at_speed: Callable[[float], Simulation],
    amplitude: float = 0.0,
    bounds: tuple[float, float] = (5.0, 150.0),
    tolerance: float = 0.1,
) -> float:
    """Return the linear critical speed [m/s]: where a small motion begins to grow by more than `NOISE`, to `tolerance`.

    Parameters
    ----------
    at_speed : callable
        Returns the vehicle at rest on straight ideal track at a speed [m/s].
    amplitude : float
        As for `state_matrix`, 0 for small motions.
    bounds : (float, float)
        [m/s]. The result is inf if all motions decay at the upper bound, and the lower bound if one grows there.

    Raises
    ------
    ContactError
        If the bounds are not in order.
    """
    if not 0.0 < bounds[0] < bounds[1]:
        raise ContactError(f"bounds = {bounds} are not in order")
    low, high = bounds

    def unstable(speed: float) -> bool:
        return growth(at_speed(speed), amplitude) > NOISE

    if not unstable(high):
        return math.inf
    if unstable(low):
        return low
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if unstable(middle) else (middle, high)
    return 0.5 * (low + high)
