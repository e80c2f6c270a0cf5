"""What the FMUs do in the same way in both packagings: bad inputs, lift-off, states, reset."""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import pair_case
import pytest
import wheelset_case
from contact_case import NAME, posed
from fmu_instance import DISCARD, WARNING, Instance, goes_on, recovers, refused
from thesis_case import THESIS

import contact
from contact_fmu.tables.wheel_rail_contact import REACTION, table


class Kind(NamedTuple):
    """An FMU: what instantiates it, sets it up before its initialisation, and drives it for `steps` steps from a step on."""

    open: Callable[[], Instance]
    prepare: Callable[[Instance], object]
    drive: Callable[[Instance, int], list[dict[str, float]]]
    steps: int


def prepared(fmu):
    """Set the case of `contact_case` and the methods of the thesis."""
    posed(fmu).update(THESIS)
    return fmu


def trajectory(fmu, start: int) -> list[dict[str, float]]:
    """Return the outputs of five steps with changing inputs from step `start` on."""
    rows = []
    for k in range(start, start + 5):
        fmu.update({"creepage.lateral": 1e-3 * math.sin(k), "load.normal_force": 8e4 + 1e4 * math.cos(k)})
        fmu.step(k * 1e-3)
        rows.append(fmu.all("output"))
    return rows


@pytest.fixture(params=["python", "native"])
def packaging(request) -> str:
    return request.param


@pytest.fixture
def open_contact(request, packaging):
    """Return a function that instantiates WheelRailContact in each packaging."""
    if packaging == "native":
        return request.getfixturevalue("open_native")
    return partial(request.getfixturevalue("open_fmu"), NAME)


@pytest.fixture
def open_wheelset(request, packaging, unzipped, freed):
    """Return a function that instantiates Wheelset in each packaging."""
    if packaging == "python":
        return partial(request.getfixturevalue("open_fmu"), "Wheelset")
    folder = unzipped(request.getfixturevalue("native_wheelset"))
    return lambda: freed(Instance(folder))


@pytest.fixture(params=["contact", "wheelset", "pair"])
def kind(request, packaging):
    """Return each of the FMUs as a `Kind`. The strips of the pair interact, so each step starts from the last one."""
    if request.param == "pair":
        python = partial(request.getfixturevalue("open_fmu"), pair_case.NAME)
        opened = request.getfixturevalue("native_pair") if packaging == "native" else python
        return Kind(opened, pair_case.warm, pair_case.trajectory, 4)
    opened = request.getfixturevalue(f"open_{request.param}")
    if request.param == "contact":
        return Kind(opened, prepared, trajectory, 5)
    return Kind(opened, lambda fmu: fmu.update({"initial.y[1]": 1e-3}), wheelset_case.trajectory, 3)


@pytest.fixture
def fmu(open_contact):
    return prepared(open_contact()).initialize(stop_time=1.0)


@pytest.fixture
def wheelset(open_wheelset):
    return open_wheelset().initialize()


@pytest.mark.parametrize(
    ("name", "value", "fault"),
    [
        ("geometry.g[7]", math.nan, "not finite"),
        ("geometry.A[41]", -1.0, "outside the allowed range [0, inf["),
        ("creepage.spin", math.inf, "outside the allowed range [-1e+06, 1e+06]"),
        ("load.normal_force", -1001.0, "outside the allowed range [-1000, inf["),
        ("friction.coefficient", math.nan, "outside the allowed range [0, 1e+06]"),
        ("speed", -1.0, "outside the allowed range [0, inf["),
    ],
)
def test_a_bad_input_is_discarded_by_name_and_the_instance_recovers(fmu, name, value, fault):
    fmu.step()
    before = fmu.all("output")
    recovers(fmu, {name: value}, f"{name} = {value:g} is {fault}", 7)  # the fifth exception in pythonfmu ends the host
    assert fmu["force.x"] == before["force.x"]
    assert fmu["total.energy"] == pytest.approx(2.0 * before["total.energy"], rel=1e-12)


@pytest.mark.parametrize("name", ["wheel[1].force.y", "wheel[2].moment.z", "speed"])
def test_a_bad_input_of_a_wheelset_is_discarded_by_name_and_the_instance_recovers(wheelset, name):
    recovers(wheelset, {name: math.nan}, f"{name} = nan is ")


def test_a_wheelset_far_from_the_track_is_discarded_and_stays_where_it_was(wheelset):
    wheelset_case.trajectory(wheelset, 0)
    before = wheelset.all("output")
    wheelset.update({"wheel[1].force.y": 1e12})
    refused(lambda: wheelset.step(3e-3), DISCARD)
    assert "a body is more than 5 m or rad from its place" in wheelset.log[-1][1]
    assert wheelset.all("output") == before
    assert wheelset_case.trajectory(wheelset, 3)[-1]["body[2].y"] == pytest.approx(before["body[2].y"], abs=1e-3)


def test_lift_off_is_a_valid_result(fmu):
    fmu.update({"load.normal_force": 0.0})
    fmu.step()
    outputs = fmu.all("output")
    assert outputs["status_real"] == contact.Status.NO_CONTACT
    assert not any(value for name, value in outputs.items() if name not in ("status_real", "approach"))
    assert not fmu.log


def test_connectors_at_zero_give_no_contact_without_load_and_a_flat_contact_with_load(fmu):
    """A master without knowledge of start values gives zeros. Curvature 0 is then not an error."""
    problem = [s.name for s in table().scalars if s.name.startswith(("geometry.g[", "geometry.A[", "creepage."))]
    problem.append("load.normal_force")
    good = {name: fmu[name] for name in problem}
    fmu.step()
    before = fmu["force.x"]
    fmu.update(dict.fromkeys(problem, 0.0))
    fmu.step(1e-3)
    assert fmu["status"] == contact.Status.NO_CONTACT
    assert not any(fmu[name] for name in REACTION)
    fmu.update({"load.normal_force": 1e3})
    fmu.step(2e-3)
    assert fmu["status"] == contact.Status.OUT_OF_RANGE
    fmu.update(good)
    fmu.step(3e-3)
    assert fmu["force.x"] == before


def test_a_patch_beyond_the_separation_is_reported_once_as_a_warning(fmu):
    fmu.update({f"geometry.g[{i}]": 1e-9 * (i - 21) ** 2 for i in range(1, 42)})
    for k in range(3):
        fmu.step(k * 1e-3)
    assert fmu["status"] == contact.Status.OUT_OF_RANGE
    assert all(math.isfinite(value) for value in fmu.all("output").values())
    assert [(status, message.split(":")[0]) for status, message in fmu.log] == [(WARNING, "status OUT_OF_RANGE")]


def test_a_restored_or_serialised_state_continues_bit_by_bit(kind):
    fmu = kind.open()
    kind.prepare(fmu)
    kind.drive(fmu.initialize(), 0)
    causalities = ("input", "output", "parameter")
    goes_on(fmu, kind.open().initialize(), lambda one: (one.all(*causalities), kind.drive(one, kind.steps)))


def test_a_state_from_before_the_initialisation_begins_the_run_again_bit_by_bit(kind):
    fmu = kind.open()
    kind.prepare(fmu)
    state = fmu.fmu.getFMUstate()
    wanted = kind.drive(fmu.initialize(), 0)
    fmu.fmu.setFMUstate(state)
    assert kind.drive(fmu.initialize(), 0) == wanted
    fmu.fmu.freeFMUstate(state)


def test_reset_restores_every_start(kind):
    wanted = kind.open().initialize().all("input", "output", "parameter")
    fmu = kind.open()
    kind.prepare(fmu)
    kind.drive(fmu.initialize(), 0)
    fmu.fmu.reset()
    assert fmu.initialize().all("input", "output", "parameter") == wanted
