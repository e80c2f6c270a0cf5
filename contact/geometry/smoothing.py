"""Smoothing of measured profiles by a cubic spline within a tolerance of the points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, require_number

Array = NDArray[np.float64]


def smoothed(y: Array, z: Array, tolerance: float) -> tuple[Array, Array, Array]:
    """Return points and tangents of the smoothest cubic spline within `tolerance` of the given points.

    The spline is (y, z) over the chord length. It is Dierckx' smoothing spline (FITPACK): it has as few knots, and as small
    jumps of the third derivative, as the tolerance allows.

    Parameters
    ----------
    y, z : ndarray, shape (n,), n >= 4
        Measured points [m].
    tolerance : float
        Root mean square of the distances by which the points may move [m], 0 ... 1e-3. Use the noise of the measurement.

    Returns
    -------
    y, z, angle : ndarray, shape (n,)
        The spline at the points' chord lengths [m], and the angle of its tangent [rad].

    Raises
    ------
    ContactError
        If the tolerance is outside its range, or no spline can be laid through the points.
    ImportError
        If scipy is not installed.
    """
    require_number("smoothing", tolerance, 0.0, 1e-3)
    try:
        from scipy.interpolate import splev, splprep
    except ImportError as missing:
        raise ImportError("smoothing needs scipy: pip install 'wheelrail-contact[profiles]'") from missing
    u = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))))
    try:
        spline, _ = splprep([y, z], u=u, s=y.size * tolerance**2, k=3)
    except (TypeError, ValueError) as error:
        raise ContactError(f"smoothing = {tolerance:g}: no spline was found through these points: {error}") from None
    (y, z), (dy, dz) = splev(u, spline), splev(u, spline, der=1)
    return y, z, np.unwrap(np.arctan2(dz, dy))
