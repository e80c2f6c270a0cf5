"""Contact search compared with CONTACT: S1002 on UIC 60, both sides, 1:40 and 1:20 (reference/wheel_rail.csv)."""

import math

import numpy as np
import pytest

import contact
import reference
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose

LOAD, R0 = 80e3, 0.460


@pytest.fixture(scope="module")
def pairs():
    wheel, rail = profile.s1002(), profile.rail_60e1(1 / 40, breakpoints="UIC 519")
    rails = {"1:40": rail, "1:20": rail.rotated(-0.025)}
    return {(c, s): Pair(wheel, rails[c], side={"R": "right", "L": "left"}[s]) for c in rails for s in "RL"}


@pytest.fixture(scope="module")
def rows(pairs):
    """Return each row with our patch at CONTACT's height of the wheelset and our patch under its load."""
    result = []
    for row in reference.wheel_rail():
        pair = pairs[row["cant"], row["side"]]
        pose = Pose(y=1e-3 * float(row["dy"]), z=1e-3 * float(row["z"]))
        (patch,) = pair.contacts(pose)
        result.append((row, patch, pair.contacts(pose, load=LOAD)[0]))
    return result


def deviations(rows, name, scale, own):
    return np.array([own(patch) - scale * float(row[name]) for row, patch, _ in rows])


# CONTACT prints z to 0.1 µm, angles to 1e-4 rad, other numbers to four digits. The row 1:20 at dy = 6 mm (two flat lobes) is
# the most sensitive to this rounding.
@pytest.mark.parametrize(
    ("claim", "name", "scale", "own", "typical", "worst"),
    [
        ("position", "y_track", 1e-3, lambda p: p.position[1], 2e-6, 2e-5),
        ("height", "z_track", 1e-3, lambda p: p.position[2], 2e-7, 2e-6),
        ("angle", "angle", 1.0, lambda p: p.angle, 6e-5, 5e-4),
        ("penetration", "penetration", 1e-3, lambda p: p.approach, 6e-8, 1.5e-7),
    ],
)
def test_geometry_agrees_to_the_printed_digits(rows, claim, name, scale, own, typical, worst):
    error = np.abs(deviations(rows, name, scale, own))
    assert error.mean() < typical, f"mean {claim} off by {error.mean():g}"
    assert error.max() < worst, f"{claim} off by {error.max():g} at {rows[int(error.argmax())][0]}"


def test_spin_creepage_agrees_with_opposite_sign(rows):
    for row, patch, _ in rows:  # CONTACT divides by the mean of V and omega r
        mean_speed = 0.5 * (1.0 + patch.rolling_radius / R0)
        assert patch.creepage.spin == pytest.approx(-1e3 * float(row["phi"]) * mean_speed, rel=6e-3, abs=2e-5), row


def test_longitudinal_creepage_is_that_of_the_wheel_surface_not_of_its_plane_of_first_contact(rows):
    for row, patch, _ in rows:
        mean_speed = 0.5 * (1.0 + patch.rolling_radius / R0)
        # the depths at the reference point and at the deepest point differ: at most the penetration over r0
        assert patch.creepage.longitudinal == pytest.approx(
            -float(row["xi"]) * mean_speed, abs=1e-3 * float(row["penetration"]) / R0 * 0.8
        ), row


def test_penetration_and_pressure_under_the_load_are_those_of_analyn(rows):
    depth, pressure = [], []
    for row, _, loaded in rows:
        solution = contact.solve(loaded.separation, loaded.creepage, load=loaded.load, **contact.THESIS)
        depth.append(loaded.approach / (1e-3 * float(row["penetration"])) - 1.0)
        pressure.append(1e-6 * solution.max_pressure / float(row["pmax"]) - 1.0)
    depth, pressure = np.abs(depth), np.abs(pressure)
    assert np.median(depth) < 0.015
    assert depth.max() < 0.08
    assert np.median(pressure) < 0.02
    assert np.sort(pressure)[-6] < 0.08  # ANALYN is known to be weak for both sides of 1:40 at 5 mm and 1:20 at 6 mm


def test_kpec_under_the_load_is_contacts_kpec(rows):
    depth, pressure = [], []
    for row, _, loaded in rows:
        if row["cant"] == "1:20" and abs(float(row["dy"])) == 6.0:
            continue  # two zones are deeper than half the approach; CONTACT uses their span (docstring of the kernel kpec)
        solution = contact.solve(loaded.separation, contact.Creepage(), load=loaded.load, normal="kpec")
        depth.append(solution.approach / (1e-3 * float(row["penetration_kpec"])) - 1.0)
        pressure.append(1e-6 * solution.max_pressure / float(row["pmax_kpec"]) - 1.0)
    depth, pressure = np.abs(depth), np.abs(pressure)
    assert np.median(depth) < 0.002
    assert depth.max() < 0.025
    assert np.median(pressure) < 0.003
    assert pressure.max() < 0.035


def manchester(pairs, y, yaw, loads):
    """Return right and left patch of Manchester A-2.2 for given vertical loads, with the roll at which both wheels carry."""
    right, left = pairs["1:40", "R"], pairs["1:40", "L"]

    def mismatch(roll):
        pose = Pose(y=y, yaw=yaw, roll=roll)
        patches = right.contacts(pose, load=loads[0])[0], left.contacts(pose, load=loads[1])[0]
        return right.z - left.z, patches

    low, high = -1e-3, 1e-3  # the wheelset is rigid, so the height of its centre is the same for both wheels
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if (mismatch(middle)[0] > 0) == (mismatch(high)[0] > 0) else (middle, high)
    return mismatch(0.5 * (low + high))[1]


@pytest.mark.parametrize(("y", "yaw", "load", "angles", "approach", "pressure"), [
    (0.0, 0.0, 9997.0, (0.029, 0.029), 0.0140e-3, 302e6),
    (0.5e-3, -1.2e-3, 9950.0, (0.056, 0.022), 0.02017e-3, 569.8e6),  # the load lies between those of 0 and 1 mm: 9997, 9827 N
    (5e-3, -12e-3, 9619.0, (0.2905, 0.0088), 0.02993e-3, 1625e6),
])  # fmt: skip
def test_kpec_on_the_manchester_benchmark(pairs, y, yaw, load, angles, approach, pressure):
    """theory.md 10, right wheel, computed with CONTACT 25.1. At 0 mm eps was capped at 1 in CONTACT (442.6 MPa without)."""
    patch, _ = manchester(pairs, y, yaw, (load * math.cos(angles[0]), 10040 * math.cos(angles[1])))
    solution = contact.solve(patch.separation, contact.Creepage(), load=load, normal="kpec")
    assert solution.approach == pytest.approx(approach, rel=0.005)
    assert solution.max_pressure == pytest.approx(pressure, rel=0.01)


def test_manchester_benchmark_with_the_roll_that_both_wheels_need(pairs):
    # Manchester in CONTACT, dy = 1 mm, 2.4 mrad: angles 0.0696 and 0.0176, lateral creepage 2.407e-3, spins
    # 0.1510 and 0.03848 1/m on the two sides (theory.md 10); its yaw has the opposite sign.
    a, b = manchester(pairs, 1e-3, -2.4e-3, (9827 * math.cos(0.0696), 10050 * math.cos(0.0176)))
    assert a.angle == pytest.approx(-0.0696, abs=2e-4)
    assert b.angle == pytest.approx(0.0176, abs=2e-4)
    assert a.creepage.lateral == pytest.approx(2.407e-3, rel=1e-3)
    assert b.creepage.lateral == pytest.approx(2.400e-3, rel=1e-3)
    assert a.creepage.spin == pytest.approx(-0.1510, rel=2e-3)
    assert b.creepage.spin == pytest.approx(0.03848, rel=2e-3)
    difference = 6.943e-4 + 6.297e-4  # of the longitudinal creepages; their mean is the benchmark's own pitch speed
    assert b.creepage.longitudinal - a.creepage.longitudinal == pytest.approx(difference, rel=0.005)
