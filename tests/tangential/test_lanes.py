"""Rows of the flat array of lanes. Kernels do not check bounds, so rows that overlap would only give wrong forces."""

import itertools

import pytest

from contact.kernels.tangential import fastrip, fastsim, mapped_lanes
from contact.kernels.tangential.lanes import LANES, N_LANE_ROWS, TRACE_WIDTH, Now, Row, Trace, Varying, after
from contact.kernels.tangential.march import March


@pytest.mark.parametrize("own", [fastrip._Lane, mapped_lanes.Lane, fastsim._Lane])
def test_rows_of_a_method_lie_between_those_of_the_march_and_of_varying_friction(own):
    sets: list[type[Row]] = [Now, March, own, Varying]
    for before, rows in itertools.pairwise(sets):
        assert after(before) <= min(rows)
        assert list(rows) == [min(rows) + LANES * k for k in range(len(rows))]
    assert after(Varying) == N_LANE_ROWS * LANES


def test_columns_of_the_trace_follow_the_output_of_an_element():
    assert after(Now) == min(Trace)
    assert after(Trace) == TRACE_WIDTH
