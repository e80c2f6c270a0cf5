"""The FMU `Wheelset` through the C interface of FMI."""

import math

import numpy as np
import pytest
from fmu_instance import DISCARD, refused
from wheelset_case import PARAMETERS, reactions, reported, trajectory

from contact_models.wheelset.model import WheelsetModel
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import CONTACT_PORTS, PROBLEM, REACTION, SIDES, WHEELSET_PORTS

NAME = "Wheelset"


@pytest.fixture
def fmu(open_fmu):
    return open_fmu(NAME).initialize()


def test_every_port_of_the_model_is_a_variable_and_connects_to_the_contact(fmu, open_fmu):
    assert {name for names in WHEELSET_PORTS.values() for name in names} <= set(fmu.variables)
    contact = open_fmu("WheelRailContact")
    assert {name for names in CONTACT_PORTS.values() for name in names} <= set(contact.variables)
    for side in SIDES:
        for source, target in (
            *((fmu.variables[f"{side}.{name}"], contact.variables[name]) for name in PROBLEM),
            *((contact.variables[name], fmu.variables[f"{side}.{name}"]) for name in REACTION),
        ):
            assert (source.causality, target.causality) == ("output", "input")
            assert source.unit == target.unit
    for name in ("geometry.y0", "geometry.dy", "wheel.radius"):
        assert float(fmu.variables[name].start) == float(contact.variables[name].start)


def test_starts_at_the_position_in_the_parameters(open_fmu):
    fmu = open_fmu(NAME)
    fmu.update({"initial.lateral": -2e-3, "initial.yaw": 1e-3, "speed": 25.0})
    assert fmu.initialize().all("output") == reported(
        WheelsetModel(WheelsetParameters(lateral=-2e-3, yaw=1e-3, speed=25.0))
    )


def test_equals_the_model_bit_by_bit(fmu):
    model = WheelsetModel(WheelsetParameters())
    rows = trajectory(fmu, 0)
    for k, row in enumerate(rows):
        for side, forces in reactions(k).items():
            model.set_forces(side, *forces.values())
        model.step(1e-3)
        assert row == reported(model)
    assert rows[-1]["lateral"] != rows[0]["lateral"]


@pytest.mark.parametrize(("name", "value"), PARAMETERS)
def test_every_parameter_reaches_the_model(fmu, open_fmu, name, value):
    other = open_fmu(NAME)
    other.update({name: value, "initial.yaw": 1e-3})
    reference = open_fmu(NAME)
    reference.update({"initial.yaw": 1e-3})
    assert trajectory(other.initialize(), 0)[-1] != trajectory(reference.initialize(), 0)[-1]
    assert not other.log


def test_the_irregularity_reaches_the_model(fmu):
    model = WheelsetModel(WheelsetParameters())
    fmu.update({"irregularity.lateral": 1e-3, "irregularity.slope": 2e-3})
    fmu.step()
    for side in SIDES:
        model.set_forces(side, 0.0, 0.0, 0.0, WheelsetParameters().approach)
    model.set_irregularity(1e-3, 2e-3)
    model.step(1e-3)
    assert fmu.all("output") == reported(model)


def test_a_start_off_the_rails_is_discarded_with_its_reason(open_fmu):
    fmu = open_fmu(NAME)
    fmu.update({"initial.lateral": 0.2})
    refused(fmu.initialize, DISCARD)
    assert "do not overlap" in fmu.log[-1][1]
    assert all(math.isfinite(v) for v in fmu.all("output").values())


def test_two_fmus_that_share_code_run_in_one_process(fmu, open_fmu):
    """Do one step of a wheelset and its right contact."""
    contact = open_fmu("WheelRailContact").initialize()
    contact.update({name: fmu[f"right.{name}"] for name in PROBLEM})
    contact.step()
    fmu.update({f"right.{name}": contact[name] for name in REACTION})
    fmu.step()
    assert contact["force.n"] == pytest.approx(fmu["right.load.normal_force"], rel=0.05)
    assert np.hypot(contact["force.x"], contact["force.y"]) > 100.0
