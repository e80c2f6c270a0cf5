"""Irregularities of a track in four channels: spectra by name, and seeded realisations (docs/understand/constants.md 13)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from contact.arrays import Array, brief
from contact.errors import ContactError, require_number, suggestion


@dataclass(frozen=True, slots=True)
class Spectrum:
    """One-sided spectrum of alignment or vertical profile, S(Ω) = A Ωc²/((Ω² + Ωr²)(Ω² + Ωc²)) [m²/(rad/m)], Ω in rad/m.

    Parameters
    ----------
    roughness : A [m rad]
    corner, knee : Ωc and Ωr [rad/m], 0 ≤ Ωr < Ωc
    source : source of the numbers
    """

    roughness: float
    corner: float
    knee: float
    source: str

    def density(self, wavenumber: Array) -> Array:
        """Return S [m²/(rad/m)] at wavenumbers Ω > 0 [rad/m]."""
        square = wavenumber * wavenumber
        return self.roughness * self.corner**2 / ((square + self.knee**2) * (square + self.corner**2))

    def variance(self, low: Array, high: Array) -> Array:
        """Return ∫ S dΩ from `low` to `high` [m²], in closed form by partial fractions."""
        share = self.corner**2 / (self.corner**2 - self.knee**2)
        return self.roughness * share * (_inverse(low, high, self.knee) - _inverse(low, high, self.corner))


def _inverse(low: Array, high: Array, at: float) -> Array:
    """Return ∫ dΩ/(Ω² + at²) from `low` to `high`."""
    if at == 0.0:
        return 1.0 / low - 1.0 / high
    return np.arctan2((high - low) * at, at * at + low * high) / at


@dataclass(frozen=True, slots=True)
class DifferenceSpectrum:
    """One-sided spectrum of cross-level or gauge, S(Ω) = A Ωc² Ω²/((Ω² + Ωr²)(Ω² + Ωc²)(Ω² + Ωs²)), Ω in rad/m.

    Parameters
    ----------
    roughness : A [m rad] of gauge, [rad/m] of the angle of the cross-level
    corner, knee, third : Ωc, Ωr and Ωs [rad/m], all different, Ωr not negative
    source : source of the numbers
    """

    roughness: float
    corner: float
    knee: float
    third: float
    source: str

    def density(self, wavenumber: Array) -> Array:
        """Return S at wavenumbers Ω > 0 [rad/m]."""
        square = wavenumber * wavenumber
        poles = (square + self.knee**2) * (square + self.corner**2) * (square + self.third**2)
        return self.roughness * self.corner**2 * square / poles

    def variance(self, low: Array, high: Array) -> Array:
        """Return ∫ S dΩ from `low` to `high`, in closed form by partial fractions in Ω²."""
        poles = (self.knee, self.corner, self.third)
        total = np.zeros_like(low)
        for k, pole in enumerate(poles):
            one, other = (poles[j] ** 2 - pole**2 for j in range(3) if j != k)
            if pole > 0.0:
                total -= pole**2 / (one * other) * _inverse(low, high, pole)
        return self.roughness * self.corner**2 * total


_B176 = "ERRI B176 (docs/understand/constants.md 13.1, two sources agree{})"
_FRA = "FRA/AAR class {} (docs/understand/constants.md 13.2, {})"
_HALF_BASE = 0.75  # half of the distance of the rails' centres, by which height is an angle [m]
#: Class → A_v, A_a [cm² rad/m], Ωs [rad/m] and what is known of them.
_CLASSES = {
    4: (0.5376, 0.3027, 1.1312, "recalled, not verified"),
    5: (0.2095, 0.0762, 0.8209, "recalled and one source"),
    6: (0.0339, 0.0339, 0.4380, "recalled and one source"),
}
_K = 0.25e-4  # FRA's k, and cm² in m²


def _erri(roughness: float) -> Spectrum:
    return Spectrum(roughness, 0.8246, 0.0206, _B176.format(""))


def _fra(roughness: float, number: int) -> Spectrum:
    return Spectrum(_K * roughness, 0.8245, 0.0, _FRA.format(number, _CLASSES[number][3]))


def _fra_difference(number: int, scale: float) -> DifferenceSpectrum:
    roughness, _, third, known = _CLASSES[number]
    return DifferenceSpectrum(4.0 * _K * roughness * scale, 0.8245, 0.0, third, _FRA.format(number, known))


#: Channel → name → spectrum. Cross-level is the angle of the track [rad]; the others are lengths [m].
SPECTRA: dict[str, dict[str, Spectrum | DifferenceSpectrum]] = {
    "alignment": {
        "ERRI B176 low": _erri(2.119e-7),
        "ERRI B176 high": _erri(6.125e-7),
        **{f"FRA {number}": _fra(values[1], number) for number, values in _CLASSES.items()},
    },
    "vertical": {
        "ERRI B176 low": _erri(4.032e-7),
        "ERRI B176 high": _erri(1.08e-6),
        **{f"FRA {number}": _fra(values[0], number) for number, values in _CLASSES.items()},
    },
    "cross_level": {
        "ERRI B176 low": DifferenceSpectrum(4.032e-7 / _HALF_BASE**2, 0.8246, 0.0206, 0.4380, _B176.format("")),
        "ERRI B176 high": DifferenceSpectrum(1.08e-6 / _HALF_BASE**2, 0.8246, 0.0206, 0.4380, _B176.format("")),
        **{f"FRA {number}": _fra_difference(number, 1.0 / (2.0 * _HALF_BASE) ** 2) for number in _CLASSES},
    },
    "gauge": {
        "ERRI B176 low": DifferenceSpectrum(5.32e-8, 0.8246, 0.0206, 0.4380, _B176.format("; A_g one")),
        "ERRI B176 high": DifferenceSpectrum(1.032e-7, 0.8246, 0.0206, 0.4380, _B176.format("; A_g one")),
        **{f"FRA {number}": _fra_difference(number, 1.0) for number in _CLASSES},
    },
}
CHANNELS = tuple(SPECTRA)


@dataclass(frozen=True, kw_only=True)
class Irregularities:
    """Random irregularity of the track in one channel.

    Parameters
    ----------
    spectrum : str
        Name in `SPECTRA`.
    shortest, longest : float
        Band of wavelengths [m], 0.5 to 500.
    scale : float
        Factor on all amplitudes [-], 0 to 10.
    waves : int
        Number of harmonics, 10 to 5000.

    Raises
    ------
    ContactError
        For values outside their range.
    """

    spectrum: str
    shortest: float = 3.0
    longest: float = 70.0
    scale: float = 1.0
    waves: int = 200

    def __post_init__(self) -> None:
        names = SPECTRA["alignment"]
        if self.spectrum not in names:
            known = ", ".join(names)
            raise ContactError(
                f"spectrum = {self.spectrum!r} is unknown{suggestion(self.spectrum, names)}; they are {known}"
            )
        require_number("shortest", self.shortest, 0.5, 500.0)
        require_number("longest", self.longest, self.shortest, 500.0, open_minimum=True)
        require_number("scale", self.scale, 0.0, 10.0)
        require_number("waves", self.waves, 10, 5000)

    def realise(self, seed: tuple[int, ...], channel: str = "alignment") -> Realisation:
        """Return a realisation of the spectrum of a channel: one wave of random phase in each part of the band.

        The same seed gives the same bits.

        The parts are equal in log Ω. Each wave has the variance of its part, so the total variance is the integral over the
        band to round-off. The wavenumber of a wave is random within its part, so the realisation is not periodic.
        """
        edges = 2.0 * math.pi / np.geomspace(self.longest, self.shortest, self.waves + 1)
        random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed)))
        place, phase = random.random(self.waves), 2.0 * math.pi * random.random(self.waves)
        variance = SPECTRA[channel][self.spectrum].variance(edges[:-1], edges[1:])
        wavenumber = edges[:-1] + place * np.diff(edges)
        return Realisation(self.scale * np.sqrt(2.0 * variance), wavenumber, phase)


@dataclass(frozen=True, eq=False)
class Realisation:
    """Irregularity Σ a cos(Ω s + φ) [m], or [rad] of a cross-level."""

    amplitude: Array
    wavenumber: Array
    phase: Array

    __repr__ = brief

    def at(self, s: float) -> tuple[float, float]:
        """Return lateral position [m] and slope [-] at the distance `s` [m]."""
        angle = self.wavenumber * s + self.phase
        lateral = float((self.amplitude * np.cos(angle)).sum())
        return lateral, -float((self.amplitude * self.wavenumber * np.sin(angle)).sum())

    def over(self, s: Array) -> Array:
        """Return values and slopes at the distances `s` [m], shape (2, n)."""
        found = np.zeros((2, s.size))
        for amplitude, wavenumber, phase in zip(self.amplitude, self.wavenumber, self.phase, strict=True):
            angle = wavenumber * s + phase
            found[0] += amplitude * np.cos(angle)
            found[1] -= amplitude * wavenumber * np.sin(angle)
        return found
