"""Assessment of a run by sections as in EN 14363:2016: percentiles, quasi-static values and rms of instability.

The standard was not at hand: filters, percentiles, lengths of sections and limits are recalled, not verified.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from contact.arrays import Array
from .assess import band_pass, guiding, low_pass, prudhomme, sliding_mean
from .track import Track

#: Percentile of the largest values, and of quasi-static ones [%].
LARGEST, QUASI_STATIC = 99.85, 50.0
#: Places at which sliding means are taken [m].
_GRID = 0.5
#: Window and step of the rms of instability [m], half its band about the frequency that is strongest between two others [Hz].
_RMS_WINDOW, _RMS_STEP, _HALF_BAND, _HUNTING = 100.0, 10.0, 2.0, (1.0, 10.0)
#: Limits of the quasi-static Q and of the largest Q [N]: that of speeds up to 160 km/h.
Q_QUASI_STATIC, Q_LARGEST = 145e3, 200e3


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the track without transitions.

    Attributes
    ----------
    begin, end : [m]
    curvature : [1/m], positive to the right; 0 on straight track
    whole : False if it is shorter than the standard asks
    """

    begin: float
    end: float
    curvature: float
    whole: bool

    @property
    def name(self) -> str:
        """Kind and place of the section."""
        what = f"curve of {1.0 / abs(self.curvature):.0f} m" if self.curvature else "straight"
        return f"{what}, {self.begin:.0f} to {self.end:.0f} m" + ("" if self.whole else " (short)")


@dataclass(frozen=True, slots=True)
class Values:
    """Values of one wheelset on one section.

    Attributes
    ----------
    guiding : percentile of |ΣY|, low-passed and meant over 2 m [N]
    quotient : percentile of |Y/Q| of both wheels, likewise
    vertical : percentile of Q of both wheels, low-passed [N]
    Y_quasi_static, Q_quasi_static : medians of the outer wheel, Y outwards [N]; nan on straight track
    instability : largest rms over 100 m of ΣY in the band of hunting [N]
    """

    guiding: float
    quotient: float
    vertical: float
    Y_quasi_static: float
    Q_quasi_static: float
    instability: float


def required_length(curvature: float) -> float:
    """Return the length of a section [m]: 250 on straight track, 100 in curves of 400 m and more, 70 in sharper ones."""
    if curvature == 0.0:
        return 250.0
    return 100.0 if abs(curvature) <= 1.0 / 400.0 else 70.0


def sections(track: Track, begin: float, end: float) -> tuple[Section, ...]:
    """Return the sections of a track between two places [m]: straight parts and circles, in pieces of the required length."""
    parts, at = [], begin
    for curve in sorted(track.curves, key=lambda each: each.start):
        direction = 1.0 if curve.direction == "right" else -1.0
        parts.append((at, min(curve.start, end), 0.0))
        circle = curve.start + curve.transition
        parts.append((max(circle, begin), min(circle + curve.length, end), direction / curve.radius))
        at = max(curve.end, begin)
    parts.append((at, end, 0.0))
    found = []
    for first, last, curvature in parts:
        wanted = required_length(curvature)
        count = max(int((last - first) / wanted), 1)
        if last - first > _RMS_STEP:
            edges: list[float] = np.linspace(first, last, count + 1).tolist()
            found += [Section(a, b, curvature, last - first >= wanted) for a, b in itertools.pairwise(edges)]
    return tuple(found)


def values(section: Section, lateral: Array, vertical: Array, distance: Array, time: Array, load: float) -> Values:
    """Return the values of one wheelset on a section. The filters see the whole run, so that they have no ends inside of it.

    Parameters
    ----------
    section : Section
    lateral, vertical : ndarray, shape (2, n)
        Y, positive outwards, and Q of the right and the left wheel [N].
    distance, time : ndarray, shape (n,)
        Of the wheelset.
    load : float
        Static load of a wheel [N].
    """
    Y, Q = (np.array([low_pass(side, time) for side in both]) for both in (lateral, vertical))
    grid = np.arange(section.begin, section.end, _GRID)

    def meant(signal: Array) -> Array:
        return np.interp(grid, distance, sliding_mean(signal, distance))

    inside = (distance >= section.begin) & (distance <= section.end)
    quotients = [meant(y / np.maximum(q, 1e-3 * load)) for y, q in zip(Y, Q, strict=True)]
    outer = 1 if section.curvature > 0.0 else 0
    curved = section.curvature != 0.0
    return Values(
        guiding=float(np.percentile(np.abs(meant(guiding(Y))), LARGEST)),
        quotient=float(max(np.percentile(np.abs(each), LARGEST) for each in quotients)),
        vertical=float(max(np.percentile(each[inside], LARGEST) for each in Q)),
        Y_quasi_static=float(np.percentile(Y[outer][inside], QUASI_STATIC)) if curved else math.nan,
        Q_quasi_static=float(np.percentile(Q[outer][inside], QUASI_STATIC)) if curved else math.nan,
        instability=_instability(guiding(lateral), distance, time, section),
    )


def _instability(sum_of_Y: Array, distance: Array, time: Array, section: Section) -> float:
    """Return the largest rms of ΣY in the band of hunting, over windows of the section [N]."""
    inside = (distance >= section.begin) & (distance <= section.end)
    even = np.linspace(time[inside][0], time[inside][-1], int(inside.sum()))
    signal = np.interp(even, time, sum_of_Y)
    power = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(signal.size))) ** 2
    frequency = np.fft.rfftfreq(signal.size, even[1] - even[0])
    band = (frequency >= _HUNTING[0]) & (frequency <= _HUNTING[1])
    if not band.any():
        return math.nan
    strongest = float(frequency[band][np.argmax(power[band])])
    filtered = band_pass(sum_of_Y, time, (max(strongest - _HALF_BAND, 0.1), strongest + _HALF_BAND))
    window = min(_RMS_WINDOW, section.end - section.begin)
    begins = np.arange(section.begin, section.end - window + 1e-9, _RMS_STEP)
    rms = [np.sqrt((filtered[(distance >= b) & (distance <= b + window)] ** 2).mean()) for b in begins]
    return float(max(rms))


def limits(load: float, radius: float) -> Values:
    """Return the limits of a wheelset with a static wheel load [N] in a radius [m], inf on straight track."""
    largest = prudhomme(2.0 * load)
    return Values(
        guiding=largest,
        quotient=0.8,
        vertical=min(90e3 + load, Q_LARGEST),
        Y_quasi_static=30e3 + 10.5e6 / radius if math.isfinite(radius) else math.nan,
        Q_quasi_static=Q_QUASI_STATIC if math.isfinite(radius) else math.nan,
        instability=0.5 * largest,
    )
