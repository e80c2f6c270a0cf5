"""Print how long the first solution takes with empty and with filled caches, for a method of every family (`make bench`).

    python benchmarks/compile_times.py

Each row is a new process with a cache of its own. Processor time, import included.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

import contact
from benchmarks.tables import table

FIRST = """
import sys, time
import contact
normal, tangential = sys.argv[1:]
separation = contact.Separation.hertzian(1.1, 0.8)
contact.solve(separation, contact.Creepage(1e-3, 0.0, 0.1), load=80e3, normal=normal, tangential=tangential)
print(time.process_time())
"""


def first_solution(normal: str, tangential: str, cache: str) -> float:
    """Return the processor time [s] of a process that solves one contact."""
    command = [sys.executable, "-c", FIRST, normal, tangential]
    done = subprocess.run(
        command, env={**os.environ, "NUMBA_CACHE_DIR": cache}, check=True, stdout=subprocess.PIPE, text=True
    )
    return float(done.stdout)


def main() -> None:
    """Print the table."""
    methods = contact.methods().batched
    one_of = [{m.family: name for name, m in kind.items()} for kind in (methods.normal, methods.tangential)]
    pairs = [("analyn", "fastrip"), ("strip_halfspace", "fastrip_mapped")]
    pairs += [(normal, "fastrip") for normal in one_of[0].values()]
    pairs += [("hertz", tangential) for tangential in one_of[1].values()]
    rows = []
    for pair in dict.fromkeys(pairs):
        with tempfile.TemporaryDirectory() as cache:
            empty, filled = first_solution(*pair, cache), first_solution(*pair, cache)
        rows.append([f"`{pair[0]}` + `{pair[1]}`", f"{empty:.1f} s", f"{filled:.2f} s"])
    print(table(["first solution", "empty cache", "filled cache"], rows))


if __name__ == "__main__":
    main()
