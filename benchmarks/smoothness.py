"""Smoothness of the solver: sweeps in small steps, and doubled resolution (tables of docs/check/smoothness.md).

    python benchmarks/smoothness.py [--write docs/check/smoothness.md]

The case is S1002 on 60E1 at 1:40, the right wheel without roll and yaw. The jump of a sweep is its largest difference between
neighbours. Its noise is the size of the second differences. Approach, pressure and area are relative, forces are over mu N,
moments over mu N sqrt(area/pi).
"""

from __future__ import annotations

import functools
import math

import numpy as np

import contact
from benchmarks.tables import table, tell
from contact.geometry import profile, wheelset
from contact.inputs.options import N_ELEMENTS, N_STRIPS
from contact.theory import kalker

MU, LOAD = 0.3, 80e3
PAIRS = (("analyn", "fastrip"), ("analyn", "fastrip_mapped"), ("strip_halfspace", "fastrip_mapped"))
NORMAL, FORCES = ("approach", "max_pressure", "area"), ("Fx", "Fy", "Mz")
FIXED = (1e-3, 1e-3, 0.3)
Array = np.ndarray
Curves = dict[str, Array]


@functools.cache
def pairs() -> dict[str, wheelset.Pair]:
    """Return the pair with one plane for the whole side, and the pair whose rule separates tread and flange."""
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
    one = wheelset.Pair(wheel, rail, combine_distance=1.0, combine_angle=math.pi)
    return {"one plane": one, "default patches": wheelset.Pair(wheel, rail)}


@functools.cache
def located(rule: str, low: float = -8.0, high: float = 8.0, step: float = 0.01) -> tuple[Array, list]:
    """Return lateral positions [mm] and the patches there under a vertical load of 80 kN."""
    y = np.linspace(low, high, round((high - low) / step) + 1)
    return y, [pairs()[rule].contacts(wheelset.Pose(y=1e-3 * float(at)), load=LOAD) for at in y]


def lateral(rule: str, patches: list, normal: str, tangential: str, creepage: str, load: float | None) -> Curves:
    """Return the results over the positions.

    A vertical load is divided between the patches in proportion to their own loads. Forces add up by these shares.
    """
    flat = [patch for at in patches for patch in at]
    owner = np.repeat(np.arange(len(patches)), [len(at) for at in patches])
    if creepage == "fixed":
        states = FIXED
    else:
        own = [(p.creepage.longitudinal, p.creepage.lateral, p.creepage.spin) for p in flat]
        states = tuple(np.array(column) for column in zip(*own, strict=True))
    found = contact.forces(
        [p.separation for p in flat], states, load=[p.load for p in flat] if load is None else load,
        friction=MU, normal=normal, tangential=tangential,
    )  # fmt: skip
    share = np.array([p.share for p in flat])
    total = {name: np.bincount(owner, share * getattr(found, name)) for name in ("Fx", "Fy", "Mz", "N", "area")}
    for name in ("approach", "max_pressure"):
        total[name] = np.maximum.reduceat(getattr(found, name), np.searchsorted(owner, np.arange(len(patches))))
    failed = np.isin(found.status, (contact.Status.NOT_CONVERGED, contact.Status.OUT_OF_RANGE))
    return relative(total) | {"failed": np.bincount(owner, failed)}


def relative(values: Curves) -> Curves:
    """Return the logarithms of the normal results, forces over mu N, moments over mu N sqrt(area/pi)."""
    scale = MU * values["N"]
    out = {name: np.log(values[name]) for name in NORMAL}
    out |= {name: values[name] / scale for name in ("Fx", "Fy")}
    return out | {"Mz": values["Mz"] / (scale * np.sqrt(values["area"].mean() / math.pi))}


def row(title: str, name: str, at: Array, curve: Array, unit: str) -> list[str]:
    """Return a table row: largest jump, its place, and median, 95 % and largest second difference."""
    jump, second = np.abs(np.diff(curve)), np.abs(np.diff(curve, 2))
    k = int(jump.argmax())
    noise = " / ".join(f"{v:.1e}" for v in (np.median(second), np.percentile(second, 95), second.max()))
    return [title, name, f"{jump[k]:.4f}", f"{0.5 * (at[k] + at[k + 1]):.4g} {unit}", noise]


HEADER = ["methods", "result", "largest jump", "at", "second differences, median / 95 % / max"]


def lateral_tables() -> str:
    """Return the tables of lateral sweeps in steps of 0.01 mm."""
    text = []
    for rule in pairs():
        y, patches = located(rule)
        many = sum(len(at) > 1 for at in patches)
        text.append(f"\n### {rule.capitalize()} ({len(y)} positions, {many} of them with several patches)\n\n")
        rows = []
        for normal, tangential in PAIRS:
            title = f"`{normal}` + `{tangential}`"
            fixed = lateral(rule, patches, normal, tangential, "fixed", LOAD if rule == "one plane" else None)
            own = lateral(rule, patches, normal, tangential, "kinematic", None)
            if tangential == "fastrip_mapped":  # the normal results do not depend on the tangential method
                rows += [row(f"`{normal}`", name, y, fixed[name], "mm") for name in NORMAL]
            rows += [row(title, f"{name}, fixed creepages", y, fixed[name], "mm") for name in FORCES]
            rows += [row(title, f"{name}, kinematic", y, own[name], "mm") for name in FORCES]
            failed = int(fixed["failed"].sum() + own["failed"].sum())
            if failed:
                text.append(f"{title}: {failed} solutions of {2 * len(y)} did not converge or left the range.\n\n")
        text.append(table(HEADER, rows))
    return "".join(text)


def zoom_table() -> str:
    """Return the table of the largest jumps under refinement. If the curve is continuous, a jump shrinks with the step."""
    rows = []
    for normal, tangential in PAIRS:
        y, patches = located("one plane")
        coarse = lateral("one plane", patches, normal, tangential, "fixed", LOAD)
        for name in (*NORMAL, *FORCES):
            jump = np.abs(np.diff(coarse[name]))
            k = int(jump.argmax())
            largest = [jump[k]]
            for step in (1e-3, 1e-4):
                _, near = located("one plane", float(y[k]), float(y[k + 1]), step)
                fine = lateral("one plane", near, normal, tangential, "fixed", LOAD)
                largest.append(np.abs(np.diff(fine[name])).max())
            rows.append([f"`{normal}` + `{tangential}`", name, f"{y[k]:.2f} mm", *(f"{v:.5f}" for v in largest)])
    return table(["methods", "result", "from", "steps of 0.01 mm", "0.001 mm", "0.0001 mm"], rows)


@functools.cache
def separations() -> dict[str, contact.Separation]:
    """Return an ellipse and four real patches: tread, two-point contact, gauge corner, flange."""
    one = pairs()["one plane"]
    real = {f"y = {y} mm": one.contacts(wheelset.Pose(y=1e-3 * y), load=LOAD)[0].separation for y in (0, 3, 6.2, 6.75)}
    return {"ellipse": contact.Separation.hertzian(1.0, 2.0), **real}


def sweeps(separation: contact.Separation) -> dict[str, tuple[str, Array, tuple, Array | float]]:
    """Return name → (unit, abscissa, creepages, load) of each sweep."""
    decades = 10 ** np.linspace(-8, 0, 1601)
    spin = np.linspace(-5, 5, 2001)
    through = np.linspace(-2e-4, 2e-4, 801)
    return {
        "load 1 N to 250 kN": ("N", 10 ** np.linspace(0, math.log10(250e3), 1601), FIXED, 0.0),
        "longitudinal creepage 1e-8 to 1": ("", decades, (decades, 1e-4, 0.1), LOAD),
        "lateral creepage 1e-8 to 1": ("", decades, (1e-4, decades, 0.1), LOAD),
        "creepages through 0": ("", through, (through, 0.3 * through, 0.0), LOAD),
        "spin −5 to 5 /m": ("/m", spin, (5e-4, 5e-4, spin), LOAD),
        "spin alone": ("/m", spin, (0.0, 0.0, spin), LOAD),
        "ψ 0.95 to 1.05, lateral creepage with it": unit_spin(separation, 1.0),
        "ψ 0.95 to 1.05, lateral creepage against it": unit_spin(separation, -1.0),
    }


def unit_spin(separation: contact.Separation, side: float) -> tuple[str, Array, tuple, float]:
    """Return a sweep of the spin through |psi| = 1 of the loaded strip, where the published FaStrip ends."""
    sol = contact.solve(separation, contact.Creepage(), load=LOAD, n_strips=31)
    k = int(sol.strips.p0.argmax())
    aspect, a = sol.strips.aspect[k], sol.strips.a[k]
    c23 = kalker.coefficients(kalker.table(0.28), math.log(aspect))[2]
    unit = MU * sol.strips.p0[k] / (1.5 * a / math.sqrt(aspect) * c23 / math.pi * contact.STEEL.shear_modulus)
    psi = np.linspace(0.95, 1.05, 401)
    return "", psi, (2e-4, side * 1.5e-3, unit * psi), LOAD


def sweep_tables() -> str:
    """Return the table of sweeps. Each row is one sweep with the worst of the separations."""
    rows = []
    for normal, tangential in PAIRS:
        worst: dict[str, tuple] = {}
        for place, separation in separations().items():
            for title, (unit, at, creepage, load) in sweeps(separation).items():
                by_load = title.startswith("load")
                found = contact.forces(
                    separation,
                    creepage,
                    load=at if by_load else load,
                    friction=MU,
                    normal=normal,
                    tangential=tangential,
                )
                curves = relative({name: getattr(found, name) for name in (*NORMAL, *FORCES, "N")})
                for name in (*(NORMAL if by_load and tangential == "fastrip_mapped" else ()), *FORCES):
                    size = np.abs(np.diff(curves[name])).max()
                    if (title, name) not in worst or size > worst[title, name][0]:
                        worst[title, name] = (size, place, row(title, name, at, curves[name], unit))
        rows += [[f"`{normal}` + `{tangential}`", *line, place] for _, place, line in worst.values()]
    return table(["methods", "sweep", *HEADER[1:], "patch"], rows)


def resolution_changes(normal: str, tangential: str) -> Array:
    """Return the changes of (Fx, Fy) over mu N if strips, elements or both are doubled, shape (3, cases).

    Cases: ellipses of a/b 0.2 to 5 and patches every 0.5 mm of lateral displacement, in 16 states each.
    """
    shapes: list[contact.Separation] = [contact.Separation.hertzian(1.0, 10.0**u) for u in (-1, -0.5, 0, 0.5, 1)]
    shapes += [at[0].separation for at in located("one plane", -8.0, 8.0, 0.5)[1]]
    N, M = N_STRIPS.usual, N_ELEMENTS.usual
    rng = np.random.default_rng(3)
    sign = rng.choice([-1.0, 1.0], (3, 16))
    xi, eta, phi = sign * np.array([1e-3, 1e-3, 0.5])[:, None] * 10 ** rng.uniform(-1, 0.7, (3, 16))
    found = [
        [contact.forces(s, (xi, eta, phi), load=LOAD, friction=MU, normal=normal, tangential=tangential,
                        n_strips=n, n_elements=m) for s in shapes]
        for n, m in ((N, M), (2 * N, M), (N, 2 * M), (2 * N, 2 * M))
    ]  # fmt: skip
    force = np.array([[f.Fx + 1j * f.Fy for f in level] for level in found]) / (MU * LOAD)
    return np.abs(force[1:] - force[0]).reshape(3, -1)


def resolution_table() -> str:
    """Return the table of doubled strips and elements."""
    rows = []
    for normal, tangential in PAIRS:
        for what, change in zip(("strips", "elements", "both"), resolution_changes(normal, tangential), strict=True):
            figures = [f"{100 * v:.3f} %" for v in (change.mean(), np.percentile(change, 95), change.max())]
            rows.append([f"`{normal}` + `{tangential}`", what, *figures])
    return table(["methods", "doubled", "mean", "95 %", "max"], rows)


def report() -> dict[str, str]:
    """Return all tables as Markdown."""
    return {
        "lateral": lateral_tables(), "zoom": zoom_table(), "sweeps": sweep_tables(), "resolution": resolution_table()
    }  # fmt: skip


if __name__ == "__main__":
    tell(report, __doc__)
