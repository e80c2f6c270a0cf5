"""The C interface rolls back. test_numbers has it with the bits of Python."""

import ctypes

from contact.geometry import profile
from contact.geometry.surfaces import Polygon, WheelSurface, compiled
from tests.capi.library import Pair

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()


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
