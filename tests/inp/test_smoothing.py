"""Smoothing of profiles by λ, as CONTACT's files ask for it."""

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry.smoothing import penalised


def test_a_wave_keeps_the_share_that_the_penalty_leaves_it():
    """On even points at the distance d a wave of length L keeps 1/(1 + λ d (2π/L)⁴)."""
    y = np.linspace(-0.05, 0.05, 1001)
    length, penalty = 4e-3, 2e-9
    z = 1e-6 * np.sin(2.0 * np.pi * y / length)
    _, smooth, _ = penalised(y, z, penalty)
    share = 1.0 / (1.0 + penalty * 1e-4 * (2.0 * np.pi / length) ** 4)
    middle = slice(300, 700)
    assert np.abs(smooth[middle]).max() == pytest.approx(share * 1e-6, rel=1e-3)


def test_points_further_apart_are_smoothed_more():
    near, far = np.linspace(-0.05, 0.0, 501)[:-1], np.linspace(0.0, 0.05, 126)
    y = np.concatenate((near, far))
    _, z, _ = penalised(y, 1e-6 * np.sin(2.0 * np.pi * y / 4e-3), 2e-9)
    assert np.abs(z[(y > 0.015) & (y < 0.035)]).max() < 0.7 * np.abs(z[(y > -0.035) & (y < -0.015)]).max()


def test_a_negative_penalty_and_too_few_points_are_refused():
    y = np.linspace(0.0, 0.01, 4)
    with pytest.raises(ContactError, match="too few"):
        penalised(y, y, 1e-12)
    with pytest.raises(ContactError, match="penalty"):
        penalised(np.linspace(0.0, 0.01, 9), np.zeros(9), -1.0)
