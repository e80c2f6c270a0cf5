"""Groups of arrays in a block of memory, laid as the annotations of their members say (`contact.kernels.block.layout`)."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from contact.kernels import memory
from contact.kernels.arrays import Size

BLOCK = np.zeros(1_000_000)


def places(group: Any) -> Iterator[tuple[int, int]]:
    """Yield begin and end of every array of a group in `BLOCK`."""
    for one in group:
        if isinstance(one, tuple):
            yield from places(one)
        elif one.size:
            begin = (one.ctypes.data - BLOCK.ctypes.data) // 8
            yield begin, begin + one.nbytes // 8


def laid(size: Size) -> Iterator[tuple[Any, int, int]]:
    """Yield what is laid one after the other for a resolution, with its begin and its end."""
    nothing, end = BLOCK[:0], 5
    parts = {
        memory.lay_rule: (size,),
        memory.lay_space: (size, nothing),
        memory.lay_search: (7, 9, 3, size.n_samples),
        memory.lay_sheet: (4, 5, 6),
        memory.lay_pair: (size, nothing, nothing, nothing, nothing),
    }
    for lay, given in parts.items():
        begin = end
        group, end = lay(BLOCK, begin, *given)
        yield group, begin, end


@pytest.mark.parametrize("size", [Size(20, 20, 81, 1, 1), Size(4, 5, 6, 1, 1), Size(120, 4, 5, 0, 1)])
def test_the_arrays_of_a_group_lie_side_by_side(size):
    for group, begin, end in laid(size):
        found = sorted(places(group))
        assert (found[0][0], found[-1][1]) == (begin, end)
        gaps = [after[0] - before[1] for before, after in pairwise(found)]
        assert min(gaps) == 0
        assert sum(gaps) < 8  # before the lanes, which begin at a line of the cache


def test_lanes_begin_at_a_line_of_the_cache():
    _, (space, *_), *_ = laid(Size(7, 5, 11, 1, 1))
    assert min(place for place, _ in places((space.lanes,))) % 8 == 0


def test_a_neighbour_shares_all_arrays_but_its_own():
    search, end = memory.lay_search(BLOCK, 0, 7, 9, 3, 11)
    near, more = memory.lay_near_search(BLOCK, end, 11, search)
    own = ("motion", "patches", "separations")
    assert sorted(places([getattr(near, name) for name in own]))[0][0] == end
    assert sum(b - a for a, b in places([getattr(near, name) for name in own])) == more - end
    assert all(getattr(near, name) is getattr(search, name) for name in search._fields if name not in own)
