"""The nonlinear critical speed: where the limit cycle of a hunting vehicle ends when its speed falls."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from contact.arrays import Array, brief
from contact.errors import ContactError, require_number
from contact.friction import Friction
from contact.geometry.profile import Profile
from .course import lay
from .declared import VehicleDeclaration
from .kernels.layout import Axis
from .simulation import ContactOptions, Simulation
from .track import Track

_WINDOW = 0.5  # over which an amplitude is taken [s]


@dataclass(frozen=True, eq=False)
class Hunting:
    """A run at falling speed.

    Attributes
    ----------
    speed, amplitude : ndarray
        Speed [m/s], and half the lateral range of the wheelset that moves most [m], in windows of half a second.
    critical : float
        Speed [m/s] at which the amplitude falls below the threshold for good: the least speed with a limit cycle. It is inf if
        there was none at the start, and the least speed of the run if the limit cycle did not end.
    """

    speed: Array
    amplitude: Array
    critical: float

    __repr__ = brief


def fall(
    vehicle: VehicleDeclaration,
    profiles: tuple[Profile, Profile],
    bounds: tuple[float, float],
    *,
    deceleration: float = 1.0,
    kick: float = 5e-3,
    threshold: float = 1e-3,
    friction: float | Friction = 0.3,
    options: ContactOptions | None = None,
    step: float = 2e-4,
) -> Hunting:
    """Return the motion on straight ideal track while the speed falls.

    Parameters
    ----------
    vehicle : VehicleDeclaration
    profiles : (wheel, rail)
    bounds : (float, float)
        Least and greatest speed [m/s].
    deceleration : float
        [m/s²]. The slower the speed falls, the sharper the critical speed.
    kick : float
        Lateral displacement of all wheelsets at the start [m].
    threshold : float
        Amplitude of a limit cycle [m].
    friction, options : as for `Simulation`
    step : float
        Of the integration [s].

    Raises
    ------
    ContactError
        For values outside their range, or if a wheel leaves its rail.
    """
    slowest, fastest = bounds
    if not 1.0 <= slowest < fastest:
        raise ContactError(f"bounds = {bounds} are not two rising speeds from 1 m/s")
    require_number("deceleration", deceleration, 0.0, open_minimum=True)
    length = 0.5 * (fastest**2 - slowest**2) / deceleration

    def speed_at(s: float) -> float:
        return math.sqrt(max(fastest**2 - 2.0 * deceleration * max(s, 0.0), slowest**2))

    simulation = Simulation(vehicle, lay(Track(), length, speed_at, (0,), 0.0), *profiles, friction, options)
    axles = simulation.model.wheelsets
    simulation.state.q[axles, Axis.Y] = kick
    speeds, amplitudes = [], []
    while simulation.distance < length:
        path = []
        for _ in range(max(round(_WINDOW / step / 25), 1)):
            simulation.advance(step, 25)
            path.append(simulation.state.q[axles, Axis.Y].copy())
        speeds.append(speed_at(simulation.distance))
        amplitudes.append(0.5 * float(np.ptp(np.array(path), axis=0).max()))
    speed, amplitude = np.array(speeds), np.array(amplitudes)
    moving = np.flatnonzero(amplitude > threshold)
    if moving.size == 0 or moving[-1] < 2:
        critical = math.inf
    else:
        critical = float(speed[moving[-1]])
    return Hunting(speed, amplitude, critical)
