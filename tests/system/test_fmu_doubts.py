"""FMUs tell what Python warns of: values that no wheel on a rail has, once for each instance and rule."""

import pytest
from fmu_instance import WARNING, Instance

from contact.results import ANSWERS, BEND

#: An elliptic contact in the middle of the table of creep forces.
LONG = {"geometry.A0": 1.1, "geometry.B0": 0.28, "load.normal_force": 8e4, "creepage.longitudinal": 1e-3}
#: Inputs of a pair, and what is said of them.
PAIR = [
    ({"velocity.x": 40.0}, "velocity.spin = -43.4783: the longitudinal creepage is too large: "),
    ({"friction.coefficient": 35.0}, "friction.coefficient = 35: "),
    ({"load.normal_force": 80.0}, "load.normal_force = 80: "),
    ({"pose.roll": 0.06}, "pose.roll = 0.06: "),
    ({"velocity.y": 5.0}, "velocity.y = 5: "),
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


def test_a_contact_doubts_its_own_values(opened):
    fmu = opened("EllipticContact")
    fmu.update({"load.normal_force": 80.0, "creepage.longitudinal": 0.5, "creepage.spin": 30.0, "speed": 200.0})
    fmu.update({"wheel.radius": 0.92})
    fmu.initialize().step()
    named = [text.split(" = ")[0] for text in warned(fmu)]
    assert sorted(named) == ["creepage.longitudinal", "creepage.spin", "load.normal_force", "speed", "wheel.radius"]


def test_what_is_not_used_or_zero_is_not_doubted(opened):
    fmu = opened("EllipticContact")
    fmu.update({"load.kind": 2, "load.approach": 5e-5, "load.normal_force": 80.0, "speed": 0.0})
    fmu.initialize().step()
    assert warned(fmu) == []


def test_a_load_below_zero_is_none_and_not_doubted(opened):
    fmu = opened("WheelRailPair")
    fmu.update({"load.normal_force": -1e-9})
    fmu.initialize().step()
    assert warned(fmu) == []
    assert fmu["force.z"] == 0.0


@pytest.mark.parametrize(
    ("name", "output", "before", "values", "least", "about"),
    [
        ("WheelRailPair", "bend", {}, {"pose.y": 6.75e-3}, BEND, ANSWERS["bend"].hint),
        ("EllipticContact", "beyond", LONG, {"geometry.A0": 6.9, "geometry.B0": 0.0588}, 0.999, ANSWERS["beyond"].hint),
    ],
)
def test_what_a_method_leaves_out_of_a_patch_is_told_once(opened, name, output, before, values, least, about):
    """A bent patch that strips take as plane, and an ellipse with a/b = .05 beyond the table of creep forces."""
    fmu = opened(name)
    fmu.update(before)
    fmu.initialize().step()
    assert fmu[output] < min(least, BEND)
    fmu.update(values)
    for _ in range(3):
        fmu.step()
    assert fmu[output] > least
    assert warned(fmu) == [f"{output} = {fmu[output]:g}: {about}"]
