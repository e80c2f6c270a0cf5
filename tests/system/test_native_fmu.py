"""The native `WheelRailContact` through the C interface of FMI, as a user calls it."""

import math

import numpy as np
import pytest
from contact_case import posed
from fmu_instance import ERROR, answered_extremes, refused
from thesis_case import THESIS

import contact


@pytest.fixture
def fmu(open_native):
    """Return an instance with the case of `contact_case`, ready to step."""
    fmu = posed(open_native())
    fmu.update(THESIS)
    return fmu.initialize(stop_time=1.0)


def test_an_invalid_step_is_an_error_and_changes_nothing(fmu):
    for time, h, text in (
        (0.0, 0.0, "= 0 is outside"),
        (0.0, math.nan, "= nan is outside"),
        (0.0, 1.1, "stopTime = 1"),
        (1e-3, 1e-3, "currentCommunicationPoint = 0.001 does not continue"),
        (-1e-3, 1e-3, "does not continue"),
        (1e-300, 1e300, "stopTime = 1"),
    ):
        fmu.log.clear()
        refused(lambda time=time, h=h: fmu.step(time, h), ERROR)
        assert text in fmu.log[0][1]
    fmu.step(0.0, 1.0)


def test_a_step_is_not_done_twice(fmu):
    """Totals would count it twice. After a saved state is restored, steps continue from its time."""
    fmu.step(0.0, 1e-3)
    state = fmu.fmu.getFMUstate()
    fmu.step(1e-3, 1e-3)
    for time in (0.0, 1e-3, 3e-3):
        refused(lambda time=time: fmu.step(time, 1e-3), ERROR)
    energy = fmu["total.energy"]
    fmu.fmu.setFMUstate(state)
    fmu.step(1e-3 * (1.0 + 1e-12), 1e-3)
    assert fmu["total.energy"] == energy
    fmu.fmu.freeFMUstate(state)


def test_extreme_values_give_finite_outputs_or_none(open_native):
    """No finite input causes a crash, a hang or NaN."""

    def chosen(rng):
        methods = (int(rng.integers(len(of_a_kind))) + 1 for of_a_kind in contact.methods().batched)
        return dict(zip(("method.normal", "method.tangential"), methods, strict=True))

    assert answered_extremes(open_native().initialize(), 400, chosen) > 20


def test_damaged_bytes_are_no_state(fmu):
    state = fmu.fmu.getFMUstate()
    content = bytearray(fmu.fmu.serializeFMUstate(state))
    fmu.fmu.freeFMUstate(state)
    rng = np.random.default_rng(1)
    for _ in range(200):
        damaged = bytearray(content)
        damaged[rng.integers(len(damaged))] ^= 1 << rng.integers(8)
        refused(lambda damaged=damaged: fmu.fmu.deSerializeFMUstate(bytes(damaged)), ERROR)
    for size in (0, 1, 100, len(content) - 1):
        refused(lambda size=size: fmu.fmu.deSerializeFMUstate(bytes(content[:size])), ERROR)
        refused(lambda size=size: fmu.fmu.deSerializeFMUstate(rng.bytes(size)), ERROR)
    fmu.step()


def test_model_exchange_has_no_delay_and_counts_energy_by_the_trapezoidal_rule(open_native):
    fmu = posed(open_native("ModelExchange")).initialize()
    fmu.fmu.newDiscreteStates()
    fmu.fmu.enterContinuousTimeMode()
    powers, energy = [fmu["power.friction"]], 0.0
    for k in range(1, 4):
        fmu.fmu.setTime(2e-3 * k)
        fmu.update({"creepage.longitudinal": 1e-3 * k})
        powers.append(fmu["power.friction"])
        fmu.fmu.completedIntegratorStep()
        energy += 1e-3 * (powers[-2] + powers[-1])
        assert fmu["total.energy"] == pytest.approx(energy, rel=1e-12)
    assert len(set(powers)) > 2


def test_discrete_variables_change_only_at_events_and_their_twins_at_once(open_native):
    """Model exchange: a host does not read a discrete variable again in continuous time."""
    fmu = open_native("ModelExchange").initialize()
    fmu.fmu.enterContinuousTimeMode()
    fmu.update({"load.normal_force": 0.0})
    assert fmu["status_real"] == contact.Status.NO_CONTACT
    assert (fmu["status"], fmu["patch.count"], fmu["patch.count_real"]) == (contact.Status.OK, 1, 0.0)
    fmu.fmu.enterEventMode()
    assert (fmu["status"], fmu["patch.count"]) == (contact.Status.NO_CONTACT, 0)
