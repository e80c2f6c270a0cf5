"""Command line: a load means the same in every command, as in Python: what the normal forces alone carry."""

import json

import pytest

pytest.importorskip("typer")

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import RollerRig, WheelRailPair
from tests.command_line import call

PAIR = Pair(profile.s1002(), profile.rail_60e1())
AT = ("--y", 6.5e-3, "--friction", 0.35)


@pytest.mark.parametrize("amount", ["load", "vertical"])
def test_rail_and_in_time_take_load_and_vertical_as_python_does(amount, tmp_path):
    s = WheelRailPair(PAIR).solve(Pose(y=6.5e-3), Velocity(forward=20.0), friction=0.35, **{amount: 80e3})
    given = (f"--{amount}", 80e3)
    (side,) = json.loads(call("rail", *AT, *given, "--json").stdout)["sides"]
    assert (side["Fx"], side["Fy"], side["Fz"]) == tuple(s.force)
    motion = tmp_path / "m.csv"
    motion.write_text("time\n0\n")
    (row,) = json.loads(call("in-time", motion, *AT, *given, "--json").stdout)["rows"]
    assert (row["Fx"], row["Fy"], row["Fz"]) == tuple(s.force)
    motion.write_text(f"time,{amount}\n0,80e3\n")
    (row,) = json.loads(call("in-time", motion, *AT, "--json").stdout)["rows"]
    assert (row["Fx"], row["Fy"], row["Fz"]) == tuple(s.force)


def test_the_name_of_the_fmu_for_the_load_is_the_load(tmp_path):
    motion = tmp_path / "m.csv"
    rows = []
    for name in ("load", "load.normal_force"):
        motion.write_text(f"time,{name}\n0,70e3\n")
        rows += json.loads(call("in-time", motion, *AT, "--json").stdout)["rows"]
    assert rows[0] == rows[1]


def test_two_amounts_exclude_each_other(tmp_path):
    motion = tmp_path / "m.csv"
    motion.write_text("time,load\n0,70e3\n")
    said = call("in-time", motion, "--vertical", 7e4, code=2).stderr
    assert "--vertical 70000 and the column 'load' exclude each other" in said
    motion.write_text("time,load,pose.z\n0,70e3,0\n")
    assert "the columns 'pose.z' and 'load' exclude each other" in call("in-time", motion, code=2).stderr
    for words in (("rail",), ("roller", 0.6), ("along",)):
        said = call(*words, "--load", 7e4, "--vertical", 8e4, code=2).stderr
        assert "--load 70000 and --vertical 80000 exclude each other" in said


def test_the_normal_forces_alone_carry_the_load_of_a_roller_rig():
    rig, at = RollerRig(PAIR, 0.6), (Pose(y=6.5e-3), Velocity(forward=20.0))
    by_load, by_force = rig.solve(*at, load=6e4), rig.solve(*at, vertical=6e4)
    assert abs(by_force.Q - 6e4) < 6.0
    assert abs(by_load.Q - 6e4) > 20.0
    frictionless = rig.solve(*at, load=6e4, friction=0.0)
    assert abs(frictionless.Q - 6e4) < 6.0
    with pytest.raises(ContactError, match=r"vertical = 60000.0 excludes load = 60000.0"):
        rig.solve(*at, load=6e4, vertical=6e4)
