"""A wheel along surfaces: columns and rows, picture, command line."""

import json
import math
import warnings

import numpy as np
import pytest

from contact import ContactError
from contact.errors import PlausibilityWarning
from contact.geometry import profile
from contact.geometry.surfaces import Flat, Polygon, RailSurface, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pose, Velocity
from contact.pair import WheelRailPair
from examples.crossing import crossing
from tests.command_line import call

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
R0 = 0.460


@pytest.fixture(scope="module")
def solver():
    wheel = WheelSurface.constant(WHEEL, Polygon(20, 1e-4))
    return WheelRailPair(SurfacePair(wheel, RAIL), normal="strip_halfspace")


@pytest.fixture(scope="module")
def run(solver):
    return solver.run(
        {"station": [0.0, 0.02, 0.04], "pose.y": 1e-3, "velocity.x": 20.0, "penetration": 8e-5}, rotation=0.1
    )


def test_the_wheel_rolls_on_with_its_nominal_radius(solver, run):
    assert run["rotation"] == pytest.approx([0.1, 0.1 - 0.02 / R0, 0.1 - 0.04 / R0], abs=1e-15)
    alone = solver.solve(
        Pose(y=1e-3), Velocity(20.0), station=0.04, rotation=float(run["rotation"][2]), penetration=8e-5
    )
    assert run.solutions[2].force == pytest.approx(alone.force, abs=1e-3 * alone.Q)  # strips start from the last call
    assert run.solutions[2].z == alone.z


def test_columns_and_rows_hold_what_the_solutions_say(run):
    rows = run.patches()
    assert run["Q"] == pytest.approx([-one.force[2] for one in run.solutions])
    assert [row["station"] for row in rows] == [0.0, 0.02, 0.04]
    contact = run.solutions[1].contacts[0]
    assert (rows[1]["N"], rows[1]["x"]) == (contact.N, contact.position[0])
    assert run["z"].max() - run["z"].min() > 1e-5  # the polygon lifts the wheel


def test_an_error_names_its_station(solver):
    with pytest.raises(ContactError, match=r"at station 0\.1 m: pose\.y = 0\.5"):
        solver.run({"station": [0.1], "pose.y": 0.5, "penetration": 1e-4})
    with pytest.raises(ContactError, match=r"'station' has shape \(1, 2\)"):
        solver.run({"station": [[0.1, 0.2]]})


@pytest.mark.slow
def test_a_picture_is_written_and_not_blank(tmp_path, run):
    plot = pytest.importorskip("contact.plot")
    mpl = pytest.importorskip("matplotlib.image")
    plot.passage(run, "a polygon").savefig(tmp_path / "run.png")
    assert mpl.imread(tmp_path / "run.png").std() > 0.02


def test_a_picture_needs_two_stations(solver):
    plot = pytest.importorskip("contact.plot")
    apart = solver.run({"station": [0.0], "pose.z": -1e-3})
    with pytest.raises(ContactError, match="1 station"):
        plot.passage(apart)


@pytest.mark.slow
def test_the_command_gives_the_numbers_of_the_python_api(tmp_path):
    words = ("along", "--flat", 0.05, "--flat-depth", 4e-4, "--points", 2, "--from", 0.0, "--to", 0.01, "--angle", 0.02)
    output = tmp_path / "flat.csv"
    result = call(*words, "--normal", "strip_halfspace", "--json", "--out", output)
    told = json.loads(result.stdout)
    wheel = WheelSurface.constant(WHEEL, Flat(0.05, R0, 4e-4))
    solver = WheelRailPair(SurfacePair(wheel, RAIL), normal="strip_halfspace")
    wanted = solver.run({"station": [0.0, 0.01], "velocity.x": 20.0, "load": 80e3}, rotation=0.02)
    assert told["z"] == pytest.approx(wanted["z"], abs=1e-12)
    assert told["patches_of"][1]["N"] == pytest.approx(wanted.patches()[1]["N"], rel=1e-9)
    assert len(output.read_text().splitlines()) == 1 + len(wanted.patches())


@pytest.mark.slow
def test_the_command_reads_slices(tmp_path):
    for k in range(3):
        lines = (f"{1e3 * y:.6f} {1e3 * z - 0.1 * k:.6f}\n" for y, z in zip(RAIL.y, RAIL.z, strict=True))
        (tmp_path / f"s{k}.txt").write_text("".join(lines))
    slices = tmp_path / "ramp.slcs"
    slices.write_text("0 1\n3\n0 0 0\n1\n-100 's0.txt'\n0 's1.txt'\n100 's2.txt'\n")
    words = ("along", "--rail", slices, "--origin", 0.7605, 0.0, "--points", 2, "--to", 0.02, "--normal", "analyn")
    result = call(*words)
    assert "N" in result.stdout
    assert "0.46" in result.stdout  # [mm] the contact lies R/1000 ahead on a ramp of 1 : 1000
    assert RailSurface.read(slices).sheet.u == pytest.approx([-0.1, 0.0, 0.1])


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("along", "--flat-depth", 1e-3), "--flat-depth 0.001 needs --flat"),
        (("along", "--rail", "absent.slcs", "--origin", 0.75, 0.0), "is missing"),
        (("along", "--polygon", 0, 1e-4), "order = 0"),
    ],
)
def test_bad_input_ends_with_a_message_and_code_2(words, message):
    assert message in call(*words, code=2).stderr.replace("\n", " ")


@pytest.mark.slow
def test_a_wheel_goes_over_from_wing_rail_to_nose_without_a_jump():
    """Both parts carry the load together for 14 mm of the way; height and forces pass over continuously."""
    found = crossing.run(np.arange(0.150, 0.1705, 0.002))
    contacts = [one.contacts for one in found.solutions]
    assert [len(c) for c in contacts] == [1, *(2 for _ in contacts[1:-2]), 1, 1]
    nose = np.array([sum(c.N for c in one if c.position[1] < 0.75) for one in contacts])
    wing = np.array([sum(c.N for c in one if c.position[1] > 0.75) for one in contacts])
    carried = [sum(c.N * math.cos(c.angle) for c in one) for one in contacts]
    assert carried == pytest.approx([8e4] * len(contacts), rel=2e-3)
    assert (np.diff(nose) > -300.0).all()  # N: only the contact angle changes at the end
    assert (np.diff(wing)[:-1] < 0.0).all()
    assert np.abs(np.diff(nose)).max() < 0.2 * 8e4
    z = found["z"]
    assert np.abs(np.diff(z)).max() < 3e-5  # 1 : 70 on 2 mm
    ahead = [c.position[0] for c in contacts[-1]]
    assert ahead[0] > 4e-3  # the nose rises, so the wheel touches it ahead of the axle


def test_a_way_that_leads_past_the_slices_is_warned_of():
    slices = RailSurface([0.0, 0.1], ramp())
    pair = WheelRailPair(SurfacePair(WHEEL, slices, rail_origin=(0.75, 0.0)), normal="analyn")
    motion = {"pose.y": 0.0, "velocity.x": 20.0, "penetration": 5e-5}
    with pytest.warns(PlausibilityWarning, match=r"station = 12 to 12.1: the slices of the rail lie at 0 to 0.1 m"):
        pair.run({"station": [12.0, 12.1], **motion})
    with warnings.catch_warnings():
        warnings.simplefilter("error", PlausibilityWarning)
        pair.run({"station": [-0.05, 0.05], **motion})


def ramp():
    """Return two slices of the rail, the second one lower by .1 mm."""
    points = np.column_stack((RAIL.y, RAIL.z))
    return [points, points + np.array([0.0, 1e-4])]
