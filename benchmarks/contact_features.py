"""Features beside steady rolling against CONTACT 25.1: docs/contact_features.md.

    python benchmarks/contact_features.py FOLDER [--write docs/contact_features.md]

FOLDER has the reference sets (G_subsurface, …), which are not part of the repository. CONTACT's tractions and forces act on the
rail, ours on the wheel. Times are process times, the least of several runs in one thread.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.tables import table
from contact.stress import SurfaceLoad, below, largest

Row = list[str]


def least(task: Callable[[], Any], runs: int = 3) -> float:
    """Return the least process time [ms]."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        task()
        times.append(time.process_time() - start)
    return 1e3 * min(times)


def summary(name: str, errors: Any, unit: str) -> Row:
    """Return a row: name, count, mean, 95 % and largest of the absolute errors, unit."""
    e = np.abs(np.asarray(errors, dtype=np.float64)).ravel()
    return [name, str(e.size), *(f"{v:.1e}" for v in (e.mean(), np.quantile(e, 0.95), e.max())), unit]


def subsurface(folder: Path) -> Iterator[Row]:
    """Set G: all stresses at all points, from CONTACT's tractions."""
    errors, mises, peaks = [], [], []
    for path in sorted((folder / "G_subsurface").glob("*.npz")):
        d = np.load(path)
        load = SurfaceLoad(d["x"] * 1e-3, d["y"] * 1e-3, d["pn"] * 1e6, -d["px"] * 1e6, -d["py"] * 1e6)
        z = d["zs"] * 1e-3
        field = below(load, z, margin=0.0)
        rows, columns = (np.abs(a[:, None] - b).argmin(axis=0) for a, b in ((d["y"], d["ys"]), (d["x"], d["xs"])))
        at = np.ix_(np.arange(z.size), rows, columns)
        top = float(d["sigvm_max"])
        names = "xx", "yy", "zz", "xy", "xz", "yz"
        errors += [(1e-6 * getattr(field, name)[at] - d[f"s{name}"]).ravel() / top for name in names]
        mises.append((1e-6 * field.von_mises[at] - d["sigvm"]).ravel() / top)
        peaks.append(1e-6 * field.von_mises[at].max() / top - 1.0)
    unit = "largest von Mises stress"
    yield summary("G: stress components", np.concatenate(errors), unit)
    yield summary("G: von Mises stress", np.concatenate(mises), unit)
    yield summary("G: largest von Mises stress at CONTACT's points", peaks, unit)


def times_subsurface() -> Iterator[Row]:
    """Stresses below 44 × 44 elements."""
    s = (np.arange(44) + 0.5) / 22.0 - 1.0
    load = SurfaceLoad(5e-3 * s, 5e-3 * s, 1e9 * np.sqrt(np.maximum(1.0 - s**2 - s[:, None] ** 2, 0.0)))
    z = np.linspace(0.0, 10e-3, 16)
    yield ["stresses at 16 depths, 44 × 44 elements", f"{least(lambda: below(load, z, margin=0.0)):.0f}"]
    yield ["largest von Mises stress, its place and depth", f"{least(lambda: largest(load)):.0f}"]


PARTS: tuple[Callable[[Path], Iterator[Row]], ...] = (subsurface,)
TIMES: tuple[Callable[[], Iterator[Row]], ...] = (times_subsurface,)

TEXT = """# CONTACT's features

`benchmarks/contact_features.py` writes this page. The reference is CONTACT 25.1 (rev 2707, Apache-2.0) with the same inputs.
The table has absolute errors: their mean, the value that 95 % do not exceed, and the largest.

{errors}
## Time

Process time in one thread on a shared machine, the least of several runs.

{times}"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="folder of the reference sets")
    parser.add_argument("--write", type=Path, help="write the report also to this file")
    arguments = parser.parse_args()
    rows = [row for part in PARTS for row in part(arguments.folder)]
    text = TEXT.format(
        errors=table(["set and quantity", "values", "mean", "95 %", "largest", "unit"], rows),
        times=table(["task", "time [ms]"], [row for part in TIMES for row in part()]),
    )
    print(text)
    if arguments.write:
        arguments.write.write_text(text)


if __name__ == "__main__":
    main()
