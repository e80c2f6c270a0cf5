"""The native `WheelRailContact` through the C interface of FMI, as a user calls it."""

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


def test_extreme_values_give_finite_outputs_or_none(open_native, open_pair):
    """No finite input causes a crash, a hang or NaN."""

    def of_contact(rng):
        methods = (int(rng.integers(len(of_a_kind))) + 1 for of_a_kind in contact.methods().batched)
        return dict(zip(("method.normal", "method.tangential"), methods, strict=True))

    def of_pair(rng):
        return {"load.kind": int(rng.integers(1, 3)), "method.tangential": int(rng.integers(1, 4))}

    assert answered_extremes(open_native().initialize(), 400, of_contact) > 20
    assert answered_extremes(open_pair().initialize(), 200, of_pair) > 20


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
