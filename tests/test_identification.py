"""The example that finds friction from a creep curve (docs/use/implicit.md)."""

import numpy as np
import pytest

from examples.identification.friction import KNOWN, NOISE, Curve, fit


@pytest.fixture(scope="module")
def curve():
    return Curve()


def test_the_derivatives_are_those_of_the_curve(curve):
    _, slopes = curve(KNOWN, True)
    for k, step in enumerate(1e-5 * KNOWN):
        move = np.zeros(KNOWN.size)
        move[k] = step
        wanted = (curve(KNOWN + move)[0] - curve(KNOWN - move)[0]) / (2.0 * step)
        assert slopes[:, k] == pytest.approx(wanted, abs=0.03 * np.abs(wanted).max())


@pytest.mark.slow
def test_the_known_parameters_are_found(curve):
    clean = curve(KNOWN)[0]
    found, half, exact = fit(curve, clean, True)
    assert found == pytest.approx(KNOWN, rel=1e-2)
    measured = clean + NOISE * np.random.default_rng(5).standard_normal(clean.size)
    found, half, exact = fit(curve, measured, True)
    assert np.all(np.abs(found - KNOWN) < 2.0 * half)
    other, _, differences = fit(curve, measured, False)
    assert other == pytest.approx(found, abs=0.05 * half.max(), rel=1e-2)
    assert exact < differences
