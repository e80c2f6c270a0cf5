"""The twin discs of docs/check/proof.md."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt

from benchmarks.tables import table
from reference import twin_disc


def section() -> tuple[str, str]:
    """Return the agreement for the summary, and the text."""
    found = twin_disc.rows()
    off = [100.0 * (ours / published - 1.0) for _, _, published, ours in found]
    rows = [
        [f"{slip:g}", f"{heat:g}", f"{published:g}", f"{ours:.3g}", f"{o:+.0f}"]
        for (slip, heat, published, ours), o in zip(found, off, strict=True)
    ]
    text = f"""## Twin disc

Heat and temperature are published (read by an earlier session, issue 35); the sizes are recalled:
discs of {2e3 * twin_disc.RADIUS:g} mm diameter, {1e3 * twin_disc.WIDTH:g} mm wide, {1e-6 * twin_disc.PEAK:g} MPa,
{60 * twin_disc.REVOLUTIONS:g} revolutions per minute.
Ours spreads the published heat like Hertz's pressure over the line contact, in the steel of
[the constants](../understand/constants.md). It tests neither friction nor creep forces.

{table(["slip [%]", "heat [W]", "published [K]", "ours [K]", "difference [%]"], rows)}
![Flash temperature over slip](proof/twin_disc.png)

Verdict: 10 to 20 % too high. The thermal constants and the speed of the source are not known; its ratio of temperature
to heat is not constant either.
"""
    return f"{min(off):+.0f} to {max(off):+.0f} %", text


def draw(path: Path) -> None:
    """Write the picture of both temperatures over the slip."""
    slip, _, published, ours = zip(*twin_disc.rows(), strict=True)
    figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
    axes.loglog(slip, published, "ko", label="published")
    axes.loglog(slip, ours, "C0-", label="this library, from the published heat")
    axes.set(xlabel="slip [%]", ylabel="largest flash temperature [K]")
    axes.legend()
    axes.grid(visible=True, alpha=0.3)
    figure.savefig(path, dpi=100)
    plt.close(figure)
