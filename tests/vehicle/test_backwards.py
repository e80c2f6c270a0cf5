"""A vehicle that rolls backwards or stands: V < 0 on a track is V on the same track read from its other end."""

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import WheelSurface
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Book, TrackRow
from contact_models.vehicle.simulation import ContactOptions, Simulation
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track
from tests.vehicle.parts import FAST, PACED

STEP = 4e-4
LOW = Irregularities(spectrum="ERRI B176 low")
CURVE = Curve(start=15.0, radius=300.0, length=30.0, transition=12.0, cant=0.1)
ROUGH = Track(curves=(CURVE,), alignment=LOW, vertical=LOW, cross_level=LOW, gauge=LOW)
#: What a turn by 180° about z makes of a body's coordinates and of the forces on a wheel.
TURNED = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])


def fading(rows: np.ndarray, begin: float, end: float) -> np.ndarray:
    """Return the rows of a track whose irregularities fade between two places [m], so that a run can start behind them."""
    t = np.clip((end - rows[TrackRow.PLACE]) / (end - begin), 0.0, 1.0)
    share, slope = t * t * (3.0 - 2.0 * t), -6.0 * t * (1.0 - t) / (end - begin)
    for row in ("RIGHT_Y", "RIGHT_Z", "LEFT_Y", "LEFT_Z"):
        value = rows[TrackRow[row]].copy()
        rows[TrackRow[row]] = share * value
        rows[TrackRow[f"{row}_SLOPE"]] = share * rows[TrackRow[f"{row}_SLOPE"]] + slope * value
    return rows


def read_from_the_other_end(rows: np.ndarray) -> np.ndarray:
    """Return the rows of a track for a vehicle that comes from its other end: right and left change, and the direction."""
    found = rows[:, ::-1].copy()
    for row in ("PLACE", "X", "Y", "CURVATURE", "CANT", "SPEED"):
        found[TrackRow[row]] *= -1.0
    for row, factor in (("Y", -1.0), ("Y_SLOPE", 1.0), ("Z", 1.0), ("Z_SLOPE", -1.0), ("FRICTION", 1.0)):
        right, left = TrackRow[f"RIGHT_{row}"], TrackRow[f"LEFT_{row}"]
        found[[right, left]] = factor * found[[left, right]]
    return found


def vehicle(rows: np.ndarray, start: float, options: ContactOptions = FAST, **more) -> Simulation:
    return Simulation(read("manchester"), rows, profile.s1002(), profile.rail_60e1(), 0.3, options, start=start, **more)


@pytest.mark.parametrize(("options", "place"), [(FAST, 2e-9), (PACED, 5e-7)], ids=["every step", "paced"])
def test_backwards_is_forwards_on_the_track_read_from_its_other_end(options, place):
    rows = fading(lay(ROUGH, 100.0, lambda s: -15.0, (1,), 5.0), 60.0, 70.0)
    back, ahead = vehicle(rows, 85.0, options), vehicle(read_from_the_other_end(rows), -85.0, options)
    for sim in (back, ahead):
        sim.advance(STEP, 7000)
    assert back.distance == pytest.approx(43.0, abs=1e-6)
    assert ahead.distance == pytest.approx(-43.0, abs=1e-6)
    # the last wheelset comes first
    order = [0, 2, 1, 6, 5, 4, 3]
    assert [back.model.bodies["place"][i] for i in order] == pytest.approx(list(-ahead.model.bodies["place"]))
    np.testing.assert_allclose(back.state.q[order], TURNED * ahead.state.q, atol=place)
    wheels = np.arange(8)[::-1]
    for name in ("vertical", "longitudinal", "lateral", "dissipation", "T_gamma"):
        factor = -1.0 if name in ("longitudinal", "lateral") else 1.0
        found, expected = back.wheels[name][wheels], factor * ahead.wheels[name]
        np.testing.assert_allclose(found, expected, atol=1e-3 * np.abs(expected).max(), err_msg=name)
    for book in (Book.DISSIPATED, Book.WEIGHT, Book.DAMPER, Book.DRIVE):
        assert back.state.books[book] == pytest.approx(ahead.state.books[book], rel=1e-3, abs=1.0), book
    assert back.state.books[Book.DISSIPATED] > 1e3
    assert abs(back.state.books[Book.RESIDUAL]) < 5e-3 * back.state.books[Book.DISSIPATED]


@pytest.mark.parametrize("options", [FAST, PACED], ids=["every step", "paced"])
def test_a_vehicle_brakes_to_rest_stands_and_rolls_back(options):
    """The speed falls by 2.5 m/s², stays 0 for a while, and falls on. Wheels carry their load all the time."""
    still = lay(Track(alignment=LOW), 60.0, lambda s: 3.0, (1,), 20.0)
    sim = vehicle(still, 0.0, ContactOptions(**{**vars(options), "reference_speed": 10.0}))
    speeds = np.concatenate((np.linspace(1.5, 0.0, 150), np.zeros(75), np.linspace(0.0, -1.0, 100)))
    found = []
    for speed in speeds:
        sim.model.track[TrackRow.SPEED] = speed
        sim.advance(2e-4, 20)
        found.append([sim.wheels["vertical"].copy(), sim.wheels["longitudinal"].copy()])
    forces = np.array(found)
    assert np.abs(forces[:, 0] / 54.5e3 - 1.0).max() < 0.6  # the bogies pitch
    assert np.abs(forces[200:225, 1]).max() < 4e3  # of 16 kN: what holds the bogies as they swing
    assert sim.distance == pytest.approx(0.45 - 0.2, abs=0.02)
    spins = sim.state.u[sim.model.wheelsets, 4]
    assert spins == pytest.approx(1.0 / 0.46, rel=0.1)  # creep forces are small below the reference speed
    assert sim.state.books[Book.DISSIPATED] >= 0.0


def test_over_wheels_that_are_not_round_a_vehicle_runs_forwards_only():
    rows = lay(Track(), 10.0, lambda s: -15.0, (1,), 0.0)
    uneven = {0: WheelSurface.constant(profile.s1002())}
    with pytest.raises(ContactError, match="speed: over wheels that are not round and rails of slices"):
        vehicle(rows, 5.0, uneven=uneven)
