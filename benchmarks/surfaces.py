"""Wheel flats, polygons and crossings against CONTACT (sets E and F): height, force, pressure and place of the poses.

    python benchmarks/surfaces.py FOLDER [--sweeps hav05 nose …] [--elements 60 | --spacing 0.2] [--normal halfspace] [--gaps]

FOLDER holds `E_wheelflat/` and `F_crossing/`, which are not ours to pass on. Every pose is searched and solved on the
surfaces, with CONTACT's height (mode z) or vertical force (mode Fz), by the element-wise half space or, with `--normal` and
`--tangential`, on strips.

* height: |z - z of CONTACT| under a force; |approach - that of CONTACT| at a height [mm].
* pressure: largest pressure of the pose, relative. force: |F - F of CONTACT| over |F of CONTACT|.
* place: distance of the reference points in the plane of the track [mm], the mean over the patches.
* patches: poses with another number of patches than CONTACT; they count only in the height and in the force.
"""

from __future__ import annotations

import csv
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.tables import read_options, table
from contact.geometry.profile import Profile
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface
from contact.geometry.surfaces.frame import Frame
from contact.geometry.wheelset import Pose, Velocity
from contact.kernels.geometry.section import AWAY
from contact.pair import HalfspacePair, WheelRailPair
from contact.study.errors import mean_p95_max
from reference import STEEL

Row = dict[str, str]
MU = 0.3


class Wheel(NamedTuple):
    """One sweep of set E: surface, its interpolation, nominal radius [m], rail, its cant, speed of rotation [rad/s]."""

    surface: str
    interpolating: bool
    radius: float
    rail: str
    cant: float
    spin: float


WHEELS = {
    "s1002flat": Wheel("s1002flat", False, 0.490, "r300_wide", 0.02, -4.08190679),
    "s1002flat_pre": Wheel("s1002flat_pre", True, 0.490, "r300_wide", 0.02, -4.08190679),
    "d09": Wheel("d09", False, 0.450, "circ_r300", 0.0, -4.44444444),
    "d09_z": Wheel("d09", False, 0.450, "circ_r300", 0.0, -4.44444444),
    "d09_i1": Wheel("d09", True, 0.450, "circ_r300", 0.0, -4.44444444),
    "hav05": Wheel("hav05", True, 0.460, "uic60", 0.0, -2000.0 / 460.0),
    "poly12": Wheel("poly12", True, 0.460, "uic60", 0.0, -2000.0 / 460.0),
}
CROSSINGS = {
    "nose": "cross_nose",
    "uk_v2_z": "uk_interrupt_v2",
    "uk_v2_Fz": "uk_interrupt_v2",
    "cross_wing": "cross_wing_extd",
}
CROSSING_SPIN = -4.3481181


def poses(files: list[Path], sweep: str) -> Iterator[list[Row]]:
    """Yield the rows of every pose of a sweep that has contact."""
    for path in files:
        with path.open() as file:
            rows = [row for row in csv.DictReader(file) if row["sweep"] == sweep and row["N"]]
        for row in rows:
            if row["patch"] == "1":
                k = rows.index(row)
                yield rows[k : k + int(row["n_patches"])]


def rail_surface(folder: Path, name: str) -> RailSurface:
    """Return a crossing of set F."""
    data = np.load(folder / "F_crossing" / f"surface_{name}.npz")
    slices = [1e-3 * data[f"yz_{i:02d}"] for i in range(data["u"].size)]
    features = 1e-3 * data["features_s"]
    return RailSurface(1e-3 * data["u"], slices, features=features, interpolating=int(data["u_intpol"]) == 1)


def pair_of(folder: Path, sweep: str, elements: int, spacing: float | None = None) -> tuple[SurfacePair, Velocity]:
    """Return surfaces and velocity of a sweep."""
    options = {"rows": elements, "columns": elements, "spacing": spacing, "material": STEEL}
    if sweep in CROSSINGS:
        yz = 1e-3 * np.load(folder / "F_crossing" / "wheel_s1002.npz")["yz"]
        pair = SurfacePair(
            WheelSurface([0.0], [yz]), rail_surface(folder, CROSSINGS[sweep]), rail_origin=(0.75, 0.0), **options
        )
        return pair, Velocity(2.0, spin=CROSSING_SPIN)
    wheel = WHEELS[sweep]
    data = np.load(folder / "E_wheelflat" / f"surface_{wheel.surface}.npz")
    surface = WheelSurface.from_deviations(
        data["theta_wc"], 1e-3 * data["y_w"], 1e-3 * data["dr"], interpolating=wheel.interpolating
    )
    yz = 1e-3 * np.load(folder / "E_wheelflat" / "profiles.npz")[f"rail_{wheel.rail}_yz"]
    rail = Profile("rail", *(yz if yz[0, 0] < yz[-1, 0] else yz[::-1]).T).rotated(-wheel.cant)
    origin = (0.75, 0.0) if wheel.rail == "circ_r300" else None
    pair = SurfacePair(surface, rail, nominal_radius=wheel.radius, rail_origin=origin, **options)
    return pair, Velocity(2.0, spin=wheel.spin)


def errors(row: list[Row], solver: WheelRailPair | HalfspacePair, velocity: Velocity) -> dict[str, float]:
    """Return the errors of one pose, and the computing time [s]."""
    first = row[0]
    pose = Pose(y=1e-3 * float(first["y_ws"]), z=1e-3 * float(first["z_wm"]), yaw=float(first["yaw"]))
    place = (
        {"station": 1e-3 * float(first["s_ws"])}
        if "s_ws" in first
        else {"rotation": np.radians(float(first["pitch_deg"]))}
    )
    begin = time.process_time()
    under = {"vertical": float(first["Fz_tr"])} if first["mode"] == "Fz" else {}
    found = solver.solve(pose, velocity, friction=MU, **place, **under)
    result = {"time": time.process_time() - begin, "contacts": float(len(found.contacts))}
    result["fit"] = found.gap_error
    true = -np.array([float(first[name]) for name in ("Fx_tr", "Fy_tr", "Fz_tr")])
    result["force"] = float(np.linalg.norm(found.force - true) / np.linalg.norm(true))
    if first["mode"] == "Fz":
        result["height"] = 1e3 * abs(found.z - pose.z)
    if len(found.contacts) != len(row):
        return result
    if first["mode"] != "Fz":
        pens = [abs(1e3 * c.approach - float(r["pen"])) for c, r in zip(found.contacts, row, strict=True)]
        result["height"] = max(pens)
    # a cylinder on its own has the rail at y = 0; here it lies at the place of the wheel
    shift = 750.0 if first["sweep"].startswith("d09") else 0.0
    at = [
        np.hypot(1e3 * c.position[0] - float(r["xcp_tr"]), 1e3 * c.position[1] - float(r["ycp_tr"]) - shift)
        for c, r in zip(found.contacts, row, strict=True)
    ]
    result["place"] = float(np.mean(at))
    result["pressure"] = abs(1e-6 * found.max_pressure / max(float(r["pmax"]) for r in row) - 1.0)
    return result


#: Sweep → file of fields.
FIELDS = {"s1002flat": "s1002flat", "poly12": "poly12_5", **{k: k for k in ("s1002flat_pre", "d09", "d09_i1", "hav05")}}
FIELDS |= {k: k for k in ("nose", "uk_v2_z", "uk_v2_Fz")}


def gap_errors(folder: Path, rows: list[list[Row]], sweep: str, pair: SurfacePair) -> list[float]:
    """Return root mean squares of our undeformed distance minus CONTACT's [µm], in its frames, of each field of a sweep."""
    set_ = "F_crossing" if sweep in CROSSINGS else "E_wheelflat"
    fields, found = np.load(folder / set_ / f"fields_{FIELDS[sweep]}.npz"), []
    for first, row in ((pose[0], row) for pose in rows for row in pose):
        for name in (key[:-1] for key in fields if key.endswith(f"_p{row['patch']}_x")):
            crossing = "s_ws" in first
            where = fields[f"{name}s_ws" if crossing else f"{name}pitch_deg"]
            same = abs(float(first["s_ws" if crossing else "pitch_deg"]) - float(where)) < 1e-9
            if not same or int(row["ncon"]) != int((fields[f"{name}pn"] > 0).sum()):
                continue
            pose = Pose(y=1e-3 * float(first["y_ws"]), z=1e-3 * float(first["z_wm"]))
            place = {"station": 1e-3 * float(where)} if crossing else {"rotation": np.radians(float(where))}
            pair.place(pose, **place)
            shift = 0.75 if sweep.startswith("d09") else 0.0
            origin = 1e-3 * np.array([float(row[k]) for k in ("xcp_tr", "ycp_tr", "zcp_tr")]) + [0.0, shift, 0.0]
            frame = Frame.turned(origin, float(row["delta_rad"]))
            gap = pair.distance(frame, 1e-3 * fields[f"{name}x"], 1e-3 * fields[f"{name}s"])
            gap[gap >= AWAY] = np.nan
            error = 1e6 * (gap - np.nanmin(gap)) - 1e3 * fields[f"{name}h"]
            found.append(float(np.sqrt(np.nanmean(error**2))))
            break
    return found


def main() -> None:
    """Print the table."""
    chosen = read_options(
        __doc__,
        folder=Path,
        sweeps=[*WHEELS, *CROSSINGS],
        elements=60,
        spacing=float,
        normal="halfspace",
        tangential="fastrip_mapped",
        gaps=False,
    )
    files = sorted(chosen.folder.glob("[EF]_*/*.csv"))
    rows = []
    for sweep in chosen.sweeps:
        pair, velocity = pair_of(chosen.folder, sweep, chosen.elements, chosen.spacing and 1e-3 * chosen.spacing)
        if chosen.gaps:
            if sweep in FIELDS:
                gaps = gap_errors(chosen.folder, list(poses(files, sweep)), sweep, pair)
                print(sweep, len(gaps), "fields, mean and largest", f"{np.mean(gaps):.3f} {max(gaps):.3f} µm")
            continue
        elementwise = chosen.normal == "halfspace"
        methods = {"normal": chosen.normal, "tangential": chosen.tangential}
        solver = HalfspacePair(pair) if elementwise else WheelRailPair(pair, material=STEEL, **methods)
        found = [errors(pose, solver, velocity) for pose in poses(files, sweep)]
        columns = []
        for name in ("height", "pressure", "force", "place", "fit"):
            values = [e[name] for e in found if name in e]
            columns.append(" / ".join(f"{v:.4f}" for v in mean_p95_max(values)) if values else "-")
        other = sum("place" not in e for e in found)
        seconds = float(np.median([e["time"] for e in found]))
        rows.append([f"`{sweep}`", str(len(found)), *columns, str(other), f"{seconds:.1f}"])
    head = [
        "sweep",
        "poses",
        "height [mm], mean / 95 % / max",
        "pressure",
        "force",
        "place [mm]",
        "patches",
        "time [s]",
    ]
    if rows:
        print(table(head, rows))


if __name__ == "__main__":
    main()
