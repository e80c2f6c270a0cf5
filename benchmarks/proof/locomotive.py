"""The locomotive's traction of docs/check/proof.md."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt

from benchmarks.tables import table
from contact.inputs.material import Thermal
from reference import traction


def section() -> tuple[str, str]:
    """Return the agreement for the summary, and the text."""
    slips = [f"{slip:g} %" for slip in traction.SLIPS]
    forces, largest = [], {"ours": 0.0, "fitted": 0.0}
    ours, fitted = traction.forces(Thermal()), traction.forces(traction.FITTED)
    for law, published in traction.FORCES.items():
        what = f"fall of {law[0]:g} over {law[1]:g} K" if law[0] else "constant friction"
        for whose, numbers in (("CONTACT", published), ("ours", ours[law]), ("ours, heat of CONTACT", fitted[law])):
            forces.append([f"{what}, {whose}", *(f"{number:.4f}" for number in numbers)])
        for key, numbers in (("ours", ours[law]), ("fitted", fitted[law])):
            off = max(abs(a / b - 1.0) for a, b in zip(numbers, published, strict=True))
            largest[key] = max(largest[key], 100.0 * off)
    found = {"CONTACT": traction.RISES, "ours": traction.rises(Thermal())}
    found["ours, CONTACT's elements and count"] = traction.counted_twice()
    rises = [[whose, *(f"{number:.4g}" for number in numbers)] for whose, numbers in found.items()]
    text = f"""## Locomotive traction

A wheel under {1e-3 * traction.LOAD:g} kN with an elliptic patch, a/b = .5, at {traction.SPEED:g} m/s; friction
{traction.FRICTION:g}, constant or falling linearly by .19 over 1200 or 400 K. Inputs are those of
`testbank/examples_temp/euro_tractcurv.inp` of github eve70a/CONTACT (commit 424e4e6), the steel of
[the constants](../understand/constants.md); CONTACT's answers those of the same test bank (issue 35).

{table(["largest rise with constant friction, K", *slips], rises)}
CONTACT counts the heat of the element itself twice (`src/m_temperature.f90`: its share is 2 √(dx/2) where the others have
differences of square roots), 11 % on its 40 elements. Our half space with the same count gives all its digits.

{table(["Fx/N at slip", *slips], forces)}
"Heat of CONTACT" is a heat capacity smaller by 1.252, with which the rise at 25 % is CONTACT's.

![Traction over slip](proof/locomotive.png)

Verdict: with CONTACT's count the rises are its own and the forces within {largest["fitted"]:.1f} %; with
the right count they are up to {largest["ours"]:.0f} % higher where the friction falls most. With
constant friction the force at .2 % slip, the only one that is not trivial, is .4 % low.
"""
    return f"forces within {largest['fitted']:.1f} %, rises within .5 %", text


def draw(path: Path) -> None:
    """Write the picture of the traction over the slip."""
    figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
    fitted = traction.forces(traction.FITTED)
    ours = traction.forces(Thermal())
    for k, (law, published) in enumerate(traction.FORCES.items()):
        what = f"−{law[0]:g} over {law[1]:g} K" if law[0] else "constant"
        axes.plot(traction.SLIPS, published, f"C{k}o", label=f"CONTACT, {what}")
        axes.plot(traction.SLIPS, fitted[law], f"C{k}-")
        axes.plot(traction.SLIPS, ours[law], f"C{k}:")
    axes.plot([], [], "k-", label="ours, heat of CONTACT")
    axes.plot([], [], "k:", label="ours")
    axes.set(xlabel="slip [%]", ylabel="Fx/N")
    axes.legend(fontsize=8)
    axes.grid(visible=True, alpha=0.3)
    figure.savefig(path, dpi=100)
    plt.close(figure)
