"""What forces and wear inherit from what is not known: friction, load, creepages, profiles (docs/check/uncertainty.md).

python examples/uncertainty/uncertainty.py [--samples 10000] [--out uncertainty.png]

A wheel S1002 on a rail 60E1 (1:40) in a curve. Every input has a standard deviation. Four ways to the spread of the outputs:
10 000 samples of the batch, the same with one input at a time, first order by the jacobian, and profiles with noise.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import contact
from contact.arrays import Array
from contact.geometry import profile, smoothing
from contact.geometry.wheelset import Patch, Pose, Velocity, contacts

POSE, SPEED, RADIUS = Pose(y=4e-3, yaw=3e-3), 20.0, 0.460
#: Input → mean and standard deviation. That of creepages is relative, as from an uncertain radius and angle of attack.
FRICTION, LOAD, CREEPAGE = (0.35, 0.05), (80e3, 6e3), 0.10
#: Root mean square of the noise of a measured profile [m], and the filter that is applied to it (`wavelength`) [m].
NOISE, WAVELENGTH = 5e-6, 3e-3
INPUTS = ("friction", "load", "longitudinal", "lateral", "spin")
OUTPUTS = ("Fx", "Fy", "Mz", "T_gamma", "max_pressure")
UNITS = {
    "Fx": ("kN", 1e-3),
    "Fy": ("kN", 1e-3),
    "Mz": ("N m", 1.0),
    "T_gamma": ("N", 1.0),
    "max_pressure": ("MPa", 1e-6),
}


def patch(wheel: profile.Profile, rail: profile.Profile, load: float = LOAD[0]) -> Patch:
    """Return the patch with the largest load."""
    found = contacts(wheel, rail, POSE, Velocity(SPEED, spin=-SPEED / RADIUS), load=load)
    return max(found, key=lambda each: each.load or 0.0)


def drawn(n: int, of: Sequence[str], base: Patch, seed: int = 1) -> dict[str, Array]:
    """Return `n` samples of the inputs. Those that are not in `of` keep their mean."""
    rng = np.random.default_rng(seed)
    draws = {
        name: rng.standard_normal(n) * (name in of) for name in ("friction", "load", "longitudinal", "lateral", "spin")
    }
    creepage = {
        name: getattr(base.creepage, name) * (1.0 + CREEPAGE * draws[name])
        for name in ("longitudinal", "lateral", "spin")
    }
    return {
        "friction": np.clip(FRICTION[0] + FRICTION[1] * draws["friction"], 0.05, None),
        "load": LOAD[0] + LOAD[1] * draws["load"],
        **creepage,
    }


def solved(separation: contact.Separation | list[contact.Separation], inputs: dict[str, Array]) -> dict[str, Array]:
    """Return the outputs of all samples by the batch."""
    creepage = tuple(inputs[name] for name in INPUTS[2:])
    found = contact.forces(separation, creepage, load=inputs["load"], friction=inputs["friction"], speed=SPEED)
    gamma = np.abs(found.Fx * creepage[0]) + np.abs(found.Fy * creepage[1]) + np.abs(found.Mz * creepage[2])
    return {"Fx": found.Fx, "Fy": found.Fy, "Mz": found.Mz, "T_gamma": gamma, "max_pressure": found.max_pressure}


def first_order(base: Patch) -> dict[str, float]:
    """Return the standard deviation of the forces by the jacobian at the means."""
    given = contact.solve(
        base.separation, base.creepage, load=LOAD[0], friction=FRICTION[0], speed=SPEED, derivatives=True
    )
    assert given.jacobian is not None
    spread = {"friction": FRICTION[1], "load": LOAD[1]} | {
        name: CREEPAGE * abs(getattr(base.creepage, name)) for name in INPUTS[2:]
    }
    return {
        row: float(np.sqrt(sum((given.jacobian[row, column] * size) ** 2 for column, size in spread.items())))
        for row in ("Fx", "Fy", "Mz")
    }


def noisy(n: int, seed: int = 2) -> list[contact.Separation]:
    """Return separations of `n` pairs of profiles measured with noise, filtered as `read(..., wavelength=)` does."""
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(n):
        pair = []
        for shape in (profile.s1002(), profile.rail_60e1()):
            across = rng.normal(0.0, NOISE, shape.y.size)
            y, z = shape.y - across * np.sin(shape.angle), shape.z + across * np.cos(shape.angle)
            pair.append(profile.Profile(shape.kind, *smoothing.filtered(y, z, WAVELENGTH)))
        found.append(patch(*pair).separation)
    return found


def main() -> None:
    """Print the tables and draw the picture."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=10_000)
    parser.add_argument("--profiles", type=int, default=200)
    parser.add_argument("--out", type=Path, help="picture")
    given = parser.parse_args()
    base = patch(profile.s1002(), profile.rail_60e1())
    print(f"creepages {base.creepage.longitudinal:.2e} {base.creepage.lateral:.2e}, spin {base.creepage.spin:.3f} 1/m")
    begin = time.perf_counter()
    together = solved(base.separation, drawn(given.samples, INPUTS, base))
    taken = time.perf_counter() - begin
    middle = solved(base.separation, drawn(1, (), base))
    alone = {name: solved(base.separation, drawn(given.samples, (name,), base)) for name in INPUTS}
    shapes = noisy(given.profiles)
    alone["profiles"] = solved(
        shapes, {key: np.full(len(shapes), value[0]) for key, value in drawn(1, (), base).items()}
    )
    linear = first_order(base)
    print(f"{given.samples} samples in {taken:.2f} s\n")
    print("output | at the means | 5 % | median | 95 % | σ of all | by first order | σ alone: " + " | ".join(alone))
    for name in OUTPUTS:
        unit, factor = UNITS[name]
        low, half, high = np.percentile(together[name], (5, 50, 95)) * factor
        parts = " | ".join(f"{factor * each[name].std():.3g}" for each in alone.values())
        told = f"{factor * linear[name]:.3g}" if name in linear else "–"
        print(
            f"{name} [{unit}] | {factor * middle[name][0]:.4g} | {low:.4g} | {half:.4g} | {high:.4g} | "
            f"{factor * together[name].std():.3g} | {told} | {parts}"
        )
    if given.out:
        draw(together, middle, given.out)


def draw(samples: dict[str, Array], middle: dict[str, Array], path: Path) -> None:
    """Draw a histogram of every output."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 2.6), layout="constrained")
    for k, name in enumerate(OUTPUTS):
        unit, factor = UNITS[name]
        axes = figure.add_subplot(1, len(OUTPUTS), k + 1)
        axes.hist(factor * samples[name], bins=60, color="#3b8bd0")
        axes.axvline(factor * float(middle[name][0]), color="#c3272b", lw=1.2)
        axes.set_xlabel(f"{name} [{unit}]")
        axes.set_yticks([])
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    main()
