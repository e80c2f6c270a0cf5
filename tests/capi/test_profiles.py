"""Profiles as arrays: those that are upside down or mirrored are refused, as Python's reader refuses files."""

import ctypes

import numpy as np
import pytest

from contact.geometry import profile
from tests.capi.library import PAIR_OPTIONS, PROFILE


def init(library, wheel, rail) -> tuple[int, str, str]:
    """Return the code of wr_pair_init for two profiles given as (y, z), its argument and its message."""
    options = np.zeros(1, PAIR_OPTIONS)
    library.need("wr_pair_default", options)
    kept, records = [], []
    for y, z in (wheel, rail):
        arrays = np.ascontiguousarray(y), np.ascontiguousarray(z)
        kept.append(arrays)
        record = np.zeros(1, PROFILE)
        record["n"], record["y"], record["z"] = len(y), arrays[0].ctypes.data, arrays[1].ctypes.data
        records.append(record)
    size = ctypes.c_size_t()
    sizes = [ctypes.c_int64(len(y)) for y, _ in (wheel, rail)]
    library.need("wr_pair_size", options, *sizes, ctypes.byref(size))
    memory = np.zeros(size.value // 8 + 8)
    code = library.call("wr_pair_init", options, *records, memory, size)
    return code, library.c.wr_argument(code).decode(), library.c.wr_message(code).decode()


S1002, RAIL = ((p.y, p.z) for p in (profile.s1002(), profile.rail_60e1()))


@pytest.mark.parametrize(
    ("wheel", "rail", "argument", "words"),
    [
        ((S1002[0], -S1002[1]), RAIL, "wheel.z", "upside down"),
        ((-S1002[0][::-1], S1002[1][::-1]), RAIL, "wheel.y", "mirrored"),
        (S1002, (RAIL[0], -RAIL[1]), "rail.z", "upside down"),
    ],
)
def test_a_profile_that_is_upside_down_or_mirrored_is_refused(library, wheel, rail, argument, words):
    code, about, message = init(library, wheel, rail)
    assert code < 0
    assert about == argument
    assert words in message


@pytest.mark.parametrize("wheel", ["S1002", "1/40", "EPS", "EN 15302 A", "EN 15302 B", "EN 15302 H", "EN 15302 I"])
@pytest.mark.parametrize("rail", ["60E1", "60E2", "54E1", "49E1", "46E1"])
def test_standard_profiles_are_taken(library, wheel, rail):
    pair = [profile.load(name, kind) for name, kind in ((wheel, "wheel"), (rail, "rail"))]
    code, argument, message = init(library, *((p.y, p.z) for p in pair))
    assert code == 0, (argument, message)


def test_a_flat_disc_is_not_judged(library):
    y = np.linspace(-0.03, 0.03, 61)
    flat = (y, y**2 / 2.0)
    assert "upside" not in init(library, flat, RAIL)[2]
