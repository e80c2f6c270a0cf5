"""The FMUs of a pair roll back, stand and are braked to rest: V < 0 is -V turned by 180° about z."""

import math

import numpy as np
import pytest
from differences import derivative, quotient
from fmpy.fmi1 import FMICallException
from fmu_instance import WARNING, Instance
from pair_case import MOTION, mirrored

R = 0.46
#: Inputs that change their sign in the mirror across the track, x to -x.
_ALONG = ["pose.yaw", "velocity.x", "velocity.yaw", "velocity.spin"]
_ALONG += [f"offset.{name}{rate}" for name in ("x", "pitch", "yaw") for rate in ("", "_rate")]
#: Outputs and their factor after a turn by 180° about z.
TURNED = {
    **{"force.x": -1, "force.y": -1, "force.z": 1, "moment.x": -1, "moment.y": -1, "moment.z": 1},
    **{"patch[1].fx": -1, "patch[1].x": -1, "patch[1].y": -1, "patch[1].mz": 1, "patch[1].longitudinal": -1},
    **{"patch[1].spin": 1, "wheel.Q": 1, "wheel.Y": 1, "wheelset.z": 1, "power.friction": 1, "pressure.max": 1},
    **{f"total.{name}": 1 for name in ("energy", "worn_volume", "distance", "T_gamma")},
}


def turned(values: dict[str, float]) -> dict[str, float]:
    """Return the values of the other wheel after a turn by 180° about z: both mirrors, along and across the track."""
    return {name: -value if name in _ALONG else value for name, value in mirrored(values).items()}


def test_backwards_is_the_other_wheel_forwards_turned_about_z(open_pair):
    back, ahead = open_pair(), open_pair()
    back.update(turned(MOTION))
    ahead.update({**MOTION, "side": 1})
    for fmu in (back, ahead):
        fmu.initialize()
        for _ in range(3):
            fmu.step()
    assert back["velocity.x"] < 0.0
    for name, factor in TURNED.items():
        size = max(abs(ahead[name]), 1e-9 if name.startswith("total") else 1e-2)
        assert back[name] == pytest.approx(factor * ahead[name], abs=1e-9 * size), name
    assert back["total.distance"] == pytest.approx(3e-3 * MOTION["velocity.x"])
    assert min(back[f"total.{name}"] for name in ("energy", "worn_volume", "T_gamma")) > 0.0


def test_noise_about_standing_is_no_error_and_no_doubt(open_pair):
    fmu = open_pair()
    fmu.update({"velocity.x": 0.0, "velocity.spin": 0.0})
    fmu.initialize()
    forces = []
    for V in (1e-12, -1e-12, 0.0, -1e-12):
        fmu.update({"velocity.x": V})
        fmu.step()
        forces.append([fmu[f"force.{axis}"] for axis in "xyz"])
    assert np.ptp(forces, axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=0.1)
    assert not [text for status, text in fmu.log if status == WARNING]


def test_on_surfaces_rolling_back_is_refused_by_name(native_surfaces, unzipped):
    fmu = Instance(unzipped(native_surfaces[0]))
    fmu.initialize()
    fmu.update({"velocity.x": -1.0})
    with pytest.raises(FMICallException):
        fmu.step()
    assert "velocity.x = -1 is outside the allowed range [0, inf[" in fmu.log[-1][1]
    fmu.free()


def test_a_saved_state_rolls_back_on_bit_by_bit(open_pair):
    fmu = open_pair()
    fmu.update({"velocity.x": -20.0, "velocity.spin": 20.0 / R, "pose.yaw": 2e-3})
    fmu.initialize().step()
    state, found = fmu.fmu.getFMUstate(), []
    for _ in range(2):
        fmu.fmu.setFMUstate(state)
        fmu.time = 1e-3
        for y in (1e-3, 2e-3):
            fmu.update({"pose.y": y})
            fmu.step()
        found.append(fmu.all("output"))
    assert found[0] == found[1]


def test_derivatives_backwards_are_those_of_differences(native_pair):
    fmu = native_pair("ModelExchange")
    fmu.update({"velocity.x": -20.0, "velocity.spin": 20.03 / R, "pose.y": 2e-3, "pose.yaw": 1e-3, "load.kind": 2})
    fmu.update({"pose.z": 1.4e-4})
    fmu.initialize()
    unknowns = ("force.x", "force.y", "moment.z")
    assert fmu["wheel.Q"] > 1e4
    for known in ("velocity.x", "velocity.spin", "velocity.y", "pose.yaw"):
        found, step = np.array(derivative(fmu, unknowns, {known: 1.0})), 1e-5 if known == "pose.yaw" else 1e-3
        wanted = np.array(quotient(fmu, unknowns, {known: 1.0}, step))
        assert found == pytest.approx(wanted, rel=0.05, abs=0.02 * np.abs(wanted).max()), known


MASS, INERTIA, STEP = 10e3, 120.0, 2e-4  # of an axle with its share of the vehicle, and the step of a fixed-step model
WEIGHT, REFERENCE = 9.81 * MASS, 5.0


def rolled(native_pair, speed, brake, slope, seconds):
    """Return speed, spin and force over time of an axle on two FMUs, by explicit steps. `brake` is a torque that holds."""
    sides = [native_pair() for _ in range(2)]
    V, spin, rows = speed, -speed / R, []
    for side, fmu in enumerate(sides, 1):
        fmu.update({"side": side, "reference_speed": REFERENCE, "load.normal_force": 0.5 * WEIGHT})
        fmu.update({"velocity.x": V, "velocity.spin": spin})
        fmu.initialize()
    for _ in range(round(seconds / STEP)):
        for fmu in sides:
            fmu.update({"velocity.x": V, "velocity.spin": spin})
            fmu.step(h=STEP)
        Fx, My = (sum(fmu[name] for fmu in sides) for name in ("force.x", "moment.y"))
        V += STEP * (Fx - slope * WEIGHT) / MASS
        free, most = spin + STEP * My / INERTIA, STEP * brake / INERTIA
        spin = free - math.copysign(min(abs(free), most), free)
        rows.append((V, spin, Fx))
    return np.array(rows).T


@pytest.mark.slow
def test_an_axle_stops_at_steps_of_a_fifth_of_a_millisecond_without_chatter(native_pair):
    V, spin, Fx = rolled(native_pair, 0.3, 6e3, 0.0, 0.6)
    assert abs(V[-1]) < 1e-3
    assert abs(spin[-1]) < 1e-9
    resting = Fx[-500:]
    assert np.abs(np.diff(resting)).max() < 1e-3 * 0.3 * WEIGHT
    assert np.abs(resting).max() < 0.02 * 0.3 * WEIGHT


@pytest.mark.slow
def test_a_braked_axle_stands_on_one_per_cent_and_an_unbraked_one_rolls_back(native_pair):
    V, _, Fx = rolled(native_pair, 0.0, 6e3, 0.01, 0.3)
    assert Fx[-1] == pytest.approx(0.01 * WEIGHT, rel=0.05)
    assert abs(V[-1]) < 5e-3  # it creeps by the damper that its contact is
    V, spin, _ = rolled(native_pair, 0.03, 0.0, 0.01, 0.6)
    assert V[0] > 0.0 > V[-1]
    assert V[-1] == pytest.approx(0.03 - 0.6 * 0.01 * WEIGHT / (MASS + INERTIA / R**2), abs=5e-3)
    assert spin[-1] == pytest.approx(-V[-1] / R, rel=0.05)
