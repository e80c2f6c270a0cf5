"""Largest stable communication steps of a wheelset and its contacts by scheme and speed, with errors of each scheme.

    python benchmarks/coupling.py [--write docs/check/coupling.md]

`reference.stability` defines when a step is stable.
"""

from __future__ import annotations

import functools

import numpy as np

from benchmarks.tables import table, tell
from contact_models.vehicle.coupling import OpenVehicle
from contact_models.wheelset import master
from contact_models.wheelset.master import Scheme
from contact_models.wheelset.system import python_contacts, scenario, simulation
from reference.stability import EXPLICIT, LONGEST, alone, modes, together

SPEEDS = (1.0, 2.0, 5.0, 10.0, 20.0, 40.0)
HUNTING, ASIDE, SECONDS = 28.0, 5e-3, 0.5  # [m/s], [m], [s] of the compared runs
NAMES = {"jacobi": "Jacobi", "gauss_seidel": "Gauss–Seidel"}


def milliseconds(h: float) -> str:
    return f"≥ {1e3 * LONGEST:.0f}" if np.isinf(h) else f"{1e3 * h:.3g}"


def explicit() -> str:
    """Return the table of single motions."""
    header = ["V, m/s"]
    header += [f"{NAMES[s]}, {m.name}: measured (estimate)" for s in EXPLICIT for m in modes(1.0)]
    rows = []
    for speed in SPEEDS:
        row = [f"{speed:g}"]
        for scheme, z in EXPLICIT.items():
            for m in modes(speed):
                measured = alone(speed, scheme, m.name)
                row.append(f"{milliseconds(measured)} ({milliseconds(z * m.mass / m.damping)})")
        rows.append(row)
    return table(header, rows)


@functools.cache
def run(h: float, scheme: Scheme) -> master.History:
    given = scenario(HUNTING)
    vehicle = OpenVehicle(simulation(given, ASIDE))
    return master.run(vehicle, python_contacts(given), step=h, duration=SECONDS, scheme=scheme)


def losses(h: float, scheme: Scheme) -> list[str]:
    """Return error of the motion and power residual of a run."""
    history, fine = run(h, scheme), run(2.5e-5, "gauss_seidel")
    error = np.abs(history["pose.y"] - np.interp(history["time"], fine["time"], fine["pose.y"])).max()
    dissipated = float(fine.creep_power.sum() * fine.step)
    residual = float(np.abs(history.power_residual).max())
    return [NAMES[scheme], f"{1e3 * h:g}", f"{1e3 * error:.2g}", f"{100 * residual / dissipated:.2g}"]


def report() -> dict[str, str]:
    """Return the parts of the page."""
    lateral, yaw, spin = modes(1.0)
    f22, f11 = (0.5e-6 * m.damping for m in (lateral, yaw))
    longer = lateral.mass / lateral.damping / (spin.mass / spin.damping)
    whole = table(
        ["V, m/s", *NAMES.values()],
        [[f"{v:g}", *(milliseconds(together(v, scheme)) for scheme in NAMES)] for v in SPEEDS],
    )
    runs: list[tuple[Scheme, float]] = [("gauss_seidel", h) for h in (4e-4, 2e-4, 1e-4)]
    runs += [("jacobi", h) for h in (5e-5, 2e-5)]
    motions = f"""Three motions of a wheelset are damped this way, with their effective masses at the contacts: lateral motion
with m = {lateral.mass:.0f} kg, yaw with I/b² = {yaw.mass:.0f} kg, the axle's spin with I_s/r² = {spin.mass:.0f} kg. The slopes
of the contact at 54.5 kN are f22 = {f22:.1f} MN (lateral) and f11 = {f11:.1f} MN (longitudinal). Each motion alone, on the true
contacts, with an explicit integration:

{explicit()}
**The spin decides.** An estimate from the lateral motion alone is {longer:.1f} times too long for an axle that turns
freely. This holds for every vehicle of your own that takes forces over a step.
"""
    lost = table(["scheme", "h, ms", "error, mm", "residual, %"], [losses(h, s) for s, h in runs])
    return {"motions": motions, "whole": whole, "losses": lost}


if __name__ == "__main__":
    tell(report, __doc__)
