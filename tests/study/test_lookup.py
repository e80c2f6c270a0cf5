"""Look-up tables: values at the breakpoints are solutions, files hold them in their order, errors are measured."""

import csv
from pathlib import Path

import numpy as np
import pytest
from scipy.io import loadmat

from contact import ContactError
from contact.geometry import profile
from contact.geometry.wheelset import Pair
from contact.pair import WheelRailPair, over_poses
from contact.study.lookup import estimate, interpolation_error, lookup_table
from tests.command_line import call

AXES = {"load": [60e3, 100e3], "y": np.linspace(-5e-3, 5e-3, 5), "longitudinal": [-2e-3, 0.0, 2e-3]}


@pytest.fixture(scope="module")
def pair():
    return WheelRailPair(Pair(profile.s1002(), profile.rail_60e1()))


@pytest.fixture(scope="module")
def table(pair):
    return lookup_table(pair, AXES, yaw=1e-3)


def test_values_at_the_breakpoints_are_solutions(pair, table):
    assert list(table.axes) == ["y", "load", "longitudinal"]
    assert table.tables["Fx"].shape == (5, 2, 3)
    one = over_poses(pair, y=AXES["y"][3], load=100e3, longitudinal=-2e-3, yaw=1e-3)
    assert table.tables["Fx"][3, 1, 0] == one.Fx
    at = table.interpolated(y=AXES["y"][3], load=100e3, longitudinal=-2e-3)
    assert at["max_pressure"] == one.max_pressure
    between = table.interpolated(y=AXES["y"][3], load=100e3, longitudinal=-1e-3)["Fx"]
    assert between == pytest.approx(table.tables["Fx"][3, 1, :2].mean())


def test_a_point_outside_of_the_table_is_cut_to_it_with_a_warning(table):
    inside = {"y": AXES["y"][3], "load": 100e3}
    with pytest.warns(UserWarning, match=r"at: longitudinal = -1 is outside of the table, -0.002 to .* is cut to it"):
        cut = table.interpolated(**inside, longitudinal=-1.0)["Fx"]
    assert cut == table.interpolated(**inside, longitudinal=-2e-3)["Fx"]


def test_files_hold_breakpoints_and_tables_in_the_order_of_the_axes(table, tmp_path):
    for ending in ("mat", "npz", "csv"):
        table.write(tmp_path / f"t.{ending}")
    mat, npz = loadmat(tmp_path / "t.mat", squeeze_me=True), np.load(tmp_path / "t.npz")
    assert mat["axes"].tolist() == ["y", "load", "longitudinal"]
    for content in (mat, npz):
        assert np.array_equal(content["Fy"], table.tables["Fy"])
        for name, points in table.axes.items():
            assert np.array_equal(content[f"bp_{name}"], points)
    with open(tmp_path / "t.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 30
    assert [float(row["Fx"]) for row in rows] == table.tables["Fx"].ravel().tolist()
    assert (float(rows[1]["y"]), float(rows[1]["load"]), float(rows[1]["longitudinal"])) == (-5e-3, 60e3, 0.0)


def test_the_error_falls_with_more_breakpoints(pair):
    coarse, fine = (
        interpolation_error(
            pair, lookup_table(pair, {"y": np.linspace(-4e-3, 4e-3, n)}, load=80e3), points=60, load=80e3
        )
        for n in (3, 65)
    )
    for name in ("Fx", "Fy", "Mx", "z"):
        assert fine[name].rms < 0.5 * coarse[name].rms, name
        assert fine[name].rms <= fine[name].largest <= 2.0 * fine[name].scale


def test_an_estimate_has_the_number_of_poses_and_the_size(pair):
    found = estimate(pair, AXES, tables=8)
    assert (found.poses, found.size) == (30, 30 * 8 * 8)
    assert 0.0 < found.seconds < 60.0


def test_wrong_tables_are_refused(pair, table, tmp_path):
    for axes, more, message in (
        ({"yew": [0.0, 1e-3]}, {}, "'yew' is none of .*did you mean 'yaw'"),
        ({"y": [0.0]}, {}, "two at least"),
        ({"y": [1e-3, 0.0]}, {}, "no increasing breakpoints"),
        ({"y": [0.0, float("nan")]}, {}, r"axes\['y'\]\[1\] = nan is not finite"),
        ({}, {}, "axes is empty"),
        ({"y": [0.0, 1e-3]}, {"tables": ("Fq",)}, "'Fq' is none of"),
        ({name: np.linspace(0.0, 1e-3, 500) for name in ("y", "yaw", "lateral")}, {}, "numbers; allowed"),
    ):
        with pytest.raises(ContactError, match=message):
            lookup_table(pair, axes, **more)
    with pytest.raises(ContactError, match="ends in one of"):
        table.write(tmp_path / "t.xlsx")
    with pytest.raises(ContactError, match="has the axes y, load, longitudinal"):
        table.interpolated(y=0.0)


def test_the_command_tells_plan_error_and_file(tmp_path):
    path = Path(tmp_path / "t.npz")
    said = call(
        "lut", "--axis", "y=-2e-3:2e-3:3", "--axis", "load=60e3,90e3", "--table", "Fx", "--check", 10, "--out", path
    )
    assert "6 poses" in said.output
    assert "Fx" in said.output
    assert np.load(path)["Fx"].shape == (3, 2)
    for wrong, message in (
        ("y=1:2", "give NAME=FROM:TO:NUMBER"),
        ("yew=0:1:3", "'yew' is none of"),
        ("y=0:1e-3:1000000000", "from 2 to 1000000"),
    ):
        assert message in call("lut", "--axis", wrong, "--out", path, code=2).output
    assert "--check" in call("lut", "--check", 10**12, "--out", path, code=2).stderr
    said = call("lut", "--axis", "y=0:1e-3:2", "--load", 80, "--speed", 300, "--check", 1, "--out", path).stderr
    assert [line.partition(": a")[0].partition(": the")[0] for line in said.splitlines() if "warning" in line] == [
        "contact: warning: --load 80",
        "contact: warning: --speed 300",
    ]
    assert "a name stands twice" in call("lut", *["--axis", "y=0:1e-3:2"] * 2, "--out", path, code=2).output
    assert "ends in one of" in call("lut", "--out", tmp_path / "t.xlsx", code=2).output
