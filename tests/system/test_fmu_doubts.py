"""FMUs tell what Python warns of: values that no wheel on a rail has, once for each instance and rule, in both packagings."""

import pytest
from fmu_instance import WARNING, Instance
from fmu_instance_fmi3 import Instance3

from contact.inputs.plausibility import about_bend, about_beyond
from contact.results import BEND, BEYOND

#: Inputs of a pair, and what is said of them.
PAIR = [
    ({"velocity.x": 40.0}, "velocity.spin = -43.4783: the longitudinal creepage is too large: "),
    ({"friction.coefficient": 35.0}, "friction.coefficient = 35: "),
    ({"load.normal_force": 80.0}, "load.normal_force = 80: "),
    ({"pose.roll": 0.06}, "pose.roll = 0.06: "),
]


def warned(instance: Instance) -> list[str]:
    return [text for status, text in instance.log if status == WARNING and " = " in text]


@pytest.mark.parametrize(("values", "message"), PAIR)
def test_a_pair_doubts_a_value_once(opened, values, message):
    fmu = opened("WheelRailPair")
    fmu.initialize().step()
    assert warned(fmu) == []
    fmu.update(values)
    for _ in range(3):
        fmu.step()
    assert [text[: len(message)] for text in warned(fmu)] == [message]


def test_the_status_of_the_step_is_a_warning_and_the_next_one_is_ok(opened):
    fmu = opened("WheelRailPair")
    fmu.initialize()
    fmu.update({"friction.coefficient": 35.0})
    step = fmu.fmu.dll.fmi2DoStep
    assert [step(fmu.fmu.component, 1e-3 * k, 1e-3, 0) for k in range(2)] == [WARNING, 0]


def test_a_bent_patch_that_strips_take_as_plane_is_told_once(opened):
    fmu = opened("WheelRailPair")
    fmu.initialize().step()
    assert 0.0 < fmu["bend"] < BEND
    fmu.update({"pose.y": 6.75e-3})
    for _ in range(3):
        fmu.step()
    assert fmu["bend"] > BEND
    (said,) = warned(fmu)
    assert said == f"bend = {fmu['bend']:g}: {about_bend(BEND)}"


def test_a_contact_doubts_its_own_values(opened):
    fmu = opened("EllipticContact")
    fmu.update({"load.normal_force": 80.0, "creepage.longitudinal": 0.5, "creepage.spin": 30.0, "speed": 200.0})
    fmu.initialize().step()
    named = [text.split(" = ")[0] for text in warned(fmu)]
    assert sorted(named) == ["creepage.longitudinal", "creepage.spin", "load.normal_force", "speed"]


def test_what_is_not_used_or_zero_is_not_doubted(opened):
    fmu = opened("EllipticContact")
    fmu.update({"load.kind": 2, "load.approach": 5e-5, "load.normal_force": 80.0, "speed": 0.0})
    fmu.initialize().step()
    assert warned(fmu) == []


def test_fmi_3_says_the_same(native_fmi3_folder):
    instance = Instance3(native_fmi3_folder)
    instance.update({"friction.coefficient": 35.0})
    instance.initialize()
    instance.step()
    assert any("friction.coefficient = 35: " in str(said) for said in instance.log)
    instance.free()


def test_a_patch_beyond_the_table_of_creep_forces_is_told_once(opened):
    fmu = opened("EllipticContact")
    fmu.update({"geometry.A0": 1.1, "geometry.B0": 0.28, "load.normal_force": 8e4, "creepage.longitudinal": 1e-3})
    fmu.initialize().step()
    assert fmu["beyond"] == 0.0
    fmu.update({"geometry.A0": 6.9, "geometry.B0": 0.0588})  # a/b = .05
    for _ in range(3):
        fmu.step()
    assert fmu["beyond"] == pytest.approx(1.0, abs=1e-3)
    assert warned(fmu) == [f"beyond = {fmu['beyond']:g}: {about_beyond(BEYOND)}"]
