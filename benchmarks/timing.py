"""Processor times of a task."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any


def least(task: Callable[[], Any], runs: int) -> float:
    """Return the least process time [ms]."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        task()
        times.append(time.process_time() - start)
    return 1e3 * min(times)
