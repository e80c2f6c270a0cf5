"""Forces on surfaces by the half space: against CONTACT, against constant profiles, balances, symmetry."""

import math

import numpy as np
import pytest

from contact import STEEL, Status
from contact.geometry import profile
from contact.geometry.surfaces import Flat, Polygon, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pose, Velocity
from contact.pair import HalfspacePair
from examples.crossing import crossing
from tests.pair.surfaces import FREE, R0, RAIL, WHEEL

#: Angle of the wheel [deg], height [mm], forces on the rail [N] in track axes, largest pressure [MPa], place x, y [mm]:
#: CONTACT 25.1 (rev 2707), sweeps hav05 (80 kN on a haversine flat of 0.5 × 60 mm) and poly12 (12th order, .2 mm, at z).
FLAT = [
    (-5.98, 0.2462, (15.116, 451.85, 79999.997), 896.15, (0.0, 750.3824)),
    (-1.71, 0.4088, (3732.85, -4218.18, 79999.963), 1093.17, (8.5033, 750.385)),
    (0.0, 0.7050, (18906.6, -351.39, 79999.947), 532.41, (0.0, 750.5658)),
]
POLYGON = [
    (-24, 0.436711, (6144.60, -418.788, 82788.83), 891.83, (0.7825, 750.3827)),
    (-8, 0.0475956, (-5996.79, 811.866, 79717.04), 911.56, (-0.2343, 750.3826)),
]


def _compare(found, row):
    """Compare with CONTACT, whose profiles are measured points of about the same profiles."""
    _, z, force, pressure, place = row
    assert 1e3 * found.z == pytest.approx(z, abs=1e-3)
    assert np.linalg.norm(found.force + force) < 0.01 * np.linalg.norm(force)
    assert 1e-6 * found.max_pressure == pytest.approx(pressure, rel=0.02)
    assert 1e3 * np.array(found.contacts[0].patch.position[:2]) == pytest.approx(place, abs=0.2)


@pytest.mark.slow
@pytest.mark.parametrize("row", FLAT)
def test_a_haversine_flat_agrees_with_CONTACT(row):
    wheel = WheelSurface.constant(WHEEL, Flat(0.060, R0, depth=0.5e-3))
    pair = HalfspacePair(SurfacePair(wheel, RAIL, rows=40, columns=40, material=STEEL))
    _compare(pair.solve(Pose(), FREE, rotation=math.radians(row[0]), vertical=row[2][2]), row)


@pytest.mark.slow
@pytest.mark.parametrize("row", POLYGON)
def test_a_polygon_agrees_with_CONTACT(row):
    wheel = WheelSurface.constant(WHEEL, Polygon(12, 2e-4))
    pair = HalfspacePair(SurfacePair(wheel, RAIL, rows=40, columns=40, material=STEEL))
    _compare(pair.solve(Pose(z=1e-3 * row[1]), FREE, rotation=math.radians(row[0])), row)


@pytest.mark.slow
def test_loads_are_carried_and_power_is_what_the_forces_do():
    pair = HalfspacePair(SurfacePair(WheelSurface.constant(WHEEL, Flat(0.05)), RAIL, rows=30, columns=30))
    normal = pair.solve(Pose(), FREE, rotation=0.02, load=6e4)
    carried = sum(c.solution.N * math.cos(c.patch.angle) for c in normal.contacts)
    assert carried == pytest.approx(6e4, rel=2e-4)
    found = pair.solve(Pose(), Velocity(2.0, spin=-2.03 / R0), rotation=0.02, vertical=6e4)
    assert pytest.approx(6e4, rel=2e-4) == found.Q
    (contact,) = found.contacts
    s = contact.solution
    c = s.creepage
    power = -(s.Fx * c.longitudinal + s.Fy * c.lateral + s.Mz * c.spin)
    assert found.power_per_metre == pytest.approx(power, rel=2e-2)  # first order in the elements


@pytest.mark.slow
def test_a_light_wheel_stands_on_the_sharp_end_of_a_flat():
    """The overlap is a few tenths of a millimetre long there, and the load is carried at every angle."""
    wheel = WheelSurface.constant(WHEEL, Flat(0.06, R0, shape="chord"))
    pair = HalfspacePair(SurfacePair(wheel, profile.rail_60e1(inclination=1 / 40), rows=20, columns=20))
    for rotation in (0.004, 0.01, 0.02, 0.03, 0.04, 0.06):
        found = pair.solve(Pose(), FREE, rotation=rotation, load=300.0, friction=0.0)
        assert pytest.approx(300.0, rel=1e-3) == found.Q
        assert found.status is Status.OK or found.status is Status.SATURATED


@pytest.mark.slow
def test_a_load_that_the_half_space_misses_is_not_called_solved():
    """In the middle of a haversine flat, where another region of overlap begins, the force jumps with the height."""
    wheel = WheelSurface.constant(WHEEL, Flat(0.06, R0))
    pair = HalfspacePair(SurfacePair(wheel, profile.rail_60e1(inclination=1 / 40), rows=30, columns=30))
    missed = pair.solve(Pose(), FREE, rotation=0.0, load=1e4, friction=0.0)
    met = pair.solve(Pose(), FREE, rotation=0.02, load=1e4, friction=0.0)
    assert abs(missed.Q / 1e4 - 1.0) > 1e-3
    assert missed.status is Status.NOT_CONVERGED
    assert pytest.approx(1e4, rel=1e-4) == met.Q
    assert met.status is not Status.NOT_CONVERGED


@pytest.mark.slow
def test_in_a_transition_forces_are_the_mean_by_shares():
    """A common plane for wing and nose, planes of their own, and the limit of distance between."""
    options = {"rail_origin": (0.75, 0.0), "rows": 20, "columns": 20}
    apart, between, joint = (
        HalfspacePair(SurfacePair(WHEEL, crossing.crossing(), combine_distance=limit, **options)).solve(
            Pose(), FREE, station=0.158, penetration=1e-4
        )
        for limit in (8e-3, 0.045, 1.0)
    )
    share = between.contacts[0].patch.share
    assert [len(one.contacts) for one in (apart, between, joint)] == [2, 3, 1]
    assert 0.2 < share < 0.8
    assert between.force == pytest.approx(share * apart.force + (1.0 - share) * joint.force, rel=1e-3)
    assert between.power_per_metre == pytest.approx(
        share * apart.power_per_metre + (1.0 - share) * joint.power_per_metre, rel=1e-3
    )
