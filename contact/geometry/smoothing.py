"""Smoothing of measured profiles: a cubic spline through a band around the points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact.errors import require_number

Array = NDArray[np.float64]


def smoothed(y: Array, z: Array, tolerance: float) -> tuple[Array, Array, Array]:
    """Points and tangents of the smoothest cubic spline (y, z) over the chord length within `tolerance` of the points.

    Parameters
    ----------
    y, z : ndarray, shape (n,), n >= 4
        Measured points [m].
    tolerance : float
        Root mean square of the distances that the points may move [m], 0 ... 1e-3: the noise of the measurement. Dierckx'
        spline (FITPACK) has as few knots, and as small jumps of its third derivative, as that allows.

    Returns
    -------
    y, z, angle : ndarray, shape (n,)
        The spline at the points' chord lengths [m] and the angle of its tangent [rad].

    Raises
    ------
    ContactError
        A tolerance outside its range.
    ImportError
        Without scipy.
    """
    require_number("smoothing", tolerance, 0.0, 1e-3)
    try:
        from scipy.interpolate import splev, splprep
    except ImportError as missing:
        raise ImportError("smoothing needs scipy: pip install 'wheelrail-contact[profiles]'") from missing
    u = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))))
    spline, _ = splprep([y, z], u=u, s=y.size * tolerance**2, k=3)
    (y, z), (dy, dz) = splev(u, spline), splev(u, spline, der=1)
    return y, z, np.unwrap(np.arctan2(dz, dy))
