"""The wheelset without contacts: equilibrium, kinematics, symmetry, state."""

import csv
import dataclasses

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact_models.wheelset import dynamics, master, reference
from contact_models.wheelset.components import direct
from contact_models.wheelset.model import WheelsetModel
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import CREEPAGE, CURVATURE, GAP, LOAD, SIDES
from tests.models.rolling import RAIL_RADIUS, on_cones
from tests.notebooks import drawn, words

FREE = {"lateral_stiffness": 0.0, "yaw_stiffness": 0.0}
MIRRORED = np.array([1.0, -1.0, -1.0])  # longitudinal, lateral, spin


def gravity(parameters: WheelsetParameters) -> tuple[float, float]:
    """Return lateral force [N] and yaw moment [N m] of only the normal loads."""
    rates = WheelsetModel(parameters).rates()
    return rates[2] * parameters.mass, rates[3] * parameters.yaw_inertia


def slope(name: str, size: float, parameters: WheelsetParameters) -> tuple[float, float]:
    plus, minus = (gravity(dataclasses.replace(parameters, **{name: sign * size})) for sign in (1.0, -1.0))
    return (plus[0] - minus[0]) / (2.0 * size), (plus[1] - minus[1]) / (2.0 * size)


@pytest.mark.parametrize("conicity", [0.025, 0.05])
def test_gravitational_stiffness_of_cones(conicity):
    """Lateral: W [2λ/B + λ²(R + r)/B²], B = b0 - λ r; yaw: -W λ B (readme, linear part of 2-5)."""
    p = on_cones(conicity, lateral=0.0, **FREE)
    _, y, r, _ = WheelsetModel(p).frame("right")
    B = y - conicity * r
    lateral, _ = slope("lateral", 1e-4, p)
    _, yaw = slope("yaw", 1e-4, p)
    W = p.axle_load
    assert lateral == pytest.approx(
        -W * (2.0 * conicity / B + conicity**2 * (RAIL_RADIUS + r) / B**2), rel=3.0 * conicity**2
    )
    assert yaw == pytest.approx(W * conicity * B, rel=3.0 * conicity**2)


@pytest.mark.parametrize("lateral", [3e-3, 4e-3, 5.8e-3])
def test_normal_loads_derive_from_the_height_of_the_weight(lateral):
    """The lateral force of gravity is W dz/dy (S1002 on 60E1) where the point of rigid contact does not jump.

    Where it jumps, the approach also changes, and the weight also does work on the contacts.
    """
    p = WheelsetParameters(**FREE)
    at = [WheelsetModel(dataclasses.replace(p, lateral=lateral + s * 1e-4)) for s in (-1.0, 1.0)]
    heights = [model.motion()[5] for model in at]
    force, _ = gravity(dataclasses.replace(p, lateral=lateral))
    assert force == pytest.approx(p.axle_load * (heights[1] - heights[0]) / 2e-4, rel=0.02)


def test_central_wheelset_is_symmetric_and_at_rest():
    model = WheelsetModel(WheelsetParameters(lateral=0.0))
    right, left = (model.problem(side) for side in SIDES)
    assert right[GAP] == pytest.approx(left[GAP][::-1], abs=1e-15)
    assert right[CURVATURE] == pytest.approx(left[CURVATURE][::-1], rel=1e-14)
    assert right[CREEPAGE] == pytest.approx(MIRRORED * left[CREEPAGE], abs=1e-15)
    assert right[LOAD] == pytest.approx(left[LOAD], rel=1e-14)
    assert right[LOAD] * np.cos(model.frame("right")[3]) == pytest.approx(109.1e3 / 2.0, rel=1e-12)
    assert np.abs(model.rates()[:4]).max() < 1e-9


@pytest.mark.parametrize("kick", [0.0, 2e3])
def test_mirrored_motion_is_the_mirror_image(kick):
    """It agrees to round-off over several steps with forces."""
    models = [WheelsetModel(WheelsetParameters(lateral=s * 4e-3, yaw=s * 2e-3, yaw_rate=s * 0.05)) for s in (1, -1)]
    for near, far in (("right", "left"), ("left", "right")):
        models[0].set_forces(near, kick, 0.5 * kick, 1e-3 * kick, 7e-5)
        models[1].set_forces(far, kick, -0.5 * kick, -1e-3 * kick, 7e-5)
    for _ in range(5):
        for model in models:
            model.step(1e-3)
    image = np.array([-1.0, -1.0, -1.0, -1.0, 1.0, 1.0, -1.0])
    assert models[1].motion() == pytest.approx(image * models[0].motion(), rel=1e-11, abs=1e-13)
    assert models[1].problem("left")[CREEPAGE] == pytest.approx(
        MIRRORED * models[0].problem("right")[CREEPAGE], abs=1e-11
    )


def test_creepages_are_those_of_the_contact_geometry():
    """Readme (7) compared with contact.geometry, which is verified with CONTACT, for a pose with all velocities."""
    p = WheelsetParameters(lateral=4e-3, yaw=3e-3, lateral_velocity=0.1, yaw_rate=-0.3)
    model = WheelsetModel(p)
    _, _, _, _, spin, z, roll = model.motion()
    frames = np.array([model.frame(side) for side in SIDES])
    state = np.array([p.lateral, p.yaw, p.lateral_velocity, p.yaw_rate, spin])
    z_rate, roll_rate = dynamics.follow(frames, state)
    for side in SIDES:
        pair = Pair(p.wheel, p.rail, side=side, combine_distance=1.0)
        velocity = Velocity(p.speed, p.lateral_velocity, z_rate, roll_rate, p.yaw_rate, -spin)
        (patch,) = pair.contacts(Pose(p.lateral, z, roll, p.yaw), velocity)
        ours, theirs = model.problem(side)[CREEPAGE], patch.creepage
        # theirs is the point on the wheel, ours that on the rail, an approach of 0.06 mm apart
        assert ours[0] == pytest.approx(theirs.longitudinal, abs=3e-4 * 0.46)
        assert ours[1] == pytest.approx(theirs.lateral, abs=2e-6)
        assert ours[2] == pytest.approx(theirs.spin, rel=1e-6)  # there the roll is about the yawed x axis
        assert model.frame(side)[3] == pytest.approx(patch.angle, abs=1e-12)


def test_lateral_creepage_of_yaw_and_of_lateral_velocity():
    """theory.md 9.4: (dy/dt/V - yaw)/cos δ at the true contact point. A lateral velocity also rolls the wheelset."""
    for side in SIDES:
        yawed = WheelsetModel(WheelsetParameters(lateral=0.0, yaw=2e-3))
        cosine = np.cos(yawed.frame(side)[3])
        assert yawed.problem(side)[CREEPAGE][1] == pytest.approx(-2e-3 / cosine, rel=3e-4)
        moving = WheelsetModel(WheelsetParameters(lateral=0.0, lateral_velocity=0.05))
        _, _, z, angle = frame = moving.frame(side)
        rolling = 1.0 - z * np.sin(angle) / dynamics.arm(frame)
        assert moving.problem(side)[CREEPAGE][1] == pytest.approx(0.05 / 28.0 * rolling / np.cos(angle), rel=1e-9)


def test_track_irregularity_displaces_the_track_not_the_creepage():
    """A wheelset that follows an inclined track exactly rolls as on straight track."""
    slope = 1e-3
    straight = WheelsetModel(WheelsetParameters(lateral=1e-3, **FREE))
    inclined = WheelsetModel(WheelsetParameters(lateral=1e-3, yaw=slope, lateral_velocity=28.0 * slope, **FREE))
    inclined.set_irregularity(0.0, slope)
    for model in (straight, inclined):
        model.step(1e-3)
    assert inclined.motion()[0] - 28.0 * slope * 1e-3 == pytest.approx(straight.motion()[0], abs=1e-9)
    for side in SIDES:
        assert inclined.problem(side)[CREEPAGE] == pytest.approx(straight.problem(side)[CREEPAGE], abs=1e-6)


def test_saved_state_continues_bit_for_bit():
    model = WheelsetModel(WheelsetParameters(lateral=5e-3))
    model.set_forces("right", 1e3, -2e3, 10.0, 8e-5)
    model.step(1e-3)
    saved = model.save()
    first = [_everything(model) for _ in range(4) if model.step(1e-3) is None]
    model.restore(saved)
    again = [_everything(model) for _ in range(4) if model.step(1e-3) is None]
    assert np.array_equal(first, again)


def _everything(model: WheelsetModel) -> np.ndarray:
    return np.concatenate((model.motion(), model.energy(), *(model.problem(s) for s in SIDES)))


def test_substeps_are_steps_with_held_forces():
    one, many = WheelsetModel(WheelsetParameters(substeps=4)), WheelsetModel(WheelsetParameters())
    one.step(4e-3)
    for _ in range(4):
        many.step(1e-3)
    assert one.motion() == pytest.approx(many.motion(), rel=1e-12, abs=1e-15)


def test_energy_is_conserved_without_creep():
    """Readme (10): springs and weight conserve energy to second order in the step."""
    p = WheelsetParameters(lateral=3e-3, yaw=1e-3)
    defects = []
    for h in (2e-3, 1e-3):
        model = WheelsetModel(p)
        start = model.mechanical_energy
        for _ in range(round(0.1 / h)):
            model.step(h)
        interface, drive, damper, end = model.energy()
        assert damper == pytest.approx(0.0, abs=1e-12)
        defects.append(abs(end - start + interface - drive))
    assert defects[0] < 5e-3
    assert defects[1] < 0.4 * defects[0]


def test_model_reproduces_its_reference():
    with reference.PATH.open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    expected = np.array(rows, dtype=np.float64)
    history = reference.simulate()
    for column, values in zip(header, expected.T, strict=True):
        scale = np.abs(values).max()
        assert history[column][:: reference.EVERY] == pytest.approx(values, abs=1e-6 * scale), column


def test_a_bad_step_raises_an_error_and_changes_nothing():
    model = WheelsetModel()
    before = model.save()
    with pytest.raises(ContactError, match=r"h = -0\.001 is outside the allowed range \]0"):
        model.step(-1e-3)
    with pytest.raises(ContactError, match=r"right\.Fy = nan"):
        model.set_forces("right", 0.0, float("nan"), 0.0, 6e-5)
    assert model.save() == before


def test_a_wheelset_off_the_track_raises_an_error_and_changes_nothing():
    model = WheelsetModel(WheelsetParameters(lateral_velocity=100.0))
    before = model.save()
    with pytest.raises(ContactError, match="y"):
        model.step(1.0)
    assert model.save() == before


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"mass": 0.0}, r"mass = 0 is outside the allowed range \]0"),
        ({"yaw_damping": -1.0}, "yaw_damping = -1"),
        ({"speed": float("nan")}, "speed = nan"),
        ({"substeps": 2.5}, "substeps"),
        ({"lateral": 1.0}, "profiles"),
    ],
)
def test_impossible_wheelsets_are_refused_with_name_and_range(change, message):
    with pytest.raises(ContactError, match=message):
        WheelsetModel(WheelsetParameters(**change))


def test_a_history_of_a_wheelset_is_shown_with_its_lateral_motion():
    parameters = WheelsetParameters(speed=20.0, lateral=2e-3)
    wheelset, contacts = direct(parameters)
    history = master.run(wheelset, contacts, speed=20.0, step=1e-3, duration=0.05)
    text = words(history._repr_html_())
    assert f"{1e3 * history['lateral'].max():.4g} mm" in text
    (line,) = drawn(history._repr_html_(), "polyline")
    assert line[0, 1] < line[-1, 1]  # it moves to the middle: down in the picture
