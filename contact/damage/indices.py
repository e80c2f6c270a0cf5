"""T-gamma and the indices of energy, surface fatigue and stress: formulas of forces, pressures and tractions."""

from __future__ import annotations

from numpy.typing import ArrayLike

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.kernels.damage.indices import (
    energy_index_kernel,
    fatigue_index_kernel,
    stress_index_kernel,
    t_gamma_kernel,
)


def t_gamma(
    Fx: ArrayLike,
    Fy: ArrayLike,
    longitudinal: ArrayLike,
    lateral: ArrayLike,
    Mz: ArrayLike = 0.0,
    spin: ArrayLike = 0.0,
) -> float | Array:
    """Return T-gamma = |Fx vx| + |Fy vy| (+ |Mz phi| with `Mz` and `spin`), energy per metre rolled [N = J/m].

    The source is thesis Eq. 6.1. With spin it is an upper bound of the dissipation -∬ q·s dA of the exact theory, in which
    the elastic part of the slip does no net work over a patch in steady rolling.

    Parameters
    ----------
    Fx, Fy : array_like
        Creep forces [N].
    longitudinal, lateral : array_like
        Creepages [-].
    Mz, spin : array_like
        Spin moment [N m] and spin creepage [1/m].

    Raises
    ------
    ContactError
        For values that are not finite or shapes that do not broadcast.
    """
    return elementwise(
        t_gamma_kernel,
        require_numbers("Fx", Fx),
        require_numbers("Fy", Fy),
        require_numbers("Mz", Mz),
        require_numbers("longitudinal", longitudinal),
        require_numbers("lateral", lateral),
        require_numbers("spin", spin),
    )


def energy_index(
    qx: ArrayLike,
    qy: ArrayLike,
    x: ArrayLike,
    y: ArrayLike,
    longitudinal: ArrayLike,
    lateral: ArrayLike,
    spin: ArrayLike = 0.0,
) -> float | Array:
    """Return the energy index EI = -(qx (vx - phi y) + qy (vy + phi x)), energy per area and metre rolled [Pa].

    It is traction times rigid slip (thesis Eq. 6.2), with the sign that makes dissipation positive for tractions on the
    wheel. The rigid slip is used also in the stick zone, so the index can be negative at some points. Its integral is
    -(Fx vx + Fy vy + Mz phi).

    Parameters
    ----------
    qx, qy : array_like
        Traction on the wheel [Pa].
    x, y : array_like
        Position [m].
    longitudinal, lateral, spin : array_like
        Creepages [-], [-], [1/m].

    Raises
    ------
    ContactError
        For values that are not finite or shapes that do not broadcast.
    """
    return elementwise(
        energy_index_kernel,
        require_numbers("qx", qx),
        require_numbers("qy", qy),
        require_numbers("x", x),
        require_numbers("y", y),
        require_numbers("longitudinal", longitudinal),
        require_numbers("lateral", lateral),
        require_numbers("spin", spin),
    )


def fatigue_index(utilisation: ArrayLike, max_pressure: ArrayLike, shear_yield: ArrayLike = 300e6) -> float | Array:
    """Return FI_surf = √(Fx² + Fy²)/N - k/p0 [-]. A positive value predicts surface fatigue.

    It is the distance from the surface's limit in the shakedown map (thesis Eq. 6.6; Ekberg, Kabo & Andersson 2002). The
    formula uses the peak pressure, the ordinate of that map, because a non-elliptic patch has no semi-axes. On an ellipse it
    equals the thesis' form with 2πabk/(3N).

    Parameters
    ----------
    utilisation : array_like
        Utilised friction √(Fx² + Fy²)/N [-], not negative.
    max_pressure : array_like
        p0 [Pa], positive.
    shear_yield : array_like
        k [Pa], positive. For R260 it is 211 MPa at first plasticity and 288 MPa at high plastic work [1] (Meyer et al.
        2020). About 300 MPa is commonly used [R] (constants.md 5).

    Raises
    ------
    ContactError
        For values outside their range.
    """
    return elementwise(
        fatigue_index_kernel,
        require_numbers("utilisation", utilisation, 0.0),
        require_numbers("max_pressure", max_pressure, 0.0, open_minimum=True),
        require_numbers("shear_yield", shear_yield, 0.0, open_minimum=True),
    )


def stress_index(qx: ArrayLike, qy: ArrayLike, shear_yield: ArrayLike = 300e6) -> float | Array:
    """Return the stress index SI = √(qx² + qy²) - k [Pa] (thesis Eq. 6.7; Dirks & Enblom). A positive value predicts fatigue.

    Parameters
    ----------
    qx, qy : array_like
        Traction [Pa].
    shear_yield : array_like
        k [Pa], positive; see `fatigue_index`.

    Raises
    ------
    ContactError
        For values outside their range.

    Notes
    -----
    The limits and exponents of Dirks' crack-length model were not found (constants.md 11), so the function returns the
    index itself.
    """
    return elementwise(
        stress_index_kernel,
        require_numbers("qx", qx),
        require_numbers("qy", qy),
        require_numbers("shear_yield", shear_yield, 0.0, open_minimum=True),
    )
