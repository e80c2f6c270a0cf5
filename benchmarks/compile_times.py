"""Print how long building the library takes, and the first solution by a method of every family (`make bench`).

    python benchmarks/compile_times.py

Each row is a new process. Processor time, import included.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile

import contact
from benchmarks.tables import table

FIRST = """
import sys
import contact
normal, tangential = sys.argv[1:]
separation = contact.Separation.hertzian(1.1, 0.8)
contact.solve(separation, contact.Creepage(1e-3, 0.0, 0.1), load=80e3, normal=normal, tangential=tangential)
"""


def first_solution(normal: str, tangential: str, **environment: str) -> float:
    """Return the processor time [s] of a process that solves one contact, and of the processes that it starts."""
    command = [sys.executable, "-c", FIRST, normal, tangential]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, env=os.environ | environment, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Print the table."""
    methods = contact.methods().batched
    one_of = [{m.family: name for name, m in kind.items()} for kind in (methods.normal, methods.tangential)]
    pairs = [("strip_halfspace", "fastrip_mapped"), ("analyn", "fastrip")]
    pairs += [(normal, "fastrip") for normal in one_of[0].values()]
    pairs += [("hertz", tangential) for tangential in one_of[1].values()]
    rows = [[f"`{n}` + `{t}`", f"{first_solution(n, t):.2f} s"] for n, t in dict.fromkeys(pairs)]
    with tempfile.TemporaryDirectory() as cache:
        took = first_solution(*pairs[0], CONTACT_CACHE_DIR=cache)
        rows.append(["the default with an empty cache: the library is built", f"{took:.0f} s"])
    print(table(["first solution of a new process", "processor time"], rows))


if __name__ == "__main__":
    main()
