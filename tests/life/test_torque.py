"""Torques as a scenario declares them."""

import pytest

from contact.errors import ContactError
from contact_models.runs.scenario import read
from contact_models.runs.torque import Torque


def test_lines_over_the_distance_of_the_axle():
    torque = Torque(at=(10.0, 20.0), values=(0.0, 5e3), axles=("rear",))
    assert torque.on("rear", 15.0, 99.0) == 2.5e3
    assert torque.on("rear", 5.0, 99.0) == 0.0
    assert torque.on("rear", 50.0, 99.0) == 5e3
    assert torque.on("front", 15.0, 99.0) == 0.0


def test_lines_over_time():
    assert Torque(at=(1.0, 2.0), values=(-4e3, 0.0), over="time").on("any", 99.0, 1.25) == -3e3


def test_an_axle_that_the_vehicle_lacks_is_named(tmp_path):
    (tmp_path / "run.toml").write_text(
        'name = "run"\nlength = 50.0\nspeed = 20.0\n[[torque]]\nat = [0.0]\nvalues = [1e3]\naxles = ["frnt"]\n'
    )
    with pytest.raises(ContactError, match=r"run.toml.torque\[0\].axles\[0\] = 'frnt' is no wheelset; .*'wheelset'"):
        read(tmp_path / "run.toml")
