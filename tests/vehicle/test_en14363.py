"""Sections of EN 14363: lengths, percentiles of signals whose values are known, rms of a sine."""

import math

import numpy as np
import pytest

from contact_models.vehicle import en14363
from contact_models.vehicle.en14363 import Section
from contact_models.vehicle.track import Curve, Track


def test_sections_are_straight_parts_and_circles_without_transitions():
    curve = Curve(start=600.0, radius=300.0, length=150.0, transition=50.0, direction="left")
    found = en14363.sections(Track(curves=(curve,)), 30.0, 1000.0)
    assert [(s.begin, s.end, s.whole) for s in found] == [
        (30.0, 315.0, True),
        (315.0, 600.0, True),
        (650.0, 725.0, True),
        (725.0, 800.0, True),
        (850.0, 1000.0, False),
    ]
    assert [s.curvature for s in found] == [0.0, 0.0, -1.0 / 300.0, -1.0 / 300.0, 0.0]
    assert found[-1].name == "straight, 850 to 1000 m (short)"


def test_quasi_static_values_are_medians_of_the_outer_wheel_and_peaks_are_percentiles():
    distance = np.arange(0.0, 400.0, 0.25)
    speed = 20.0
    wave = 5e3 * np.sin(2.0 * math.pi * 2.0 * distance / speed)  # 2 Hz
    lateral = np.array([1e4 * np.ones_like(distance), 3e4 + wave])
    vertical = np.array([5e4, 7e4])[:, None] * np.ones_like(distance)
    section = Section(100.0, 300.0, 1.0 / 300.0, True)  # to the right: the left wheel is outside
    found = en14363.values(section, lateral, vertical, distance, distance / speed, 6e4)
    mean = math.sin(math.pi * 2.0 * 2.0 / speed) / (math.pi * 2.0 * 2.0 / speed)  # of a wave over 2 m
    assert found.Y_quasi_static == pytest.approx(3e4, rel=2e-3)
    assert found.Q_quasi_static == pytest.approx(7e4)
    assert found.guiding == pytest.approx(2e4 + mean * 5e3, rel=2e-3)
    assert found.quotient == pytest.approx((3e4 + mean * 5e3) / 7e4, rel=2e-3)
    assert found.instability == pytest.approx(5e3 / math.sqrt(2.0), rel=0.03)


def test_straight_track_has_no_quasi_static_values_and_a_mirrored_curve_has_the_same():
    rng = np.random.default_rng(1)
    distance = np.arange(0.0, 300.0, 0.25)
    lateral, vertical = 1e4 * rng.normal(size=(2, distance.size)), 6e4 + 1e3 * rng.normal(size=(2, distance.size))
    given = distance, distance / 25.0, 6e4
    straight = en14363.values(Section(20.0, 280.0, 0.0, True), lateral, vertical, *given)
    assert math.isnan(straight.Y_quasi_static)
    assert math.isnan(straight.Q_quasi_static)
    right, left = (
        en14363.values(Section(20.0, 280.0, sign / 500.0, True), lateral[::order], vertical[::order], *given)
        for sign, order in ((1.0, 1), (-1.0, -1))
    )
    assert (right.guiding, right.instability) == pytest.approx((left.guiding, left.instability))
    assert (right.Y_quasi_static, right.Q_quasi_static) == pytest.approx((left.Y_quasi_static, left.Q_quasi_static))


def test_limits_of_a_wheelset_of_the_benchmark_vehicle():
    found = en14363.limits(54.5e3, 300.0)
    assert found.guiding == pytest.approx(1e4 + 109e3 / 3.0)
    assert (found.vertical, found.Y_quasi_static) == pytest.approx((144.5e3, 65e3))
    assert math.isnan(en14363.limits(54.5e3, math.inf).Y_quasi_static)
