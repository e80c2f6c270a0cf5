"""A vehicle without contacts gives the run of the one kernel, wherever its contacts are computed."""

import numpy as np
import pytest

from contact.errors import ContactError
from contact_models.vehicle.coupling import ANSWER, QUESTION, OpenVehicle
from contact_models.vehicle.simulation import ContactOptions
from examples.coupled_vehicle.coupled import coupled, difference, in_one_kernel, python_contacts, vehicle

OPTIONS = ContactOptions(normal="analyn", tangential="fastrip", n_strips=20, n_elements=12, pace=1)
STEP, SAMPLES = 2e-4, 30


@pytest.fixture(scope="module")
def whole():
    found = in_one_kernel(OPTIONS, STEP, SAMPLES)
    assert np.abs(np.diff(found, axis=0)).max() > 10.0  # forces vary by more than 10 N between samples
    return found


def test_contacts_in_python_give_the_same_run_to_round_off(whole):
    y, force = difference(whole, coupled(python_contacts(OPTIONS), OPTIONS, STEP, SAMPLES))
    assert y < 1e-12
    assert force < 1e-6


def test_the_energy_of_a_coupled_run_closes():
    whole = vehicle(OPTIONS)
    opened = OpenVehicle(whole)
    opened.run(python_contacts(OPTIONS), STEP, 200)
    assert abs(opened.residual) < 0.02
    assert opened.time == pytest.approx(200 * STEP)


def test_questions_are_what_the_fmu_asks_for():
    opened = OpenVehicle(vehicle(OPTIONS))
    asked = opened.ask()
    assert asked.shape == (8, len(QUESTION))
    first = dict(zip(QUESTION, asked[0], strict=True))
    assert first["velocity.x"] == pytest.approx(15.0)
    assert first["velocity.spin"] == pytest.approx(-15.0 / 0.46)
    assert first["friction.coefficient"] == 0.3
    assert len(opened.wheels) == 8
    assert opened.wheels[1] == ("wheelset 1", "left")
    with pytest.raises(ContactError, match="2 contacts for 8 wheels"):
        opened.run(python_contacts(OPTIONS)[:2], STEP, 1)
    assert len(ANSWER) == 9
