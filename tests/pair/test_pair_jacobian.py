"""Derivatives of a pair (`PairSolution.jacobian`), against central differences of closely iterated solutions."""

import dataclasses
import pickle

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.pair import ElasticRail, WheelRailPair

LOAD, SPEED, RADIUS = 80e3, 20.0, 0.460
TREAD = Pose(y=1.5e-3, roll=1e-3, yaw=3e-3)
#: Moves with the wheelset: column of the jacobian, argument, member, step.
POSES = [("pose.y", 2e-7), ("pose.z", 2e-8), ("pose.roll", 2e-8), ("pose.yaw", 2e-7)]


def made(side="right", inclination=1 / 40, **options) -> WheelRailPair:
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=inclination)
    pair = WheelRailPair(Pair(wheel, rail, side=side, **options))
    pair.arrays.case["tolerance"] = 1e-10
    return pair


@pytest.fixture(scope="module")
def right() -> WheelRailPair:
    return made()


def numbers(found) -> np.ndarray:
    return np.array([*found.force, *found.moment, found.z])


def arguments(pose, velocity, irregularity):
    return {"pose": pose, "velocity": velocity, "irregularity": irregularity}


def difference(pair, name, step, given, options) -> np.ndarray:
    """Return the central difference by the member `name`, "pose.y" or an option."""
    sides = []
    for sign in (1.0, -1.0):
        moved, chosen = dict(given), dict(options)
        if "." in name:
            record, member = name.split(".")
            at = getattr(moved[record], member)
            moved[record] = dataclasses.replace(moved[record], **{member: at + sign * step})
        else:
            chosen[name] += sign * step
        pair.forget()
        sides.append(numbers(pair.solve(**moved, **chosen)))
    return (sides[0] - sides[1]) / (2.0 * step)


def compare(pair, given, options, names, tolerance) -> None:
    pair.forget()
    found = pair.solve(**given, **options, derivatives=True)
    assert found.jacobian.one_sided == ()
    unit = np.array([1.0, 1.0, 1.0, 0.75, 0.75, 0.75, 1e-9])  # the height's slope is about 1e-9 m/N
    for name, step in names:
        wanted = difference(pair, name, step, given, options)
        got = np.array([found.jacobian[row, name] for row in found.jacobian.rows])
        assert got / unit == pytest.approx(wanted / unit, abs=tolerance * np.abs(wanted / unit).max()), name


def settled(pair, pose, load=LOAD) -> Pose:
    """Return the pose at which the wheel carries its load."""
    pair.forget()
    return dataclasses.replace(pose, z=pair.solve(pose, Velocity(SPEED), load=load).z)


def rolling(pair, pose):
    return arguments(
        settled(pair, pose), Velocity(SPEED, y=0.01, roll=0.01, yaw=0.02, spin=-1.0005 * SPEED / RADIUS), Irregularity()
    )


@pytest.mark.parametrize("options", [{"penetration": 1e-4}, {"load": LOAD}, {"vertical": LOAD}])
def test_the_height_follows_its_condition(right, options):
    (name,) = options
    given = arguments(dataclasses.replace(TREAD, z=0.0), Velocity(SPEED, y=0.012), Irregularity())
    steps = [("pose.y", 1e-6), ("pose.yaw", 1e-6), ("velocity.y", 1e-5), ("irregularity.z", 1e-6)]
    compare(right, given, {**options, "friction": 0.3}, [*steps, (name, 1e-4 * options[name])], 2e-2)


def test_a_rail_on_springs_gives_way(right):
    rail = ElasticRail(ky=30e6, kz=60e6)
    given = rolling(right, TREAD)
    right.forget()
    rigid = right.solve(**given, derivatives=True)
    soft = right.solve(**given, rail=rail, derivatives=True)
    right.forget()
    stiff = right.solve(**given, rail=ElasticRail(ky=1e15, kz=1e15), derivatives=True)
    assert stiff.jacobian.values == pytest.approx(
        rigid.jacobian.values, rel=1e-3, abs=1e-3 * abs(rigid.jacobian.values).max()
    )
    # one spring after the other: the contact's and the rail's
    contact, both = -rigid.jacobian["Fz", "pose.z"], -soft.jacobian["Fz", "pose.z"]
    assert both < 0.5 * contact
    assert both == pytest.approx(1.0 / (1.0 / contact + 1.0 / 60e6), rel=0.1)


def test_a_displaced_wheel_is_referred_to_its_wheelset(right):
    offset = WheelOffset(y=2e-4, z=1e-5, roll=5e-4, yaw=1e-3, y_rate=1e-3, yaw_rate=1e-2)
    given = rolling(right, TREAD)
    compare(right, given, {"offset": offset, "friction": 0.3}, [*POSES, ("velocity.yaw", 1e-7)], 2e-3)


def test_the_solution_stays_as_it_is_without_derivatives():
    asked, plain = made(), made()
    given = rolling(made(), TREAD)
    for step in range(3):
        moved = {**given, "pose": dataclasses.replace(given["pose"], y=given["pose"].y + 1e-4 * step)}
        one, other = asked.solve(**moved, derivatives=True), plain.solve(**moved)
        assert numbers(one).tolist() == numbers(other).tolist()
        assert one.contacts == other.contacts
    assert other.jacobian is None


def test_without_contact_all_derivatives_are_zero(right):
    found = right.solve(Pose(z=-1e-3), derivatives=True)
    assert not found.jacobian.values[:6].any()
    assert found.jacobian["z", "pose.z"] == 1.0


@pytest.mark.parametrize("speed", [0.0, 1e-6, 60.0])
@pytest.mark.parametrize("friction", [0.0, 0.4])
@pytest.mark.parametrize("y", [-5e-3, 0.0, 6.7e-3, 7.3e-3])
def test_derivatives_are_finite(right, speed, friction, y):
    found = right.solve(Pose(y=y, yaw=-4e-3), Velocity(speed, y=0.1), load=LOAD, friction=friction, derivatives=True)
    assert np.isfinite(found.jacobian.values).all()


def test_a_jacobian_is_read_by_names_and_shown_with_units(right):
    found = right.solve(TREAD, Velocity(SPEED), load=LOAD, derivatives=True).jacobian
    assert np.asarray(found).shape == (7, 18)
    assert found.columns[-2:] == ("load", "friction")
    assert "velocity.forward [m/s]" in found._repr_html_()
    assert pickle.loads(pickle.dumps(found)).values.tolist() == found.values.tolist()
    with pytest.raises(ContactError, match=r"columns are pose\.y, pose\.z"):
        found["Fx", "y"]
    assert right.solve(TREAD, derivatives=True).jacobian.columns[-2] == "irregularity.roll_rate"


@pytest.mark.parametrize("normal", ["hertz", "kik_piotrowski", "stripes_ab", "strip_halfspace"])
def test_columns_under_a_load_are_those_at_the_height_that_the_method_itself_finds(normal):
    """The separation is that at the height of the load; at ANALYN's height slopes are up to 1e-2 others."""
    pair = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)), normal=normal)
    pair.arrays.case["tolerance"] = 1e-10
    pose, velocity, load = Pose(y=-4e-3, roll=-1e-3, yaw=5e-3), Velocity(20.0, y=0.01, spin=-20.01 / 0.46), 60e3

    def at(z: float, y: float) -> tuple[np.ndarray, float]:
        pair.forget()
        found = pair.solve(dataclasses.replace(pose, y=pose.y + y, z=z), velocity)
        carried = sum(each.N * np.cos(each.angle) for each in found.contacts)
        return np.array([*found.force, *found.moment]), carried - load

    def under_load(y: float) -> np.ndarray:
        low = pair.solve(dataclasses.replace(pose, y=pose.y + y), velocity, load=load).z
        high = low + 1e-7
        (_, before), (wrench, after) = at(low, y), at(high, y)
        for _ in range(8):
            if abs(after) < 1e-7:
                break
            low, high, before = high, high - after * (high - low) / (after - before), after
            wrench, after = at(high, y)
        return wrench

    found = pair.solve(pose, velocity, load=load, derivatives=True)
    assert found.jacobian is not None
    h = 2e-7
    wanted = (under_load(h) - under_load(-h)) / (2.0 * h)
    column = found.jacobian.values[:6, found.jacobian.columns.index("pose.y")]
    assert np.abs(column - wanted).max() < 1e-4 * np.abs(wanted).max()
