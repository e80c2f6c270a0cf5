"""What all FMUs do in the same way: bad inputs, lift-off, states, reset."""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
import pair_case
import pytest
import wheelset_case
from contact_case import CREEPAGES, NAME, posed
from fmu_instance import DISCARD, ERROR, WARNING, Instance, goes_on, recovers, refused
from thesis_case import THESIS

import contact
from contact.kernels import memory
from contact.kernels.arrays import Size
from contact_fmu.tables.wheel_rail_contact import table


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


@pytest.fixture(params=[NAME, "Wheelset", pair_case.NAME])
def kind(request, opened):
    """Return each of the FMUs as a `Kind`. The strips of the pair interact, so each step starts from the last one."""
    make = partial(opened, request.param)
    if request.param == pair_case.NAME:
        return Kind(make, pair_case.warm, pair_case.trajectory, 4)
    if request.param == "Wheelset":
        return Kind(make, lambda fmu: fmu.update({"initial.y[1]": 1e-3}), wheelset_case.trajectory, 3)
    return Kind(make, prepared, trajectory, 5)


#: FMU, value, and what is said of it: for inputs and tunable parameters.
REFUSED = [
    (NAME, {"geometry.g[7]": math.nan}, "geometry.g[7] = nan is outside the allowed range [-100000, 100000]"),
    (NAME, {"geometry.A[41]": -1.0}, "geometry.A[41] = -1 is outside the allowed range [0, 1e+09]"),
    (NAME, {"creepage.spin": math.inf}, "creepage.spin = inf is outside the allowed range [-1e+06, 1e+06]"),
    (NAME, {"friction.coefficient": math.nan}, "friction.coefficient = nan is outside the allowed range [0, 1e+06]"),
    (NAME, {"material.poisson_ratio": 0.7}, "material.poisson_ratio = 0.7 is outside the allowed range [0, 0.5]"),
    ("Wheelset", {"wheel[1].force.y": math.nan}, "wheel[1].force.y = nan is "),
    ("Wheelset", {"speed": math.nan}, "speed = nan is "),
    (pair_case.NAME, {"pose.y": math.nan}, "pose.y = nan is not finite"),
    (pair_case.NAME, {"pose.yaw": 0.2}, "pose.yaw = 0.2 is outside the allowed range [-0.1, 0.1]"),
    (pair_case.NAME, {"irregularity.roll_rate": math.inf}, "irregularity.roll_rate = inf is not finite"),
    (pair_case.NAME, {"offset.yaw": 0.098, "pose.yaw": 4e-3}, "offset"),  # with the wheelset's yaw beyond 0.1
    (
        pair_case.NAME,
        {"load.normal_force": -1e4},
        "load.normal_force = -10000 is outside the allowed range [-1000, 1e+15]",
    ),
    (pair_case.NAME, {"pose.y": 1.0}, "pose.y = 1: the profiles of wheel and rail do not overlap, with irregularity"),
    (pair_case.NAME, {"load.normal_force": 1e12}, "load.normal_force = 1e+12: no height was found"),
]


@pytest.mark.parametrize(("name", "values", "says"), REFUSED)
def test_a_bad_input_is_discarded_by_name_and_the_instance_recovers(opened, name, values, says):
    fmu = opened(name)
    fmu.update(
        {NAME: {**CREEPAGES, **THESIS}, pair_case.NAME: {**pair_case.MOTION, **THESIS, "accumulation.wear_law": 2}}.get(
            name, {}
        )
    )
    fmu.initialize(stop_time=1.0).step()
    before = fmu.all("output")
    recovers(fmu, values, says, 2)
    if name != "Wheelset":  # which moves on
        assert fmu["force.y"] == before["force.y"]
        assert fmu["total.energy"] == pytest.approx(2.0 * before["total.energy"], rel=1e-12)
        assert before["total.energy"] > 0.0


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("geometry.dy", 0.0, "[1e-12, 100000]"),
        ("material.poisson_ratio", 0.6, "[0, 0.5]"),
        ("resolution.n_strips", 3, "[4, 1000]"),
        ("method.normal", 99, f"[1, {len(contact.methods().batched.normal)}]"),
        ("load.normal_force", -1e4, "[-1000, 1e+15]"),
    ],
)
def test_a_bad_start_value_is_discarded_by_name_and_can_be_corrected_in_initialisation(opened, name, value, allowed):
    fmu = opened(NAME)
    good = {scalar.name: scalar.first for scalar in table().scalars}[name]
    fmu.update({name: value})
    refused(fmu.initialize, DISCARD)
    assert fmu.log == [(DISCARD, f"{name} = {value:g} is outside the allowed range {allowed}")]
    fmu.update({name: good})
    fmu.fmu.exitInitializationMode()
    fmu.step()
    assert fmu["status"] == contact.Status.OK


def test_a_wheelset_far_from_the_track_is_discarded_and_stays_where_it_was(opened):
    wheelset = opened("Wheelset").initialize()
    wheelset_case.trajectory(wheelset, 0)
    before = wheelset.all("output")
    wheelset.update({"wheel[1].force.y": 1e12})
    refused(lambda: wheelset.step(3e-3), DISCARD)
    assert "a body is more than 5 m or rad from its place" in wheelset.log[-1][1]
    assert wheelset.all("output") == before
    assert wheelset_case.trajectory(wheelset, 3)[-1]["body[2].y"] == pytest.approx(before["body[2].y"], abs=1e-3)


def test_a_patch_beyond_the_separation_is_reported_once_as_a_warning(opened):
    fmu = prepared(opened(NAME)).initialize()
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


@pytest.mark.parametrize(("name", "starts"), [(NAME, 2), (pair_case.NAME, 1)])
def test_a_state_has_a_second_warm_start_only_where_fields_are_computed_from_it(opened, name, starts):
    def size(n_strips):
        fmu = opened(name)
        strips = {"method.normal": list(contact.methods().batched.normal).index("strip_halfspace") + 1}
        fmu.update({**(CREEPAGES if name == NAME else pair_case.MOTION), **strips, "resolution.n_strips": n_strips})
        fmu.initialize().step()
        return len(fmu.fmu.serializeFMUState(fmu.fmu.getFMUState())) / 8

    def start(n_strips):
        piece = memory.memory_size(Size(n_strips, 20, 41, 1, 0))
        return piece if name == NAME else memory.pair_memory_size(piece)

    assert size(22) - size(20) == starts * (start(22) - start(20))


def test_a_state_from_before_the_initialisation_begins_the_run_again_bit_by_bit(kind):
    fmu = kind.open()
    kind.prepare(fmu)
    state = fmu.fmu.getFMUState()
    wanted = kind.drive(fmu.initialize(), 0)
    fmu.fmu.setFMUState(state)
    assert kind.drive(fmu.initialize(), 0) == wanted
    fmu.fmu.freeFMUState(state)


def test_reset_restores_every_start(kind):
    wanted = kind.open().initialize().all("input", "output", "parameter")
    fmu = kind.open()
    kind.prepare(fmu)
    kind.drive(fmu.initialize(), 0)
    fmu.fmu.reset()
    assert fmu.initialize().all("input", "output", "parameter") == wanted


def test_an_invalid_step_is_an_error_and_changes_nothing(opened):
    fmu = prepared(opened(NAME)).initialize(stop_time=1.0)
    for time, h in ((0.0, 0.0), (0.0, math.nan), (0.0, 1.1), (1e-3, 1e-3), (-1e-3, 1e-3), (1e-300, 1e300)):
        fmu.log.clear()
        refused(partial(fmu.step, time, h), ERROR)
        assert fmu.log[0][0] == ERROR
    fmu.step(0.0, 1.0 + 1e-12)


def test_a_step_is_not_done_twice(opened):
    """Totals would count it twice. After a saved state is restored, steps continue from its time."""
    fmu = prepared(opened(NAME)).initialize(stop_time=1.0)
    fmu.step(0.0, 1e-3)
    state = fmu.fmu.getFMUstate()
    fmu.step(1e-3, 1e-3)
    for time in (0.0, 1e-3, 3e-3):
        refused(partial(fmu.step, time, 1e-3), ERROR)
    energy = fmu["total.energy"]
    fmu.fmu.setFMUstate(state)
    fmu.step(1e-3 * (1.0 + 1e-12), 1e-3)
    assert fmu["total.energy"] == energy
    fmu.fmu.freeFMUstate(state)


def test_a_time_in_single_precision_runs(opened):
    fmu = opened("EllipticContact")
    fmu.fmu.setupExperiment(startTime=100.0, stopTime=100.1)
    fmu.fmu.enterInitializationMode(), fmu.fmu.exitInitializationMode()
    for i in range(100):
        fmu.step(float(np.float32(100.0 + 1e-3 * i)))
    refused(lambda: fmu.step(float(np.float32(100.0 + 1e-3 * 99))), ERROR)
    refused(lambda: fmu.step(100.1 + 6e-5), ERROR)
