"""The example on uncertainty: samples of the batch and first order by the jacobian are two ways to the same spread."""

import numpy as np
import pytest

from contact.geometry import profile
from examples.uncertainty import uncertainty


@pytest.fixture(scope="module")
def base():
    return uncertainty.patch(profile.s1002(), profile.rail_60e1())


def test_small_spreads_of_samples_are_those_of_first_order(base, monkeypatch):
    """With a tenth of the spreads the forces are nearly linear; kinks of strips leave some per cent."""
    monkeypatch.setattr(uncertainty, "FRICTION", (0.35, 0.005))
    monkeypatch.setattr(uncertainty, "LOAD", (80e3, 600.0))
    monkeypatch.setattr(uncertainty, "CREEPAGE", 0.01)
    sampled = uncertainty.solved(base.separation, uncertainty.drawn(2000, uncertainty.INPUTS, base))
    linear = uncertainty.first_order(base)
    for name in ("Fx", "Fy"):
        assert np.std(sampled[name]) == pytest.approx(linear[name], rel=0.05), name


def test_inputs_that_are_not_drawn_keep_their_mean(base):
    alone = uncertainty.drawn(50, ("load",), base)
    assert np.ptp(alone["friction"]) == 0.0
    assert np.ptp(alone["load"]) > 0.0
    assert (alone["spin"] == base.creepage.spin).all()


def test_noise_of_profiles_moves_the_pressure(base):
    shapes = uncertainty.noisy(12)
    inputs = {name: np.full(12, value[0]) for name, value in uncertainty.drawn(1, (), base).items()}
    pressure = uncertainty.solved(shapes, inputs)["max_pressure"]
    assert 0.02 < np.std(pressure) / np.mean(pressure) < 0.3
