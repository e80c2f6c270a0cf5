"""EN 15302 in docs/check/proof.md."""

from __future__ import annotations

import numpy as np

import reference
from benchmarks.tables import table
from contact.geometry import profile
from contact.geometry.en15302 import conicity

GAUGE = 1.4351645  # [m] of the standard's rail A


def section() -> tuple[str, str]:
    """Return the agreement for the summary, and the text."""
    rows, largest = [], {"2021": 0.0, "2008": 0.0}
    for row in reference.conicities():
        given = [k for k in range(7) if row[str(k + 1)]]
        wanted = np.array([float(row[str(k + 1)]) for k in given])
        right, left = (profile.named(f"wheel {row[side]}") for side in ("right", "left"))
        found = conicity(
            right, profile.named("rail A"), step=1e-4 if row["edition"] == "2008" else 2e-5, left_wheel=left,
            left_radius=float(row["left_radius"]), gauge=GAUGE,
        ).conicity[given]  # fmt: skip
        off = np.abs(found - wanted)
        share = 100.0 * float((off / np.maximum(np.minimum(0.05, 0.5 * wanted), 5e-4)).max())
        largest[row["edition"]] = max(largest[row["edition"]], share)
        pair = f"{row['right']}/{row['left']}" + (" 920/918" if row["left_radius"] == "0.459" else "")
        rows.append([row["edition"], pair, str(len(given)), f"{off.max():.4f}", f"{share:.0f}"])
    text = f"""## Equivalent conicity

EN 15302: reference wheels on rail A, tan γe at amplitudes of 1 to 7 mm, with the standard's tolerance (.05 or half of the
value). Tables of both editions as transcribed in github rohrbecka/EN15302 and criogenox/B_ECC-Equivalent-Conicity-Calculation,
kept in `reference/en15302.csv`. Steps of .02 mm; .1 mm for the edition of 2008, which used them.
[Profiles](../use/profiles.md) has more.

{table(["edition", "right/left wheel", "values", "largest deviation", "largest share of the tolerance [%]"], rows)}
Verdict: all values lie within the tolerance of their edition; at most {largest["2021"]:.0f} % of it (2021) and
{largest["2008"]:.0f} % (2008).
"""
    return f"at most {max(largest.values()):.0f} % of the tolerance", text
