"""Quasi-static curving: the equilibrium of a vehicle that runs steadily through a curve, from its own kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array, brief
from contact.errors import ContactError
from contact.friction import Friction
from contact.geometry.profile import Profile
from .course import lay
from .declared import VehicleDeclaration
from .kernels.frames import carried, lay_frames
from .kernels.layout import Axis, Book
from .linear import coordinates
from .simulation import ContactOptions, Simulation
from .track import Curve, Track

_INSTANT = 1e-6  # step from which the accelerations are taken [s]
_TRANSITION = 40.0  # at the start of the curve [m]
_SETTLING = 4.0  # time in the curve before equilibrium is looked for [s]
_STEP = 3e-4  # of that run [s]
_MOST = 25  # iterations
_TOLERANCE = 1e-3  # of the accelerations [m/s²], [rad/s²]


@dataclass(frozen=True, eq=False)
class Curving:
    """A vehicle in equilibrium in a curve.

    Attributes
    ----------
    radius, speed, cant : [m], [m/s], [m]
    q : coordinates of all bodies, shape (bodies, 6)
    wheels : records WHEEL of all wheels
    """

    radius: float
    speed: float
    cant: float
    q: Array
    wheels: NDArray

    __repr__ = brief


class Equilibrium:
    """A vehicle in a circular curve, brought to equilibrium by Newton's method from a state near it.

    The unknowns are the free coordinates, the spins and the displacements of the rails; the equations are that nothing is
    accelerated while all bodies go round with their frames.
    """

    def __init__(self, simulation: Simulation, speed: float) -> None:
        self.simulation, self._speed, self._place = simulation, speed, simulation.distance
        state = simulation.state
        free = coordinates(simulation)
        axles = [(int(i), int(Axis.PITCH)) for i in simulation.model.wheelsets]
        self._unknown: list[tuple[Array, tuple[int, ...]]] = [(state.q, at) for at in free]
        self._unknown += [(state.u, at) for at in axles]
        self._rate: list[tuple[Array, tuple[int, ...]]] = [(state.u, at) for at in (*free, *axles)]
        if simulation.model.rail[0] > 0.0:
            rails = [(n, side, k) for n in range(len(axles)) for side in range(2) for k in range(2)]
            self._unknown += [(state.rails, at) for at in rails]
            self._rate += [(state.rails, (n, side, k + 2)) for n, side, k in rails]

    def _accelerations(self, x: Array) -> Array:
        """Return the rates of all velocities with the unknowns `x`."""
        simulation = self.simulation
        state, model = simulation.state, simulation.model
        for (array, at), value in zip(self._unknown, x, strict=True):
            array[at] = value
        state.books[:] = 0.0
        state.books[Book.DISTANCE] = self._place
        state.rails[:, :, 2:] = 0.0
        lay_frames(model, self._place, self._speed, simulation.scratch.frames)
        for i, body in enumerate(model.bodies):
            for j in Axis:
                if not (body["wheelset"] and j == Axis.PITCH):
                    state.u[i, j] = carried(simulation.scratch.frames[i], body, state.q[i], self._speed, int(j))
        before = np.array([array[at] for array, at in self._rate])
        kept = state.q.copy(), state.rails.copy(), state.u.copy()
        simulation.advance(_INSTANT)
        rates = (np.array([array[at] for array, at in self._rate]) - before) / _INSTANT
        state.q[:], state.rails[:], state.u[:] = kept
        return rates

    def find(self) -> None:
        """Bring the vehicle to equilibrium.

        Raises
        ------
        ContactError
            If no equilibrium is found.
        """
        x = np.array([float(array[at]) for array, at in self._unknown])
        f = self._accelerations(x)
        for _ in range(_MOST):
            if np.abs(f).max() < _TOLERANCE:
                return
            jacobian = np.empty((x.size, x.size))
            for k in range(x.size):
                size = 1e-3 if self._unknown[k][0] is self.simulation.state.u else 1e-7
                ends = []
                for sign in (1.0, -1.0):
                    moved = x.copy()
                    moved[k] += sign * size
                    ends.append(self._accelerations(moved))
                jacobian[:, k] = (ends[0] - ends[1]) / (2.0 * size)
            step = np.linalg.solve(jacobian, -f)
            limit = np.array([0.05 if array is self.simulation.state.u else 5e-4 for array, _ in self._unknown])
            share = min(1.0, float((limit / np.maximum(np.abs(step), 1e-300)).min()) * 4.0)
            for _ in range(6):
                trial = self._accelerations(x + share * step)
                if np.linalg.norm(trial) < np.linalg.norm(f):
                    break
                share *= 0.5
            x, f = x + share * step, self._accelerations(x + share * step)
        raise ContactError(f"no equilibrium was found; an acceleration of {np.abs(f).max():.3g} m/s² or rad/s² is left")


def in_curve(
    vehicle: VehicleDeclaration,
    profiles: tuple[Profile, Profile],
    radius: float,
    *,
    speed: float,
    cant: float = 0.0,
    friction: float | Friction = 0.3,
    options: ContactOptions | None = None,
) -> Curving:
    """Return the equilibrium of a vehicle in a curve to the right. It runs into the curve, then Newton's method takes over.

    Parameters
    ----------
    vehicle : VehicleDeclaration
    profiles : (wheel, rail)
    radius : float
        [m], 15 to 100000.
    speed, cant : float
        [m/s], height of the outer rail [m].
    friction : float or Friction
    options : ContactOptions, optional

    Raises
    ------
    ContactError
        If no equilibrium is found.
    """
    half = 0.5 * max(abs(body.at) for body in vehicle.wheelsets)
    length = _TRANSITION + 4.0 * half + speed * _SETTLING
    curve = Curve(start=2.0 * half, radius=radius, length=2.0 * length, transition=_TRANSITION, cant=cant)
    track = lay(Track(curves=(curve,)), 2.0 * length, lambda s: speed, (0,), 0.0)
    simulation = Simulation(vehicle, track, *profiles, friction, options)
    simulation.advance(_STEP, round(length / speed / _STEP))
    Equilibrium(simulation, speed).find()
    simulation.advance(_INSTANT)
    return Curving(radius, speed, cant, simulation.state.q.copy(), simulation.wheels.copy())
