"""Features beside steady rolling against CONTACT 25.1: docs/check/contact_features.md.

    python benchmarks/contact_features.py FOLDER [--write docs/check/contact_features.md]

FOLDER has the reference sets (G_subsurface, …), which are not part of the repository. CONTACT's tractions and forces act on the
rail, ours on the wheel. Times are process times, the least of several runs in one thread.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import contact
import reference
from benchmarks import bent_surface, feature_times, roller_polygon
from benchmarks.patches_of_sets import BOTH, pair_of, parabolas
from benchmarks.tables import fill, read_options, summary, table
from contact.geometry.wheelset import Pose, Velocity
from contact.halfspace import Gap
from contact.pair import ElasticRail, RollerRig, WheelRailPair
from contact.stress import SurfaceLoad, below

Row = list[str]
MU = 0.3


def subsurface(folder: Path) -> Iterator[Row]:
    """Set G: all stresses at all points, from CONTACT's tractions."""
    errors, mises, peaks = [], [], []
    for path in sorted((folder / "G_subsurface").glob("*.npz")):
        d = np.load(path)
        load = SurfaceLoad(d["x"] * 1e-3, d["y"] * 1e-3, d["pn"] * 1e6, -d["px"] * 1e6, -d["py"] * 1e6)
        z = d["zs"] * 1e-3
        field = below(load, z, margin=0.0)
        rows, columns = (np.abs(a[:, None] - b).argmin(axis=0) for a, b in ((d["y"], d["ys"]), (d["x"], d["xs"])))
        at = np.ix_(np.arange(z.size), rows, columns)
        top = float(d["sigvm_max"])
        names = "xx", "yy", "zz", "xy", "xz", "yz"
        errors += [(1e-6 * getattr(field, name)[at] - d[f"s{name}"]).ravel() / top for name in names]
        mises.append((1e-6 * field.von_mises[at] - d["sigvm"]).ravel() / top)
        peaks.append(1e-6 * field.von_mises[at].max() / top - 1.0)
    unit = "largest von Mises stress"
    yield summary("G: stress components", np.concatenate(errors), unit)
    yield summary("G: von Mises stress", np.concatenate(mises), unit)
    yield summary("G: largest von Mises stress at CONTACT's points", peaks, unit)


def given_forces(folder: Path) -> Iterator[Row]:
    """Set H, module 3: one or both forces given on CONTACT's 44 × 44 elements."""
    creepages, forces = [], []
    for row in reference.rows(folder / "H_prescribed" / "module3.csv"):
        gap, creepage, case = prescribed(row)
        found = contact.solve(gap, creepage, **case, **BOTH)
        limit = case["friction"] * case["load"]
        saturation = 3.0 * limit * math.pi / (4.0 * case["material"].shear_modulus * found.area)
        away = found.creepage.longitudinal + float(row["xi"]), found.creepage.lateral + float(row["eta"])
        creepages.append(math.hypot(*away) / saturation)
        forces.append(math.hypot(found.Fx + float(row["Fx_check"]), found.Fy + float(row["Fy_check"])) / limit)
    yield summary("H: creepage", creepages, "creepage of saturation")
    yield summary("H: force", forces, "μN")


def transients(folder: Path) -> Iterator[Row]:
    """Set I: every step of a shift and of rolling on CONTACT's 32 × 32 elements."""
    forces, tractions = [], []
    for path in sorted((folder / "I_transient").glob("*.npz")):
        d = np.load(path)
        material, N, mu = contact.Material(1e6 * float(d["G"]), float(d["nu"])), float(d["N"]), float(d["mu"])
        gap = parabolas(1e-3 * float(d["aa"]), 1e-3 * float(d["bb"]), 1e6 * float(d["p0"]), material, 32)
        patch = contact.Transient(gap, load=N, friction=mu, material=material)
        for k in np.flatnonzero(d["T"] < 3):
            x, y, turn = (float(v) for v in -d["kin"][k])
            if d["T"][k] == 1:
                s = patch.shift(1e-3 * x, 1e-3 * y, turn)
            else:
                s = patch.roll(contact.Creepage(x, y, 1e3 * turn), distance=gap.dx)
            forces.append(math.hypot(s.Fx + d["Fx"][k], s.Fy + d["Fy"][k]) / (mu * N))
            for kept in np.flatnonzero(d["field_steps"] == k):
                load = SurfaceLoad.of(s)
                top = 1e6 * mu * float(d["pn"].max())
                i, j = (np.abs(a[:, None] - b).argmin(axis=0) for a, b in ((gap.y, load.y), (gap.x, load.x)))
                for mine, theirs in ((load.qx, d["px"][kept]), (load.qy, d["py"][kept])):
                    tractions.append((mine + 1e6 * theirs[np.ix_(i, j)]).ravel() / top)
    yield summary("I: force of a step", forces, "μN")
    yield summary("I: traction of an element", np.concatenate(tractions), "μ p0")


def unlike(folder: Path) -> Iterator[Row]:
    """Set J: unlike bodies on CONTACT's 40 × 40 elements; the creepage is found where no force is prescribed."""
    forces, pressures, creepages = [], [], []
    for row in reference.rows(folder / "J_dissimilar" / "summary.csv"):
        v = {name: float(text) for name, text in row.items() if name not in ("case", "warn") and text}
        rail, wheel = ((2e6 * v[f"G{k}"] * (1.0 + v[f"nu{k}"]), v[f"nu{k}"]) for k in (1, 2))
        s = (2.0 * np.arange(40) + 1.0) / 40.0 - 1.0
        x, y = (1.15e-3 * v[name] * s for name in ("a0", "b0"))
        gap = Gap(x, y, 1e3 * (v["A"] * x**2 + v["B"] * y[:, None] ** 2))
        free = v["F1"] == 1.0
        found = contact.solve(
            gap,
            contact.Creepage(0.0 if free else -v["xi"], -v["eta"], -1e3 * v["phi"]),
            load=v["N"],
            friction=v["mu"],
            material=contact.Material.from_pair(*rail, *wheel),
            force=0.0 if free else None,
            **BOTH,
        )
        forces.append(math.hypot(found.Fx + v["Fx"], found.Fy + v["Fy"]) / (v["mu"] * v["N"]))
        pressures.append(1e-6 * found.max_pressure / v["pmax"] - 1.0)
        creepages += [(found.creepage.longitudinal + v["xi"]) / v["xi"]] if free else []
    yield summary("J: force", forces, "μN")
    yield summary("J: largest pressure", pressures, "itself")
    yield summary("J: creepage of free rolling", creepages, "itself")


def deflections(folder: Path) -> Iterator[Row]:
    """Set L: a rail on springs under S1002, by the default methods, on CONTACT's profiles."""
    solver = WheelRailPair(pair_of(folder / "L_rail_deflection"))
    sideways, down, vectors, forces = [], [], [], []
    for row in reference.rows(folder / "L_rail_deflection" / "rail_deflection.csv"):
        if row["patch"] != "1":
            continue
        v = {name: float(text) for name, text in row.items() if name not in ("id", "mode") and text}
        springs = ElasticRail(1e3 * v["KYRAIL"], 1e3 * v["KZRAIL"], v["FYRAIL"], v["FZRAIL"])
        pose = Pose(y=1e-3 * v["y_ws"], z=1e-3 * v["value"] * (row["mode"] == "z"), yaw=v["yaw"])
        solver.forget()
        vertical = None if row["mode"] == "z" else v["value"]
        s = solver.solve(pose, Velocity(2.0, spin=-2.0 / 0.46 * 1.0003), vertical=vertical, rail=springs)
        true = -np.array([v["Fx_tr"], v["Fy_tr"], v["Fz_tr"]])
        forces.append(np.linalg.norm(s.force - true) / np.linalg.norm(true))
        balance = np.array([v["dy_balance"], v["dz_balance"]])
        vectors.append(np.linalg.norm(1e3 * np.array(s.deflection) - balance) / np.linalg.norm(balance))
        sideways.append(1e3 * s.deflection[0] - v["dy_balance"])
        down.append((1e3 * s.deflection[1] - v["dz_balance"]) / v["dz_balance"])
    yield summary("L: force vector, default methods", forces, "itself")
    yield summary("L: deflection vector", vectors, "itself")
    yield summary("L: lateral deflection", sideways, "mm")
    yield summary("L: vertical deflection", down, "itself")


def third_bodies(folder: Path) -> Iterator[Row]:
    """Set K: creep curves with elastic and plastic layers on CONTACT's 36 × 36 elements."""
    errors: dict[str, list[float]] = {}
    gap = None
    for row in reference.rows(folder / "K_thirdbody" / "creepcurves.csv"):
        v = {name: float(text or 0.0) for name, text in row.items() if name != "layer"}
        material = contact.Material(1e6 * v["G"], v["nu"])
        gap = gap or parabolas(1e-3 * v["a"], 1e-3 * v["b"], 1e6 * v["p0"], material, 36)
        layer = None
        if v["GG3"]:
            layer = contact.ThirdBody(1e-9 * v["h3"] / v["GG3"], 1e6 * v["tau_c0"] or math.inf, 1e9 * v["k_tau"])
        creepage = contact.Creepage(-v["xi"], -v["eta"], -1e3 * v["phi"])
        s = contact.solve(gap, creepage, load=v["N"], friction=v["mu"], material=material, layer=layer, **BOTH)
        away = math.hypot(s.Fx / (v["mu"] * s.N) + v["fx"], s.Fy / (v["mu"] * s.N) + v["fy"])
        errors.setdefault("softening" if v["k_tau"] < 0.0 else "all other layers", []).append(away)
    for name, found in errors.items():
        yield summary(f"K: force, {name}", found, "μN")


def rollers(folder: Path) -> Iterator[Row]:
    """Set N: S1002 on rollers, by the default methods, on CONTACT's profiles."""
    pair = pair_of(folder / "N_roller")
    forces, creepages = [], []
    for row in reference.rows(folder / "N_roller" / "roller.csv"):
        if row["patch"] != "1":
            continue
        v = {name: float(text) for name, text in row.items() if name != "id" and text}
        radius = 1e-3 * v["R_roller"]
        rig = RollerRig(pair, radius, offset=1e-3 * v["x_ws"])
        velocity = Velocity(v["RPITCH"] * radius, spin=v["VPITCH"])
        s = rig.solve(Pose(y=1e-3 * v["y_ws"], yaw=v["yaw"]), velocity, vertical=v["Fz_in"])
        true = -np.array([v["Fx_tr"], v["Fy_tr"], v["Fz_tr"]])
        forces.append(np.linalg.norm(s.force - true) / np.linalg.norm(true))
        creepages.append(s.contacts[0].creepage.longitudinal + v["xi"])
    yield summary("N: force vector, default methods", forces, "itself")
    yield summary("N: longitudinal creepage", creepages, "1")


def driven(folder: Path) -> Iterator[Row]:
    """Set H, module 1: a longitudinal force given, the spin found, by the default methods on CONTACT's profiles."""
    solver = WheelRailPair(pair_of(folder / "H_prescribed"))
    errors = []
    for row in reference.rows(folder / "H_prescribed" / "module1.csv"):
        if row["patch"] == "1":
            pose, force = Pose(y=1e-3 * float(row["y_ws"])), -float(row["Fx_ws_in"])
            found = solver.solve(pose, Velocity(2.0), force=force, vertical=float(row["Fz_in"]))
            errors.append(found.spin / float(row["VPITCH"]) - 1.0)
    yield summary("H: spin of a driven wheel, default methods", errors, "itself")


def prescribed(row: dict[str, str]) -> tuple[Gap, contact.Creepage, dict[str, Any]]:
    """Return gap, known creepages and arguments of `contact.solve` of a row of set H."""
    a, b, N, mu, G, p0 = (float(row[name]) for name in ("a", "b", "N", "mu", "G", "p0"))
    material = contact.Material(1e6 * G, float(row["nu"]))
    force = [None if not row[name] else -float(row[name]) * mu * N for name in ("fx_rel", "fy_rel")]
    creepage = contact.Creepage(0.0, -float(row["eta_in"] or 0.0), -1e3 * float(row["phi"]))
    gap = parabolas(1e-3 * a, 1e-3 * b, 1e6 * p0, material, 44)
    return gap, creepage, {"load": N, "friction": mu, "material": material, "force": tuple(force)}


PARTS: tuple[Callable[[Path], Iterator[Row]], ...] = (
    subsurface,
    given_forces,
    driven,
    transients,
    unlike,
    third_bodies,
    deflections,
    bent_surface.errors,
    rollers,
    roller_polygon.errors,
)


def main() -> None:
    arguments = read_options(__doc__, folder=None, write=Path)
    folder = arguments.folder and arguments.folder.resolve()
    rows = [row for part in PARTS if folder for row in part(folder)]
    parts = {
        "elements": table(["task, 124 × 68 elements", "time [ms]", "CONTACT/ours"], list(feature_times.elements())),
        "pairs": table(["task", "time [ms]"], list(feature_times.pairs())),
    }
    if folder:
        parts["errors"] = table(["set and quantity", "values", "mean", "95 %", "largest", "unit"], rows)
    fill(arguments.write, parts)


if __name__ == "__main__":
    main()
