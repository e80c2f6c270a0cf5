"""The FMU `WheelRailPair` through the C interface of FMI."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from pair_case import MOTION, NAME, R0, compare, expected, solved
from thesis_case import THESIS

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import ElasticRail, WheelRailPair

ROOT = Path(__file__).parents[2]


def test_equals_the_solver_on_random_cases(open_pair):
    fmu = open_pair()
    statuses = {s.status for seed in range(300) if (s := compare(fmu, seed))}
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


@pytest.mark.parametrize("V", [30.0, -30.0])
def test_totals_are_rates_times_the_time_and_grow_in_both_directions(open_pair, V):
    fmu, energy, worn, T_gamma = open_pair(), 0.0, 0.0, 0.0
    fmu.update({**MOTION, **THESIS, "velocity.x": V, "velocity.spin": -V / R0 * 1.001})
    fmu.initialize(stop_time=1.0)
    for k in range(5):
        fmu.update({"pose.y": 1e-3 * k})
        fmu.step(2e-3 * k, 2e-3)
        energy += 2e-3 * fmu["power.friction"]
        worn += 2e-3 * abs(V) * fmu["damage.archard_volume"]
        T_gamma += 2e-3 * abs(V) * fmu["damage.T_gamma"]
    found = [fmu[f"total.{name}"] for name in ("energy", "worn_volume", "T_gamma", "distance")]
    assert found == pytest.approx([energy, worn, T_gamma, 0.01 * abs(V)], rel=1e-12)
    assert min(found) > 0.0


def exchanged(file: Path, folder: Path) -> tuple[Path, list[profile.Profile]]:
    """Return the FMU with a cone on a circular rail, from plain columns in millimetres, and the profiles as read."""
    options, read = [], []
    for kind, shape in (("wheel", profile.cone(0.05)), ("rail", profile.rail_arc(0.3))):
        path = folder / f"{kind}.txt"
        np.savetxt(path, 1e3 * np.stack((shape.y, shape.z), axis=1))
        options += [f"--{kind}", path]
        read.append(profile.read(path, kind=kind, unit="mm", side="right"))
    path = Path(shutil.copy(file, folder))
    command = [sys.executable, "-m", "contact_fmu.exchange", "profiles", path, *options]
    subprocess.run([*command, "--profile-unit", "mm", "--profile-side", "right"], check=True, cwd=ROOT)
    return path, read


def test_takes_a_users_own_profiles(native, open_pair, tmp_path):
    """They are replaced in the finished file, without a compiler."""
    path, profiles = exchanged(native.with_name(f"{NAME}.fmu"), tmp_path)
    fmu = open_pair(path=path)
    values = {"pose.y": 1e-3, "velocity.x": 20.0, "velocity.spin": -20.0 / 0.46}
    fmu.update({**values, "track.gauge_point": 1e-3, "rail.inclination": 0.0})
    fmu.initialize().step()
    wanted = expected(solved(values, WheelRailPair(Pair(*profiles, gauge_point=1e-3))), 20.0)
    assert {name: fmu[name] for name in wanted} == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    assert fmu["patch[1].angle"] == pytest.approx(-math.atan(0.05), abs=1e-5)


def test_a_state_of_other_profiles_is_refused(native, open_pair, tmp_path):
    path, _ = exchanged(native.with_name(f"{NAME}.fmu"), tmp_path)
    one, other = open_pair(), open_pair(path=path)
    state = one.fmu.getFMUstate()
    copy = other.fmu.deSerializeFMUstate(one.fmu.serializeFMUstate(state))
    with pytest.raises(FMICallException):
        other.fmu.setFMUstate(copy)
    assert "other files in resources" in other.log[-1][1]
    other.fmu.freeFMUstate(copy)
    one.fmu.freeFMUstate(state)
