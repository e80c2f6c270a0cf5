"""The undeformed gap between wheel and rail, the only geometry that the normal problem needs."""

from __future__ import annotations

from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import as_array
from contact.core import Packed
from contact.errors import ContactError
from contact.inputs.options import CURVATURE, LEAST_STEP, LENGTH, ROLLING, TILT, Real
from contact.inputs.plausibility import doubt_value
from contact.kernels.arrays import Samples
from contact.kernels.separation import HERTZIAN_POINTS, fill_hertzian
from contact.view.notebook import Sketch

#: Notebooks show the gap up to this height above its minimum [mm].
SKETCHED = 2.0


class Separation:
    """Undeformed distance z(x, y) = A(y)·(x - x_c(y))² + g(y) of the bodies at first touch.

    Parameters
    ----------
    y : array_like, shape (n,), n >= 3
        Lateral coordinate in the contact plane [m], strictly increasing.
    g : array_like, shape (n,)
        Undeformed gap on the contact locus [m]. The approach is measured from g = 0.
    A : array_like, shape (n,) or float
        Half curvature along the rolling direction [1/m], positive: cos(contact angle)/(2·rolling radius).
    x_c : array_like, shape (n,) or float
        Longitudinal position of the contact locus [m]. It differs from 0 under yaw.
    tilt : array_like, shape (n,) or float
        Slope dz/dy of the curved contact surface against the contact plane [-], within ±1e3. z points from the wheel into
        the rail. Only `contact.solve(conformal=True)` uses it.
    rolling : float
        Rotation of the wheel about the y axis of the plane per metre rolled [1/m], within ±1e3: cos(contact angle)/rolling
        radius. Only `contact.solve(conformal=True)` uses it.

    Raises
    ------
    ContactError
        For wrong shapes, values that are not finite, y not increasing, A not positive, or tilt or rolling outside their
        range.

    Warns
    -----
    PlausibilityWarning
        For a half curvature or a width that no wheel on a rail has, as from lengths in mm.

    Examples
    --------
    >>> import contact
    >>> import numpy as np
    >>> y = np.linspace(-0.02, 0.02, 81)
    >>> gap = contact.Separation(y, 0.8 * y**2, 1.1)  # two parabolas; `hertzian` makes the same
    >>> round(contact.solve(gap, contact.Creepage(), load=80e3).max_pressure / 1e6)
    893
    """

    __slots__ = ("A", "fit_error", "g", "packed", "rolling", "samples", "tilt", "told", "x_c", "y")

    y: NDArray[np.float64]
    g: NDArray[np.float64]
    A: NDArray[np.float64]
    x_c: NDArray[np.float64]
    tilt: NDArray[np.float64]
    rolling: float
    samples: Samples  # the arrays as kernels use them
    packed: Packed  # the same as the library takes them
    told: set[str]  # for what there was a ModelWarning; those of a pair share it
    fit_error: float  # of the parabolas along x, which a search knows (`contact.kernels.records`: `fit_error`)

    def __init__(
        self,
        y: ArrayLike,
        g: ArrayLike,
        A: ArrayLike,
        x_c: ArrayLike = 0.0,
        tilt: ArrayLike = 0.0,
        rolling: float = 0.0,
    ) -> None:
        self.y = _column("y", y, None)
        n = self.y.size
        if n < 3:
            raise ContactError(f"y has {n} points; at least 3 are needed")
        steps = np.diff(self.y)
        if not steps.min() >= LEAST_STEP:
            i = int(np.argmin(steps))
            raise ContactError(
                f"y must increase, by {LEAST_STEP:g} at least; y[{i}] = {self.y[i]:g}, y[{i + 1}] = {self.y[i + 1]:g}"
            )
        self.g = _column("g", g, n)
        self.A = _column("A", A, n, CURVATURE)
        self.x_c = _column("x_c", x_c, n)
        self.tilt = _column("tilt", tilt, n, TILT)
        self.rolling = ROLLING.require("rolling", rolling)
        doubt_value("A", float(self.A[n // 2]))
        doubt_value("extent of y", float(self.y[-1] - self.y[0]))
        self._lay_out()

    @classmethod
    def hertzian(cls, A: float, B: float) -> Separation:
        """Return the separation z = A·x² + B·y² with half curvatures `A`, `B` [1/m], sampled up to a gap of 1 mm or more.

        The interpolation between the samples reproduces the parabola exactly, so a patch of any size is resolved.
        """
        A, B = CURVATURE.require("A", A), CURVATURE.require("B", B)
        y, g = np.empty(HERTZIAN_POINTS), np.empty(HERTZIAN_POINTS)
        fill_hertzian(A, B, y, g)
        return cls(y, g, A)

    def with_gap(self, g: ArrayLike, A: ArrayLike) -> Separation:
        """Return a copy with another gap `g` [m] and half curvature `A` [1/m] at the same `y`."""
        other = object.__new__(type(self))
        other.y, other.x_c, other.tilt, other.rolling = self.y, self.x_c, self.tilt, self.rolling
        other.g, other.A = _column("g", g, self.y.size), _column("A", A, self.y.size, CURVATURE)
        other._lay_out()
        return other

    def _lay_out(self) -> None:
        """Make the arrays read-only and set `samples`, `packed`, `told` and `fit_error`."""
        self.told, self.fit_error = set(), 0.0
        self.samples = Samples(self.y, self.g, self.A, self.x_c, self.tilt)
        for array in self.samples:
            array.setflags(write=False)
        self.packed = Packed(Samples, self.samples)

    def __getstate__(self) -> tuple[Any, ...]:
        return self.y, self.g, self.A, self.x_c, self.tilt, self.rolling, self.fit_error

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self.y, self.g, self.A, self.x_c, self.tilt, self.rolling, *more = state
        self._lay_out()
        self.fit_error = more[0] if more else 0.0  # pickles of version 0.8 have none

    def _repr_html_(self) -> str:
        """Return HTML with a sketch of the gap near its minimum, for a notebook."""
        height = 1e3 * (self.g - self.g.min())
        near = np.flatnonzero(height <= max(SKETCHED, float(np.sort(height)[2])))
        first, last = max(int(near[0]) - 1, 0), min(int(near[-1]) + 2, height.size)
        y, height = 1e3 * self.y[first:last], np.minimum(height, SKETCHED)[first:last]
        top = float(height.max())
        drawn = Sketch((y[0], y[-1]), (0.0, top), ("y [mm]", "gap above its least value [mm]"), "gap of the separation")
        drawn.area(np.r_[y[0], y, y[-1]], np.r_[top, height, top])
        return f"{drawn.svg()}<div>{escape(repr(self))}</div>"

    def __repr__(self) -> str:
        return f"Separation({self.y.size} points, y = {self.y[0]:g} … {self.y[-1]:g} m, least gap {self.g.min():g} m)"


def _column(name: str, values: ArrayLike, n: int | None, limits: Real = LENGTH) -> NDArray[np.float64]:
    """Return a float64 copy of `values` with length `n`, within the limits. A scalar is repeated."""
    array = as_array(name, values)
    if array.ndim == 0 and n is not None:
        array = np.full(n, float(array))
    if array.ndim != 1 or (n is not None and array.size != n):
        wanted = "(n,)" if n is None else f"({n},)"
        raise ContactError(f"{name} has shape {array.shape}; {wanted} is needed")
    if not np.isfinite(array).all():
        i = int(np.argmin(np.isfinite(array)))
        raise ContactError(f"{name}[{i}] = {array[i]} is not finite")
    for i in (int(array.argmin()), int(array.argmax())) if array.size else ():
        if not limits.least <= array[i] <= limits.most:
            limits.require(f"{name}[{i}]", array[i])
    return array
