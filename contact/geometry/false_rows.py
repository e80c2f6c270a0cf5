"""False and missing rows of a scan: what a device writes for "nothing seen", like 0 0, -999 -999, NaN or an empty cell.

They are dropped before anything else looks at the points. Measures are relative to the profile, in whatever unit it is.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]  # shape (n, 2): y, z
Mask = NDArray[np.bool_]

_BEYOND = 1.5  # extents of the other points: a value farther from them is no coordinate
_SPREADS = 8.0  # quartile ranges from the median: the same for values that differ
_JUMP, _OVER_SPACING = 0.05, 4.0  # least step to a false point, over the extent and over the median step
_RETURN = 0.25  # greatest distance of the points around over the two steps to a false point and back
_RETURN_OF_CODE = 0.7  # the same for zeros and repeated values
_FEW, _SHARE, _SHARE_AT_END = 3, 0.05, 0.02  # points beside the profile that may be false together
_SHARE_OF_ZEROS = 0.25  # of the points that may be false in one run with 0 in a column
_SHARE_REPEATED = 0.1  # of the points that may stand at several places
_MOST_AT_ENDS = 4  # jumps of a scan that may all lead to false points at its ends; drawings of long lines have more
_TOGETHER = 3  # unlike false points beside each other
_MOST_ROUNDS = 100
_END = 0.4  # of the extent: a step this long to an end of the scan is no gap


def false_rows(points: Points) -> Mask:
    """Return which rows are no points of the profile that the others lie on. A row without a value has NaN."""
    false: Mask = np.asarray(~np.isfinite(points).all(axis=1))
    for find in (_spread, _far, _spread, _repeated, _aside, _zeros):
        for _ in range(_MOST_ROUNDS):
            there = np.flatnonzero(~false)
            found = find(points[there]) if there.size > 7 else np.zeros(0, dtype=bool)
            if not found.any():
                break
            false[there[found]] = True
    return false


def _extent(points: Points) -> float:
    return float(np.hypot(*np.ptp(points, axis=0))) if len(points) else 0.0


def _far(points: Points) -> Mask:
    """Return the rows with the one value that lies farthest beyond all others, if it is too far; however many have it."""
    best, found = _BEYOND, np.zeros(len(points), dtype=bool)
    for column in points.T:
        values = np.unique(column)
        if values.size < 3:
            continue
        for value, other in ((values[0], values[1]), (values[-1], values[-2])):
            rows = column == value
            extent = _extent(points[~rows])
            if abs(value / 2.0 - other / 2.0) > best * extent / 2.0 and extent > 0.0:
                best, found = abs(value / 2.0 - other / 2.0) / (extent / 2.0), rows
    return found


def _spread(points: Points) -> Mask:
    """Return the rows far from the middle half of the points."""
    low, middle, high = np.quantile(points, (0.25, 0.5, 0.75), axis=0)
    return np.asarray((np.abs(points - middle) > _SPREADS * max((high - low).max(), 1e-300)).any(axis=1))


def _repeated(points: Points) -> Mask:
    """Return the rows with a point that stands at several places of the scan, if few points do."""
    found = np.zeros(len(points), dtype=bool)
    changes = np.concatenate(([True], np.diff(points, axis=0).any(axis=1)))
    _, of_row, times = np.unique(points, axis=0, return_inverse=True, return_counts=True)
    places = np.zeros(times.size, dtype=int)
    np.add.at(places, of_row.reshape(-1)[changes], 1)
    if (points[0] == points[-1]).all():  # a closed outline
        places[of_row.reshape(-1)[0]] -= 1
    again = (places > 1)[of_row.reshape(-1)]
    if 0 < np.count_nonzero(again & changes) < _SHARE_REPEATED * np.count_nonzero(changes):
        step = np.concatenate(([np.inf], np.hypot(*np.diff(points, axis=0).T), [np.inf]))
        far = _least_jump(points)
        for a, b in _runs(again):
            found[a:b] = step[a] > far and step[b] > far
    return found


def _aside(points: Points) -> Mask:
    """Return the points to which a scan jumps and from which it comes back: those that are clearest of it, or at its ends."""
    n = len(points)
    found = np.zeros(n, dtype=bool)
    cuts = np.flatnonzero(np.hypot(*np.diff(points, axis=0).T) > _least_jump(points)) + 1
    if not 0 < cuts.size < n // 3:
        return found
    bounds = [0, *cuts.tolist(), n]
    few, usual = max(_FEW, int(_SHARE * n)), _usual_step(points)
    ranked = []
    for k in range(1, len(bounds) - 2):
        for m in range(1, min(_TOGETHER, len(bounds) - 2 - k) + 1):
            a, b = bounds[k], bounds[k + m]
            most = few if m == 1 else _FEW
            if m == 1 and (points[a:b] == 0.0).all(axis=0).any():
                most = int(_SHARE_OF_ZEROS * n)
            if b - a > n // 2 or _unlike(points[a:b]) > most:
                break
            code = _code(points[a:b], usual)
            detour = _detour(points[a - 1], points[a:b], points[b], code)
            if detour < 1.0:
                ranked.append((m, not code, detour, k, a, b))
    free = np.ones(len(bounds) + 1, dtype=bool)
    for m, _, _, k, a, b in sorted(ranked):  # zeros first: good points between two false ones look aside too
        if free[k - 1 : k + m + 1].all():
            free[k : k + m] = False
            found[a:b] = True
    if not found.any() and cuts.size <= _MOST_AT_ENDS:
        few = max(_FEW, int(_SHARE_AT_END * n))
        for end, rest in ((slice(0, bounds[1]), slice(bounds[1], n)), (slice(bounds[-2], n), slice(0, bounds[-2]))):
            nearest = points[end][::-1] if end.start == 0 else points[end]
            scan = points[rest] if end.start == 0 else points[rest][::-1]
            zeros = (nearest == 0.0).all(axis=0).any()
            if _unlike(nearest) <= (_SHARE_OF_ZEROS * n if zeros else few) < len(scan) and _beside(
                nearest, scan, usual
            ):
                found[end] = True
    return found


def _least_jump(points: Points) -> float:
    """Return the length from which on a step may lead to a false point."""
    return max(_JUMP * _extent(points), _OVER_SPACING * _usual_step(points))


def _usual_step(points: Points) -> float:
    step = np.hypot(*np.diff(points, axis=0).T)
    return float(np.median(step[step > 0.0])) if (step > 0.0).any() else 0.0


def _runs(rows: Mask) -> list[tuple[int, int]]:
    """Return start and end of every run of true values."""
    padded = np.concatenate(([False], rows, [False]))
    edges = np.flatnonzero(padded[1:] != padded[:-1])
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def _unlike(points: Points) -> int:
    """Return the number of points, of equal neighbours one."""
    return 1 + int(np.count_nonzero(np.diff(points, axis=0).any(axis=1)))


def _code(points: Points, usual: float) -> bool:
    """Return whether one of the coordinates is 0, or the same in rows that lie apart as `usual` or less."""
    near = len(points) > 1 and np.hypot(*np.diff(points, axis=0).T).max() <= _OVER_SPACING * usual
    return bool((points == 0.0).all(axis=0).any() or (near and (np.ptp(points, axis=0) == 0.0).any()))


def _detour(before: Points, points: Points, after: Points, code: bool) -> float:
    """Return the distance of the points around over the way by the points between, over what it may be: below 1 is false."""
    way = np.hypot(*(points[0] - before)) + np.hypot(*(after - points[-1]))
    return float(np.hypot(*(after - before)) / way) / (_RETURN_OF_CODE if code else _RETURN)


def _beside(end: Points, scan: Points, usual: float) -> bool:
    """Return whether the few points `end` before a scan, the nearest first, do not lead it on."""
    step = end[0] - scan[0]
    back = (scan[min(5, len(scan) - 1)] - scan[0]) @ step > 0.0
    return bool(back or _code(end, usual) or np.hypot(*step) > _END * _extent(scan))


def _zeros(points: Points) -> Mask:
    """Return runs with 0 in a column to which the scan turns back, and from which it turns back again."""
    n = len(points)
    found = np.zeros(n, dtype=bool)
    least = 1.2 * _usual_step(points)
    for column in points.T:
        for a, b in _runs(column == 0.0):
            if a > 0 and b < n and b - a <= max(_FEW, _SHARE_OF_ZEROS * n) and not np.ptp(points[a:b], axis=0).all():
                there, back = points[a] - points[a - 1], points[b] - points[b - 1]
                far = min(np.hypot(*there), np.hypot(*back)) > least or b - a > 1 or not points[a:b].any()
                found[a:b] |= bool(far and there @ back < 0.0)
    return found
