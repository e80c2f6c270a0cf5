"""Accuracy over time of all methods on the same wheel-rail contacts: docs/check/method_map.md and its picture.

python -m benchmarks.method_map [--contacts 500] [--write docs]

A contact is the most loaded patch of a random pose of S1002 on 60E1 (1:40), at its own spin and random creepages. The reference
is the element-wise half space, which agrees with CONTACT to 6e-6 of friction times load (docs/check/halfspace.md). Its error
falls with the size of the elements, so its forces are extrapolated from two grids, both finer than any that is shown.
"""

from __future__ import annotations

import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import contact
from benchmarks.tables import read_options, table
from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose

FRICTION, FINER, FINEST, REPEATS = 0.3, 120, 240, 3
Contact = tuple[contact.Separation, contact.Creepage, float]

#: Title, normal and tangential method, strips (elements along y), elements along x.
SHOWN: list[tuple[str, str, str, int, int]] = [
    ("default", "strip_halfspace", "fastrip_mapped", 20, 20),
    ("default, 40 × 40", "strip_halfspace", "fastrip_mapped", 40, 40),
    ("default, 10 × 10", "strip_halfspace", "fastrip_mapped", 10, 10),
    ("half-space strips + FASTSIM", "strip_halfspace", "fastsim", 20, 20),
    ("half-space strips + table", "strip_halfspace", "table", 20, 20),
    ("thesis: ANALYN + FaStrip", "analyn", "fastrip", 30, 20),
    ("ANALYN + mapped FaStrip", "analyn", "fastrip_mapped", 20, 20),
    ("ANALYN + FASTSIM", "analyn", "fastsim", 20, 20),
    ("Kik-Piotrowski + FASTSIM", "kik_piotrowski", "fastsim", 20, 20),
    ("Kik-Piotrowski 2008 + FASTSIM", "kik_piotrowski_2008", "fastsim", 20, 20),
    ("Linder", "linder", "fastsim_linder", 20, 20),
    ("STRIPES", "stripes_ab", "fastsim_stripes", 20, 20),
    ("KPEC + FASTSIM", "kpec", "fastsim", 20, 20),
    ("equivalent ellipse + FASTSIM", "pascal_sauvage", "fastsim", 20, 20),
    ("Hertz + FASTSIM", "hertz", "fastsim", 20, 20),
    ("Hertz + FaStrip", "hertz", "fastrip", 20, 20),
    ("Hertz + table", "hertz", "table", 20, 20),
    ("Hertz + Shen-Hedrick-Elkins", "hertz", "shen_hedrick_elkins", 20, 20),
    ("Hertz + Polach", "hertz", "polach", 20, 20),
    ("Hertz + linear theory, limited", "hertz", "linear_saturated", 20, 20),
    ("half space, 15 × 15", "halfspace", "halfspace", 15, 15),
    ("half space, 30 × 30", "halfspace", "halfspace", 30, 30),
    ("half space, 60 × 60", "halfspace", "halfspace", 60, 60),
]

PAGE = """# Accuracy and time of all methods

Written by `python -m benchmarks.method_map --write docs`. {count} contacts: the most loaded patch of random poses of S1002
on 60E1 (1:40), y from -8 to 8 mm, yaw up to 10 mrad, 20 to 160 kN a wheel, friction {friction:g}. Spin is that of the pose.
Longitudinal and lateral creepage have random signs and sizes of .01 to 1 %, even in their logarithms. Every method gets
the same separation, creepages and load.

The reference is our element-wise half space, which agrees with CONTACT on the same grid to 6e-6 of friction times load
([Half space](halfspace.md)). Forces are extrapolated from {finer} × {finer} and {finest} × {finest} elements (from
160 and 240 instead, 24 of the contacts differ by .0003 in the mean and .002 at most); largest pressures are
those of {finest} × {finest}. CONTACT
itself cannot be run here. Time is processor time, the median over the contacts, of a call from Python that starts from
nothing; the least of {repeats} calls for fast methods, one call for the half space.

![Error of the force over time of one contact](proof/method_map.png)

{table}
{missed}## What it says

* Of what is faster than the default ({default_us:.0f} µs, mean error {default:.2%}), the best with other methods is {best}
  with {left:.1%}. The default on 10 × 10 takes {coarse_us:.0f} µs and has {coarse_default:.2%}.
* More strips and elements hardly help the default: {fine_default:.2%} on 40 × 40. What is left is
  the error of its traction.
* The normal problem bounds what a better tangential method gains: FASTSIM on the default's strips has {fastsim:.1%}, the mapped
  FaStrip on ANALYN's strips {analyn:.1%}.
* A half space of {coarse} needs {times:.0f} times the time of the default for an error of {coarse_error:.2%}.
* 1 % of the default's contacts take more than {slow:.0f} µs from nothing; in a run each starts from the last one
  ([Real time](real_time.md)).

Not in the map, since their equations could not be read: KBTNH, MKP, INFCON, extended Kik-Piotrowski and neural surrogates.
USETAB's place is taken by `table`, our own half space's forces on ellipses.
"""


def contacts(count: int) -> list[Contact]:
    """Return the most loaded patch of `count` random poses."""
    rng = np.random.default_rng(35)
    pair = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))
    found: list[Contact] = []
    while len(found) < count:
        pose = Pose(y=rng.uniform(-8e-3, 8e-3), yaw=rng.uniform(-10e-3, 10e-3))
        patches = [patch for patch in pair.contacts(pose, load=rng.uniform(20e3, 160e3)) if patch.load]
        longitudinal, lateral = rng.choice([-1.0, 1.0], 2) * 10 ** rng.uniform(-4.0, -2.0, 2)
        if patches:
            most = max(patches, key=lambda patch: patch.load)
            found.append((most.separation, contact.Creepage(longitudinal, lateral, most.creepage.spin), most.load))
    return found


def answer(solver: contact.Solver, given: Contact, repeats: int) -> tuple[float, ...]:
    """Return Fx, Fy, Mz, largest pressure, seconds and whether the solution has no fault; NaN where it cannot be had."""
    separation, creepage, load = given
    least = np.inf
    for _ in range(repeats):
        start = time.thread_time()
        found = solver.forces(separation, creepage, load=load)
        least = min(least, time.thread_time() - start)
    good = found.status in (contact.Status.OK, contact.Status.SATURATED)
    return found.Fx, found.Fy, found.Mz, found.max_pressure, least, float(good)


def extrapolated(given: Contact) -> tuple[float, ...]:
    """Return `answer` of the half space with the forces extrapolated to elements of no size; the pressure is the finest's."""
    coarse, fine = (np.array(half_space_answer(given, n)) for n in (FINER, FINEST))
    forces = (FINEST * fine - FINER * coarse)[:3] / (FINEST - FINER)
    return (*forces, fine[3], fine[4], min(coarse[5], fine[5]))


def half_space_answer(given: Contact, n: int) -> tuple[float, ...]:
    """Return `answer` of the element-wise half space on `n` by `n` elements."""
    separation, creepage, load = given
    start = time.process_time()
    found = contact.solve(
        separation, creepage, load=load, friction=FRICTION, normal="halfspace", tangential="halfspace",
        n_strips=n, n_elements=n, throw=False,
    )  # fmt: skip
    took = time.process_time() - start
    return found.Fx, found.Fy, found.Mz, found.max_pressure, took, float(found.converged)


def answers(of: tuple[str, str, str, int, int], given: list[Contact]) -> Array:
    """Return `answer` of every contact by a method, one row each."""
    _, normal, tangential, n_strips, n_elements = of
    if normal == "halfspace":
        return np.array([half_space_answer(each, n_strips) for each in given])
    solver = contact.Solver(
        normal=normal, tangential=tangential, n_strips=n_strips, n_elements=n_elements, friction=FRICTION
    )
    return np.array([answer(solver, each, REPEATS) for each in given])


def draw(path: Path, times: Array, errors: Array, interacting: list[bool]) -> None:
    """Draw the mean error of the force over the median time."""
    figure, axes = plt.subplots(figsize=(9.0, 5.4), layout="constrained")
    taken: list[tuple[float, float]] = []
    for i, (t, e, inner) in enumerate(zip(times, errors, interacting, strict=True)):
        near = sum(abs(np.log(t / a)) < 0.12 and abs(np.log(e / b)) < 0.06 for a, b in taken)
        taken.append((t, e))
        axes.loglog(t, e, "o", color="C0" if inner else "C1")
        axes.annotate(str(i + 1), (t, e), xytext=(5 + 14 * near, 2), textcoords="offset points", fontsize=8)
    axes.set(
        xlabel="processor time of one contact, median [µs]",
        ylabel="mean error of the creep force over friction times load",
    )
    axes.grid(visible=True, which="both", alpha=0.2)
    for colour, label in (("C0", "strips or elements interact"), ("C1", "each strip or ellipse for itself")):
        axes.plot([], [], "o", color=colour, label=label)
    axes.legend(loc="lower left")
    names = "\n".join(f"{i + 1:2d}  {of[0]}" for i, of in enumerate(SHOWN))
    axes.text(0.83, 0.98, names, transform=axes.transAxes, va="top", ha="right", fontsize=8, linespacing=1.3, ma="left")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main() -> None:
    """Print the table, or write page and picture."""
    options = read_options(__doc__, contacts=500, write=Path)
    given = contacts(options.contacts)
    with ProcessPoolExecutor() as pool:
        exact = np.array(list(pool.map(extrapolated, given, chunksize=8)))
    bound = FRICTION * np.array([load for _, _, load in given])
    trusted = exact[:, 5] > 0.0
    rows, times, errors, slowest = [], [], [], []
    for of in SHOWN:
        found = answers(of, given)
        force = np.hypot(*(found[:, :2] - exact[:, :2]).T)[trusted] / bound[trusted]
        peak = np.abs(found[:, 3] / exact[:, 3] - 1.0)[trusted]
        times.append(1e6 * float(np.median(found[:, 4])))
        slowest.append(1e6 * float(np.quantile(found[:, 4], 0.99)))
        errors.append(float(force.mean()))
        cells = [
            f"{force.mean():.4f} / {np.quantile(force, 0.95):.3f} / {force.max():.3f}",
            f"{100 * peak.mean():.2f} / {100 * np.quantile(peak, 0.95):.1f} / {100 * peak.max():.0f}",
            f"{times[-1]:.3g} / {slowest[-1]:.3g}",
            f"{int((found[:, 5] == 0.0).sum())}",
        ]
        rows.append([of[0], f"`{of[1]}` + `{of[2]}`", *cells])
        print(" | ".join(rows[-1]), flush=True)
    if options.write:
        measured = np.array((times, errors, slowest))
        write(options.write, rows, measured, int((~trusted).sum()), len(given))


def write(folder: Path, rows: list[list[str]], measured: Array, untrusted: int, count: int) -> None:
    """Write page and picture."""
    times, errors, slowest = measured
    methods = contact.methods().normal
    draw(folder / "check" / "proof" / "method_map.png", times, errors, [methods[of[1]].interacting for of in SHOWN])
    at = {of[0]: i for i, of in enumerate(SHOWN)}
    default, coarse = at["default"], at["half space, 30 × 30"]
    best = min(
        (i for i, of in enumerate(SHOWN) if times[i] < times[default] and "default" not in of[0]),
        key=lambda i: errors[i],
    )
    head = [
        "what",
        "methods",
        "force over μN, mean / 95 % / max",
        "largest pressure [%], the same",
        "time [µs], median / 99 %",
    ]
    missed = f"{untrusted} contacts are left out, whose reference did not converge.\n" if untrusted else ""
    text = PAGE.format(
        count=count,
        friction=FRICTION,
        finer=FINER,
        finest=FINEST,
        repeats=REPEATS,
        table=table([*head, "not converged"], rows),
        missed=missed,
        default_us=times[default],
        left=errors[best],
        best=SHOWN[best][0],
        coarse_us=times[at["default, 10 × 10"]],
        coarse_default=errors[at["default, 10 × 10"]],
        fine_default=errors[at["default, 40 × 40"]],
        slow=slowest[default],
        default=errors[default],
        fastsim=errors[at["half-space strips + FASTSIM"]],
        analyn=errors[at["ANALYN + mapped FaStrip"]],
        coarse="30 × 30",
        times=times[coarse] / times[default],
        coarse_error=errors[coarse],
    )
    (folder / "check" / "method_map.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
