"""Linear theory of one wheelset with conical wheels (theory.md 9.4), the reference for the coupled system."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class LinearWheelset:
    """Wheelset with conical wheels and one creep coefficient, without spin creepage and gravitational stiffness.

    Parameters
    ----------
    mass, yaw_inertia : float
        [kg], [kg m²].
    half_base : float
        Half distance b0 of the contact points [m].
    radius : float
        Rolling radius r0 [m].
    conicity : float
        Equivalent conicity λ [-].
    lateral_stiffness, yaw_stiffness : float
        Primary suspension k_y [N/m], k_psi [N m/rad].
    creep_coefficient : float
        f [N] of one wheel, force = -f·creepage.
    """

    mass: float
    yaw_inertia: float
    half_base: float
    radius: float
    conicity: float
    lateral_stiffness: float
    yaw_stiffness: float
    creep_coefficient: float

    @property
    def klingel_wavelength(self) -> float:
        """Kinematic wavelength 2π√(r0 b0/λ) [m]."""
        return 2.0 * math.pi * math.sqrt(self.radius * self.half_base / self.conicity)

    @property
    def critical_speed(self) -> float:
        """Speed [m/s] above which the central position is unstable (Routh–Hurwitz); inf if there is no such speed.

        V_c² = 4 f² b0² ω² / [m I ω⁴ - (m k_psi + I k_y) ω² + k_y k_psi + 4 f² λ b0/r0]
        with the frequency ω² = (k_psi + b0² k_y)/(m b0² + I) at the limit.
        """
        m, inertia, b0, f = self.mass, self.yaw_inertia, self.half_base, self.creep_coefficient
        ky, kpsi = self.lateral_stiffness, self.yaw_stiffness
        w2 = (kpsi + b0**2 * ky) / (m * b0**2 + inertia)
        denominator = (
            m * inertia * w2**2
            - (m * kpsi + inertia * ky) * w2
            + ky * kpsi
            + 4.0 * f**2 * self.conicity * b0 / self.radius
        )
        return 2.0 * f * b0 * math.sqrt(w2 / denominator) if denominator > 0.0 else math.inf

    def matrix(self, speed: float) -> NDArray[np.float64]:
        """Return the state matrix, shape (4, 4), of (y, psi, dy/dt, dpsi/dt) at `speed` [m/s]."""
        f, b0 = self.creep_coefficient, self.half_base
        A = np.zeros((4, 4))
        A[0, 2] = A[1, 3] = 1.0
        A[2] = np.array([-self.lateral_stiffness, 2.0 * f, -2.0 * f / speed, 0.0]) / self.mass
        A[3] = (
            np.array([-2.0 * f * self.conicity * b0 / self.radius, -self.yaw_stiffness, 0.0, -2.0 * f * b0**2 / speed])
            / self.yaw_inertia
        )
        return A
