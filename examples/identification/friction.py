"""Friction and its fall from a creep curve, with confidence intervals, by the derivatives of the forces.

python examples/identification/friction.py [--repeats 200] [--out friction.png]

A wheel is driven at 20 m/s, and its tractive force is measured over the creepage. The coefficient of friction falls with the
sliding velocity, mu(v) = mu_0 (A + (1 - A) exp(-B v)) (Polach 2005), and the contact is softer than a clean one: a
factor on the creepages. The measurement is made up: forces of known parameters with noise. Least squares by SciPy with the
exact Jacobian finds the parameters again. Repeated with other noise, the intervals tell whether they cover what is known.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import t as student

import contact
from contact.arrays import Array

SPEED, LOAD, NOISE = 20.0, 100e3, 600.0
NAMES = ("mu_0", "A", "B [s/m]", "softness")
KNOWN, START = np.array([0.36, 0.45, 0.9, 0.55]), np.array([0.30, 0.70, 0.4, 1.0])
BOUNDS = ([0.05, 0.0, 0.0, 0.05], [1.0, 1.0, 10.0, 2.0])
SEPARATION = contact.Separation.hertzian(1.1, 0.9)
CREEPAGES = -np.concatenate((np.linspace(2e-4, 4e-3, 12), np.linspace(6e-3, 0.08, 14)))


def friction_of(p: Array, v: Array) -> tuple[Array, Array]:
    """Return the coefficients at the sliding velocities `v`, and their derivatives by the first three parameters."""
    rest, far, rate = p[:3]
    fall = np.exp(-rate * v)
    share = far + (1.0 - far) * fall
    return rest * share, np.stack((share, rest * (1.0 - fall), -rest * (1.0 - far) * v * fall), axis=1)


class Curve:
    """Tractive forces over the creepage, and their derivatives by the parameters."""

    def __init__(self) -> None:
        self.solver, self.solutions = contact.Solver(), 0

    def __call__(self, p: Array, derivatives: bool = False) -> tuple[Array, Array]:
        """Return the forces on the rail [N] at `CREEPAGES`, and their derivatives.

        Every point has one coefficient of friction, so d(force)/d(p) = dF/dmu dmu/dp + dF/dcreepage dcreepage/dp.
        """
        mu, by_p = friction_of(p, SPEED * np.abs(CREEPAGES))
        forces, slopes = np.empty(CREEPAGES.size), np.zeros((CREEPAGES.size, p.size))
        for i, creepage in enumerate(CREEPAGES):
            at = contact.Creepage(p[3] * creepage)
            found = self.solver.forces(SEPARATION, at, load=LOAD, friction=float(mu[i]), derivatives=derivatives)
            forces[i] = found.Fx
            self.solutions += 1
            if found.jacobian is not None:
                slopes[i, :3] = found.jacobian["Fx", "friction"] * by_p[i]
                slopes[i, 3] = found.jacobian["Fx", "longitudinal"] * creepage
        return forces, slopes


def fit(curve: Curve, measured: Array, exact: bool) -> tuple[Array, Array, int]:
    """Return the parameters, half their 95 % intervals, and the number of solutions. `exact` is the Jacobian of the forces."""
    curve.solutions = 0
    found = least_squares(
        lambda p: (curve(p)[0] - measured) / NOISE,
        START,
        jac=(lambda p: curve(p, True)[1] / NOISE) if exact else "2-point",
        bounds=BOUNDS,
        x_scale=[0.1, 0.3, 0.5, 0.3],
    )
    free = measured.size - found.x.size
    variance = 2.0 * found.cost / free
    spread = np.sqrt(variance * np.diag(np.linalg.inv(found.jac.T @ found.jac)))
    return found.x, spread * student.ppf(0.975, free), curve.solutions


def main(arguments: list[str] | None = None) -> None:
    """Print the parameters of one measurement, and how often the intervals cover the known ones."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=200)
    parser.add_argument("--out", type=Path)
    options = parser.parse_args(arguments)
    curve, rng = Curve(), np.random.default_rng(3)
    clean = curve(KNOWN)[0]
    measured = clean + NOISE * rng.standard_normal(clean.size)
    for name, exact in (("the derivatives", True), ("differences", False)):
        begun = time.perf_counter()
        p, half, solutions = fit(curve, measured, exact)
        print(f"with {name}: {solutions} solutions, {time.perf_counter() - begun:.2f} s")
        for parameter, known, value, width in zip(NAMES, KNOWN, p, half, strict=True):
            print(f"  {parameter:9} known {known:.3f}   found {value:.4f} ± {width:.4f}")
    covered = np.zeros(KNOWN.size)
    for _ in range(options.repeats):
        one, half, _ = fit(curve, clean + NOISE * rng.standard_normal(clean.size), True)
        covered += np.abs(one - KNOWN) <= half
    if options.repeats:
        shares = ", ".join(f"{name} {share:.0%}" for name, share in zip(NAMES, covered / options.repeats, strict=True))
        print(f"95 % intervals cover the known parameter in {options.repeats} repeats: {shares}")
    if options.out:
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(figsize=(6, 3.6), layout="constrained")
        axes.plot(-100 * CREEPAGES, 1e-3 * measured, "o", label="measured (made up)")
        axes.plot(-100 * CREEPAGES, 1e-3 * curve(p)[0], label="fitted")
        axes.set_xlabel("creepage [%]")
        axes.set_ylabel("tractive force [kN]")
        axes.legend()
        figure.savefig(options.out, dpi=120)


if __name__ == "__main__":
    main()
