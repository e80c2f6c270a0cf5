"""What hosts give that know little of the model: zeros, noise, and anything where it is not used."""

import math

import pytest
from fmu_instance import DISCARD, Instance, refused

from contact import Status
from contact_fmu.tables import wheel_rail_contact, wheel_rail_pair
from contact_fmu.variables import Causality

CONTACT, PAIR = "WheelRailContact", "WheelRailPair"
TABLES = {CONTACT: wheel_rail_contact.table(), PAIR: wheel_rail_pair.table()}
#: Choices of an FMU by which every input is used or not used at some time.
CHOICES = [
    (CONTACT, {"geometry.kind": 1, "load.kind": 1}),
    (CONTACT, {"geometry.kind": 1, "load.kind": 2}),
    (CONTACT, {"geometry.kind": 1, "load.kind": 1, "geometry.surface": 2}),
    (CONTACT, {"geometry.kind": 2, "load.kind": 1}),
    (CONTACT, {"geometry.kind": 2, "load.kind": 2, "geometry.surface": 2}),
    (PAIR, {"load.kind": 1}),
    (PAIR, {"load.kind": 2}),
    (PAIR, {"load.kind": 3}),
]


@pytest.fixture
def make(opened):
    """Return a function that instantiates an FMU by name, with parameters, before its initialisation."""

    def make(name: str, parameters: dict | None = None) -> Instance:
        made = opened(name)
        made.update(parameters or {})
        return made

    return make


def inputs(name: str) -> list:
    return [s for s in TABLES[name].scalars if s.row.causality is Causality.INPUT]


def is_used(row, parameters: dict) -> bool:
    table = TABLES[row[0]]
    return all(
        table.row[of].enumeration.item(parameters.get(of, 1)) in items for of, items in table.row[row[1]].used.items()
    )


@pytest.mark.parametrize(("name", "parameters"), CHOICES)
def test_an_input_that_is_not_used_may_be_anything(make, name, parameters):
    """It changes no output, and the step is done."""
    fmu, plain = make(name, parameters), make(name, parameters)
    unused = [s.name for s in inputs(name) if not is_used((name, s.row.name), parameters)]
    assert unused
    for value in (math.nan, math.inf, -1e300, -1.0):
        fmu.fmu.reset(), fmu.update(parameters), fmu.update(dict.fromkeys(unused, value))
        plain.fmu.reset(), plain.update(parameters)
        for instance in (fmu, plain):
            instance.initialize().step()
        assert fmu.all("output") == plain.all("output")


@pytest.mark.parametrize(("name", "parameters"), CHOICES)
def test_all_inputs_at_zero_give_no_contact_or_a_valid_answer(make, name, parameters):
    fmu = make(name, parameters)
    fmu.update({s.name: 0.0 for s in inputs(name)})
    fmu.initialize().step()
    outputs = fmu.all("output")
    assert all(map(math.isfinite, outputs.values()))
    if parameters["load.kind"] != 2 or name == CONTACT:
        assert outputs["status_real"] == Status.NO_CONTACT
        assert outputs["force.x"] == outputs["force.y"] == 0.0


@pytest.mark.parametrize("name", TABLES)
def test_a_small_negative_load_is_no_load_and_a_large_one_a_wrong_sign(make, name):
    fmu = make(name).initialize()
    for load in (0.0, -1e-9, -1.0, -999.0):
        fmu.update({"load.normal_force": load})
        fmu.step()
        outputs = fmu.all("output")
        assert outputs["status_real"] == Status.NO_CONTACT
        left = (
            "status_real", "approach", "wheelset.z", "total.distance", "total.energy", "total.worn_volume",
            "total.T_gamma",
        )  # fmt: skip
        assert not any(value for name, value in outputs.items() if name not in left)
        assert load or not fmu.log
    fmu.update({"load.normal_force": -80e3})
    refused(fmu.step, DISCARD)


def test_a_contact_at_standstill_has_forces_and_no_rates(make):
    fmu, rolling = make(CONTACT), make(CONTACT)
    for instance, speed in ((fmu, 0.0), (rolling, 20.0)):
        instance.update({"speed": speed, "creepage.longitudinal": 1e-3})
        instance.initialize().step()
    assert fmu["force.x"] == rolling["force.x"] < -1e4
    assert fmu["power.friction"] == fmu["total.energy"] == 0.0


@pytest.mark.parametrize("name", [CONTACT, PAIR, "Wheelset"])
def test_default_start_values_give_a_meaningful_first_step(make, name):
    fmu = make(name).initialize()
    fmu.step()
    outputs = fmu.all("output")
    assert all(map(math.isfinite, outputs.values()))
    if name == "Wheelset":
        assert outputs["wheel[1].velocity.x"] == pytest.approx(28.0)
        assert outputs["wheel[1].pose.y"] == outputs["wheel[2].pose.y"] == pytest.approx(3e-3, abs=1e-4)
    else:
        assert outputs["status_real"] in (Status.OK, Status.SATURATED)
        assert outputs["pressure.max"] > 5e8


@pytest.mark.parametrize(
    ("twin", "choices"),
    [("method.normal", (2, 3)), ("method.tangential", (2, 4)), ("load.kind", (2,)), ("friction.law", (3,))],
)
def test_a_choice_by_number_is_the_choice_by_item(make, twin, choices):
    for choice in choices:
        fmu, other = make(CONTACT, {f"{twin}_integer": choice}), make(CONTACT, {twin: choice})
        for instance in (fmu, other):
            instance.update({"creepage.longitudinal": 2e-3})
            instance.initialize().step()
        assert fmu.all("output") == other.all("output")
        assert fmu[twin] == choice


def test_the_number_wins_in_any_order_and_0_leaves_the_item(make):
    """Hosts that set every parameter also set those that the user has not changed."""
    fmu = make(CONTACT, {"method.tangential_integer": 2, "method.tangential": 1})
    other = make(CONTACT, {"method.tangential": 2, "method.tangential_integer": 0})
    for instance in (fmu, other):
        instance.update({"creepage.longitudinal": 2e-3})
        instance.initialize().step()
    assert fmu["force.x"] == other["force.x"] != 0.0
    assert fmu["method.tangential"] == other["method.tangential"] == 2


def test_a_number_of_no_item_is_refused_by_its_name(make):
    fmu = make(CONTACT, {"method.normal_integer": 99})
    refused(fmu.initialize, DISCARD)
    assert "method.normal_integer = 99 is outside the allowed range [0, " in fmu.log[-1][1]


def test_every_real_twin_shows_its_variable(make):
    fmu = make(PAIR).initialize()
    for load in (80e3, 0.0, 50e3):
        fmu.update({"load.normal_force": load})
        fmu.step()
        assert fmu["status_real"] == fmu["status"]
        assert fmu["patches.count_real"] == fmu["patches.count"] == (load > 0.0)
