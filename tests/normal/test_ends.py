"""Ends of the panels: they arrive however narrow the strips are, and patches that lie apart have panels of their own."""

import math

import numpy as np
import pytest

import contact
from contact.geometry import profile, wheelset
from contact.kernels.normal.ends import end_moves, go_far
from contact.kernels.normal.partition import have_gap
from contact.kernels.normal.residuals import level_light
from contact.kernels.rows import N_VECTOR_ROWS, Vector
from contact.pair import WheelRailPair
from tests.separations import patch

NO_CREEP = contact.Creepage()
PAIR = wheelset.Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))
EPS, E2 = {"wheel": "EPS"}, {"rail": "60E2"}


@pytest.mark.parametrize(
    ("at", "profiles", "numbers", "peak", "area"),
    [
        # A second lobe is narrow. At y = 4.8 mm 20 to 160 strips gave 1259, 1260, 2017 and 6382 MPa: narrow strips kept the
        # ends from where they belong.
        *(((y, yaw), {}, (20, 40, 80, 160), 0.005, 0.01) for y, yaw in ((4.75, 0), (4.8, 0), (5.6, 0), (5.6, 2))),
        *(((1.963, yaw), {}, (20, 40, 80, 160), 0.005, 0.01) for yaw in (0, 8)),
        # The line of their middles bends. At y = 6.6 mm and 8 mrad they gave 2000, 2023, 1823 and 2756 MPa: the middles of
        # narrow strips zigzagged. At y = 6.9 mm 4472, 4478, 4481 and 12333: an end that was fixed too far inside moved by
        # widths of its strip.
        *(((6.648, yaw), {}, (20, 40, 80, 160), 0.03, 0.02) for yaw in (2, 8)),
        *(((y, 8), {}, (20, 40, 80, 160), 0.03, 0.02) for y in (6.6, 6.7, 6.9)),
        # An end of a lobe .7 mm wide was fixed inside it: 5344, 6520 and 26566 MPa.
        ((6.87583762, -19.14625512, 0.0, 120.573672), EPS, (20, 40, 80), 0.01, 0.02),
        # 60 strips had an end inside the contact: 1.5 times the pressure, and the status was OK.
        ((5.2807, 29.731, 4.038, 81.69), EPS | {"rail": "50E1"}, (20, 60), 0.02, 0.02),
        # 160 strips gave 2830, 6988, 4029 and 2206 MPa, the last at status OK: the middles of the last strips, far narrower
        # there than those of fewer strips, were hardly straightened, and the ends followed their pressures.
        ((6.2224, -14.704, 0.0, 107.35), E2, (40, 160), 5e-3, 1e-2),
        ((6.2067, -14.752, 0.0, 107.39), E2, (40, 160), 5e-3, 1e-2),
        ((6.2233, -14.863, 0.0, 107.58), E2, (40, 160), 5e-3, 1e-2),
        ((6.2174561, -14.8682845, 0.0, 106.746045), E2, (40, 160), 5e-3, 1e-2),
    ],
)
def test_refined_strips_settle(at, profiles, numbers, peak, area):
    separation, load = patch(*at, **profiles)
    found = [contact.solve(separation, NO_CREEP, load=load, n_strips=n) for n in numbers]
    assert np.abs(np.diff(np.log([sol.max_pressure for sol in found]))).max() < peak
    assert found[-1].area == pytest.approx(found[-2].area, rel=area)


def test_strips_that_bear_next_to_nothing_do_not_tell_the_pressure_of_what_is_not_at_rest():
    """A spike in a lobe .02 mm wide made 12 878 MPa of 5164, with an alarm."""
    vectors = np.zeros((N_VECTOR_ROWS, 10))
    vectors[Vector.P, :6] = 3e9, 4e9, 3.5e9, 1e9, 2e10, 9e9
    vectors[Vector.A], vectors[Vector.HALF] = 5e-3, 1e-4
    vectors[Vector.HALF, 4:6] = 1e-7
    kept = vectors[Vector.P].copy()
    assert level_light.__wrapped__(10, vectors)
    assert vectors[Vector.P].tolist() == np.minimum(kept, 4e9).tolist()
    assert not level_light.__wrapped__(10, vectors)


def test_a_spike_at_an_end_is_lowered_to_the_pressure_beside_it():
    """The last strip of a lobe, where no rest is found, carries next to nothing, and gave 2612 MPa in place of 1455."""
    separation, carried = patch(6.209, -14.826, 0.0, 107.23, **E2)
    found = [contact.solve(separation, NO_CREEP, load=carried, n_strips=n, throw=False) for n in (40, 160)]
    assert found[1].max_pressure == pytest.approx(found[0].max_pressure, rel=5e-3)


def test_an_end_that_wants_the_longest_move_makes_it():
    """The mixing left a tenth of it, so an end crept over a thin bridge between two lobes: the slowest steps of a C host took
    33 iterations from nothing (99.9 %), now 23."""
    n, width, longest = 20, 10e-3, 0.6 * 20.0 * 0.5 * (1.0 - math.cos(math.pi / 20))
    cosines, vectors = -np.cos(np.pi * np.arange(n + 1) / n), np.zeros((N_VECTOR_ROWS, n))
    vectors[Vector.R, [0, n - 1]] = -longest * width, 0.5 * longest * width
    vectors[Vector.STEP, [0, n - 1]] = -1e-4, 2e-4
    go_far.__wrapped__(n, 1, np.array([0.0, width]), cosines, vectors)
    assert vectors[Vector.STEP, [0, n - 1]] == pytest.approx([-longest * width, 2e-4], rel=1e-12)


@pytest.mark.parametrize("n", [20, 40, 80, 160])
@pytest.mark.parametrize("off", [-0.02, -0.01, 0.01, 0.02])
def test_one_move_brings_an_end_most_of_the_way_whatever_the_number_of_strips(n, off):
    """The pressure is an ellipse over a part of the panel, or continues beyond it. The rule moves by .6 of what is missing."""
    cosines = -np.cos(np.arange(n + 1) * math.pi / n)
    vectors, panels = np.zeros((N_VECTOR_ROWS, n)), np.array([-1.0, 1.0])
    middles = 0.5 * (cosines[:-1] + cosines[1:])
    high = 1.0 + 2.0 * off
    p = np.sqrt(np.maximum((middles + 1.0) * (high - middles), 0.0))
    vectors[Vector.P], vectors[Vector.END], vectors[Vector.HALF] = p, p, 0.5 * np.diff(cosines)
    end_moves(np.array([-10.0, 10.0]), n, 1, panels, cosines, vectors, False, False, False)
    assert vectors[Vector.R, -1] == pytest.approx(2.0 * off, abs=0.75 * abs(2.0 * off))
    assert vectors[Vector.R, -1] * off > 0.0


@pytest.mark.parametrize(
    ("pressures", "gap"),
    [
        ([1] * 8 + [0] * 4 + [1] * 8, True),
        ([1] * 8 + [0] + [1] * 11, False),  # 8 % of the width
        ([0] * 4 + [1] * 12 + [0] * 4, False),
        ([1] * 2 + [0] * 6 + [1] * 12, False),  # two strips are no patch
        ([1] * 20, False),
        ([0] * 20, False),
    ],
)
def test_wide_idle_parts_between_loaded_strips_are_gaps(pressures, gap):
    cosines = -np.cos(np.arange(21) * math.pi / 20)
    vectors, panels = np.zeros((N_VECTOR_ROWS, 20)), np.array([-1.0, 1.0])
    vectors[Vector.P], vectors[Vector.A] = pressures, 1.0
    assert have_gap(20, 1, panels, cosines, vectors) == gap


@pytest.mark.parametrize(("length", "gap"), [(1.0, True), (8.0, False)])
def test_a_thin_lobe_whose_strips_are_much_longer_than_the_idle_part_between_them_is_not_parted(length, gap):
    cosines = -np.cos(np.arange(21) * math.pi / 20)
    vectors, panels = np.zeros((N_VECTOR_ROWS, 20)), np.array([-1.0, 1.0])
    vectors[Vector.P], vectors[Vector.A] = [1] * 8 + [0] * 4 + [1] * 8, length
    assert have_gap(20, 1, panels, cosines, vectors) == gap


def test_two_patches_that_began_as_one_panel_are_resolved_by_a_panel_each():
    """The strips between them were idle, and the others so wide that the area was 2.8 % off that of 160 strips."""
    separation, load = patch(5.37)
    found = [contact.solve(separation, NO_CREEP, load=load, n_strips=n) for n in (20, 160)]
    assert [sol.n_patches for sol in found] == [2, 2]
    # they are .0004 below and .0014 above 480 rows of elements
    assert found[0].max_pressure == pytest.approx(found[1].max_pressure, rel=2.5e-3)
    assert found[0].strips.y.size == 40


@pytest.mark.parametrize("yaw", [0.0, 2e-3])
@pytest.mark.parametrize("y", [5.0e-3, 5.01e-3, 5.17e-3, 5.38e-3, 5.4e-3, 5.42e-3])
def test_the_same_height_has_one_answer(y, yaw):
    """A height found under a load, then given: at y = 5.01 mm the peaks were 2.4 % apart, with one panel and with two."""
    pair = WheelRailPair(PAIR)
    velocity = wheelset.Velocity(forward=20.0)
    found = pair.solve(wheelset.Pose(y=y, yaw=yaw), velocity, vertical=80e3)
    pair.forget()
    again = pair.solve(wheelset.Pose(y=y, yaw=yaw, z=found.z), velocity)
    peaks = [max(c.max_pressure for c in sol.contacts) for sol in (found, again)]
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-3)
