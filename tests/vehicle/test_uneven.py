"""Wheels with flats and polygons in the vehicle and in scenarios (docs/understand/vehicle.md, 6)."""

import math
from dataclasses import replace

import numpy as np
import pytest

from contact.accumulation import Histogram
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import Flat, WheelSurface
from contact.instance.workspace import closed_ledger
from contact_models.runs import report, result
from contact_models.runs.run import VehicleRun
from contact_models.runs.scenario import read as read_scenario
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.ledgers import ledger
from contact_models.vehicle.simulation import Simulation
from contact_models.vehicle.track import Track
from tests.vehicle.parts import FAST, interrupted, simulation

RADIUS, SPEED = 0.46, 20.0  # [m], [m/s]
TURN = 2.0 * math.pi * RADIUS / SPEED  # [s]
SCENARIO = """
name = "flat"
length = 1.75
speed = 20.0
recording = {settling = 1.0, spacing = 0.25}
methods = {normal = "analyn", tangential = "fastrip", strips = 20, elements = 12}
"""
FLAT = """
[[wheels.flat]]
axle = "wheelset"
side = "right"
length = 0.05
angle = 1.0
"""


def elastic():
    """The single wheelset on the rails of the Manchester vehicle: 300 kg on springs."""
    return replace(read("wheelset"), rail=read("manchester").rail)


def loads(h, turns, length=0.05):
    """Return normal force [N] and residual [J] at every step, and the simulation, of a flat that starts at the top."""
    wheel = WheelSurface.constant(profile.s1002(), Flat(length, RADIUS, angle=math.pi))
    run = simulation(elastic(), speed=SPEED, uneven={0: wheel, 1: wheel})
    rows = []
    for _ in range(round(turns * TURN / h)):
        run.advance(h)
        rows.append((run.wheels["normal"][0], run.state.books[Book.RESIDUAL]))
    return *np.array(rows).T, run


@pytest.fixture(scope="module")
def two_impacts():
    """Half a turn after the start, and one turn later."""
    return loads(1e-4, 1.6)


def test_round_surface_is_the_wheel_of_revolution():
    # The surface is a spline through points every 0.5 mm, found with another search: the normal force agrees within 3e-7,
    # the creep forces of conicity, some 360 N, within 1 N.
    wheel = WheelSurface.constant(profile.s1002())
    surface, plain = simulation(uneven={0: wheel, 1: wheel}), simulation()
    for run in (surface, plain):
        run.advance(2e-4, 400)
    for name, most in (("normal", 0.1), ("lateral", 2.0), ("longitudinal", 2.0)):
        assert surface.wheels[name] == pytest.approx(plain.wheels[name], abs=most), name
    assert surface.state.q == pytest.approx(plain.state.q, abs=1e-6)
    assert surface.rotations[0] != 0.0
    assert plain.rotations[0] == 0.0


def test_round_wheel_beside_an_uneven_one_is_that_of_the_round_vehicle_until_the_impact():
    wheel = WheelSurface.constant(profile.s1002(), Flat(0.05, RADIUS, angle=math.pi))
    mixed, plain = simulation(uneven={1: wheel}), simulation()
    for run in (mixed, plain):
        run.advance(2e-4, 100)  # 0.4 m; the flat is at the top
    # the two searches differ by nanometres in height, so the wheelset rolls by as much: 4.5 N of 54.5 kN
    assert mixed.wheels["normal"] == pytest.approx(plain.wheels["normal"], rel=2e-4)
    mixed.advance(2e-4, 300)
    assert mixed.state.books[Book.IMPACTS] > 0.0


def test_impact_repeats_every_revolution_and_keeps_its_energy(two_impacts):
    normal, residual, run = two_impacts
    half = normal.size // 2
    first, second = normal[:half].argmax(), half + normal[half:].argmax()
    assert normal[first] > 5.0 * normal[0]
    assert normal[second] == pytest.approx(normal[first], rel=0.03)
    assert (second - first) * 1e-4 == pytest.approx(TURN, rel=2e-3)
    assert abs(math.remainder(run.rotations[0], math.tau)) == pytest.approx(0.4 * math.tau, abs=0.05)
    assert abs(residual[half - 1]) < 2.0  # [J] after the impact; the contacts store up to 80 J in it


def test_half_the_step_changes_the_peak_by_little(two_impacts):
    normal, _, _ = two_impacts
    finer, _, _ = loads(5e-5, 0.6)
    assert finer.max() == pytest.approx(normal[: normal.size // 2].max(), rel=0.03)


@pytest.mark.usefixtures("undrawn")
def test_scenario_with_a_flat_runs_resumes_and_leaves_out_the_damage_of_its_wheel(tmp_path):
    path = tmp_path / "flat.toml"
    path.write_text(SCENARIO + FLAT)
    whole = VehicleRun(read_scenario(path))
    for _ in range(5):
        whole.advance()
    interrupted(whole)
    assert set(whole.damage()) == {("wheelset", "left", "wheel"), ("wheelset", "left", "rail")}
    assert whole.trust.impacts > 0.0
    assert result.dataset(whole).attrs["without_damage"] == '[["wheelset", "right"]]'
    assert "Without damage, as they are not round: wheelset right." in report.page_of(whole)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (FLAT.replace("wheelset", "wheel"), r"flat.toml.wheels.flat\[0\].axle = 'wheel' is no wheelset; .*'wheelset'"),
        (FLAT.replace("right", "inside"), r"flat.toml.wheels.flat\[0\]: side = 'inside' is none of 'right', 'left'"),
        (FLAT.replace("0.05", "50.0"), r"flat.toml.wheels.flat\[0\]: length = 50.*0\.3"),
        (FLAT.replace("length = 0.05", ""), r"flat.toml.wheels.flat\[0\].length is missing"),
        ('[[wheels.polygon]]\naxle = "wheelset"\norder = 0\namplitude = 1e-4', r"polygon\[0\]: order = 0.*500"),
        ('[[wheels.polygon]]\naxle = "wheelset"\norder = 3\namplitude = 0.1', r"polygon\[0\]: amplitude = 0.1.*0\.01"),
    ],
)
def test_wrong_wheels_are_refused(table, message, tmp_path):
    path = tmp_path / "flat.toml"
    path.write_text(SCENARIO + table)
    with pytest.raises(ContactError, match=message):
        read_scenario(path)


def test_vehicles_refuse_ledgers_of_some_wheels_only():
    rail, wheel = profile.rail_60e1(), profile.s1002()
    both = Histogram(wheel, width=5e-4, radius=RADIUS), Histogram(rail, width=5e-4)
    one = ledger(*both, FAST.n_strips)
    track = lay(Track(), 10.0, lambda s: SPEED, (1,), 0.0)
    for ledgers, without in (((one, closed_ledger()), 1), ((closed_ledger(), one), 0)):
        with pytest.raises(ContactError, match=rf"pairs \[{without}\] of 2 have no ledger; all or none have one"):
            Simulation(elastic(), track, wheel, rail, 0.3, FAST, ledgers=ledgers)
