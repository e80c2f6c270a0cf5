"""The vehicle's equations of motion: balance of energy, symmetry, equilibrium, convergence."""

import dataclasses

import numpy as np
import pytest

from contact.geometry import profile
from contact_models.vehicle.declared import Damper, Rail, read
from contact_models.vehicle.kernels.layout import Axis, Book
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Friction, Track
from tests.vehicle.parts import FAST, PACED, simulation

ROUGH = {
    channel: Irregularities(spectrum="ERRI B176 low") for channel in ("alignment", "vertical", "cross_level", "gauge")
}


def curve(direction: str, start: float = 12.0) -> Track:
    return Track(
        curves=(Curve(start=start, radius=300.0, length=20.0, transition=15.0, cant=0.1, direction=direction),)
    )


def residual(sim) -> float:
    return float(sim.state.books[Book.RESIDUAL] / sim.state.books[Book.DISSIPATED])


def test_vehicle_at_rest_on_straight_track_stays_at_rest():
    """Preloads carry the weights, and the wheels their static loads."""
    sim = simulation("manchester", speed=20.0)
    sim.advance(4e-4, 500)
    assert not sim.state.q[:, [Axis.Y, Axis.ROLL, Axis.YAW]].any()
    assert np.abs(sim.state.q).max() < 3e-4  # the rolling resistance of spin, and the wheels' approach
    assert sim.wheels["vertical"] == pytest.approx(54546.0, rel=1e-3)


def test_energy_closes_over_transitions_and_a_curve():
    """The prototype lost 2 to 10 %: rails climb on a ramp of the cant. The left curve is the mirror image (below)."""
    sim = simulation("manchester", curve("right"), speed=15.0, length=75.0)
    sim.advance(4e-4, 12500)  # 75 m
    assert sim.distance == pytest.approx(75.0)
    assert sim.state.books[Book.DISSIPATED] > 5e3
    assert abs(residual(sim)) < 5e-3


@pytest.mark.parametrize("options", [FAST, PACED], ids=["every step", "paced"])
def test_left_curve_is_the_mirror_image_of_the_right_one(options):
    signs = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    sims = [
        simulation("manchester", curve(side), speed=15.0, length=40.0, options=options) for side in ("right", "left")
    ]
    for sim in sims:
        sim.advance(4e-4, 5000)
    right, left = (sim.state for sim in sims)
    assert np.abs(right.q[:, Axis.Y]).max() > 1e-3
    np.testing.assert_allclose(right.q, signs * left.q, atol=1e-11)
    np.testing.assert_allclose(sims[0].wheels["vertical"][0::2], sims[1].wheels["vertical"][1::2], rtol=1e-7)
    np.testing.assert_allclose(sims[0].wheels["lateral"][0::2], -sims[1].wheels["lateral"][1::2], atol=1e-2)


def test_friction_along_the_track_and_on_one_side():
    """Without friction on the left rail its creep forces vanish."""
    track = Track(friction=Friction(at=(3.0, 4.0), right=(1.0, 0.5), left=(1.0, 0.0)))
    sim = simulation("wheelset", track, length=10.0)
    sim.state.q[1, Axis.YAW] = 5e-3
    sim.advance(2e-4, 500)  # 2 m
    before = sim.wheels["dissipation"].copy()
    sim.advance(2e-4, 1000)
    assert before[1] > 1e-3
    assert sim.wheels["dissipation"][1] == 0.0


def test_a_damper_in_series_follows_the_maxwell_law():
    """A slow motion meets the damper, a fast one the spring: here a step of the frame decays with c/k."""
    wheelset = read("wheelset")
    k, c = 1e5, 1e4
    damper = Damper(
        between=(("frame", "wheelset"),), at=(0.0, 0.0, 0.46), stiffness=(0.0, k, 0.0), damping=(0.0, c, 0.0)
    )
    sim = simulation(dataclasses.replace(wheelset, dampers=(damper,)))
    sim.state.q[0, Axis.Y] = 1e-3  # the frame is held there
    h, held = 2e-4, []
    for _ in range(500):
        sim.advance(h)
        held.append(sim.state.inner[-1, 1])
    gap = sim.state.q[1, Axis.Y] - 1e-3
    assert gap - held[-1] == pytest.approx((-1e-3) * np.exp(-0.1 * k / c) + 0.0, abs=6e-4)
    assert abs(held[-1]) > 3e-4


def test_a_wheelset_aside_stands_on_both_rails_and_rolls_on_their_mean_radius():
    """A wheelset that is only displaced presses one rail with several times the static force."""
    rigid = dataclasses.replace(read("wheelset"), rail=Rail(mass=0.0))
    standing, displaced = simulation(rigid), simulation(rigid)
    standing.stand_aside(5e-3)
    displaced.state.q[1, Axis.Y] = 5e-3
    for sim in (standing, displaced):
        sim.advance(1e-6)
    assert standing.state.q[1, Axis.ROLL] < -1e-4  # the wheel at its flange root lies higher
    assert standing.wheels["vertical"] == pytest.approx([54550.0] * 2, rel=0.05)
    assert displaced.wheels["normal"].max() > 2.0 * 54550.0
    slip = standing.wheels["creep_x"]
    assert abs(slip.sum()) < 0.05 * np.abs(slip).max()


def test_a_rigid_track_has_no_motion_of_the_rails():
    rigid = dataclasses.replace(read("wheelset"), rail=Rail(mass=0.0))
    sim = simulation(rigid, Track(**ROUGH), settling=1.0)
    sim.advance(2e-4, 1000)
    assert not sim.state.rails.any()
    assert np.abs(sim.state.q[1, Axis.Y]) > 1e-5


def test_profiles_of_the_wheels_may_differ():
    one, two = profile.s1002(), profile.cone(0.05)
    sim = simulation("wheelset")
    mixed = type(sim)(sim.vehicle, sim.model.track, (one, two), (profile.rail_60e1(),) * 2, 0.3)
    mixed.advance(2e-4, 50)
    assert mixed.wheels["angle"][0] != -mixed.wheels["angle"][1]
    assert mixed.wheels["vertical"].sum() == pytest.approx(2 * 54550.0, rel=0.1)
