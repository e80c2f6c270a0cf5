"""Times of a task."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any


def least(
    task: Callable[[], Any],
    runs: int,
    *,
    before: Callable[[], Any] = lambda: None,
    clock: Callable[[], float] = time.process_time,
) -> float:
    """Return the least time [ms] of a task, by default of the processor; `before` each run something is called."""
    times = []
    for _ in range(runs):
        before()
        start = clock()
        task()
        times.append(clock() - start)
    return 1e3 * min(times)
