"""Energy index: T-gamma per area at each point of the patch (thesis Eq. 6.2; Dirks & Enblom)."""

from __future__ import annotations

from numpy.typing import ArrayLike

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.kernels.damage.energy_index import energy_index_kernel


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
