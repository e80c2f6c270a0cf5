"""What a notebook shows of the simulations of vehicle and wheelset (issue 34, 7)."""

import numpy as np
import pytest

from models.vehicle.run import VehicleRun
from models.wheelset import master
from models.wheelset.components import direct
from models.wheelset.parameters import WheelsetParameters
from tests.test_records import drawn, parsed, words
from tests.vehicle.test_run import completed, scenario


@pytest.fixture(scope="module")
def whole() -> VehicleRun:
    return completed(VehicleRun(scenario()))


def test_a_run_is_shown_with_its_largest_force_and_both_wheels(whole):
    text = words(whole._repr_html_())
    assert "short" in text
    largest = max(series.max() for name, series in whole.series.items() if name.endswith("largest_vertical_force"))
    assert f"{1e-3 * largest:.4g} kN, wheelset" in text
    lines = drawn(whole._repr_html_(), "polyline")
    assert len(lines) == 4  # Q and Y of both wheels
    assert all(np.ptp(line[:, 0]) == pytest.approx(260.0) for line in lines)


def test_a_run_is_shown_before_its_first_step():
    text = words(VehicleRun(scenario())._repr_html_())
    assert "of 6 m in 0 steps" in text


def test_a_simulation_shows_every_wheel(whole):
    shown = whole.simulation._repr_html_()
    for wheel in whole.simulation.wheels:
        assert f"{1e-3 * wheel['vertical']:.4g}" in words(shown)
    assert sum(element.tag.endswith("rect") for element in parsed(shown)) == 2


def test_a_history_of_a_wheelset_is_shown_with_its_lateral_motion():
    parameters = WheelsetParameters(speed=20.0, lateral=2e-3)
    wheelset, contacts = direct(parameters)
    history = master.run(wheelset, contacts, speed=20.0, step=1e-3, duration=0.05)
    text = words(history._repr_html_())
    assert f"{1e3 * history['lateral'].max():.4g} mm" in text
    (line,) = drawn(history._repr_html_(), "polyline")
    assert line[0, 1] < line[-1, 1]  # it moves to the middle: down in the picture
