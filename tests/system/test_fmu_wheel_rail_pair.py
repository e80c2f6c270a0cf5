"""The FMU `WheelRailPair` in both packagings, through the C interface of FMI."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmu_instance import Instance, recovers
from pair_case import MOTION, NAME, R0, compare, expected, solved, trajectory, warm
from thesis_case import THESIS

import contact
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import ContactDamping, ElasticRail, FrictionMemory, WheelRailPair

ROOT = Path(__file__).parents[2]


@pytest.fixture
def fmu(open_pair):
    """Return an instance in MOTION under 80 kN, ready to step."""
    fmu = open_pair()
    fmu.update({**MOTION, **THESIS})
    return fmu.initialize(stop_time=1.0)


def test_equals_the_solver_on_random_cases(open_pair, request):
    fmu = open_pair()
    cases = 300 if "native" in request.node.name else 60
    statuses = {s.status for seed in range(cases) if (s := compare(fmu, seed))}
    assert statuses >= {contact.Status.OK, contact.Status.NO_CONTACT, contact.Status.SATURATED}


def test_a_rail_on_springs_is_in_balance_and_starts_from_its_last_deflection(open_pair):
    springs = {"rail.ky": 8e6, "rail.kz": 5e7, "rail.preload_y": 500.0, "load.kind": 3, "load.normal_force": 6e4}
    fmu, pair = open_pair(), WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(1.0 / 40.0)))
    fmu.update(springs)
    fmu.initialize()
    rail = ElasticRail(8e6, 5e7, 500.0)
    pair.solve(Pose(), Velocity(20.0, spin=-20.0 / 0.46), vertical=6e4, rail=rail)  # as the FMU when it is initialised
    for k, y in enumerate((5e-3, 6e-3, 6.5e-3)):
        fmu.update({"pose.y": y})
        fmu.step(1e-3 * k, 1e-3)
        wanted = pair.solve(Pose(y=y), Velocity(20.0, spin=-20.0 / 0.46), vertical=6e4, rail=rail)
        # both stop at 2e-5 of the vertical force, from the deflections before, which become the same
        apart = 2.0 * 2e-5 * 6e4 / 8e6 if k < 2 else 1e-9
        assert fmu["rail.deflection_y"] == pytest.approx(wanted.deflection[0], abs=apart)
        assert fmu["rail.deflection_z"] == pytest.approx(6e4 / 5e7, rel=1e-4)
        assert fmu["force.y"] == pytest.approx(wanted.force[1], abs=2.4)
        assert 8e6 * fmu["rail.deflection_y"] == pytest.approx(500.0 - fmu["force.y"], abs=2.0)
    assert fmu["rail.deflection_y"] > 1e-4


def test_friction_along_the_track_is_an_input(open_pair):
    """The coefficient of every step is that of the place where the wheel is."""
    fmu, pair = open_pair(), WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(1.0 / 40.0)))
    spin = -20.0 / 0.46 * 1.005
    fmu.update({"velocity.spin": spin, "load.kind": 3})
    fmu.initialize()
    used = []
    for k in range(5):
        along = 20.0 * 1e-3 * k
        friction = 0.35 - 0.2 * math.exp(-(((along - 0.04) / 0.03) ** 2))  # a dirty place
        fmu.update({"friction.coefficient": friction})
        fmu.step(1e-3 * k, 1e-3)
        wanted = pair.solve(Pose(), Velocity(20.0, spin=spin), vertical=80e3, friction=friction)
        assert fmu["force.x"] == pytest.approx(wanted.force[0], abs=1e-9 * 80e3)
        used.append(fmu["used_friction"] / friction)
    np.testing.assert_allclose(used, 1.0, atol=2e-3)  # full slip follows the coefficient


def test_a_host_adds_friction_memory_and_contact_damping(open_pair):
    """From the outputs of the FMU, as docs/understand/other_wheels.md says."""
    n, step, damping = 6, 1e-3, 2e-4
    law = Friction(static=0.35, law="exponential", kinetic=0.15, half_speed=0.5)
    spin = -20.0 / 0.46 * (1.0 + 2e-3 * np.arange(n))
    motion = {"velocity.x": np.full(n, 20.0), "velocity.spin": spin, "load.normal_force": 6e4 + 2e3 * np.arange(n)}
    motion |= {"pose.y": 2e-4 * np.arange(n), "offset.yaw": 2e-4 * np.arange(n)}
    wanted = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(1.0 / 40.0))).run(
        {name.replace("load.normal_force", "vertical"): column for name, column in motion.items()}
        | {"time": step * np.arange(n)},
        memory=FrictionMemory(law, 1e-3),
        damping=ContactDamping(damping, damping),
    )
    fmu, memory, before = open_pair(), FrictionMemory(law, 1e-3), None
    fmu.update({"load.kind": 3})
    fmu.initialize()
    for k in range(n):
        fmu.update(
            {**{name: float(column[k]) for name, column in motion.items()}, "friction.coefficient": memory.coefficient}
        )
        fmu.step(step * k, step)
        forces = np.array([fmu[f"patch[1].{name}"] for name in ("n", "fx", "fy")])
        added = np.zeros(3) if before is None else damping * (forces - before) / step
        c, s = math.cos(fmu["patch[1].angle"]), math.sin(fmu["patch[1].angle"])
        turned = np.array([added[1], c * added[2] + s * added[0], s * added[2] - c * added[0]])
        found = turned + np.array([fmu["force.x"], fmu["force.y"], fmu["force.z"]])
        np.testing.assert_allclose(found, [wanted[name][k] for name in ("Fx", "Fy", "Fz")], atol=1e-6 * 6e4)
        before = forces
        memory.advance(20.0 * math.hypot(fmu["patch[1].longitudinal"], fmu["patch[1].lateral"]), step)
    assert memory.coefficient < 0.34  # from 0.35


def test_energy_is_the_power_times_the_time(fmu):
    energy = worn = 0.0
    for k in range(5):
        fmu.update({"pose.y": 1e-3 * k})
        fmu.step(2e-3 * k, 2e-3)
        energy += 2e-3 * fmu["power.friction"]
        worn += 2e-3 * fmu["velocity.x"] * fmu["damage.archard_volume"]
    assert fmu["total.energy"] == pytest.approx(energy, rel=1e-12)
    assert fmu["total.worn_volume"] == pytest.approx(worn, rel=1e-12)


def test_a_wheel_that_spins_on_the_spot_dissipates_its_friction_times_its_slip(open_pair):
    fmu = open_pair()
    fmu.update({"velocity.x": 0.0, "velocity.spin": -2.0, **THESIS})
    fmu.initialize().step()
    slip = abs(fmu["patch[1].longitudinal"]) * 1e-3  # creepages refer to reference_speed, 1 mm/s
    assert slip == pytest.approx(2.0 * R0, rel=0.01)
    assert fmu["power.friction"] == pytest.approx(abs(fmu["force.x"]) * slip, rel=2e-3)


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("pose.y", math.nan, "pose.y = nan is not finite"),
        ("pose.yaw", 0.2, "pose.yaw = 0.2 is outside the allowed range [-0.1, 0.1]"),
        ("velocity.x", -math.inf, "velocity.x = -inf is not finite"),
        ("irregularity.roll_rate", math.inf, "irregularity.roll_rate = inf is not finite"),
        ("offset.yaw", 0.11, "offset.yaw = 0.11 is outside the allowed range [-0.1, 0.1]"),
        ("offset.z_rate", math.nan, "offset.z_rate = nan is not finite"),
        ("offset.yaw", 0.098, "offset"),  # with the wheelset's yaw beyond 0.1
        ("load.normal_force", -1e4, "load.normal_force = -10000 is outside the allowed range [-1000, inf["),
        ("pose.y", 1.0, "pose.y = 1: the profiles of wheel and rail do not overlap"),
        ("load.normal_force", 1e12, "load.normal_force = 1e+12: no height was found"),
    ],
)
def test_a_bad_input_is_discarded_by_name_and_the_instance_goes_on(fmu, name, value, says):
    fmu.step()
    before = fmu["force.y"]
    recovers(fmu, {name: value}, says, 2)
    assert fmu["force.y"] == before


def test_lift_off_is_a_valid_result(fmu):
    fmu.update({"load.normal_force": 0.0})
    fmu.step()
    outputs = fmu.all("output")
    assert outputs["status_real"] == contact.Status.NO_CONTACT
    left = ("status_real", "wheelset.z", "total.distance")
    assert not any(value for name, value in outputs.items() if name not in left)


def exchanged(file: Path, folder: Path) -> tuple[Path, list[profile.Profile]]:
    """Return the FMU with a cone on a circular rail, from plain columns in millimetres, and the profiles as read."""
    options, read = [], []
    for kind, shape in (("wheel", profile.cone(0.05)), ("rail", profile.rail_arc(0.3))):
        path = folder / f"{kind}.txt"
        np.savetxt(path, 1e3 * np.stack((shape.y, shape.z), axis=1))
        options += [f"--{kind}", path]
        read.append(profile.read(path, kind=kind, unit="mm", side="right"))
    path = Path(shutil.copy(file, folder))
    command = [sys.executable, "-m", "contact_fmu.profiles", path, *options]
    subprocess.run([*command, "--profile-unit", "mm", "--profile-side", "right"], check=True, cwd=ROOT)
    return path, read


def test_takes_a_users_own_profiles(pair_file, open_pair, tmp_path):
    """They are replaced in the finished file, without a compiler."""
    path, profiles = exchanged(pair_file, tmp_path)
    fmu = open_pair(path=path)
    values = {"pose.y": 1e-3, "velocity.x": 20.0, "velocity.spin": -20.0 / 0.46}
    fmu.update({**values, "track.gauge_point": 1e-3, "rail.inclination": 0.0})
    fmu.initialize().step()
    wanted = expected(solved(values, WheelRailPair(Pair(*profiles, gauge_point=1e-3))), 20.0)
    assert {name: fmu[name] for name in wanted} == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    assert fmu["patch[1].angle"] == pytest.approx(-math.atan(0.05), abs=1e-5)


@pytest.mark.parametrize("damage", ["a bit", "the end", "all"])
def test_a_damaged_profile_is_refused_when_instantiated(pair_file, tmp_path, damage):
    folder = Path(fmpy.extract(str(pair_file), str(tmp_path)))
    resource = folder / "resources" / "rail.profile"
    content = bytearray(resource.read_bytes())
    content[2000] ^= damage == "a bit"
    resource.write_bytes(content[:-9] if damage == "the end" else content)
    if damage == "all":
        resource.unlink()
    log = []
    with pytest.raises(Exception, match="instantiate"):
        Instance(folder, log)
    if pair_file.parent.name == "native":  # pythonfmu prints what a constructor raises
        assert "resource rail.profile" in log[0][1]


def test_both_packagings_go_on_alike_from_step_to_step(native_pair, open_fmu):
    """This uses interacting strips, which start from the last step."""
    one, other = native_pair(), open_fmu(NAME)
    for fmu in (one, other):
        warm(fmu).initialize()
    assert trajectory(one, 0) == trajectory(other, 0)


def test_a_state_of_other_profiles_is_refused(native, native_pair, tmp_path):
    path, _ = exchanged(native.with_name(f"{NAME}.fmu"), tmp_path)
    one, other = native_pair(), native_pair(path=path)
    state = one.fmu.getFMUstate()
    copy = other.fmu.deSerializeFMUstate(one.fmu.serializeFMUstate(state))
    with pytest.raises(FMICallException):
        other.fmu.setFMUstate(copy)
    assert "other files in resources" in other.log[-1][1]
    other.fmu.freeFMUstate(copy)
    one.fmu.freeFMUstate(state)
