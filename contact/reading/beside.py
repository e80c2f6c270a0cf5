"""A second profile beside the first in the rows of a file."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def second_profile(rows: Sequence[Sequence[float | None]], chosen: tuple[int, int]) -> tuple[int, int] | None:
    """Return the columns, from 1, of a second profile beside the chosen one: another y with its z, or another z."""
    n = max(3, sorted(map(len, rows))[len(rows) // 2] if rows else 0)
    whole = np.array([row for row in rows if len(row) == n and None not in row], dtype=np.float64).reshape(-1, n)
    whole = whole[np.isfinite(whole).all(axis=1)]
    if len(whole) < 8:
        return None
    away = np.abs(whole[:, chosen[0]] - np.median(whole[:, chosen[0]]))
    whole = whole[away <= 6.0 * np.median(away)]  # without rows like -999 -999 -999
    deviation = whole - whole.mean(axis=0)
    covariance = np.abs(deviation.T @ deviation)
    size = np.sqrt(np.diag(covariance))

    def is_like(k: int, of: int) -> bool:
        """Whether a column runs like another one. The angle of a rail has a correlation of .92 with y."""
        return bool(0.4 * size[of] < size[k] < 2.5 * size[of] and covariance[k, of] > 0.97 * size[k] * size[of])

    y, z = chosen
    for k in range(z + 1, n):
        if k + 1 < n and is_like(k, y):
            return k + 1, k + 2
        if is_like(k, z):
            return y + 1, k + 1
    return None
