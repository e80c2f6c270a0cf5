"""Equivalent conicity by the procedure of EN 15302: the cone with the same wavelength as the real profiles.

A wheelset that rolls without creepage moves like y'' = -Δr(y)/(e r0). Here e is the distance of the tape circles and r0
their radius. The first integral is S(y) = ∫ Δr dy. An oscillation of amplitude ŷ between y1 and y2 = y1 + 2 ŷ has S = C at
both ends and the wavelength λ = 2 ∫ dy/ψ with ψ² = 2 (C - S)/(e r0). Klingel's formula of a cone then defines
tan γe = (π/λ)² 2 e r0 (constants.md 12.1). e and r0 cancel: tan γe = π²/(∫ dy/√(C - S))².
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, brief, require_numbers
from contact.errors import ContactError, require_number
from contact.geometry.rigid import ContactPoints, contact_points
from contact.geometry.shape import Profile
from contact.inputs.options import RADIUS

STEP = 2e-5  # step of the table of Δr [m]
BEYOND = 5e-3  # the table extends beyond the largest amplitude by this [m], on both sides
_NODES = 2000  # nodes of the integral
_FLAT = 1e-14  # C - S [m²] below this is round-off; it is a conicity of about 1e-8


@dataclass(frozen=True, eq=False)
class Conicity:
    """Equivalent conicity over the amplitude.

    Attributes
    ----------
    amplitude : ndarray, shape (n,)
        Amplitudes of the wheelset's lateral oscillation [m].
    conicity : ndarray, shape (n,)
        tan γe [-]. Negative if Δr drives the wheelset away from the middle; 0 if no oscillation has this amplitude.
    centre : ndarray, shape (n,)
        Middle between both ends of the oscillation [m]. Not zero for unequal wheels or rails.
    points : ContactPoints
        The contact points and Δr that were used.
    """

    amplitude: Array
    conicity: Array
    centre: Array
    points: ContactPoints

    __repr__ = brief

    def wavelength(self, base: float = 1.5, radius: float = RADIUS.usual) -> Array:
        """Return Klingel's wavelength λ = 2π √(e r0/(2 tan γe)) [m]; infinite unless the conicity is positive.

        `base` is the distance e of the tape circles [m], `radius` their radius r0 [m].
        """
        require_number("base", base, 0.0, open_minimum=True)
        require_number("radius", radius, 0.0, open_minimum=True)
        square = np.full_like(self.conicity, np.inf)
        np.divide(0.5 * base * radius, self.conicity, out=square, where=self.conicity > 0.0)
        return 2.0 * np.pi * np.sqrt(square)


def conicity(
    wheel: Profile, rail: Profile, amplitudes: ArrayLike | None = None, *, step: float = STEP, **options: Any
) -> Conicity:
    """Return the equivalent conicity of wheels on rails.

    Parameters
    ----------
    wheel, rail : Profile
    amplitudes : array_like, shape (n,), optional
        Amplitudes [m], 1e-4 to 0.02; default 1, 2, … 7 mm.
    step : float
        Step of the table of Δr [m], 1e-6 to 1e-4. Between its values Δr is linear, so a jump becomes a slope. With 0.1 mm
        the reference tables of the 2008 edition are reproduced to 0.002, with the finer default those of 2021.
    **options
        As for `contact.geometry.contact_points`: left_wheel, left_rail, nominal_radius, left_radius, gauge, flange_back,
        gauge_point, roll (EN 15302 neglects the roll).

    Returns
    -------
    Conicity

    Raises
    ------
    ContactError
        As `contact_points`. Also if, for an amplitude, no centre of oscillation lies within 5 mm of the track's centre.
    """
    wanted = _amplitudes(np.arange(1, 8) * 1e-3 if amplitudes is None else amplitudes)
    n = int(np.ceil((wanted.max() + BEYOND) / require_number("step", step, 1e-6, 1e-4)))
    return equivalent_conicity(contact_points(wheel, rail, np.arange(-n, n + 1) * step, **options), wanted)


def equivalent_conicity(points: ContactPoints, amplitudes: ArrayLike) -> Conicity:
    """Return the equivalent conicity from known contact points at equal steps of y.

    Parameters
    ----------
    points : ContactPoints
    amplitudes : array_like, shape (n,)
        Amplitudes [m], 1e-4 to 0.02.

    Returns
    -------
    Conicity

    Raises
    ------
    ContactError
        For unequal steps, amplitudes that reach beyond the points, and as `conicity`.
    """
    wanted = _amplitudes(amplitudes)
    steps = np.diff(points.y)
    if steps.size < 2 or not (steps > 0.0).all() or np.ptp(steps) > 1e-6 * steps.max():
        raise ContactError("points.y does not increase in equal steps")
    if 2.0 * wanted.max() >= points.y[-1] - points.y[0]:
        raise ContactError(
            f"amplitudes = {wanted.max():g} reach beyond the points, which lie within [{points.y[0]:g}, {points.y[-1]:g}] m"
        )
    found = [_equivalent(points.y, points.radius_difference, value) for value in wanted.tolist()]
    return Conicity(wanted, np.array([c for c, _ in found]), np.array([centre for _, centre in found]), points)


def _amplitudes(given: ArrayLike) -> Array:
    wanted = np.atleast_1d(require_numbers("amplitudes", given, 1e-4, 0.02))
    if wanted.ndim != 1 or not wanted.size:
        raise ContactError(f"amplitudes of shape {wanted.shape}: at least one is needed")
    return wanted


def _equivalent(y: Array, dr: Array, amplitude: float) -> tuple[float, float]:
    """Return tan γe [-] and the centre [m] of the oscillation of this amplitude. Δr is linear between the equal steps of y."""
    h = y[1] - y[0]
    integral = np.concatenate(([0.0], np.cumsum(0.5 * h * (dr[1:] + dr[:-1]))))

    def S(at: Any) -> Any:
        k = np.clip(((at - y[0]) / h).astype(int), 0, y.size - 2)
        t = at - y[k]
        return integral[k] + t * (dr[k] + 0.5 * t * (dr[k + 1] - dr[k]) / h)

    def drive(centre: Array) -> Array:
        return S(centre + amplitude) - S(centre - amplitude)

    centre = _zero_nearest_the_middle(drive, y[(y >= y[0] + amplitude) & (y <= y[-1] - amplitude)], amplitude)
    # y = centre + ŷ sin θ removes the singularities of 1/√(C - S); the midpoint rule avoids both ends
    theta = (np.arange(_NODES) + 0.5) * np.pi / _NODES - 0.5 * np.pi
    ends = centre + amplitude * np.array([-1.0, 1.0])
    well = S(ends).mean() - S(centre + amplitude * np.sin(theta))
    sign = 1.0 if well[_NODES // 2] > 0.0 else -1.0
    if np.abs(well).max() < _FLAT or (sign * well <= 0.0).any():
        return 0.0, centre
    length = (amplitude * np.cos(theta) / np.sqrt(sign * well)).sum() * np.pi / _NODES
    return sign * (np.pi / length) ** 2, centre


def _zero_nearest_the_middle(drive: Any, candidates: Array, amplitude: float) -> float:
    """Return the centre [m], nearest to the track's centre, at which the mean of Δr over the oscillation is zero."""
    values = drive(candidates)
    changes = np.flatnonzero((values[:-1] <= 0.0) & (values[1:] >= 0.0) | (values[:-1] >= 0.0) & (values[1:] <= 0.0))
    if not changes.size:
        raise ContactError(
            f"amplitudes = {amplitude:g}: the mean of Δr has the same sign wherever the wheelset is within "
            f"[{candidates[0]:g}, {candidates[-1]:g}] m; are the gauge, the flange backs and both radii right?"
        )
    k = changes[np.argmin(np.abs(candidates[changes] + candidates[changes + 1]))]
    ends = np.array([candidates[k], candidates[k + 1]])
    if values[k] == 0.0 or values[k + 1] == 0.0:
        return float(ends[0] if values[k] == 0.0 else ends[1])
    rising = values[k + 1] > 0.0
    for _ in range(60):
        middle = ends.mean()
        ends[int((drive(np.array([middle]))[0] > 0.0) == rising)] = middle
    return float(ends.mean())
