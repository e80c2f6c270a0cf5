"""T-gamma: force times creepage, the energy measure of the whole contact (thesis Eq. 6.1)."""

from __future__ import annotations

from numpy.typing import ArrayLike

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.kernels.damage.t_gamma import t_gamma_kernel


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
