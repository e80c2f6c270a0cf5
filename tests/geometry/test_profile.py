"""Standard profiles: their formulas, tangents and sampling."""

import math

import numpy as np
import pytest

from contact.geometry import profile
from tests.geometry.heights import height

# y, z [mm] copied from MBench_S1002_v3.prw (y turned to the field side) and MBench_UIC60_v3.prr, the profile files of the
# Manchester contact benchmark in the examples of CONTACT 25.1 (Apache-2.0).
S1002_FILE = np.array(
    [
        (-57.991469, 27.62115), (-47.919797, 25.770735), (-41.528095, 19.321641), (-40.151629, 16.657551),
        (-36.043389, 7.9420277), (-29.514778, 3.7481586), (-21.26435, 1.7950104), (-11.608701, 0.64945529),
        (-0.7830606, 0.027272952), (10.720527, -0.21622827), (21.79952, -0.3434092), (31.411948, -0.73100733),
        (40.476452, -1.3341065), (49.540957, -1.9384068), (58.605461, -2.5427071),
    ]
)  # fmt: skip
RAIL_FILE = np.array(
    [
        (-42.536707, 11.696774), (-40.525335, 7.769531), (-37.197807, 4.663638), (-32.255133, 2.7017034),
        (-25.499721, 1.3491745), (-16.838143, 0.47324606), (-6.3314414, 0.066945096), (3.8279707, 0.02741739),
        (12.13044, 0.62867441), (18.559752, 1.6998989), (23.250518, 3.7072984), (26.437748, 6.8238663),
        (28.422032, 10.966405),
    ]
)  # fmt: skip


def test_s1002_is_the_benchmark_file_to_its_printed_digits():
    z, _ = height(profile.s1002(), S1002_FILE[:, 0])
    np.testing.assert_allclose(z, S1002_FILE[:, 1], rtol=0, atol=2e-6)


def test_60e1_with_the_uic_519_breakpoints_is_the_benchmark_file():
    rail = profile.rail_60e1(1 / 40, breakpoints="UIC 519")
    # the file's origin: its rail axis is at y = -7.491699, its crown at z = 0 (theory.md 9.2)
    z, slope = height(rail, RAIL_FILE[:, 0] + 7.491699)
    np.testing.assert_allclose((z + 0.093717 - RAIL_FILE[:, 1]) / np.hypot(1, slope), 0, atol=4e-5)


@pytest.mark.parametrize("inclination", [1 / 40, 1 / 20])
def test_inclination_turns_the_crown_towards_the_track(inclination):
    rail = profile.rail_60e1(inclination)
    upright = profile.rail_60e1(0.0)
    assert rail.angle[0] - upright.angle[0] == pytest.approx(-math.atan(inclination))
    assert (
        rail.y[np.argmin(rail.z)] > 5e-3
    )  # the rail leans to the gauge side, so its highest point is on the field side of its axis


def test_a_cone_falls_by_its_conicity():
    wheel = profile.cone(0.05)
    np.testing.assert_allclose(wheel.z, -0.05 * wheel.y, atol=1e-15)
    np.testing.assert_allclose(np.tan(wheel.angle), -0.05, rtol=1e-14)


def test_spline_tangents_of_points_converge_with_third_order_or_better():
    errors = []
    for n in (20, 40, 80):
        t = np.linspace(-1.0, 1.0, n)
        shape = profile.Profile("rail", 0.05 * np.sin(t), 0.05 * (1 - np.cos(t)))
        errors.append(np.abs(shape.angle - t)[2:-2].max())
    assert errors[1] < errors[0] / 8
    assert errors[2] < errors[1] / 8


def test_a_file_is_turned_by_inclination_and_rotation(tmp_path):
    upright = profile.named("60E1", inclination=0.0)
    file = tmp_path / "upright.txt"
    file.write_text("\n".join(f"{1e3 * y:.9f} {1e3 * z:.9f}" for y, z in zip(upright.y, upright.z, strict=True)))
    read = {"unit": "mm", "side": "right"}
    expected = profile.named("60E1", inclination="1/20")
    for turned in ({"inclination": "1/20"}, {"rotation": -math.atan(0.05)}):
        found = profile.load(str(file), "rail", **read, **turned)
        np.testing.assert_allclose(found.y, expected.y, atol=1e-9)
        np.testing.assert_allclose(found.z, expected.z, atol=1e-9)
    turned = profile.load("S1002", "wheel", rotation=0.01)
    np.testing.assert_allclose(turned.z, profile.s1002().rotated(0.01).z)
