"""Manchester contact benchmark: the half space reproduces CONTACT's published numbers."""

import math

import pytest

import contact
from reference.manchester import places, settled


def test_signs_and_units_are_ours():
    right = next(place for place in places() if place.name == "5 mm right")
    assert (right.y, right.yaw, right.angle) == (5e-3, 12e-3, -0.2905)
    # the wheel steers to the right: lateral creepage to the left, force to the right; the 10 kN include friction
    assert right.lateral == pytest.approx(-right.yaw / math.cos(right.angle), rel=5e-3)
    assert right.Fy > 0.0
    assert right.N * math.cos(right.angle) - right.Fy * math.sin(right.angle) == pytest.approx(10e3, rel=1e-4)
    assert right.spin == pytest.approx(math.sin(right.angle) / 0.46, rel=0.01)
    assert len(places()) == 9


@pytest.mark.parametrize("name", ["1 mm right", "1 mm left", "10 mm right"])
def test_the_half_space_meets_contact(name):
    (place,) = (one for one in places() if one.name == name)
    patch, case = settled(place, 40)
    true = contact.compare(case, "analyn+fastrip", reference_elements=40).solutions[0]
    assert patch.angle == pytest.approx(place.angle, abs=1e-4)
    assert case.load == pytest.approx(place.N, rel=1e-3)
    assert math.hypot(true.Fx - place.Fx, true.Fy - place.Fy) < 0.004 * 0.3 * place.N
    # CONTACT's patch at 10 mm has four rows of elements
    tolerance = 0.005 if place.y < 5e-3 else 0.035
    assert true.approach == pytest.approx(place.approach, rel=tolerance)
    assert true.max_pressure == pytest.approx(place.max_pressure, rel=tolerance)
