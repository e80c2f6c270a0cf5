"""Rows of the flat array of lanes. Kernels do not check bounds, so rows that overlap would only give wrong forces."""

import itertools

import numpy as np
import pytest

import contact
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


@pytest.mark.parametrize("n_strips", [17, 18, 20, 24, 25, 31])
def test_the_last_strips_of_a_patch_bear_the_tractions_of_their_mirror_images(n_strips):
    """The first sixteen march side by side. The few that are left march in fewer lanes."""
    gap = contact.Separation.hertzian(A=1.2, B=0.8)
    sol = contact.solve(gap, contact.Creepage(1.5e-3), load=80e3, friction=0.3, n_strips=n_strips, normal="hertz")
    assert 0.0 < np.mean(sol.stick) < 1.0
    for field in (sol.qx, sol.stick.astype(float)):
        np.testing.assert_allclose(field[::-1], field, rtol=0, atol=1e-9 * np.abs(field).max())
