"""Rails of slices in the vehicle and in scenarios (docs/understand/vehicle.md, 7)."""

import json
from dataclasses import replace

import numpy as np
import pytest
import typer

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import RailSurface
from contact_fmu import catalogue
from contact_fmu.exchange import exchange_track
from contact_models.life import declared_set
from contact_models.runs import report, result
from contact_models.runs.run import VehicleRun
from contact_models.runs.scenario import read as read_scenario
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.sections import RailSection
from examples.crossing import turnout
from tests.vehicle.parts import interrupted, simulation

RAIL = np.stack((profile.rail_60e1().y, profile.rail_60e1().z), axis=1)


def dip(depth=1e-3, length=0.6):
    """A rail 60E1 with a dip of one cosine [m]."""
    s = np.linspace(0.0, length, 31)
    down = 0.5 * depth * (1.0 - np.cos(2.0 * np.pi * s / length))
    return RailSurface(s, [RAIL + np.array([0.0, each]) for each in down], name="dip")


def elastic(vehicle="wheelset"):
    """A vehicle on the rails of the Manchester vehicle: 300 kg on springs."""
    return replace(read(vehicle), rail=read("manchester").rail)


def over(surface, steps, h=1e-4, at=0.5, sides=("right", "left"), **options):
    """Return a run over slices, and normal forces of the first wheels [N] and residual [J] at every step."""
    sections = [RailSection(surface=surface, side=side, at=at, name=f"of the {side}") for side in sides]
    run = simulation(elastic(), speed=20.0, sections=sections, **options)
    rows = []
    for _ in range(steps):
        run.advance(h)
        rows.append((run.distance, *run.wheels["normal"][:2], run.state.books[Book.RESIDUAL], run.on_surfaces[0]))
    return run, np.array(rows)


def test_slices_of_the_rail_are_the_rail():
    straight = RailSurface([0.0, 0.3, 0.6], [RAIL] * 3)
    run, rows = over(straight, 700)
    plain = simulation(elastic(), speed=20.0)
    on_profiles = np.empty(700)
    for k in range(700):
        plain.advance(1e-4)
        on_profiles[k] = plain.wheels["normal"][0]
    assert rows[:, 4].sum() * 1e-4 * 20.0 == pytest.approx(0.8, abs=0.005)  # 0.6 m and 0.1 m on both sides
    # the paths of the slices lie every 0.5 mm: where they begin, the force has a step of 0.16 %, and the wheel answers it
    assert rows[:, 1] == pytest.approx(on_profiles, rel=3e-3)
    assert run.state.q == pytest.approx(plain.state.q, abs=2e-6)


def test_a_wheel_follows_a_dip_and_leaves_with_its_static_load():
    run, rows = over(dip(), 1800)
    s, right, left = rows[:, :3].T
    static = right[0]
    before, after = s < 0.4, s > 3.2
    assert right[before] == pytest.approx(static, rel=3e-3)  # it oscillates about its static load by 1.0e-3
    assert right == pytest.approx(left, rel=1e-6)
    assert right.max() > 1.5 * static
    assert right.min() < 0.6 * static
    assert right[after] == pytest.approx(static, rel=0.03)
    assert run.state.books[Book.UNTRUSTED] == 0.0
    # energy: the wheelset's weight, 109 kN, falls by 1 mm in the dip: 109 J are exchanged
    assert np.abs(rows[:900, 3]).max() < 0.5


def test_every_wheelset_of_a_vehicle_meets_the_dip_where_it_is():
    vehicle = elastic("manchester")
    places = sorted((axle.at for axle in vehicle.wheelsets), reverse=True)
    sections = [RailSection(surface=dip(), side=side, at=places[0] + 0.3) for side in ("right", "left")]
    run = simulation(vehicle, speed=20.0, length=30.0, sections=sections)
    loads = np.empty((1050, 8))
    for row in loads:
        run.advance(2e-4)
        row[:] = run.wheels["normal"]
    first, second = loads[:, 0].argmax(), loads[:, 2].argmax()
    assert (second - first) * 2e-4 * 20.0 == pytest.approx(places[0] - places[1], abs=0.02)
    assert loads[second, 2] == pytest.approx(loads[first, 0], rel=0.1)
    assert loads[:, [0, 2]].max(axis=0) == pytest.approx(loads[:, [1, 3]].max(axis=0), rel=1e-3)
    assert np.ptp(loads[:, 4:]) < 0.1 * loads[0, 4]  # the rear bogie is not there yet
    assert abs(run.state.books[Book.RESIDUAL]) < 1.0


def test_a_dip_under_one_wheel_rolls_the_wheelset():
    _, rows = over(dip(), 500, sides=("left",))
    right, left = rows[:, 1:3].T
    assert np.ptp(left) > 3.0 * np.ptp(right)


def test_load_goes_from_the_wing_rail_to_the_nose_and_energy_is_kept():
    run, rows = over(turnout.surface(), 1400, at=0.3, sides=("right",))
    right = rows[:, 1]
    assert run.distance > 2.7
    assert not run.on_surfaces.any()
    assert 0.5 * right[0] < right.min() < 0.9 * right[0]
    assert 1.3 * right[0] < right.max() < 2.0 * right[0]
    assert np.abs(right[-100:] / right[0] - 1.0).max() < 0.1
    # the wheelset falls by 1 mm and climbs again: 109 J are exchanged
    assert np.abs(rows[:, 3]).max() < 2.5


def test_sections_that_do_not_continue_the_rail_are_refused():
    step = RailSurface([0.0, 0.5], [RAIL, RAIL + np.array([0.0, 5e-5])])
    with pytest.raises(ContactError, match=r"of the right: on its last slice a wheel stands -0.05 mm higher.*0.02 mm"):
        over(step, 0)


def test_sections_that_overlap_are_refused():
    sections = [RailSection(surface=dip(), side="left", at=at, name=f"[{at}]") for at in (3.0, 3.7)]
    with pytest.raises(
        ContactError, match=r"\[3.7\]: on the left rail it begins at 3.6 m, before \[3.0\] ends at 3.7 m"
    ):
        simulation(sections=sections)


SCENARIO = """
name = "crossing"
length = 3.0
speed = 20.0
recording = {settling = 0.2, spacing = 0.1}
methods = {normal = "analyn", tangential = "fastrip", strips = 20, elements = 12}
"""
SLICES = """
[[rails.slices]]
file = "crossing.slcs"
at = 0.5
side = "right"
"""


@pytest.fixture
def short(tmp_path):
    """Write a scenario beside a rail of three slices, which is read faster than the crossing, and return its path."""
    lines = [f"{at} 'slice{k}.txt'" for k, at in enumerate((0.0, 300.0, 600.0))]
    (tmp_path / "crossing.slcs").write_text("\n".join(["0 1", "3", "0 0 0", "1", *lines]) + "\n")
    for k in range(3):
        np.savetxt(tmp_path / f"slice{k}.txt", 1e3 * RAIL, fmt="%.6f")
    path = tmp_path / "crossing.toml"
    path.write_text(SCENARIO + SLICES)
    return path


@pytest.mark.usefixtures("undrawn")
def test_scenario_with_slices_runs_resumes_and_says_where_damage_is_not_counted(short):
    whole = VehicleRun(read_scenario(short))
    for _ in range(15):  # to a place on the slices
        whole.advance()
    assert whole.simulation.on_surfaces.tolist() == [True, False]
    interrupted(whole)
    found = result.dataset(whole)
    assert found.attrs["without_damage"] == "[]"
    side, begin, end = json.loads(found.attrs["sections_without_damage"])[0]
    assert (side, begin, end) == ("right", pytest.approx(0.4), pytest.approx(1.2))
    assert "given by slices: right rail, 0.40 to 1.2" in report.page_of(whole)
    # what rolls on the slices is not counted: half of the wheels on .8 of 2.8 m
    assert 0.0 < whole.balance["counted"] < 0.95 * whole.balance["dissipated"]


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (SLICES.replace("crossing.slcs", "none.slcs"), r"crossing.toml.rails.slices\[0\]: .*none.slcs"),
        (SLICES.replace("right", "inner"), r"rails.slices\[0\]: side = 'inner' is none of 'right', 'left'"),
        (SLICES + "origin = [0.7]", r"rails.slices\[0\]: origin = \(0.7,\) has 1 numbers; y and z are needed"),
        (SLICES + 'unit = "cm"', r"rails.slices\[0\]: unit = 'cm' is neither 'mm' nor 'm'"),
        (SLICES.replace("at = 0.5", ""), r"rails.slices\[0\].at is missing"),
        (SLICES + "begin = 1.0", r"rails.slices\[0\].begin is unknown"),
    ],
)
def test_wrong_slices_are_refused(table, message, short):
    short.write_text(SCENARIO + table)
    with pytest.raises(ContactError, match=message):
        read_scenario(short)


def test_fingerprint_changes_with_the_slices(short):
    before = read_scenario(short).fingerprint
    first = short.parent / "slice1.txt"
    np.savetxt(first, np.loadtxt(first) + np.array([0.0, 0.01]))
    assert read_scenario(short).fingerprint != before


FLAT = '[[wheels.flat]]\naxle = "wheelset"\nside = "right"\nlength = 0.05\nangle = 1.0\n'


@pytest.mark.parametrize(("of", "table"), [("rails", SLICES), ("wheels", FLAT)])
def test_wear_and_fmus_refuse_slices_and_flats(short, capsys, of, table):
    short.write_text(SCENARIO + table)
    path = short.parent / "set.toml"
    path.write_text('name = "s"\nmileage = 1e6\n[[scenarios]]\nfile = "crossing.toml"\nweight = 1.0\n')
    with pytest.raises(ContactError, match=rf"set.toml: crossing.toml.{of}: a study of wear takes no flats.*slices"):
        declared_set.read(path)
    with pytest.raises(ContactError, match=rf"crossing.toml.{of}: the FMUs of a vehicle take no .*slices"):
        catalogue.vehicles(short)
    with pytest.raises(typer.Exit):
        exchange_track(short.parent / "none.fmu", file=short)
    assert f"crossing.toml.{of}: the FMUs of a vehicle take no flats, polygons and slices" in capsys.readouterr().err


def measured_wheel(folder, lift=0.0):
    """Write a wheel S1002 in 36 slices, lifted by a sine with one period around it [m]; return the file's name."""
    shape = profile.s1002()
    lines = ["0 1", "36", "0 0 0", "1"]
    for k in range(36):
        theta = 2.0 * np.pi * k / 36
        points = np.stack((shape.y, shape.z + lift * np.sin(theta)), axis=1)
        np.savetxt(folder / f"wheel{k}.txt", 1e3 * points, fmt="%.6f")
        lines.append(f"{theta:.9f} 'wheel{k}.txt'")
    (folder / "wheel.slcw").write_text("\n".join(lines) + "\n")
    return "wheel.slcw"


def test_a_measured_wheel_of_slices_rolls_as_the_polygon_that_it_is(tmp_path):
    runs = []
    tables = (
        f'[[wheels.slices]]\naxle = "wheelset"\nfile = "{measured_wheel(tmp_path, 5e-4)}"\n',
        '[[wheels.polygon]]\naxle = "wheelset"\norder = 1\namplitude = 5e-4\n',
    )
    for table in tables:
        path = tmp_path / "wheel.toml"
        path.write_text(SCENARIO + table)
        runs.append(VehicleRun(read_scenario(path)))
        while runs[-1].distance < 1.2:
            runs[-1].advance()
    sliced, polygon = (run.series["wheelset_right_vertical_force"] for run in runs)
    assert np.ptp(polygon) > 2e3
    assert sliced == pytest.approx(polygon, rel=0.01)
    assert runs[0].without_damage == (("wheelset", "right"), ("wheelset", "left"))


def test_a_wheel_is_measured_once(tmp_path):
    name = measured_wheel(tmp_path)
    table = f'[[wheels.slices]]\naxle = "wheelset"\nfile = "{name}"\n'
    path = tmp_path / "wheel.toml"
    path.write_text(SCENARIO + table + table + 'side = "left"\n')
    with pytest.raises(ContactError, match=r"wheel.toml.wheels.slices\[1\]: a wheel of 'wheelset' is given twice"):
        read_scenario(path)
