"""Largest stable communication step of the coupled wheelset by scheme and speed, with cost and errors of each scheme.

    python benchmarks/coupling.py [--write docs/check/coupling.md]

`reference.stability` defines when a step is stable.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable

import numpy as np

from benchmarks.tables import table, tell
from contact_models.wheelset import master
from contact_models.wheelset.parameters import WheelsetParameters
from reference.stability import EXPLICIT, LONGEST, coupled, measured, modes

SPEEDS = (1.0, 2.0, 5.0, 10.0, 20.0, 40.0)
HUNTING = 28.0  # [m/s] speed of the compared runs


def milliseconds(h: float) -> str:
    return f"≥ {1e3 * LONGEST:.0f}" if np.isinf(h) else f"{1e3 * h:.3g}"


def limits(spins: bool, schemes: Iterable[str]) -> list[list[str]]:
    rows = []
    for speed in SPEEDS:
        p = WheelsetParameters(speed=speed)
        every = [m for m in modes(p) if spins or m.name != "spin"]
        row = [f"{speed:g}"]
        for scheme in schemes:
            h, mode = measured(speed, scheme, spins)
            if scheme in EXPLICIT:
                z = EXPLICIT[scheme]
                row += [f"**{milliseconds(h)}**, {mode}", *(milliseconds(z * m.mass / m.damping) for m in every)]
            else:
                row.append(f"**{milliseconds(h)}**")
        rows.append(row)
    return rows


@functools.cache
def finest() -> master.History:
    """Return the reference run with the smallest step."""
    return coupled(WheelsetParameters(speed=HUNTING, lateral=5e-3), 1.25e-4, 1.0, "iterated")


def losses(h: float, scheme: str) -> list[str]:
    """Return error of the motion, power residual and cost of one second of hunting."""
    p = WheelsetParameters(speed=HUNTING, lateral=5e-3)
    history, fine = coupled(p, h, 1.0, scheme), finest()
    every = round(h / fine.step)
    error = np.abs(history["lateral"] - fine["lateral"][::every][: history.values.shape[0]]).max()
    dissipated = float(fine.creep_power.sum() * fine.step)
    residual = float(np.abs(history.power_residual).max())
    evaluations = 1.0 if scheme in EXPLICIT else 1.0 + float(history.rounds.mean())
    return [scheme, f"{1e3 * h:g}", f"{1e3 * error:.2g}", f"{100 * residual / dissipated:.2g}", f"{evaluations:.2g}"]


def ratio(scheme: str) -> float:
    """Return the mean ratio of measured to estimated limit of the spin over all speeds."""
    spins = [(v, modes(WheelsetParameters(speed=v))[2]) for v in SPEEDS]
    return float(np.mean([measured(v, scheme)[0] * m.damping / (EXPLICIT[scheme] * m.mass) for v, m in spins]))


def report() -> str:
    lateral, yaw, spin = modes(WheelsetParameters(speed=1.0))
    f22, f11 = (0.5e-6 * m.damping for m in (lateral, yaw))
    longer = lateral.mass / lateral.damping / (spin.mass / spin.damping)
    names = {"jacobi": "Jacobi", "gauss_seidel": "Gauss–Seidel"}

    def header(*motions: str) -> list[str]:
        columns = ((f"{names[s]}, measured", *(f"{z:g} m/c {m}" for m in motions)) for s, z in EXPLICIT.items())
        return ["V, m/s", *(column for columns_of in columns for column in columns_of)]

    runs = [("jacobi", 0.25e-3), ("gauss_seidel", 0.25e-3), ("gauss_seidel", 0.5e-3), ("gauss_seidel", 1e-3)]
    runs += [("iterated", h) for h in (0.25e-3, 0.5e-3, 1e-3, 2e-3)]
    every = table(
        [*header("lateral", "yaw", "spin"), "iterated, forces agree up to"], limits(True, (*EXPLICIT, "iterated"))
    )
    return f"""# Coupling

The largest communication step in milliseconds at which the wheelset of `models/contact_models/wheelset` (S1002 on 60E1) and
its two contacts are stable, by bisection on growth, and the energy that the coupling loses. Written by
`make coupling`. The schemes are those of `models/contact_models/wheelset/master.py`.

## Estimate

A creep force that is held over a step h while it damps a mass m, m dv/dt = -c v with c = 2 f/V, gives v' = (1 - z) v
by Gauss–Seidel and v'' = v' - z v by Jacobi, with z = c h/m. They grow for z > 2 and z > 1. The iterated scheme (trapezoidal
rule) gives v' = (1 - z/2)/(1 + z/2) v, which never grows.

Three motions of a wheelset are damped this way, with their effective masses at the contacts: lateral motion with
m = {lateral.mass:.0f} kg, yaw with I/b² = {yaw.mass:.0f} kg, the axle's spin with I_s/r² = {spin.mass:.0f} kg. The slopes of
the contact at 54.5 kN are f22 = {f22:.1f} MN (lateral) and f11 = {f11:.1f} MN (longitudinal).

## Measured

{every}
Measured limits are bold, with the motion that grows first. The other columns are the estimates for each motion.

* **The spin decides.** An estimate from the lateral motion alone is {longer:.1f} times too long for an axle that turns
  freely (with 1600 kg and f = 8 MN it gives 1 ms by Jacobi and 2 ms by Gauss–Seidel at 10 m/s).
* The measured limit is {ratio("jacobi"):.2f} (Jacobi) and {ratio("gauss_seidel"):.2f} (Gauss–Seidel) of the estimate by the
  spin, at all speeds. A run counts as growing from a factor of two on, and bisection stops at 1 %.
* The iterated scheme has no stability limit, but if the response to a small change of force saturates within a step,
  {master.MOST_ROUNDS} rounds do not converge (limit at 1 mm off the centre; lower at larger amplitudes, and in flange impacts
  at any step). `History.rounds` shows it.

With the spin held (I_s → ∞) lateral motion and yaw grow together, a few per cent from the estimates:

{table(header("lateral", "yaw"), limits(False, EXPLICIT))}
## Losses in one second of hunting

The wheelset runs at {HUNTING:g} m/s and starts at 5 mm. The error is the largest difference of the lateral displacement from
the iterated scheme at 0.125 ms. The residual is the largest energy that left the wheelset and was neither dissipated by creep
nor stored, in per cent of the dissipated energy. Evaluations are solutions of each contact per step.

{table(["scheme", "h, ms", "error, mm", "residual, %", "evaluations"], [losses(h, s) for s, h in runs])}
The residual of the iterated scheme does not vanish with the step, because non-Hertzian contacts store not quite 2/5 of
load times approach.
"""


if __name__ == "__main__":
    tell(report, __doc__)
