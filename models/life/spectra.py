"""Lateral irregularity of a track's centre line: spectra by name, and seeded realisations (constants.md 13)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, require_number, suggestion

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Spectrum:
    """One-sided spectrum of the alignment, S(Ω) = A Ωc²/((Ω² + Ωr²)(Ω² + Ωc²)) [m²/(rad/m)], Ω in rad/m.

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


_B176 = "ERRI B176, alignment (constants.md 13.1, two sources agree)"
_FRA = "FRA/AAR class {}, alignment (constants.md 13.2, {})"
#: Name → spectrum.
SPECTRA = {
    "ERRI B176 low": Spectrum(2.119e-7, 0.8246, 0.0206, _B176),
    "ERRI B176 high": Spectrum(6.125e-7, 0.8246, 0.0206, _B176),
    # k A_a = 0.25 A_a, 1 cm² rad/m = 1e-4 m² rad/m
    "FRA 4": Spectrum(0.25e-4 * 0.3027, 0.8245, 0.0, _FRA.format(4, "recalled, not verified")),
    "FRA 5": Spectrum(0.25e-4 * 0.0762, 0.8245, 0.0, _FRA.format(5, "recalled and one source")),
    "FRA 6": Spectrum(0.25e-4 * 0.0339, 0.8245, 0.0, _FRA.format(6, "recalled and one source")),
}


@dataclass(frozen=True, kw_only=True)
class Irregularities:
    """Random alignment of the track.

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
        if self.spectrum not in SPECTRA:
            known = ", ".join(SPECTRA)
            raise ContactError(
                f"spectrum = {self.spectrum!r} is unknown{suggestion(self.spectrum, SPECTRA)}; they are {known}"
            )
        require_number("shortest", self.shortest, 0.5, 500.0)
        require_number("longest", self.longest, self.shortest, 500.0, open_minimum=True)
        require_number("scale", self.scale, 0.0, 10.0)
        require_number("waves", self.waves, 10, 5000)

    def realise(self, seed: tuple[int, ...]) -> Realisation:
        """Return a realisation: one wave of random phase in each part of the band. The same seed gives the same bits.

        The parts are equal in log Ω. Each wave has the variance of its part, so the total variance is the integral over the
        band to round-off. The wavenumber of a wave is random within its part, so the realisation is not periodic.
        """
        edges = 2.0 * math.pi / np.geomspace(self.longest, self.shortest, self.waves + 1)
        random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed)))
        place, phase = random.random(self.waves), 2.0 * math.pi * random.random(self.waves)
        variance = SPECTRA[self.spectrum].variance(edges[:-1], edges[1:])
        wavenumber = edges[:-1] + place * np.diff(edges)
        return Realisation(self.scale * np.sqrt(2.0 * variance), wavenumber, phase)


@dataclass(frozen=True, eq=False)
class Realisation:
    """Lateral irregularity Σ a cos(Ω s + φ) [m]."""

    amplitude: Array
    wavenumber: Array
    phase: Array

    def at(self, s: float) -> tuple[float, float]:
        """Return lateral position [m] and slope [-] at the distance `s` [m]."""
        angle = self.wavenumber * s + self.phase
        lateral = float((self.amplitude * np.cos(angle)).sum())
        return lateral, -float((self.amplitude * self.wavenumber * np.sin(angle)).sum())
