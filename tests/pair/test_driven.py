"""A driven wheel: the spin answers a force or a torque, CONTACT's spins, unreachable forces, errors."""

import pytest

from contact import Status
from contact.geometry.wheelset import Pose, Velocity

FREE = -2.0 / 0.46


@pytest.mark.parametrize("y", [-3e-3, 0.0, 5e-3])
@pytest.mark.parametrize("share", [-0.8, -0.1, 0.0, 0.5])
def test_the_spin_gives_the_force(pair, y, share):
    force = share * 0.3 * 7e4
    found = pair.solve(Pose(y=y), Velocity(2.0), force=force, vertical=7e4)
    assert found.status in (Status.OK, Status.SATURATED)
    assert float(found.force[0]) == pytest.approx(force, abs=1e-4 * 7e4)
    again = pair.solve(Pose(y=y), Velocity(2.0, spin=found.spin), vertical=7e4)
    assert float(again.force[0]) == pytest.approx(force, abs=1e-3 * 7e4)


def test_a_torque_is_a_force_at_the_radius(pair):
    by_torque = pair.solve(Pose(y=-3e-3), Velocity(2.0), torque=3e3, vertical=7e4)
    assert float(by_torque.moment[1]) == pytest.approx(3e3, abs=0.5)
    assert float(by_torque.force[0]) == pytest.approx(3e3 / 0.46, rel=0.01)


#: Set H, module 1, CONTACT 25.1: y [mm], force on the rail in wheelset axes [N], spin found [rad/s].
SPINS = [
    (0.0, 3000.0, -4.3469237),
    (0.0, -8000.0, -4.3503125),
    (2.0, 5000.0, -4.340805),
    (2.0, -15000.0, -4.349577),
    (-3.0, -4000.0, -4.3510967),
    (5.0, 6000.0, -4.3278229),
]


@pytest.mark.parametrize(("y", "force", "spin"), SPINS)
def test_the_spins_are_contacts(pair, y, force, spin):
    """Within 1e-3: the rolling radius depends on the profile, and 60E1 is not CONTACT's profile point by point.

    `benchmarks/contact_features.py` compares with CONTACT's own profiles.
    """
    found = pair.solve(Pose(y=1e-3 * y), Velocity(2.0), force=-force, vertical=8e4)
    assert found.spin == pytest.approx(spin, rel=1e-3)


def test_more_than_friction_is_unreachable(pair):
    found = pair.solve(Pose(), Velocity(2.0), force=0.4 * 7e4, vertical=7e4)
    assert found.status is Status.UNREACHABLE
    assert float(found.force[0]) < 0.31 * 7e4
    assert abs(found.spin) > 1.4 * abs(FREE)


def test_a_lifted_wheel_has_no_force(pair):
    found = pair.solve(Pose(z=-0.01), Velocity(2.0), force=1e3)
    assert found.status is Status.NO_CONTACT
