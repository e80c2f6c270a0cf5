"""Probes at which panels of strips act on each other."""

import numpy as np
import pytest

from contact.kernels.normal.between_panels import PROBES, fill_probes
from contact.kernels.quadrature import fill_panel


@pytest.mark.parametrize("n", [4, 5, 6, 7, 20])
def test_probes_do_not_depend_on_what_their_memory_held(n):
    """With four strips two probes are left over. As a number of a strip, what an FMU's memory held may be anything."""
    cosines, logs = np.zeros(n + 1), np.zeros((n, n + 1))
    fill_panel(cosines, logs)
    found = []
    for held in (0.0, 1e300, np.nan):
        probes, spread = np.full(PROBES, held), np.full((PROBES, n), held)
        fill_probes(cosines, probes, spread)
        found.append((probes, spread))
    for probes, spread in found:
        np.testing.assert_array_equal(probes, found[0][0])
        np.testing.assert_array_equal(spread, found[0][1])
    assert np.all((probes >= 0) & (probes < n))
    np.testing.assert_allclose(spread.sum(axis=0), 1.0)  # a displacement that is even stays even
