"""Dang Van's criterion over one passage of the contact (subsurface.md).

A particle at (y, z) passes the stresses along the line x. Its mesoscopic stress is sigma(t) minus a constant deviator, the
centre of the smallest sphere around the path of the deviator. Fatigue is expected if at any time

    tau(t) + slope·sigma_h(t) > limit,

with tau half the difference of the largest and smallest principal stress of the mesoscopic stress, and sigma_h the
hydrostatic stress, including a constant residual one (Dang Van et al. 1989 [R]; Ekberg et al. 2002 for wheels [R]).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array, brief, require_numbers
from contact.errors import ContactError, require_number
from contact.results import Solution
from contact.stress.field import Peak
from contact.stress.half_space import below
from contact.stress.load import SurfaceLoad

#: Walk to the centre of the smallest sphere: largest number of steps, and what counts as zero.
_MAX_STEPS, _SMALL = 200, 1e-12
_ROOT = np.sqrt(2.0)


@dataclass(frozen=True, slots=True, eq=False)
class DangVan:
    """Dang Van's equivalent stress over the section across the rolling direction; arrays have shape (nz, ny).

    Attributes
    ----------
    y : lateral position [m]
    z : depth below the surface [m]
    equivalent : largest of tau + slope·sigma_h over the passage [Pa]; fatigue is expected above the limit
    amplitude : largest of tau [Pa]
    slope : of the criterion [-]
    body : "rail" or "wheel"
    """

    y: Array
    z: Array
    equivalent: Array
    amplitude: Array
    slope: float
    body: str

    __repr__ = brief

    @property
    def peak(self) -> Peak:
        """Largest equivalent stress [Pa] and its place; x is 0, because every particle passes all x."""
        i, j = (int(k) for k in np.unravel_index(int(np.argmax(self.equivalent)), self.equivalent.shape))
        return Peak(float(self.equivalent[i, j]), 0.0, float(self.y[i, j]), float(self.z[i, j]))


@dataclass(frozen=True, slots=True)
class Endurance:
    """Wöhler line of Dang Van's equivalent stress: N = cycles (limit/τ_DV)^exponent passages to failure (Basquin).

    Parameters
    ----------
    limit : float
        Equivalent stress that is borne `cycles` times [Pa], positive.
    exponent : float
        Positive [-].
    cycles : float
        At least 1 [-].

    There are no defaults: the numbers depend on the steel and on the failure that is meant.

    Raises
    ------
    ContactError
        For a number outside its range.
    """

    limit: float
    exponent: float
    cycles: float

    def __post_init__(self) -> None:
        require_number("endurance.limit", self.limit, 0.0, open_minimum=True)
        require_number("endurance.exponent", self.exponent, 0.0, 100.0, open_minimum=True)
        require_number("endurance.cycles", self.cycles, 1.0)

    def damage(self, equivalent: ArrayLike) -> Array:
        """Return the share of the life that one passage takes [-], for equivalent stresses [Pa]; 0 for those below 0."""
        ratio = np.maximum(require_numbers("equivalent", equivalent), 0.0) / self.limit
        return np.asarray(ratio**self.exponent / self.cycles)


def dang_van(
    load: Solution | SurfaceLoad,
    z: ArrayLike,
    *,
    slope: float = 1.0 / 3.0,
    residual: float = 0.0,
    body: str = "rail",
    poisson_ratio: float | None = None,
    margin: float = 0.5,
) -> DangVan:
    """Return Dang Van's equivalent stress of one passage of a steadily rolling contact.

    Parameters
    ----------
    load, body, poisson_ratio
        As in `contact.stress.at`.
    z : array_like, shape (nz,)
        Depths below the surface [m] ≥ 0.
    slope : float
        Weight of the hydrostatic stress [-], 0 to 3: 3 τ_w/σ_w - 3/2 with the fatigue limits τ_w in alternating torsion and
        σ_w in alternating bending. The default 1/3 is a usual value for wheel steel (recalled).
    residual : float
        Hydrostatic residual stress [Pa], negative in compression.
    margin : float
        The passage begins and ends this share of the grid before and behind it, 0 to 10.

    Returns
    -------
    DangVan
        Compare `equivalent` with the fatigue limit τ_w.

    Raises
    ------
    ContactError
        As `contact.stress.at`, and for numbers outside their range.
    """
    slope = require_number("slope", slope, 0.0, 3.0)
    residual = require_number("residual", residual)
    field = below(load, z, body=body, poisson_ratio=poisson_ratio, margin=margin)
    if field.x.size == 0:
        raise ContactError("z has no depth")
    hydrostatic = field.hydrostatic
    # A vector whose length is that of the deviator as a tensor
    path = np.stack(
        [
            field.xx - hydrostatic,
            field.yy - hydrostatic,
            field.zz - hydrostatic,
            _ROOT * field.xy,
            _ROOT * field.xz,
            _ROOT * field.yz,
        ],
        axis=-1,
    )
    meso = path - centres(path)[..., None, :]
    shear = tuple(meso[..., k] / _ROOT for k in (3, 4, 5))
    rows = (
        (meso[..., 0], shear[0], shear[1]),
        (shear[0], meso[..., 1], shear[2]),
        (shear[1], shear[2], meso[..., 2]),
    )
    principal = np.linalg.eigvalsh(np.stack([np.stack(row, axis=-1) for row in rows], axis=-2))
    tau = 0.5 * (principal[..., 2] - principal[..., 0])
    equivalent = (tau + slope * (hydrostatic + residual)).max(axis=-1)
    return DangVan(field.y[..., 0], field.z[..., 0], equivalent, tau.max(axis=-1), slope, field.body)


def centres(path: Array) -> Array:
    """Return the centres of the smallest spheres around the points of paths, shape (…, dimensions).

    `path` has shape (…, points, dimensions). Each centre walks towards the circumcentre of the points that it touches; it
    stops at the next point it touches, and leaves a point that would be outside the convex hull's weights (Fischer, Gärtner
    and Kutz 2003 [R]). All paths walk at the same time.
    """
    points = path.reshape(-1, *path.shape[-2:])
    paths, _, dimensions = points.shape
    centre = points.mean(axis=1)
    first = ((points - centre[:, None]) ** 2).sum(axis=2).argmax(axis=1)
    touched = np.full((paths, dimensions + 1), -1)
    touched[:, 0] = first
    left = np.arange(paths)  # the paths whose centre still walks
    for _ in range(_MAX_STEPS):
        point, base = points[left], points[left, touched[left, 0]]
        goal, weights = _circumcentre(point, touched[left])
        way = goal - centre[left]
        ahead = 2.0 * np.einsum("pd,pkd->pk", way, base[:, None] - point)
        room = ((centre[left] - base) ** 2).sum(axis=1)[:, None] - ((centre[left][:, None] - point) ** 2).sum(axis=2)
        scale = (way**2).sum(axis=1)[:, None] + 1e-300
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(ahead > _SMALL * scale, np.maximum(room, 0.0) / ahead, np.inf)
        for column in touched[left].T:
            share[np.flatnonzero(column >= 0), column[column >= 0]] = np.inf
        hit = share.argmin(axis=1)
        step = share[np.arange(left.size), hit]
        full = (touched[left] >= 0).all(axis=1)
        stops = (step < 1.0) & ~full
        centre[left] += np.minimum(np.where(full, 1.0, step), 1.0)[:, None] * way
        free = (touched[left] < 0).argmax(axis=1)
        touched[left[stops], free[stops]] = hit[stops]
        least = np.where(touched[left] >= 0, weights, np.inf).argmin(axis=1)
        leaves = ~stops & (weights[np.arange(left.size), least] < -_SMALL)
        _leave(touched, left[leaves], least[leaves])
        left = left[stops | leaves]
        if left.size == 0:
            break
    return centre.reshape(*path.shape[:-2], dimensions)


def _circumcentre(points: Array, touched: NDArray[np.int64]) -> tuple[Array, Array]:
    """Return the circumcentres of the touched points, and the weights of these points; unused places weigh 0."""
    base = np.take_along_axis(points, touched[:, :1, None], axis=1)
    arms = np.take_along_axis(points, np.maximum(touched[:, 1:], 0)[:, :, None], axis=1) - base
    used = touched[:, 1:] >= 0
    arms *= used[:, :, None]
    gram = np.einsum("pid,pjd->pij", arms, arms)
    square = np.einsum("pii->pi", gram).copy()
    size = square.max(axis=1)[:, None] + 1e-300
    k = np.arange(gram.shape[1])
    gram[:, k, k] += np.where(used, _SMALL * size, 1.0)
    weights = np.linalg.solve(gram, 0.5 * square[:, :, None])[:, :, 0]
    centre = base[:, 0] + np.einsum("pi,pid->pd", weights, arms)
    return centre, np.concatenate((1.0 - weights.sum(axis=1, keepdims=True), weights), axis=1)


def _leave(touched: NDArray[np.int64], paths: NDArray[np.int64], places: NDArray[np.int64]) -> None:
    """Remove the point at each of the `places`; the last one takes its place, so the first place stays used."""
    for path, place in zip(paths, places, strict=True):
        last = int((touched[path] >= 0).sum()) - 1
        touched[path, place] = touched[path, last]
        touched[path, last] = -1
