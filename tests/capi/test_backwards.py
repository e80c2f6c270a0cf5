"""The C interface rolls back, stands and is braked to rest as Python does: V < 0 is -V turned by 180° about z."""

import ctypes

import numpy as np
import pytest

from contact.geometry import profile
from contact.geometry.surfaces import Polygon, WheelSurface, compiled
from contact.geometry.wheelset import Pair as Profiles
from contact.geometry.wheelset import Pose, Velocity
from contact.pair import WheelRailPair
from tests.capi.library import Pair

WHEEL, RAIL, R = profile.s1002(), profile.rail_60e1(), 0.46
FORCE, MOMENT = ("Fx", "Fy", "Fz"), ("Mx", "My", "Mz")


def solved(pair, V, y, yaw, slip, rate):
    motion = pair.input["motion"]
    motion["y"], motion["yaw"], motion["vx"], motion["spin"], motion["vy"] = y, yaw, V, -slip * V / R, rate
    pair.solve()
    total = pair.answer["total"][0]
    return np.array([total[n] for n in FORCE]), np.array([total[n] for n in MOMENT]), total


@pytest.mark.parametrize("reference", [1e-3, 5.0])
def test_standing_and_rolling_back_have_the_bits_of_python_at_any_reference_speed(library, reference):
    pair = Pair(library, WHEEL, RAIL, reference_speed=reference)
    python = WheelRailPair(Profiles(WHEEL, RAIL, reference_speed=reference))
    for V in (-3.0, -1e-12, 0.0, 0.02):
        force, moment, _ = solved(pair, V, 2e-3, 1e-3, 0.99, 1e-4)
        wanted = python.solve(Pose(y=2e-3, yaw=1e-3), Velocity(V, y=1e-4, spin=-0.99 * V / R), load=80e3)
        assert [*force, *moment] == [*wanted.force, *wanted.moment]
        library.need("wr_pair_accept", pair.memory)


def test_the_default_input_rolls_back_without_slip(library):
    pair = Pair(library, WHEEL, RAIL)
    library.need("wr_pair_input_default", pair.options, *map(ctypes.c_double, (0.3, -20.0, 80e3)), pair.input)
    assert (pair.input["motion"]["vx"][0], pair.input["surface"]["speed"][0]) == (-20.0, 20.0)
    assert library.call("wr_pair_doubts", pair.options, pair.input) == 0
    pair.solve()
    assert abs(pair.answer["total"]["Fx"][0]) < 0.05 * 0.3 * 80e3


def test_on_surfaces_rolling_back_is_refused_by_name(library):
    numbers = [compiled.numbers(WheelSurface.constant(WHEEL, Polygon(20, 1e-4)))]
    pair = Pair(library, numbers[0], numbers[0])
    pair.input["motion"]["vx"] = -1.0
    code = library.call("wr_pair_solve", pair.memory, pair.input, pair.answer)
    assert library.about(code) == "input.motion.vx"
    assert b"forward only" in library.c.wr_message(code)
