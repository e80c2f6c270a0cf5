"""Run a folder of CONTACT's input files, compare with its printed results, and write the tables of docs/use/from_contact.md.

    make bank BANK=folder     (or: python benchmarks/contact_bank.py FOLDER --write docs/use/from_contact.md)

The folder is the public bank of CONTACT 25.1 or a part of it; it is not part of the repository. Times are process times of one
thread. Without a folder only the table of digits is written, which a test compares with the table of the format.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from pathlib import Path

from benchmarks.tables import fill, read_options
from contact import inp
from contact.errors import ContactError
from contact.inp.digits import digit_table

#: Cases of a file that are run, at most: files without printed results show the time, and a few cases do for that.
_MOST_UNCOMPARED = 50
#: Times of CONTACT [s], built with gfortran -O2 and MKL, one thread, the whole run.
CONTACT_TIMES = {
    "examples/bentall": 5.9,
    "examples/carter2d": 0.06,
    "examples/catt_to_cart": 2.3,
    "examples/cattaneo": 0.02,
    "examples/conformal": 0.25,
    "examples/ertz_temperature": 1.06,
    "examples/fastsim": 1.32,
    "examples/mbench_a22_kpec": 1.44,
    "examples/mbench_a22_left": 1.75,
    "examples/mbench_a22_right": 1.83,
    "examples/mbench_a22_varfric": 3.7,
    "examples/plastic_3bl": 0.15,
    "examples/spence35": 1.5,
    "examples/subsurf": 0.35,
    "examples/tractcurv": 14.6,
    "examples/veldep_fric": 0.60,
    "examples/visc_cylindr": 0.13,
    "examples/wheelflat": 16.7,
    "perfc_test/carter2d_100": 3.1,
    "perfc_test/carter2d_800": 23.5,
    "perfc_test/mbench_100kn_dx05_zpos": 3.9,
}
HEAD = (
    "| file | cases | run | compared | agree | refused | force | pressure | approach | time here [s] | CONTACT [s] |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|\n"
)


def row(path: Path) -> str:
    """Return the row of one file."""
    name = path.stem
    try:
        cases = inp.read(path)
    except ContactError as error:
        return f"| {path.parent.name}/{name} | – | – | – | – | {str(error).split(': ', 1)[-1]} | | | | | |\n"
    reference = path.with_suffix(".ref_out")
    chosen = cases if reference.exists() or len(cases) <= _MOST_UNCOMPARED else cases[:_MOST_UNCOMPARED]
    start = time.process_time()
    results = inp.solve(chosen)
    taken = time.process_time() - start
    reasons = Counter(result.refused for result in results if result.refused)
    told = ", ".join(f"{reason} ({count})" for reason, count in reasons.items())
    ran = sum(not result.refused for result in results)
    compared = agree = 0
    worst = ["", "", ""]
    if reference.exists():
        differences = inp.compare(results, inp.read_printed(reference))
        of_case = inp.worst_of(differences)
        compared, agree = len(of_case), sum(error <= 1e-3 for error in of_case.values())
        groups = (("FN", "FX", "FY", "FX(TR)", "FY(TR)", "FZ(TR)"), ("PMAX",), ("APPROACH",))
        for k, names in enumerate(groups):
            errors = [one.error for one in differences if one.name in names and math.isfinite(one.error)]
            worst[k] = f"{max(errors):.1e}" if errors else ""
    there = CONTACT_TIMES.get(f"{path.parent.name}/{name}")
    whole = len(chosen) == len(cases)
    theirs = "" if there is None or not whole else f"{there:g}"
    shown = f"{len(cases)}" if whole else f"{len(chosen)} of {len(cases)}"
    cells = [
        f"{path.parent.name}/{name}",
        shown,
        ran,
        compared or "",
        agree if compared else "",
        told,
        *worst,
        f"{taken:.2f}",
        theirs,
    ]
    return f"| {' | '.join(map(str, cells))} |\n"


def main() -> None:
    """Write the tables, or print them."""
    given = read_options(__doc__, folder=None, write=Path)
    parts = {"digits": digit_table()}
    if given.folder is not None:
        rows = []
        for path in sorted(given.folder.rglob("*.inp")):
            rows.append(row(path))
            print(rows[-1], end="", flush=True)
        parts["files"] = HEAD + "".join(rows)
    fill(given.write, parts)


if __name__ == "__main__":
    main()
