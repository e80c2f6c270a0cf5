"""Motions of a wheelset for the tests of `WheelRailPair`, and the solver's results for them."""

import math

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmu_instance import named

import contact
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.pair import ElasticRail, PairSolution, WheelRailPair
from reference.random_cases import PARTNERS

NAME = "WheelRailPair"
METHODS = contact.methods().batched
R0 = 0.46
#: A motion with lateral shift, yaw, rates and an irregular rail.
MOTION = {
    **named("pose", y=2e-3, roll=1e-3, yaw=4e-3),
    **named("velocity", x=30.0, y=0.05, z=0.01, roll=0.01, yaw=0.02, spin=-30.0 / R0 * 1.001),
    **named("irregularity", y=0.5e-3, z=-0.2e-3, roll=1e-3, y_rate=0.02, z_rate=-0.01, roll_rate=0.03),
    **named("offset", x=0.4e-3, y=-0.6e-3, z=0.3e-3, roll=-1.5e-3, pitch=0.01, yaw=2e-3),
    **named("offset", x_rate=0.02, y_rate=0.03, z_rate=-0.01, roll_rate=0.02, pitch_rate=-0.03, yaw_rate=0.01),
}
OFFSET = [name.split(".")[1] for name in MOTION if name.startswith("offset.")]


_PATCH = ("n", "fx", "fy", "mx", "my", "mz", "x", "y", "z", "angle", "area", "pmax", "longitudinal", "lateral", "spin")
_PATCH += ("approach", "rail_y", "rail_z", "wheel_y", "wheel_z", "used_friction")


#: Outputs whose differences are taken as they are.
_OF_ONE = {"x", "y", "z", "deflection_y", "deflection_z", "rail_y", "rail_z", "wheel_y", "wheel_z", "Y_over_Q"}
_OF_ONE |= {"used_friction", "longitudinal", "lateral", "angle", "spin", "ratio"}


def warm(fmu):
    """Set MOTION, strips that interact, which start from the last step, and damage in bins in an instance and return it."""
    strips = {"method.normal": list(METHODS.normal).index("strip_halfspace") + 1}
    fmu.update({**MOTION, **strips, "accumulation.wear_law": 2})
    return fmu


def trajectory(fmu, start: int) -> list[dict[str, float]]:
    """Return the outputs of four steps with changing inputs from step `start` on."""
    rows = []
    for k in range(start, start + 4):
        fmu.update({"pose.y": 6e-3 * math.sin(0.4 * k), "load.normal_force": 8e4 + 1e4 * math.cos(k)})
        fmu.step(k * 1e-3)
        rows.append(fmu.all("output"))
    return rows


def solved(values: dict[str, float], pair: WheelRailPair, **place: float) -> PairSolution:
    """Return the solver's result for inputs by name, on surfaces at a place."""

    def part(name: str, *fields: str) -> list[float]:
        return [values.get(f"{name}.{field}", 0.0) for field in fields]

    load = {} if values.get("load.kind", 1) == 2 else {"load": values.get("load.normal_force", 80e3)}
    if values.get("load.kind") == 3:
        load = {"vertical": load["load"]}
    return pair.solve(
        Pose(*part("pose", "y", "z", "roll", "yaw")),
        Velocity(*part("velocity", "x", "y", "z", "roll", "yaw", "spin")),
        irregularity=Irregularity(*part("irregularity", "y", "z", "roll", "y_rate", "z_rate", "roll_rate")),
        friction=values.get("friction.coefficient", 0.3),
        rail=ElasticRail(
            values.get("rail.ky", 0.0) or math.inf,
            values.get("rail.kz", 0.0) or math.inf,
            *part("rail", "preload_y", "preload_z"),
        ),
        offset=WheelOffset(*part("offset", *OFFSET)),
        **load,
        **place,
    )


def expected(s: PairSolution, speed: float) -> dict[str, float]:
    """Return the outputs by the solver, without the totals."""
    d = s.damage
    outputs = {
        **dict(zip(("force.x", "force.y", "force.z"), s.force.tolist(), strict=True)),
        **dict(zip(("moment.x", "moment.y", "moment.z"), s.moment.tolist(), strict=True)),
        **{"wheelset.z": s.z, "pressure.max": s.max_pressure, "slip.ratio": s.slip_ratio, "gap_error": s.gap_error},
        **{
            "power.friction": abs(speed) * s.power_per_metre,
            "used_friction": s.used_friction,
            "bend": s.bend,
            "beyond": s.beyond,
        },
        **named("patches", count=len(s.contacts), area=s.area),
        **named("damage", T_gamma=d.T_gamma, wear_rate_pearce_sherratt=d.pearce_sherratt, index_burstow=d.burstow),
        **named("damage", wear_rate_usfd=d.usfd, archard_depth_max=d.archard_depth, archard_volume=d.archard_volume),
        **named("damage", fatigue_index_surface=d.fatigue_index, stress_index_max=d.stress_index),
        **{"damage.energy_index_max": d.energy_index, "status": s.status},
        **named("wheel", Q=s.Q, Y=s.Y, Y_over_Q=s.Y_over_Q),
        **named("rail", deflection_y=s.deflection[0], deflection_z=s.deflection[1]),
    }
    for k in range(3):
        c = s.contacts[k] if k < len(s.contacts) else None
        numbers = (0.0,) * len(_PATCH)
        if c:
            forces, xi = (c.N, c.Fx, c.Fy, c.Mx, c.My, c.Mz), c.creepage
            numbers = (*forces, *c.position, c.angle, c.area, c.max_pressure, xi.longitudinal, xi.lateral, xi.spin)
            numbers = (*numbers, c.approach, *c.on_rail, *c.on_wheel, c.used_friction)
        outputs |= {f"patch[{k + 1}].{name}": x for name, x in zip(_PATCH, numbers, strict=True)}
    return outputs


def scale(name: str, values: dict[str, float], wanted: dict[str, float]) -> float:
    """Return the scale of an output for differences: its value, or the norm of the quantity to which it belongs."""
    load = max(abs(wanted["force.z"]), 1.0)
    leaf = name.split(".")[-1]
    if name.startswith("force") or leaf in ("n", "fx", "fy", "Q", "Y"):
        return load
    if name.startswith("moment"):
        return load * 1.0
    if leaf in ("mx", "my", "mz"):
        return load * 1e-2
    if leaf in _OF_ONE:
        return 1.0
    return max(abs(wanted[name]), 1e-300)


def random_case(seed: int) -> tuple[dict[str, float], WheelRailPair]:
    """Return values of the FMU and a solver with the same parameters."""
    rng = np.random.default_rng(seed)
    left, by_load = bool(rng.integers(2)), rng.random() < 0.6
    V = rng.uniform(2.0, 80.0) * (
        -1.0 if seed % 7 == 3 else 0.0 if seed % 11 == 6 else 1.0
    )  # some roll back, some stand
    reference = 8.0 if seed % 5 == 2 else 1e-3
    radius, gauge, inclination = rng.uniform(0.3, 0.6), 1.435 + rng.uniform(-3e-3, 6e-3), rng.uniform(0.0, 0.06)
    gauge_point, flange_back = rng.uniform(0.010, 0.016), 1.360 + rng.uniform(-2e-3, 2e-3)
    distance, angle, most = rng.uniform(0.0, 1e-2), rng.uniform(0.0, 0.4), int(rng.integers(1, 4))
    samples, n_strips, n_elements = int(rng.integers(41, 121)), int(rng.integers(6, 40)), int(rng.integers(6, 40))
    normal, drawn = int(rng.integers(len(METHODS.normal))), int(rng.integers(len(METHODS.tangential)))
    family = PARTNERS[list(METHODS.normal.values())[normal].family]
    partners = [k for k, method in enumerate(METHODS.tangential.values()) if method.family == family]
    tangential = partners[drawn % len(partners)]
    G, nu, H, k = rng.uniform(70e9, 90e9), rng.uniform(0.0, 0.5), rng.uniform(2e9, 4e9), rng.uniform(2e8, 4e8)
    material = contact.Material(G, nu, hardness=H, shear_yield=k)
    geometry = Pair(
        profile.s1002(), profile.rail_60e1(0.0).rotated(-math.atan(inclination)), side="left" if left else "right",
        nominal_radius=radius, gauge=gauge, gauge_point=gauge_point, flange_back=flange_back, combine_distance=distance,
        combine_angle=angle, most_patches=most, samples=samples, material=material, reference_speed=reference,
    )  # fmt: skip
    pose, rail = rng.uniform((-9e-3, -0.02, -0.03), (9e-3, 0.02, 0.03)), rng.uniform(-1, 1, 3) * (1e-3, 1e-3, 5e-3)
    at = Pose(pose[0], 0.0, pose[1], pose[2])
    z = geometry.touch(at, Irregularity(*rail)) + rng.uniform(-3e-5, 2e-4)
    values = {
        **{"side": 1 if left else 2, "reference_speed": reference, "wheel.radius": radius, "wheel.flange_back": flange_back},
        **{"track.gauge": gauge, "track.gauge_point": gauge_point, "rail.inclination": inclination},
        **named("patches", max=most, combine_distance=distance, combine_angle=angle),
        **named("method", normal=normal + 1, tangential=tangential + 1),
        **named("material", shear_modulus=G, poisson_ratio=nu, hardness=H, shear_yield=k),
        **named("resolution", n_strips=n_strips, n_elements=n_elements, n_samples=samples),
        **named("pose", y=pose[0], z=z, roll=pose[1], yaw=pose[2]),
        "velocity.x": V,
        **{f"velocity.{name}": x for name, x in zip(("y", "z", "roll", "yaw"), rng.uniform(-0.1, 0.1, 4), strict=True)},
        "velocity.spin": -V / radius * rng.uniform(0.995, 1.005),
        **{f"irregularity.{name}": x for name, x in zip(("y", "z", "roll"), rail, strict=True)},
        **{f"irregularity.{name}_rate": x for name, x in zip(("y", "z", "roll"), rng.uniform(-0.05, 0.05, 3), strict=True)},
        "load.kind": 1 if by_load else 2,
        "load.normal_force": 10 ** rng.uniform(3.5, 5.2) if rng.random() < 0.95 else 0.0,
        "friction.coefficient": rng.uniform(0.0, 0.6),
    }  # fmt: skip
    if rng.random() < 0.15:  # a rail on springs
        values |= {
            "rail.ky": rng.choice((0.0, 10 ** rng.uniform(6.5, 8.0))),
            "rail.kz": rng.choice((0.0, 10 ** rng.uniform(7.0, 8.5))),
            "rail.preload_y": rng.uniform(-5e3, 5e3),
            "rail.preload_z": rng.uniform(-2e4, 2e4),
        }
    if rng.random() < 0.3:  # a flexible wheel
        size = np.array((1e-3, 1e-3, 1e-4, 5e-3, 0.1, 5e-3, *6 * (0.05,)))
        values |= {f"offset.{name}": x for name, x in zip(OFFSET, rng.uniform(-1, 1, 12) * size, strict=True)}
    methods = {"normal": list(METHODS.normal)[normal], "tangential": list(METHODS.tangential)[tangential]}
    pair = WheelRailPair(geometry, material=material, **methods, n_strips=n_strips, n_elements=n_elements)
    return values, pair


def _run(fmu) -> None:
    fmu.initialize()
    fmu.step(0.0, 1e-3)


def compare(fmu, seed: int) -> PairSolution | None:
    """Step an instance through a random case and compare it with the solver. Return None if there is no solution."""
    values, pair = random_case(seed)
    fmu.fmu.reset()
    fmu.update(values)
    try:
        s = solved(values, pair)
    except contact.ContactError:
        with pytest.raises(FMICallException, match="discard"):
            _run(fmu)
        return None
    _run(fmu)
    wanted = expected(s, max(abs(values["velocity.x"]), values["reference_speed"]))
    actual = {name: fmu[name] for name in wanted}
    worst = {name: abs(actual[name] - x) / scale(name, values, wanted) for name, x in wanted.items()}
    assert max(worst.values()) <= 1e-12, (seed, max(worst, key=worst.get), max(worst.values()))
    return s
