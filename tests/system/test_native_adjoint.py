"""Adjoint derivatives of the native FMUs of FMI 3.0, and the derivatives that the kernels know."""

import numpy as np
import pytest
from fmu_instance import Instance3

CREEPAGES = {"creepage.longitudinal": 1e-3, "creepage.lateral": -5e-4, "creepage.spin": 0.2}
CONTACT = ("force.x", "force.y", "moment.z", "force.n", "approach", "power.friction")
BY = (*CREEPAGES, "load.normal_force", "friction.coefficient")
WRENCH = ("force.x", "force.y", "force.z", "moment.x", "moment.y", "moment.z", "wheelset.z")
MOTION = ("pose.y", "pose.roll", "pose.yaw", "velocity.y", "velocity.yaw", "velocity.spin", "irregularity.y")
MOTION += ("load.normal_force",)


@pytest.fixture(params=["WheelRailContact", "WheelRailPair"])
def case(request, native, unzipped):
    """Return an instance of model exchange, what its kernels derive, and by what."""
    path = native.parent / "fmi3" / f"{request.param}.fmu"
    fmu = Instance3(unzipped(path), kind="ModelExchange")
    contact = request.param == "WheelRailContact"
    fmu.update(CREEPAGES if contact else {"pose.y": 2e-3, "pose.yaw": 2e-3, "velocity.y": 0.02})
    fmu.initialize()
    yield fmu, *((CONTACT, BY) if contact else (WRENCH, MOTION))
    fmu.free()


def test_both_ways_through_the_derivatives_agree(case):
    """v J u by directional derivatives and by adjoint ones, to round-off where the kernels know the derivatives."""
    fmu, unknowns, knowns = case
    rng = np.random.default_rng(3)
    full = np.array([fmu.directional(unknowns, [known], [1.0]) for known in knowns]).T
    scale = np.abs(full).max(1, keepdims=True)
    for _ in range(5):
        v, u = rng.normal(size=len(unknowns)) / scale[:, 0], rng.normal(size=len(knowns))
        one, other = v @ fmu.directional(unknowns, knowns, u), fmu.adjoint(unknowns, knowns, v) @ u
        assert one == pytest.approx(other, rel=1e-12)
        assert one == pytest.approx(v @ full @ u, rel=1e-12)


def test_adjoint_derivatives_of_what_the_kernels_do_not_derive(case):
    """Other outputs, and an input that is an array: rows of difference quotients."""
    fmu, unknowns, knowns = case
    unknowns = (unknowns[0], "pressure.max")
    knowns = (*knowns[:2], "geometry.g") if "geometry.g" in fmu.variables else (*knowns[:2], "offset.y")
    n = fmu.size(knowns)
    rows = [fmu.adjoint(unknowns, knowns, v) for v in np.eye(2)]
    for j in (0, 1, 2 + (n - 3) // 2):
        u = np.zeros(n)
        u[j] = 1.0
        np.testing.assert_allclose([row[j] for row in rows], fmu.directional(unknowns, knowns, u), rtol=1e-12)
    assert np.abs(rows).max() > 0.0


def test_derivatives_belong_to_the_present_values(case):
    """They are kept as long as no input changes, and are the same bits when it comes back."""
    fmu, unknowns, knowns = case
    before = fmu.directional(unknowns, knowns[:1], [1.0])
    at = fmu[knowns[0]]
    fmu.update({knowns[0]: 1.5 * at})
    between = fmu.directional(unknowns, knowns[:1], [1.0])
    fmu.update({knowns[0]: at})
    np.testing.assert_array_equal(fmu.directional(unknowns, knowns[:1], [1.0]), before)
    assert (between != before).any()
    state = fmu.fmu.getFMUState()
    fmu.update({knowns[0]: 1.5 * at})
    fmu.directional(unknowns, knowns[:1], [1.0])
    fmu.fmu.setFMUState(state)
    fmu.fmu.freeFMUState(state)
    np.testing.assert_array_equal(fmu.directional(unknowns, knowns[:1], [1.0]), before)
