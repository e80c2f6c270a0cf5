"""Several scans in the rows of a profile, and one there and back."""

from __future__ import annotations

import numpy as np

from contact.arrays import Array
from contact.geometry.roughness import Points

JUMP = 0.4  # of the extent: a step this long starts another scan
_OVERLAP = 0.1  # of the narrower of two parts: those of one scan with a gap overlap less
RETURN = 0.2  # share of the points on the way back that makes a backward scan
_ASIDE, _FOLD = 0.1, 8  # of the extent: how far it may lie aside of the way out; points on either side of its turn


def scans(points: Points) -> list[Points]:
    """Return the parts of the points between long jumps back, without parts of one or two points. A jump ahead is a gap."""
    step = np.hypot(*np.diff(points, axis=0).T)
    jumps = np.flatnonzero(step > JUMP * np.hypot(*np.ptp(points, axis=0))) + 1
    found: list[Points] = []
    for part in np.split(points, jumps):
        if len(part) < 3:
            continue
        if found and len(found[-1]) < len(points) and _goes_on(found[-1][:, 0], part[:, 0]):
            found[-1] = np.concatenate((found[-1], part))
        else:
            found.append(part)
    return found or [points]


def _goes_on(before: Array, after: Array) -> bool:
    """Return whether the y of a part lie beyond those of the part before."""
    overlap = min(before.max(), after.max()) - max(before.min(), after.min())
    return bool(overlap <= _OVERLAP * min(np.ptp(before), np.ptp(after)))


def turning(points: Points) -> int:
    """Return the index at which a scan turns and comes back over the way that it went; 0 if it does not."""
    far = int(np.argmax(np.hypot(*(points - points[0]).T)))
    back = len(points) - 1 - far
    returned = np.hypot(*(points[-1] - points[far])) > JUMP * np.hypot(*(points[far] - points[0]))
    if not (returned and back > RETURN * len(points)):
        return 0
    again = points[far :: max(1, back // 50)]
    aside = np.sqrt([((points[: far + 1] - point) ** 2).sum(axis=1).min() for point in again])
    if np.median(aside) > _ASIDE * np.hypot(*np.ptp(points, axis=0)):
        return 0
    most = len(points) // 4
    near = range(max(_FOLD, far - most), min(len(points) - 1 - _FOLD, far + most))
    apart = {k: _apart(points[k - _FOLD : k + _FOLD + 1]) for k in near}
    fold = min(apart, key=apart.__getitem__, default=far)
    return fold if apart.get(fold, 1.0) < 0.5 else far


def _apart(points: Points) -> float:
    """Return how far the points before the middle one lie from those after it, over their way from it: 0 at a fold."""
    middle = len(points) // 2
    before, after = points[:middle][::-1], points[middle + 1 :]
    way = np.abs(before - points[middle]).sum() + np.abs(after - points[middle]).sum()
    return float(np.abs(before - after).sum() / way) if way else 1.0


def length(points: Points) -> float:
    """Return the length of the path through points [m]."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())
