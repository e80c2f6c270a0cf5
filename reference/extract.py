"""Reduce CONTACT's results to the reference files of `make accuracy` and the tests.

    python reference/extract.py DIRECTORY

DIRECTORY holds sets A_hertz_creep, B_hertz_fields and D_nonhertz_gap, computed with CONTACT 25.1 (rev 2707, Apache-2.0,
github eve70a/CONTACT). The text files have five significant digits. They contain all of set A, with CONTACT's own fast methods
and its half-space solution; every third element in both directions of the traction fields of set B; the gaps, the forces and
every second element in both directions of the pressure of set D.
"""

import csv
import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
PROVENANCE = "computed with CONTACT 25.1 (rev 2707, Apache-2.0)"
METHODS = (
    "fastsim_1flx_par",
    "fastsim_3flx_par",
    "fastsim_3flx_ell",
    "fastrip_orig",
    "fastrip_fullslid",
    "fastrip_modf",
)
PAIRS = ("contactN_fastsim", "contactN_fastripmod", "kpec_fastsim", "analyn_fastsim", "analyn_fastripmod")


def digits(values: object, n: int = 5) -> list:
    """Return nested lists of numbers with n significant digits, whole numbers as integers."""
    if np.ndim(values) > 0:
        return [digits(v, n) for v in np.asarray(values)]
    number = float(f"{float(values):.{n}g}")
    return int(number) if number == int(number) else number


def ellipses(source: Path) -> None:
    with open(source / "A_hertz_creep" / "hertz_creep.csv") as file:
        rows = list(csv.DictReader(file))
    columns = ["curve", "aob", "xi", "eta", "phi"]
    columns += [f"{what}_{m}" for m in ("contact", *METHODS) for what in ("fx", "fy", "mz", "adh")]
    with open(HERE / "ellipses.csv", "w") as file:
        file.write(
            f"# Creep forces on ellipses, {PROVENANCE}. N = 52359.88 N, mu = 0.3, G = 82 GPa, nu = 0.28, sqrt(ab) = 5 mm, "
            "p0 = 1 GPa;\n# spin in 1/mm; fx, fy over mu N, mz over mu N sqrt(ab), adh = adhesion area over contact area.\n"
        )
        file.write(",".join(columns) + "\n")
        for row in rows:
            cells = [row["curve"], repr(float(f"{float(row['aob']):.10g}"))]
            cells += [f"{float(row[c]):.8g}" for c in columns[2:5]] + [f"{float(row[c]):.5g}" for c in columns[5:]]
            file.write(",".join(cells) + "\n")


def fields(source: Path) -> None:
    cases = []
    for path in sorted((source / "B_hertz_fields").glob("*.npz")):
        data = np.load(path, allow_pickle=True)
        every = np.s_[1::3, 1::3]
        cases.append(
            {
                "name": path.stem,
                **{k: float(data[k]) for k in ("N", "mu", "nu", "G", "aa", "bb", "xi", "eta", "phi")},
                "x": digits(data["x"][1::3], 8),
                "y": digits(data["y"][1::3], 8),
                "qx": digits(data["px"][0][every], 4),
                "qy": digits(data["py"][0][every], 4),
                "error_contact_fastrip": {
                    name: digits(
                        np.sqrt(((data["px"][k] - data["px"][0]) ** 2 + (data["py"][k] - data["py"][0]) ** 2).sum())
                        / np.sqrt((data["px"][0] ** 2 + data["py"][0] ** 2).sum())
                    )
                    for k, name in ((4, "original"), (6, "modified"))
                },
            }
        )
    about = f"Traction fields on ellipses, {PROVENANCE}; mm, N, 1/mm; [iy][ix], every third element of 66 x 66"
    (HERE / "fields.json").write_text(json.dumps({"about": about, "cases": cases}, separators=(",", ":")) + "\n")


def patches(source: Path) -> None:
    cases = []
    for path in sorted((source / "D_nonhertz_gap").glob("*.npz")):
        data = np.load(path, allow_pickle=True)

        def forces(name: str, data: dict = data) -> dict:
            return {
                **{k: digits(data[f"{k}_{name}"], 6) for k in ("Fx", "Fy", "Mz")},
                **{k: digits(np.ravel(data[f"{k}_{name}"])[0], 6) for k in ("N", "area", "pmax")},
            }

        full = data["pn_contact"]
        cases.append(
            {
                "name": path.stem,
                "y": digits(data["y_gap"], 8),
                "g": digits(data["g"], 8),
                "A": digits(data["A"], 8),
                "delta": float(data["delta"]),
                "states": [str(s) for s in data["state_names"]],
                **{k: digits(data[k], 8) for k in ("xi", "eta", "phi")},
                "contact": forces("contact"),
                "fast": {name: forces(name) for name in PAIRS},
                "pressure_error": {
                    name: digits(np.linalg.norm(data[f"pn_{name}"] - full) / np.linalg.norm(full))
                    for name in ("kpec", "analyn")
                },
                "x_p": digits(data["x"][::2], 6),
                "y_p": digits(data["y"][::2], 6),
                "p": digits(full[::2, ::2], 4),
            }
        )
    about = (
        f"S1002 on UIC60, gap z = A x^2 + g(y) at a prescribed approach, {PROVENANCE}; mm, N, MPa, 1/mm; mu = 0.3, "
        "G = 82 GPa, nu = 0.28; p[iy][ix] every second element of the 0.2 mm grid"
    )
    (HERE / "patches.json").write_text(json.dumps({"about": about, "cases": cases}, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    for extract in (ellipses, fields, patches):
        extract(Path(sys.argv[1]))
