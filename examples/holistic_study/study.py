"""A holistic study: profiles × positions × loads × creepages × friction, a million contacts with their damage (readme.md)."""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import contact
from contact.arrays import Array
from contact.damage import fatigue_index
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact_models.life.scale import Workers

PAIRS = (
    ("S1002", "60E1", 1 / 40),
    ("S1002", "60E1", 1 / 20),
    ("S1002", "54E1", 1 / 40),
    ("1/40", "60E1", 1 / 40),
    ("EPS", "60E1", 1 / 40),
)
LOADS = np.array([20e3, 45e3, 70e3, 95e3, 120e3])  # [N]
FRICTION = np.array([0.1, 0.2, 0.3, 0.4, 0.5])
LARGEST = 8e-3  # longitudinal and lateral creepage, evenly spaced in their square roots: dense where forces grow
POSITIONS = (-4e-3, 5.5e-3)  # [m] lateral displacement of the wheelset
QUANTITIES = {
    "T_gamma": ("N", "mean T-gamma over the creepages"),
    "dissipation": ("N", "mean frictional energy per metre"),
    "utilisation": ("1", "mean creep force over normal force"),
    "max_pressure": ("Pa", "greatest pressure"),
    "fatigue": ("1", "share of the contacts with a positive surface fatigue index"),
    "untrusted": ("1", "contacts without a trustworthy solution"),
}


@dataclass(frozen=True)
class Batch:
    """All loads, creepages and friction coefficients of one pair of profiles at one position."""

    wheel: str
    rail: str
    inclination: float
    y: float
    creepages: int  # number of longitudinal and of lateral creepages


def solve(batch: Batch) -> Array:
    """Return the quantities of the right wheel's patch with the greatest load, shape (quantities, loads, friction)."""
    pair = Pair(profile.named(batch.wheel, kind="wheel"), profile.named(batch.rail, inclination=batch.inclination))
    patch = max(
        pair.contacts(Pose(y=batch.y), Velocity(), load=LOADS.max()), key=lambda patch: patch.share * patch.load
    )
    root = np.linspace(-1.0, 1.0, batch.creepages)
    creepage = LARGEST * root * np.abs(root)
    shape = (LOADS.size, FRICTION.size, creepage.size, creepage.size)
    load, mu, xi, eta = np.broadcast_arrays(*np.meshgrid(LOADS, FRICTION, creepage, creepage, indexing="ij"))
    found = contact.forces(patch.separation, (xi, eta, patch.creepage.spin), load=load, friction=mu, threads=1)
    utilisation = np.hypot(found.Fx, found.Fy) / found.N
    index = fatigue_index(utilisation, found.max_pressure, contact.STEEL.shear_yield)
    over = {"axis": (2, 3)}
    answer = (
        (np.abs(found.Fx * xi) + np.abs(found.Fy * eta)).mean(**over),
        found.power_per_metre.mean(**over),
        utilisation.mean(**over),
        found.max_pressure.max(**over),
        (np.asarray(index).reshape(shape) > 0.0).mean(**over),
        (found.status >= contact.Status.OUT_OF_RANGE).sum(**over),
    )
    return np.stack(answer)


def study(positions: int, creepages: int, pool: Workers, watch: Any = lambda done, total: None) -> Any:
    """Return the whole grid as an `xarray.Dataset` over pair, position, load and friction."""
    import xarray

    places = np.linspace(*POSITIONS, positions)
    batches = [Batch(*pair, y, creepages) for pair in PAIRS for y in places.tolist()]
    answers = np.array(pool.map(solve, batches, watch))
    table = answers.reshape(len(PAIRS), positions, len(QUANTITIES), LOADS.size, FRICTION.size)
    dims = ("pair", "position", "load", "friction")
    return xarray.Dataset(
        {
            name: (dims, table[:, :, k], {"units": unit, "long_name": what})
            for k, (name, (unit, what)) in enumerate(QUANTITIES.items())
        },
        {
            "pair": [f"{wheel} on {rail}, 1:{1.0 / slope:.0f}" for wheel, rail, slope in PAIRS],
            "position": ("position", places, {"units": "m"}),
            "load": ("load", LOADS, {"units": "N"}),
            "friction": ("friction", FRICTION, {"units": "1"}),
        },
        {"contacts": len(batches) * LOADS.size * FRICTION.size * creepages**2},
    )


def draw(found: Any) -> Any:
    """Draw T-gamma, pressure and the share of contacts with surface fatigue over position, for each pair of profiles."""
    from matplotlib.figure import Figure

    from contact import plot

    middle = found.sel(load=70e3, friction=0.3)
    figure = Figure(figsize=(7.4, 7.4), dpi=150.0, layout="constrained")
    panels = (("T_gamma", 1.0, "T-gamma [N]"), ("max_pressure", 1e-6, "p [MPa]"), ("fatigue", 100.0, "FI > 0 [%]"))
    for ax, (name, factor, label) in zip(figure.subplots(3, 1, sharex=True), panels, strict=True):
        curves = {str(pair): factor * middle[name].sel(pair=pair).values for pair in found["pair"].values}
        plot.curve(1e3 * found["position"].values, curves, xlabel="", ylabel=label, ax=ax)
        ax.grid(visible=True)
        if name != "max_pressure":
            ax.get_legend().remove()
    ax.set_xlabel("lateral displacement of the wheelset [mm]")
    figure.suptitle("70 kN, μ = 0.3, mean over all creepages", x=0.01, ha="left", fontsize=10.0)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--positions", type=int, default=20)
    parser.add_argument("--creepages", type=int, default=20)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--scheduler")
    parser.add_argument("--out", type=Path, default=Path("out"))
    given = parser.parse_args()
    began = time.perf_counter()
    with Workers(given.workers, given.scheduler) as pool:
        found = study(given.positions, given.creepages, pool, lambda k, n: print(f"\r{k} of {n}", end="", flush=True))
    seconds, contacts = time.perf_counter() - began, found.attrs["contacts"]
    given.out.mkdir(parents=True, exist_ok=True)
    found.to_netcdf(given.out / "holistic.nc", engine="scipy", format="NETCDF3_64BIT")
    draw(found).savefig(given.out / "holistic.png")
    print(f"\n{contacts} contacts in {seconds:.1f} s, {1e6 * seconds / contacts:.1f} µs each")
    print(f"without a trustworthy solution: {int(found['untrusted'].sum())}; written to {given.out}/")
    for pair in found["pair"].values:
        mean = found.sel(pair=pair).mean()
        print(f"{pair!s:22} T-gamma {float(mean['T_gamma']):6.1f} N   FI > 0 {100.0 * float(mean['fatigue']):5.1f} %")


if __name__ == "__main__":
    main()
