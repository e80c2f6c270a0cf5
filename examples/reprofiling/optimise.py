"""Where to cut a worn wheel: pressure and conicity as goals, and their gradient by the adjoint of the half space.

python examples/reprofiling/optimise.py [--out reprofiling.png]

A wheel S1002 with a made-up hollow of .5 mm runs on 60E1 (1:40). The cut is a cubic spline over the tread whose coefficients
are not negative, since metal cannot be added. The goal is a mean of the pressure over displacements of the wheelset, the mean
squared error of the conicity at 1 to 4 mm, and the metal that is lost. Every evaluation solves the contact of 9 displacements
by `norm`. The gradient takes three linear systems more for each of them, whatever the number of coefficients, where differences
need one more evaluation for every coefficient. SciPy minimises with both.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import BSpline, CubicSpline
from scipy.optimize import OptimizeResult, minimize

import contact
from contact.arrays import Array
from contact.geometry import profile
from contact.halfspace.norm import norm, response

LOAD, RADIUS = 80e3, 0.46  # of a wheel [N], rolling radius [m]
HOLLOW = 0.5e-3, 15e-3  # depth of the wear and its half width [m]
DX, DY = 0.6e-3, 0.5e-3  # elements [m]
X, Y = np.arange(-9.9e-3, 10e-3, DX), np.arange(-32e-3, 30.1e-3, DY)
DISPLACEMENTS = np.linspace(-4e-3, 4e-3, 9)  # of the wheelset [m]
#: Place of a centred wheel's tape circle in the rail's profile [m]: 1500 mm between them, 1435 mm of gauge, heads of 72 mm.
CENTRE = 0.75 - 0.5 * (1.435 + 0.072)
CONICITY = 0.15  # that is wanted
POWER, OVER = 8.0, 4.0  # of the means that stand for the largest pressure of a patch, and over the displacements
OF_CONICITY, OF_CUT = (
    100.0,
    0.1,
)  # weights of the conicity's squared error and of the mean cut [1/mm], the pressure in GPa
KNOTS = np.linspace(-34e-3, 34e-3, 18)
N = KNOTS.size - 4


@dataclass(frozen=True)
class Rolling:
    """One displacement: generalised pressure [Pa], rolling radius [m], and their derivatives by the coefficients."""

    pressure: float
    radius: float
    pressure_by: Array
    radius_by: Array


class Goal:
    """The goal and its gradient by the coefficients of the cut [mm]."""

    def __init__(self) -> None:
        wheel, rail = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
        depth, width = HOLLOW
        self.rail = CubicSpline(rail.y, rail.z)(Y)
        self.worn = CubicSpline(wheel.y, wheel.z - depth * np.exp(-((wheel.y / width) ** 2)))
        self.cut = BSpline(KNOTS, 1e-3 * np.eye(N), 3, extrapolate=False)
        self.solutions = 0

    def shapes(self, y: Array) -> Array:
        """Return the depth of the cut of every coefficient at places on the wheel [m], shape (y.size, N)."""
        return np.nan_to_num(self.cut(y))

    def roll(self, c: Array, displacement: float, derivatives: bool) -> Rolling:
        """Solve the contact of a wheel that is displaced by `displacement` [m] to its field side."""
        self.solutions += 1
        on_wheel = Y - CENTRE - displacement
        shapes = self.shapes(on_wheel)
        z = self.worn(on_wheel) - shapes @ c
        gap = (self.rail - z)[:, None] + X**2 / (2.0 * RADIUS)
        material = contact.STEEL
        p = norm(gap, DX, DY, material, load=LOAD, tolerance=1e-7).p
        total, peak = p.sum(), p.max()
        powers = ((p / peak) ** POWER).sum()
        pressure = peak * powers ** (1.0 / POWER)
        weight = p.sum(axis=1) / total
        radius = RADIUS + weight @ z
        if not derivatives:
            return Rolling(pressure, radius, np.zeros(N), np.zeros(N))
        # adjoints: C l = d(sum)/dp. The load stays, so the approach follows: sum of r (d(approach) - d(gap)) = 0.
        by_pressure = (p / pressure) ** (POWER - 1.0)
        by_radius = np.broadcast_to(((z - weight @ z) / total)[:, None], p.shape)
        r, of_pressure, of_radius = (
            response(p, field, DX, DY, material) for field in (np.ones_like(p), by_pressure, by_radius)
        )

        def chain(adjoint: Array) -> Array:
            """Return the derivative by the coefficients, which raise the gap by their shapes."""
            return ((adjoint.sum() / r.sum()) * r - adjoint).sum(axis=1) @ shapes

        return Rolling(pressure, radius, chain(of_pressure), chain(of_radius) - weight @ shapes)

    def __call__(self, c: Array, derivatives: bool = True) -> tuple[float, Array]:
        """Return the goal and its gradient."""
        found = [self.roll(c, y, derivatives) for y in DISPLACEMENTS]
        pressures, by_c = 1e-9 * np.array([one.pressure for one in found]), [1e-9 * one.pressure_by for one in found]
        mean = np.mean(pressures**OVER) ** (1.0 / OVER)
        value = mean + OF_CUT * float(c.mean())
        slope = (
            np.mean([(p / mean) ** (OVER - 1.0) * by for p, by in zip(pressures, by_c, strict=True)], axis=0)
            + OF_CUT / N
        )
        n = len(DISPLACEMENTS) // 2
        for k in range(n):  # pairs of displacements to both sides
            left, right, amplitude = found[k], found[-1 - k], DISPLACEMENTS[-1 - k]
            error = (right.radius - left.radius) / (2.0 * amplitude) - CONICITY
            value += OF_CONICITY / n * error**2
            slope += OF_CONICITY / n * error / amplitude * (right.radius_by - left.radius_by)
        return value, slope

    def conicity(self, c: Array) -> tuple[Array, Array]:
        """Return amplitudes [m] and half the difference of the rolling radii over them [-]."""
        y = np.linspace(1e-3, 4e-3, 7)
        return y, np.array([self.roll(c, v, False).radius - self.roll(c, -v, False).radius for v in y]) / (2.0 * y)


def optimise(goal: Goal, exact: bool, most: int = 100) -> OptimizeResult:
    """Minimise the goal from no cut on, with the gradient or with differences."""
    start, bounds = np.full(N, 0.1), [(0.0, 5.0)] * N
    options = {"maxiter": most, "ftol": 1e-7}
    if exact:
        return minimize(goal, start, jac=True, method="L-BFGS-B", bounds=bounds, options=options)
    return minimize(
        lambda c: goal(c, False)[0], start, method="L-BFGS-B", bounds=bounds, options=options | {"eps": 1e-4}
    )


def main(arguments: list[str] | None = None) -> None:
    """Print what both ways take and reach, and draw the cut."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path)
    parser.add_argument("--differences", action="store_true", help="also without the gradient (minutes)")
    options = parser.parse_args(arguments)
    goal, worn = Goal(), np.zeros(N)
    ways = [("the adjoint", True), *([("differences", False)] if options.differences else [])]
    for name, exact in ways:
        goal.solutions, begun = 0, time.perf_counter()
        found = optimise(goal, exact)
        took = time.perf_counter() - begun
        print(
            f"with {name}: goal {goal(worn, False)[0]:.3f} -> {found.fun:.4f}, {goal.solutions} solutions, {took:.0f} s"
        )
        print("  cut [mm]:", " ".join(f"{value:.2f}" for value in found.x))
        if exact:
            c = found.x
    for name, at in (("worn", worn), ("cut", c)):
        pressures = [goal.roll(at, y, False).pressure for y in DISPLACEMENTS]
        _, conicity = goal.conicity(at)
        print(
            f"{name}: up to {1e-6 * np.max(pressures):.0f} MPa, conicity {conicity.min():.3f} to {conicity.max():.3f}"
        )
    if options.out:
        draw(goal, c, options.out)


def draw(goal: Goal, c: Array, path: Path) -> None:
    """Draw profiles, pressure and conicity, worn and cut."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), layout="constrained")
    for name, at in (("worn", np.zeros(N)), ("cut", c)):
        axes[0].plot(1e3 * Y, 1e3 * (goal.worn(Y) - goal.shapes(Y) @ at), label=name)
        axes[1].plot(1e3 * DISPLACEMENTS, [1e-6 * goal.roll(at, y, False).pressure for y in DISPLACEMENTS], label=name)
        y, conicity = goal.conicity(at)
        axes[2].plot(1e3 * y, conicity, label=name)
    axes[0].invert_yaxis()
    axes[2].axhline(CONICITY, color="0.7", linewidth=0.8)
    for axis, labels in zip(
        axes,
        (
            ("y on the wheel [mm]", "z [mm], down"),
            ("displacement [mm]", "generalised pressure [MPa]"),
            ("amplitude [mm]", "conicity [-]"),
        ),
        strict=True,
    ):
        axis.set_xlabel(labels[0])
        axis.set_ylabel(labels[1])
        axis.legend()
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    main()
