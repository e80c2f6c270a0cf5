"""Damage that the FMU `WheelRailPair` accumulates in bins over both profiles, in both packagings."""

import numpy as np
import pytest
from fmu_instance import discarded
from fmu_instance_fmi3 import Instance3
from pair_case import NAME
from thesis_case import THESIS

import contact
from contact.accumulation import MAXIMA, SUMS, Histogram
from contact.damage import WEAR_LAWS, DamageParameters
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact_fmu.tables.wheel_rail_pair import BINS, BODIES

ON = {"accumulation.wear_law": 2}


def bins(fmu, body: str, quantity: str) -> np.ndarray:
    """Return the bins of a quantity on one body."""
    return np.array(list(fmu.read(f"accumulated.{body}.{quantity}[{k + 1}]" for k in range(BINS)).values()))


def everything(fmu) -> np.ndarray:
    return np.array([bins(fmu, body, quantity) for body in BODIES for quantity in SUMS | MAXIMA])


def histograms(parameters: DamageParameters) -> dict[str, Histogram]:
    """Return the histograms of `rolled` by contact.accumulation."""
    wheel, rail = profile.s1002(), profile.rail_60e1(1 / 40)
    found = {body: Histogram(p, width=1e-3, parameters=parameters) for body, p in (("wheel", wheel), ("rail", rail))}
    pair, velocity = Pair(wheel, rail), Velocity(30.0, spin=-30.0 / 0.46 * 1.001)
    for k in range(4):
        patches = pair.contacts(Pose(y=2e-3 * k, yaw=4e-3), velocity, load=80e3)
        solutions = [
            contact.solve(p.separation, p.creepage, load=p.load, speed=30.0, throw=False, **contact.THESIS)
            for p in patches
        ]
        for histogram in found.values():
            histogram.add(patches, solutions, distance=30.0 * 2e-3)
    return found


def rolled(fmu, start: int = 0, steps: int = 4):
    for k in range(start, start + steps):
        fmu.update({"pose.y": 2e-3 * k})
        fmu.step(2e-3 * k, 2e-3)
    return fmu


ROLLING = {"pose.yaw": 4e-3, "velocity.x": 30.0, "velocity.spin": -30.0 / 0.46 * 1.001, **THESIS}


@pytest.mark.parametrize("law", range(len(WEAR_LAWS)))
def test_accumulates_what_contact_accumulation_does(open_pair, law):
    """The FMU finds the height of the load within 1e-9 of it; the histogram's contacts are solved for their loads. Bins at the
    edges of a patch hold little and magnify the difference: they are compared by the largest bin."""
    fmu = open_pair()
    fmu.update({**ROLLING, "accumulation.wear_law": law + 2})
    rolled(fmu.initialize())
    for body, wanted in histograms(DamageParameters(wear_law=WEAR_LAWS[law])).items():
        edges = np.arange(-60, 40)
        at = np.searchsorted(np.round(wanted.edges[:-1] / 1e-3), edges)
        inside = (edges >= round(wanted.edges[0] / 1e-3)) & (at < wanted.centres.size)
        for quantity in SUMS | MAXIMA:
            theirs = np.where(inside, wanted[quantity][np.minimum(at, wanted.centres.size - 1)], 0.0)
            mine = bins(fmu, body, quantity)
            assert mine.sum() == pytest.approx(wanted[quantity].sum(), rel=1e-7), "nothing lies beyond the bins"
            np.testing.assert_allclose(mine, theirs, rtol=1e-5, atol=1e-7 * np.abs(theirs).max(), err_msg=quantity)


def test_bins_add_up_to_the_totals_and_grow_linearly(open_pair):
    fmu = open_pair()
    fmu.update({**ROLLING, **ON})
    fmu.initialize().step(0.0, 2e-3)
    once = everything(fmu)
    for k in range(1, 5):
        fmu.step(2e-3 * k, 2e-3)
    later, maxima = everything(fmu), np.flatnonzero([quantity in MAXIMA for _ in BODIES for quantity in SUMS | MAXIMA])
    np.testing.assert_allclose(np.delete(later, maxima, 0), 5.0 * np.delete(once, maxima, 0), rtol=1e-12)
    np.testing.assert_array_equal(later[maxima], once[maxima])
    assert fmu["total.distance"] == pytest.approx(30.0 * 0.01, rel=1e-12)
    for body in BODIES:
        assert bins(fmu, body, "volume").sum() == pytest.approx(fmu["total.worn_volume"], rel=1e-12)
        assert bins(fmu, body, "T_gamma").sum() == pytest.approx(fmu["total.T_gamma"], rel=1e-12)
    assert fmu["total.T_gamma"] > 0.0


def test_bins_are_part_of_the_state_and_a_discarded_step_leaves_them(open_pair):
    fmu, other = open_pair(), open_pair()
    fmu.update({**ROLLING, **ON})
    rolled(fmu.initialize(), steps=2)
    state, before = fmu.fmu.getFMUstate(), everything(fmu)
    content = fmu.fmu.serializeFMUstate(state)
    wanted = everything(rolled(fmu, 2, 2))
    assert (wanted > before).any()
    fmu.fmu.setFMUstate(state)
    np.testing.assert_array_equal(everything(fmu), before)
    good = fmu["pose.yaw"]
    fmu.update({"pose.yaw": 1.0})
    discarded(fmu, 4e-3, 2e-3)
    np.testing.assert_array_equal(everything(fmu), before)
    fmu.update({"pose.yaw": good})
    np.testing.assert_array_equal(everything(rolled(fmu, 2, 2)), wanted)
    fmu.fmu.freeFMUstate(state)
    other.fmu.setFMUstate(other.fmu.deSerializeFMUstate(content))
    np.testing.assert_array_equal(everything(other), before)
    np.testing.assert_array_equal(everything(rolled(other, 2, 2)), wanted)
    fmu.fmu.reset()
    fmu.update({**ROLLING, **ON})
    assert not everything(fmu.initialize()).any()


def test_bins_stay_zero_when_nothing_accumulates(open_pair):
    fmu = open_pair()
    fmu.update(ROLLING)
    fmu.initialize().step()
    assert not everything(fmu).any()
    assert fmu["total.T_gamma"] > 0.0


@pytest.fixture
def open_pair_fmi3(native_fmi3, unzipped, freed):
    """Return a function that instantiates the native FMU of FMI 3.0."""
    folder = unzipped(native_fmi3.with_name(f"{NAME}.fmu"))
    return lambda kind="CoSimulation": freed(Instance3(folder, kind=kind))


def test_arrays_of_fmi3_are_the_bins(open_pair_fmi3, native_pair):
    two, three = native_pair(), open_pair_fmi3()
    for fmu in (two, three):
        fmu.update({**ROLLING, **ON})
        rolled(fmu.initialize())
    for body in BODIES:
        for quantity in SUMS | MAXIMA:
            array = three[f"accumulated.{body}.{quantity}"]
            assert array.shape == (BINS,)
            np.testing.assert_array_equal(array, bins(two, body, quantity))
