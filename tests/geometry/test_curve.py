"""Curves of nodes with slopes."""

import numpy as np
import pytest

from contact.kernels.geometry import curve


def test_a_cubic_is_reproduced_between_its_nodes():
    y = np.linspace(0.0, 1.0, 5)
    value, slope = curve.at(np.stack((y, y**3, 3.0 * y**2)), 2, 0.6)
    assert value == pytest.approx(0.216, rel=1e-13)
    assert slope == pytest.approx(1.08, rel=1e-13)
