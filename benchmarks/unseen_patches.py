"""Accuracy of normal methods on patches that were not used for tuning, against our own element-wise half space.

    python benchmarks/unseen_patches.py [--cases 40] [--seed 1]

The cases are random poses of S1002 on 60E1 (1:20 and 1:40) with loads of 2 to 200 kN. Half of them have three random cosines
(3 to 20 µm, 8 to 25 mm) on the gap, as worn profiles have. The reference is `contact.halfspace.norm` at the approach of the
strip half space on a grid of width/100. Its own error is about 0.3 % in the peak.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import CubicSpline

import contact
from benchmarks.tables import read_options, table
from contact.geometry import profile, wheelset
from contact.halfspace import norm


def case(rng: np.random.Generator, worn: bool) -> tuple[contact.Separation, float]:
    """Return a random separation and load [N]."""
    inclination = rng.choice([1 / 40, 1 / 20])
    load = math.exp(rng.uniform(math.log(2e3), math.log(200e3)))
    pair = wheelset.Pair(profile.s1002(), profile.rail_60e1(inclination=inclination), samples=241, combine_distance=1.0)
    patch = pair.contacts(wheelset.Pose(y=rng.uniform(-6e-3, 6e-3)), load=load)[0]
    y, g, A = patch.separation.y, patch.separation.g.copy(), patch.separation.A
    if worn:
        for _ in range(3):
            g += rng.uniform(3e-6, 20e-6) * np.cos(2 * np.pi * y / rng.uniform(8e-3, 25e-3) + rng.uniform(0, 2 * np.pi))
    return contact.Separation(y, g - g.min(), A), load


def main() -> None:
    arguments = read_options(__doc__, cases=40, seed=1)
    rng = np.random.default_rng(arguments.seed)
    errors: dict[tuple[bool, str], list[tuple[float, ...]]] = {}
    for k in range(arguments.cases):
        worn = k % 2 == 1
        separation, load = case(rng, worn)
        start = contact.solve(
            separation, contact.Creepage(), load=load, normal="strip_halfspace", n_strips=40, throw=False
        )
        low, high = start.patch_edges.min(), start.patch_edges.max()
        n = 100
        dy, dx = 1.2 * (high - low) / n, 1.3 * start.length / n
        y = 0.5 * (low + high) + (np.arange(n) - 0.5 * (n - 1)) * dy
        x = (np.arange(n) - 0.5 * (n - 1)) * dx
        g = CubicSpline(separation.y, separation.g)(y)  # the interpolation of the methods between samples
        A = np.interp(y, separation.y, separation.A)
        p = norm(g[:, None] + A[:, None] * x**2, dx, dy, contact.STEEL, approach=start.approach).p
        N = p.sum() * dx * dy
        for method in ("analyn", "strip_halfspace"):
            sol = contact.solve(
                separation, contact.Creepage(), approach=start.approach, normal=method, n_strips=40, throw=False
            )
            own = sol.pressure(x[None, :], y[:, None])
            row = (
                sol.N / N - 1,
                sol.max_pressure / p.max() - 1,
                float(np.linalg.norm(own - p) / np.linalg.norm(p)),
                float(not sol.converged),
            )
            errors.setdefault((worn, method), []).append(row)
            if method == "strip_halfspace" and (abs(row[0]) > 0.004 or row[2] > 0.06):
                print(
                    f"case {k}: {load:.0f} N, dN {row[0]:+.4f}, dpmax {row[1]:+.4f}, L2 {row[2]:.4f}, {sol.n_patches} patches"
                )
    lines = []
    for (worn, method), rows in errors.items():
        e = np.abs(np.array(rows))
        cells = [f"{100 * e[:, i].mean():.2f} / {100 * e[:, i].max():.2f} %" for i in range(2)]
        cells.append(f"{e[:, 2].mean():.3f} / {e[:, 2].max():.3f}")
        lines.append(["worn-like" if worn else "new", f"`{method}`", *cells, str(int(e[:, 3].sum()))])
    names = (f"{name}, mean / max" for name in ("N", "max pressure", "pressure L2"))
    print(table(["profiles", "method", *names, "not converged"], lines))


if __name__ == "__main__":
    main()
