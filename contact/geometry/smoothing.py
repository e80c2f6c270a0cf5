"""Smoothing of measured profiles by a cubic spline within a tolerance of the points."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, optional, require_number


def _interpolate() -> Any:
    return optional("scipy.interpolate", "smoothing needs", "profiles")


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
    scipy, u = _interpolate(), _chords(y, z)
    try:
        spline, _ = scipy.splprep([y, z], u=u, s=y.size * tolerance**2, k=3)
    except (TypeError, ValueError, OverflowError) as error:
        raise ContactError(f"smoothing = {tolerance:g}: no spline was found through these points: {error}") from None
    (y, z), (dy, dz) = scipy.splev(u, spline), scipy.splev(u, spline, der=1)
    return y, z, np.unwrap(np.arctan2(dz, dy))


def filtered(y: Array, z: Array, wavelength: float) -> tuple[Array, Array, Array]:
    """Return points and tangents of the cubic spline in which waves of `wavelength` along the profile have half their height.

    The spline minimises ∫ (distance)² ds + λ ∫ (second derivative)² ds for y and z over the chord length s. A wave of length
    L keeps the share 1/(1 + (wavelength/L)⁴), so λ = (wavelength/2π)⁴, whatever the spacing of the points.

    Parameters
    ----------
    y, z : ndarray, shape (n,), n >= 5
        Measured points [m].
    wavelength : float
        [m], 1e-4 ... 0.05.

    Returns
    -------
    y, z, angle : ndarray, shape (n,)
        The spline at the points' chord lengths [m], and the angle of its tangent [rad].

    Raises
    ------
    ContactError
        If the wavelength is outside its range, or there are fewer than five points.
    ImportError
        If scipy is not installed.
    """
    require_number("wavelength", wavelength, 1e-4, 0.05)
    _require_several(f"wavelength = {wavelength:g}", y)
    s = _chords(y, z)
    return _spline(y, z, s / wavelength, np.gradient(s) / wavelength, (0.5 / np.pi) ** 4)


def penalised(y: Array, z: Array, penalty: float) -> tuple[Array, Array, Array]:
    """Return points and tangents of the cubic smoothing spline of Reinsch (1967), as CONTACT has it.

    It minimises Σ (distance)² + penalty ∫ (second derivative)² ds for y and z over the chord length s, so it smooths more
    where the points are further apart; `filtered` does not.

    Parameters
    ----------
    y, z : ndarray, shape (n,), n >= 5
        Measured points [m].
    penalty : float
        [m³], at least 0.

    Returns
    -------
    y, z, angle : ndarray, shape (n,)
        The spline at the points' chord lengths [m], and the angle of its tangent [rad].

    Raises
    ------
    ContactError
        If the penalty is negative, or there are fewer than five points.
    ImportError
        If scipy is not installed.
    """
    require_number("penalty", penalty, 0.0)
    _require_several(f"penalty = {penalty:g}", y)
    s = _chords(y, z)
    unit = float(s[-1]) / (y.size - 1)  # the mean spacing
    return _spline(y, z, s / unit, None, penalty / unit**3)


def _require_several(given: str, y: Array) -> None:
    if y.size < 5:
        raise ContactError(f"{given}: {y.size} points are too few to smooth; at least 5 are needed")


def _spline(y: Array, z: Array, u: Array, weights: Array | None, penalty: float) -> tuple[Array, Array, Array]:
    """Return points and tangents of the smoothing spline over `u`, lengths near 1: scipy looks at absolute numbers."""
    splines = [_interpolate().make_smoothing_spline(u, values, weights, lam=penalty) for values in (y, z)]
    dy, dz = (spline.derivative()(u) for spline in splines)
    return splines[0](u), splines[1](u), np.unwrap(np.arctan2(dz, dy))


def _chords(y: Array, z: Array) -> Array:
    """Return the length of the chords up to each point [m]."""
    return np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))))
