"""Friction memory and contact damping over time steps, against their closed forms."""

import json
import math

import numpy as np
import pytest

from contact import ContactError
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import ContactDamping, FrictionMemory, RollerRig
from tests.command_line import call

LAW = Friction(static=0.35, law="exponential", kinetic=0.15, half_speed=0.5)


def test_the_coefficient_fades_exponentially_over_the_distance_slid():
    for n in (1, 7):
        memory = FrictionMemory(LAW, 2e-3)
        for _ in range(n):
            memory.advance(0.8, 4e-3 / n)
        steady = float(LAW.coefficient(0.8))
        assert memory.coefficient == pytest.approx(steady + (0.35 - steady) * math.exp(-0.8 * 4e-3 / 2e-3), rel=1e-12)
    assert memory.friction.law == "coulomb"
    assert memory.friction.static == memory.coefficient


def test_without_sliding_the_state_rests_unless_it_has_a_least_velocity():
    memory = FrictionMemory(LAW, 1e-3)
    fast = memory.advance(5.0, 1.0)
    assert fast == pytest.approx(float(LAW.coefficient(5.0)), rel=1e-9)
    assert memory.advance(0.0, 10.0) == fast
    memory = FrictionMemory(LAW, 1e-3, least=1e-3)
    memory.advance(5.0, 1.0)
    assert memory.advance(0.0, 2.0) == pytest.approx(0.35 + (fast - 0.35) * math.exp(-2.0), rel=1e-9)


def test_a_short_memory_is_the_law():
    memory = FrictionMemory(LAW, 1e-9)
    for sliding in (0.1, 2.0, 0.4):
        assert memory.advance(sliding, 1e-3) == pytest.approx(float(LAW.coefficient(sliding)), rel=1e-12)


def solved(pair, load, creep=0.0):
    return pair.solve(Pose(y=2e-3), Velocity(20.0, spin=-20.0 / 0.46 * (1.0 + creep)), load=load)


def test_a_force_that_rises_evenly_has_its_rate_times_the_damping_time_more(pair):
    damping = ContactDamping(2e-4, 5e-4)
    first = solved(pair, 60e3, 1e-4)
    np.testing.assert_array_equal(damping.force(first, 1e-3), first.force)
    one, other = first.contacts[0], (second := solved(pair, 61e3, 4e-4)).contacts[0]
    added = damping.force(second, 1e-3) - second.force
    assert added[0] == pytest.approx(5e-4 * (other.Fx - one.Fx) / 1e-3, rel=1e-9)
    normal, lateral = 2e-4 * (other.N - one.N) / 1e-3, 5e-4 * (other.Fy - one.Fy) / 1e-3
    c, s = math.cos(other.angle), math.sin(other.angle)
    assert added[1:] == pytest.approx((c * lateral + s * normal, s * lateral - c * normal), rel=1e-9)
    damping.forget()
    np.testing.assert_array_equal(damping.force(second, 1e-3), second.force)


def test_rates_are_limited_and_no_patch_pulls(pair):
    damping = ContactDamping(1e-3, normal_rate=2e5)
    high, low = solved(pair, 80e3), solved(pair, 1e3)
    damping.force(high, 1e-3)
    middle = solved(pair, 60e3)
    assert np.linalg.norm(damping.force(middle, 1e-3) - middle.force) == pytest.approx(1e-3 * 2e5, rel=1e-6)
    damping = ContactDamping(1.0)
    damping.force(high, 1e-3)
    left = damping.force(low, 1e-3) - low.force
    assert np.linalg.norm(left) == pytest.approx(low.contacts[0].N, rel=1e-9)


def test_a_new_patch_has_no_damping(pair):
    damping, flange = ContactDamping(1e-3), pair.solve(Pose(y=7e-3), Velocity(20.0), load=6e4)
    damping.force(solved(pair, 6e4), 1e-3)
    np.testing.assert_array_equal(damping.force(flange, 1e-3), flange.force)


TIME = np.array([0.0, 1e-3, 3e-3, 4e-3])
SPIN = -20.0 / 0.46 * np.array([1.002, 1.004, 1.006, 1.004])
MOTION = {"time": TIME, "pose.y": [1e-3, 1e-3, 2e-3, 2e-3], "velocity.x": [20.0] * 4, "velocity.spin": SPIN}
UNDER_LOAD = {**MOTION, "load.normal_force": [6e4, 6e4, 5e4, 7e4], "offset.yaw": [0.0, 1e-3, 1e-3, 0.0]}


def test_a_motion_is_solved_row_by_row(pair):
    pair.forget()
    found = pair.run(UNDER_LOAD, friction=0.2)
    pair.forget()
    for k in range(4):
        pose, velocity = Pose(y=MOTION["pose.y"][k]), Velocity(20.0, spin=SPIN[k])
        offset, load = WheelOffset(yaw=UNDER_LOAD["offset.yaw"][k]), UNDER_LOAD["load.normal_force"][k]
        s = pair.solve(pose, velocity, load=load, friction=0.2, offset=offset)
        assert [found[name][k] for name in ("Fx", "Fy", "Fz")] == s.force.tolist()
        assert (found["Q"][k], found["Y"][k], found["z"][k], found["status"][k]) == (s.Q, s.Y, s.z, s.status)
        assert found["power"][k] == 20.0 * s.power_per_metre


def test_a_motion_may_be_a_table_of_pandas(pair):
    motion = {"time": [0.0, 1e-3], "pose.y": [1e-3, 2e-3], "load": [8e4, 8e4]}
    frame = pytest.importorskip("pandas").DataFrame(motion, index=[7, 8])
    assert np.array_equal(pair.run(frame)["Fy"], pair.run(motion)["Fy"])


def test_friction_along_the_track_is_a_column(pair):
    found = pair.run(UNDER_LOAD | {"friction.coefficient": [0.1, 0.2, 0.3, 0.4]})
    np.testing.assert_array_equal(found["friction"], [0.1, 0.2, 0.3, 0.4])
    one = pair.run({name: column[2:3] for name, column in UNDER_LOAD.items()}, friction=0.3)
    assert found["Fx"][2] == pytest.approx(one["Fx"][0], abs=1e-4 * 6e4)


def test_the_memory_lets_friction_follow_the_sliding_of_the_rows_before(pair):
    found = pair.run(UNDER_LOAD, memory=FrictionMemory(LAW, 1e-3))
    memory = FrictionMemory(LAW, 1e-3)
    assert found["friction"][0] == LAW.static
    for k in range(3):
        # what slides is the rolling circle, plus a little lateral creepage
        s = pair.solve(
            Pose(y=MOTION["pose.y"][k]),
            Velocity(20.0, spin=SPIN[k]),
            load=UNDER_LOAD["load.normal_force"][k],
            friction=memory.friction,
            offset=WheelOffset(yaw=UNDER_LOAD["offset.yaw"][k]),
        )
        creepage = s.contacts[0].creepage
        memory.advance(20.0 * math.hypot(creepage.longitudinal, creepage.lateral), float(np.diff(TIME)[k]))
        assert found["friction"][k + 1] == pytest.approx(memory.coefficient, rel=1e-9)
    assert (np.diff(found["friction"]) < 0.0).all()


def test_damping_is_added_from_the_second_row_on(pair):
    plain, damped = (pair.run(UNDER_LOAD, damping=d) for d in (None, ContactDamping(2e-4)))
    assert damped["Fz"][0] == pytest.approx(plain["Fz"][0], rel=1e-4)
    rate = (plain["Q"][3] - plain["Q"][2]) / 1e-3
    assert damped["Q"][3] - plain["Q"][3] == pytest.approx(2e-4 * rate, rel=0.02)  # N, nearly vertical, carries Q


@pytest.mark.parametrize(
    ("motion", "options", "message"),
    [
        ({"pose.y": [0.0]}, {}, "motion has no column 'time' and no column 'station'"),
        ({"station": [0.0]}, {"memory": FrictionMemory(LAW, 1.0)}, "friction memory and contact damping need"),
        ({"time": [0.0], "pose.q": [0.0]}, {}, "motion has 'pose.q'; known are time, station, pose.y"),
        ({"time": [0.0, 0.0]}, {}, "'time' is not a column of increasing numbers"),
        ({"time": [0.0, 1.0], "pose.y": [0.0]}, {}, r"'pose.y' has shape \(1,\), 'time' has \(2,\)"),
        ({"time": ["now"]}, {}, r"motion\['time'\] is not an array of numbers"),
        ({"time": [0.5], "pose.yaw": [0.2]}, {}, r"at time 0.5 s: pose.yaw = 0.2 is outside"),
        (
            {"time": [0.0], "friction.coefficient": [0.3]},
            {"memory": FrictionMemory(LAW, 1.0)},
            "memory and friction.coefficient exclude each other",
        ),
    ],
)
def test_bad_motions_are_refused(pair, motion, options, message):
    with pytest.raises(ContactError, match=message):
        pair.run(motion, **options)


def test_the_command_line(pair, tmp_path):
    file = tmp_path / "motion.csv"
    columns = {name: list(column) for name, column in UNDER_LOAD.items()}
    file.write_text("\n".join(",".join(map(str, row)) for row in (columns, *zip(*columns.values(), strict=True))))
    words = ("in-time", file, "--friction", 0.35, "--falling", "exponential", 0.15, 0.5)
    words += ("--friction-memory", 1e-3, 0.0, "--damping", 1e-4, 0.0)
    assert "friction" in call(*words).stdout
    rows = json.loads(call(*words, "--json").stdout)["rows"]
    pair.forget()
    wanted = pair.run(UNDER_LOAD, memory=FrictionMemory(LAW, 1e-3), damping=ContactDamping(1e-4))
    for name, column in wanted.items():
        assert [row[name] for row in rows] == pytest.approx(column.tolist(), rel=1e-6, abs=1e-9), name
    assert "--y: " in call(*words, "--y", 1e-3, code=2).stderr
    assert "--side 'both'" in call(*words, "--side", "both", code=2).stderr
    file.write_text("time,pose.y\n0\n")
    assert "has 1 values for 2 names" in call("in-time", file, code=2).stderr
    assert "is missing" in call("in-time", tmp_path / "none.csv", code=2).stderr


def test_a_pair_refuses_columns_that_it_does_not_take():
    rig = RollerRig(Pair(profile.s1002(), profile.rail_60e1()), 0.6)
    with pytest.raises(ContactError, match=r"motion has 'station'; RollerRig.solve takes no station"):
        rig.run({"station": [0.0]})
    found = rig.run({"time": [0.0, 0.1], "pose.y": [1e-3, 2e-3], "velocity.x": 10.0, "vertical": 6e4})
    assert found["Q"] == pytest.approx([6e4, 6e4], rel=1e-5)


def test_a_torque_is_a_column(pair):
    torque = np.array([1e3, 2e3])
    found = pair.run({"time": [0.0, 0.1], "velocity.x": 20.0, "vertical": 6e4, "torque": torque})
    made = [one.moment[1] for one in found.solutions]
    assert made == pytest.approx(torque, abs=1e-2 * 6e4 * 0.46)
    assert (found["spin"] == [one.spin for one in found.solutions]).all()
    assert found["spin"][1] < found["spin"][0] < -20.0 / 0.46 * (1.0 - 1e-3)
