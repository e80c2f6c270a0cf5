"""The FMU `WheelRailPair` for hosts with Python as a whole, through the C interface of FMI."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from fmu_instance import Instance
from pair_case import MOTION, NAME, compare, expected, mirrored, solved

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair
from contact.pair import WheelRailPair

ROOT = Path(__file__).parents[2]
DISCARD = 2


@pytest.fixture
def fmu(open_fmu):
    """In MOTION under 80 kN, ready to step."""
    fmu = open_fmu(NAME)
    fmu.update(MOTION)
    return fmu.initialize(stop_time=1.0)


def discarded(fmu, time=0.0, h=1e-3) -> str:
    """Step, see it discarded, return what the FMU says."""
    fmu.log.clear()
    with pytest.raises(FMICallException) as caught:
        fmu.step(time, h)
    assert caught.value.status == DISCARD
    assert [status for status, _ in fmu.log] == [DISCARD]
    return fmu.log[0][1]


def test_fmpy_finds_no_problem(fmus):
    assert validate_fmu(str(fmus / f"{NAME}.fmu")) == []


def test_equals_the_solver_on_random_cases(open_fmu):
    fmu = open_fmu(NAME)
    statuses = {s.status for seed in range(60) if (s := compare(fmu, seed))}
    assert statuses >= {contact.Status.OK, contact.Status.NO_CONTACT, contact.Status.SATURATED}


def test_left_is_the_mirror_image_of_right(fmu, open_fmu):
    left = open_fmu(NAME)
    left.update({**mirrored(MOTION), "side": 1})
    left.initialize()
    for instance in (fmu, left):
        instance.step()
    sign = {"force.x": 1, "force.y": -1, "force.z": 1, "moment.x": -1, "moment.y": 1, "moment.z": -1, "patch[1].y": -1}
    for name, factor in sign.items():
        assert left[name] == factor * fmu[name]
    assert left["patch[1].angle"] == -fmu["patch[1].angle"]
    assert left["total.energy"] == fmu["total.energy"] > 0.0


def test_energy_is_the_power_times_the_time(fmu):
    energy = worn = 0.0
    for k in range(5):
        fmu.update({"pose.y": 1e-3 * k})
        fmu.step(2e-3 * k, 2e-3)
        energy += 2e-3 * fmu["power.friction"]
        worn += 2e-3 * fmu["velocity.x"] * fmu["damage.archard_volume"]
    assert fmu["total.energy"] == pytest.approx(energy, rel=1e-12)
    assert fmu["total.worn_volume"] == pytest.approx(worn, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("pose.y", math.nan, "pose.y = nan is outside the allowed range ]-inf, inf["),
        ("pose.yaw", 0.2, "pose.yaw = 0.2 is outside the allowed range [-0.1, 0.1]"),
        ("velocity.x", 0.0, "velocity.x = 0 is outside the allowed range ]0, inf["),
        ("irregularity.roll_rate", math.inf, "irregularity.roll_rate = inf is outside"),
        ("load.normal_force", -1.0, "load.normal_force = -1 is outside the allowed range [0, inf["),
        ("pose.y", 1.0, "pose.y = 1: the right wheel and rail profiles do not overlap"),
        ("load.normal_force", 1e12, "load = 1e+12: no z was found"),
    ],
)
def test_a_bad_input_is_discarded_by_name_and_the_instance_goes_on(fmu, name, value, says):
    fmu.step()
    before, good = fmu.all("output"), fmu[name]
    fmu.update({name: value})
    for _ in range(2):
        assert discarded(fmu, 1e-3).startswith(says)
    assert fmu.all("output") == before
    fmu.update({name: good})
    fmu.step(1e-3)
    assert fmu["force.y"] == before["force.y"]


def test_lift_off_is_a_valid_result(fmu):
    fmu.update({"load.normal_force": 0.0})
    fmu.step()
    outputs = fmu.all("output")
    assert outputs["status"] == contact.Status.NO_CONTACT
    assert not any(value for name, value in outputs.items() if name not in ("status", "wheelset.z"))


def trajectory(fmu, start: int) -> list[dict[str, float]]:
    rows = []
    for k in range(start, start + 4):
        fmu.update({"pose.y": 6e-3 * math.sin(0.4 * k), "load.normal_force": 8e4 + 1e4 * math.cos(k)})
        fmu.step(k * 1e-3)
        rows.append(fmu.all("output"))
    return rows


def test_a_serialised_state_with_its_warm_start_continues_bit_by_bit(open_fmu):
    fmu, other = open_fmu(NAME), open_fmu(NAME)
    for instance in (fmu, other):
        instance.update(
            {**MOTION, "method.normal": list(contact.methods().batched.normal).index("strip_halfspace") + 1}
        )
        instance.initialize()
    trajectory(fmu, 0)
    state = fmu.fmu.getFMUstate()
    content = fmu.fmu.serializeFMUstate(state)
    wanted = trajectory(fmu, 4)
    fmu.fmu.setFMUstate(state)
    assert trajectory(fmu, 4) == wanted
    fmu.fmu.freeFMUstate(state)
    other.fmu.setFMUstate(other.fmu.deSerializeFMUstate(content))
    assert trajectory(other, 4) == wanted


def test_takes_a_users_own_profiles(fmus, tmp_path):
    """Exchanged in the finished file: a cone on a rail that is one arc, from plain columns in millimetres."""
    files = {"wheel": profile.cone(0.05), "rail": profile.rail_arc(0.3)}
    options = []
    for kind, shape in files.items():
        path = tmp_path / f"{kind}.txt"
        np.savetxt(path, 1e3 * np.stack((shape.y, shape.z), axis=1))
        options += [f"--{kind}", path]
    path = shutil.copy(fmus / f"{NAME}.fmu", tmp_path)
    command = [sys.executable, "-m", "fmu_src.profiles", path, *options, "--unit", "mm", "--side", "right"]
    subprocess.run(command, check=True, cwd=ROOT)
    fmu = Instance(Path(fmpy.extract(path, str(tmp_path / "unzipped"))))
    values = {"pose.y": 1e-3, "velocity.x": 20.0, "velocity.spin": -20.0 / 0.46}
    fmu.update({**values, "track.gauge_point": 1e-3, "rail.inclination": 0.0})
    fmu.initialize().step()
    read = [profile.read(tmp_path / f"{kind}.txt", kind=kind, unit="mm", side="right") for kind in files]
    wanted = expected(solved(values, WheelRailPair(Pair(*read, gauge_point=1e-3))), 20.0)
    assert {name: fmu[name] for name in wanted} == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    assert fmu["patch[1].angle"] == pytest.approx(-math.atan(0.05), abs=1e-5)
    fmu.fmu.freeInstance()


def test_a_damaged_profile_is_refused_when_instantiated(fmus, tmp_path):
    folder = Path(fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path)))
    resource = folder / "resources" / "rail.profile"
    content = bytearray(resource.read_bytes())
    content[2000] ^= 1
    resource.write_bytes(content)
    with pytest.raises(Exception, match="instantiate"):
        Instance(folder)
