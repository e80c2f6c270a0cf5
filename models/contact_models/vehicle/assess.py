"""Safety of a run: filtered wheel forces and their limits. Filters and limits of EN 14363 are recalled, not verified."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile

CUT_OFF = 20.0  # of the low pass of wheel forces [Hz]
WINDOW = 2.0  # of the sliding mean of Y/Q and of the guiding force of an axle [m]
#: Corner of a filter of second order over the frequency at which it has -3 dB after both ways.
_BOTH_WAYS = (math.sqrt(2.0) - 1.0) ** -0.25
_LEAST_SAMPLES = 20  # below this number nothing is filtered
LARGEST_QUOTIENT = 0.8  # limit of Y/Q for a flange angle of 70° and radii from 250 m


@dataclass(frozen=True, slots=True)
class Safety:
    """Safety of one wheelset.

    Attributes
    ----------
    quotient : greatest |Y/Q| of both wheels, low-passed and meant over `WINDOW`
    guiding : greatest |ΣY|, low-passed and meant over `WINDOW` [N]
    prudhomme : its limit [N]
    vertical : greatest Q, low-passed [N]
    unloading : greatest share of the static load that a wheel has lost, 1 - Q/Q0, low-passed
    """

    quotient: float
    guiding: float
    prudhomme: float
    vertical: float
    unloading: float


def low_pass(values: Array, time: Array, cut_off: float = CUT_OFF) -> Array:
    """Return values without what is faster than `cut_off` [Hz]: -3 dB there, 24 dB per octave beyond, without delay.

    A Butterworth filter of second order runs forwards and backwards over equidistant times. Samples that are too far apart for
    it stay as they are.

    Raises
    ------
    ContactError
        If the cut-off frequency is not positive.
    """
    corner = require_number("cut_off", cut_off, 0.0, open_minimum=True) * _BOTH_WAYS
    return _filtered(values, time, corner, "lowpass", corner)


def band_pass(values: Array, time: Array, band: tuple[float, float]) -> Array:
    """Return what lies between two frequencies [Hz], likewise."""
    low, high = band
    return _filtered(values, time, (low / _BOTH_WAYS, high * _BOTH_WAYS), "bandpass", high * _BOTH_WAYS)


def _filtered(values: Array, time: Array, corners: float | tuple[float, float], kind: str, fastest: float) -> Array:
    from scipy.signal import butter, sosfiltfilt

    if time.size <= _LEAST_SAMPLES:
        return values.copy()
    even = np.linspace(time[0], time[-1], math.ceil(float((time[-1] - time[0]) / np.diff(time).min())) + 1)
    rate = 1.0 / float(even[1] - even[0])
    if rate <= 2.2 * fastest:
        return values.copy()
    sections = butter(2, corners, kind, fs=rate, output="sos")
    return np.interp(time, even, sosfiltfilt(sections, np.interp(even, time, values)))


def sliding_mean(values: Array, distance: Array, window: float = WINDOW) -> Array:
    """Return the mean over `window` [m] around each place, of the trapezoidal rule. Near the ends the window is shorter."""
    if values.size < 2:
        return values.copy()
    area = np.concatenate(([0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(distance))))
    low, high = (np.clip(distance + side * window, distance[0], distance[-1]) for side in (-0.5, 0.5))
    return (np.interp(high, distance, area) - np.interp(low, distance, area)) / (high - low)


def nadal(flange_angle: float, friction: float) -> float:
    """Return Nadal's limit of Y/Q, (tan δ - μ)/(1 + μ tan δ), for a flange angle δ [rad].

    Raises
    ------
    ContactError
        For an angle outside ]0, π/2[ or a negative friction.
    """
    slope = math.tan(require_number("flange_angle", flange_angle, 0.0, math.radians(89.9), open_minimum=True))
    mu = require_number("friction", friction, 0.0)
    return (slope - mu) / (1.0 + mu * slope)


def flange_angle(wheel: Profile) -> float:
    """Return the steepest angle of the flange's face, between tip and tread [rad]."""
    tip = int(np.argmax(np.where(wheel.y < 0.0, wheel.z, -np.inf)))
    return float(np.abs(wheel.angle[tip : int(np.argmin(np.abs(wheel.y)))]).max())


def prudhomme(axle_load: float, share: float = 1.0) -> float:
    """Return Prud'homme's limit of the guiding force of an axle [N]: share (10 kN + axle load/3).

    `share` is 1 for locomotives and coaches, 0.85 for freight wagons.
    """
    return share * (10e3 + axle_load / 3.0)


def guiding(Y: Array) -> Array:
    """Return ΣY, the force of a wheelset on both rails to the right [N], of Y of its right and its left wheel, outwards."""
    return Y[0] - Y[1]


def safety(lateral: Array, vertical: Array, distance: Array, time: Array, load: float) -> Safety:
    """Return the safety of one wheelset.

    Parameters
    ----------
    lateral, vertical : ndarray, shape (2, n)
        Y, positive outwards, and Q of the right and the left wheel [N].
    distance, time : ndarray, shape (n,)
    load : float
        Static load of a wheel [N].

    Raises
    ------
    ContactError
        If there is no sample.
    """
    if distance.size == 0:
        raise ContactError("distance is empty; at least one sample is needed")
    Y, Q = (np.array([low_pass(side, time) for side in both]) for both in (lateral, vertical))
    quotients = [sliding_mean(y / np.maximum(q, 1e-3 * load), distance) for y, q in zip(Y, Q, strict=True)]
    return Safety(
        quotient=float(np.abs(quotients).max()),
        guiding=float(np.abs(sliding_mean(guiding(Y), distance)).max()),
        prudhomme=prudhomme(2.0 * load),
        vertical=float(Q.max()),
        unloading=float(1.0 - Q.min() / load),
    )
