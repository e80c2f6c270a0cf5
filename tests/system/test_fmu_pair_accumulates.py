"""Damage that the FMU `WheelRailPair` accumulates in bins over both profiles. `test_fmu_behaviour.py` has their states."""

import numpy as np
import pytest
from thesis_case import THESIS

import contact
from contact.accumulation import MAXIMA, SUMS
from contact.damage import WEAR_LAWS, DamageParameters
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.instance import workspace
from contact.pair import WheelRailPair
from contact_fmu.tables.wheel_rail_pair import BINS, BODIES


def bins(fmu, body: str, quantity: str) -> np.ndarray:
    """Return the bins of a quantity on one body."""
    return np.array(list(fmu.read(f"accumulated.{body}.{quantity}[{k + 1}]" for k in range(BINS)).values()))


def everything(fmu) -> np.ndarray:
    return np.array([bins(fmu, body, quantity) for body in BODIES for quantity in SUMS | MAXIMA])


SPIN = -30.0 / 0.46 * 1.001
ROLLING = {"pose.yaw": 4e-3, "velocity.x": 30.0, "velocity.spin": SPIN, **THESIS}


@pytest.mark.parametrize("law", range(len(WEAR_LAWS)))
def test_bins_are_those_of_the_ledger_of_a_pair_and_add_up_to_the_totals(open_pair, law):
    fmu = open_pair()
    fmu.update({**ROLLING, "accumulation.wear_law": law + 2})
    fmu.initialize()
    for k in range(4):
        fmu.update({"pose.y": 2e-3 * k})
        fmu.step(2e-3 * k, 2e-3)
    bodies = profile.s1002(), profile.rail_60e1(1 / 40)
    ledger = workspace.ledger(*(np.stack((p.y, p.z)) for p in bodies), 20, BINS, fmu["accumulation.first"], 1e-3)
    damage = DamageParameters(wear_law=WEAR_LAWS[law])
    pair = WheelRailPair(Pair(*bodies), damage=damage, ledger=ledger, **contact.THESIS)
    for k in range(4):
        pair.solve(Pose(y=2e-3 * k, yaw=4e-3), Velocity(30.0, spin=SPIN), load=80e3, friction=0.3, distance=30.0 * 2e-3)
    np.testing.assert_allclose(everything(fmu), ledger.bins.reshape(-1, BINS), rtol=1e-9, atol=1e-15)
    for body in BODIES:
        if WEAR_LAWS[law] == "archard":
            assert bins(fmu, body, "volume").sum() == pytest.approx(fmu["total.worn_volume"], rel=1e-12)
        assert bins(fmu, body, "T_gamma").sum() == pytest.approx(fmu["total.T_gamma"], rel=1e-12)
    assert fmu["total.T_gamma"] > 0.0


def test_bins_stay_zero_when_nothing_accumulates(open_pair):
    fmu = open_pair()
    fmu.update(ROLLING)
    fmu.initialize().step()
    assert not everything(fmu).any()
    assert fmu["total.T_gamma"] > 0.0
