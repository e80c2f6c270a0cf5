"""Linear stability of the coupled system, by numerical differentiation of its equations of motion.

Unlike `linear.py` this is valid for any profiles. It includes Kalker's coefficients of the true patches, spin creepage and
gravitational stiffness. By symmetry the spin of the axle does not couple with the lateral motion.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .components import Component, DirectContact, DirectWheelset
from .model import WheelsetModel
from .parameters import WheelsetParameters
from .ports import SIDES

_MOTION = ("lateral", "yaw", "lateral_velocity", "yaw_rate")
_ROUNDS = 4  # exchanges of load and lateral force; they then agree to many digits


def state_matrix(parameters: WheelsetParameters, friction: float = 0.3, amplitude: float = 1e-4) -> NDArray[np.float64]:
    """Return the state matrix, shape (4, 4), of (lateral, yaw, lateral_velocity, yaw_rate) about the track's centre.

    Parameters
    ----------
    parameters : WheelsetParameters
        Constants. The initial motion is not used.
    friction : float
        Coefficient of friction [-].
    amplitude : float
        Lateral displacement of the central difference [m]. The other displacements are those of a kinematic motion with
        this amplitude.
    """
    p = parameters
    contacts = [DirectContact(p, friction) for _ in SIDES]
    frequency = p.speed * math.sqrt(0.1 / (p.radius * 0.5 * p.gauge))
    sizes = amplitude * np.array([1.0, frequency / p.speed, frequency, frequency**2 / p.speed])
    columns = []
    for name, size in zip(_MOTION, sizes, strict=True):
        plus, minus = (_rates(p, contacts, name, sign * size) for sign in (1.0, -1.0))
        columns.append((plus - minus) / (2.0 * size))
    return np.array(columns).T


def _rates(p: WheelsetParameters, contacts: Sequence[Component], name: str, value: float) -> NDArray[np.float64]:
    motion: dict[str, Any] = dict.fromkeys(_MOTION, 0.0) | {name: value}
    model = WheelsetModel(dataclasses.replace(p, **motion))
    wheelset = DirectWheelset(model)
    for _ in range(_ROUNDS):
        for side, contact in zip(SIDES, contacts, strict=True):
            contact.write("problem", wheelset.read(f"{side}.problem"))
            contact.step(0.0, 0.0)
            wheelset.write(f"{side}.reaction", contact.read("reaction"))
        rates = model.rates()
    return rates[:4]


def growth(parameters: WheelsetParameters, friction: float = 0.3, amplitude: float = 1e-4) -> float:
    """Return the largest real part of the eigenvalues [1/s]. If it is negative, a small motion decays."""
    return float(np.linalg.eigvals(state_matrix(parameters, friction, amplitude)).real.max())


def critical_speed(
    parameters: WheelsetParameters,
    friction: float = 0.3,
    amplitude: float = 1e-4,
    bounds: tuple[float, float] = (2.0, 150.0),
    tolerance: float = 0.01,
) -> float:
    """Return the speed [m/s] within `bounds` at which `growth` becomes positive, by bisection to `tolerance`.

    The result is inf if `growth` is not positive at the upper bound, and the lower bound if it is positive there.
    """

    def unstable(speed: float) -> bool:
        return growth(dataclasses.replace(parameters, speed=speed), friction, amplitude) > 0.0

    return onset(unstable, bounds, tolerance)


def onset(unstable: Callable[[float], bool], bounds: tuple[float, float], tolerance: float) -> float:
    """Return the speed within `bounds` above which a motion is unstable, by bisection to `tolerance`; all in m/s.

    The result is inf if it is stable at the upper bound, and the lower bound if it is unstable there.
    """
    low, high = bounds
    if not unstable(high):
        return math.inf
    if unstable(low):
        return low
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if unstable(middle) else (middle, high)
    return 0.5 * (low + high)
