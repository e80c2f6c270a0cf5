"""Curves of nodes with slopes."""

import numpy as np
import pytest
from numba import njit

from contact.kernels.geometry import curve


def test_kernels_can_be_called_from_kernels():
    @njit
    def caller(table, y):
        return curve.at(table, curve.advance(table, table.shape[1], 0, y), y)[0]

    y = np.linspace(0.0, 1.0, 5)
    assert caller(np.stack((y, y**3, 3.0 * y**2)), 0.6) == pytest.approx(0.216, rel=1e-13)
