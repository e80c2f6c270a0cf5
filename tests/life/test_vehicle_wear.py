"""A wear study of a vehicle: every wheel and rail on its own, traffic, fatigue, reprofiling."""

from pathlib import Path

import numpy as np
import pytest

from contact.accumulation import Histogram
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.profile import Profile
from contact_models.life import declared_set, wear_report, wear_result
from contact_models.life.flange import Flange
from contact_models.life.part import Rail, Wheel, displacement
from contact_models.life.reprofiling import cut, forecast
from contact_models.life.scale import Workers
from contact_models.life.wear import Life
from tests.life.short_set import completed

METHODS = '[methods]\nnormal = "analyn"\ntangential = "fastrip"\nstrips = 20\nelements = 12\n'
CURVE = f"""
name = "{{side}}"
length = 16.0
speed = 15.0
vehicle = "wheelset"
{METHODS}
[[track.curves]]
start = 0.0
radius = 500.0
length = 60.0
transition = 4.0
direction = "{{side}}"
[recording]
settling = 6.0
"""
SET = """
name = "set"
mileage = 2e6
mileage_per_year = 1e8
amplitudes = [3e-3]
{more}
[[scenarios]]
file = "right.toml"
weight = 1.0
tonnes_per_year = 2e7
{other}
[steps]
distance = 1e6
"""


def plan(folder: Path, more: str = "", other: str = "", **changes: str):
    text = SET.format(more=more, other=other)
    for old, new in changes.items():
        text = text.replace(old, new)
    for side in ("right", "left"):
        (folder / f"{side}.toml").write_text(CURVE.format(side=side), encoding="utf-8")
    (folder / "set.toml").write_text(text, encoding="utf-8")
    return declared_set.read(folder / "set.toml")


@pytest.fixture(scope="module")
def life(tmp_path_factory) -> Life:
    return completed(Life(plan(tmp_path_factory.mktemp("set"))))


def test_every_wheel_and_rail_wears_on_its_own(life):
    assert list(life.wheels) == [("wheelset", "right"), ("wheelset", "left")]
    assert list(life.rails) == [("right", "right"), ("right", "left")]
    right, left = life.wheels.values()
    assert not np.allclose(displacement(right.new, right.last), displacement(left.new, left.last), atol=1e-8)
    assert all(part["deepest"][1:].min() > 0.0 for part in life.parts)


def test_the_second_step_runs_on_the_worn_profiles(life):
    present = life._present(0, 1)
    assert present.wheels[1] is life.wheels["wheelset", "left"].last
    assert present.rails[0] is life.rails["right", "right"].last
    assert present.fingerprint != life.plan.scenarios[0].fingerprint


def test_a_rail_wears_by_the_axle_passes_of_its_traffic(life):
    """Two thousand kilometres are 2 % of a year: 400 000 t, in axles of the wheelset's load."""
    load = 2.0 * (
        1813.0 * 9.81 / 2.0 + 45657.0
    )  # wheelset and preloads of models/contact_models/vehicle/included/wheelset.toml
    for rail in life.rails.values():
        assert rail["passes"].sum() == pytest.approx(4e5 * 1e3 * 9.81 / load, rel=1e-9)
    assert life.tonnes("right") == pytest.approx(4e5)


def test_the_balance_of_mass_is_that_of_both_wheels(life):
    masses = [wheel["mass"] for wheel in life.wheels.values()]
    assert life["mass"] == pytest.approx(np.mean(masses, axis=0), rel=1e-12)


def test_resumed_study_equals_the_uninterrupted_one_bit_for_bit(life):
    first = Life(life.plan)
    with Workers() as pool:
        first.step(pool)
    second = Life(life.plan)
    second.restore(first.save())
    ours, theirs = completed(second).save(), life.save()
    assert set(ours) == set(theirs)
    assert all(np.array_equal(ours[name], theirs[name]) for name in theirs)


def test_left_and_right_curves_in_equal_parts_wear_both_sides_alike(tmp_path):
    """The mirrored curve does to the left side what the curve does to the right one."""
    other = '[[scenarios]]\nfile = "left.toml"\nweight = 1.0\n'
    both = Life(plan(tmp_path, other=other))
    with Workers() as pool:
        both.step(pool)
    right, left = (displacement(wheel.new, wheel.last) for wheel in both.wheels.values())
    assert right == pytest.approx(left, rel=1e-6, abs=1e-12)
    assert right.max() > 1e-9


def test_wheels_that_wear_alike_wear_by_their_mean(tmp_path, life):
    alike = Life(plan(tmp_path, more='alike = "sides"'))
    with Workers() as pool:
        alike.step(pool)
    assert list(alike.wheels) == [("wheelset",)]
    mean = np.mean([wheel["area"][1] for wheel in life.wheels.values()])
    assert alike.wheels["wheelset",]["area"][1] == pytest.approx(mean, rel=1e-12)


def test_other_traffic_wears_the_same_rails_with_its_own_wheels(tmp_path):
    other = '[[scenarios]]\nfile = "left.toml"\nweight = 0.0\ntonnes_per_year = 2e7\nrails = "right"\n'
    shared = Life(plan(tmp_path, other=other))
    assert list(shared.rails) == [("right", "right"), ("right", "left")]
    with Workers() as pool:
        shared.step(pool)
    rail = shared.rails["right", "right"]
    assert (rail.shares.max(axis=1) > 0.0).all()
    assert not shared.wheels["wheelset", "right"].shares[1].any()
    assert rail["passes"].sum() == pytest.approx(2.0 * 2e5 * 1e3 * 9.81 / (1813.0 * 9.81 + 2.0 * 45657.0), rel=1e-9)
    assert shared._present(1, 1).wheels[0] is shared.plan.scenarios[1].wheel


def test_pressures_are_limited_in_wear_unless_it_is_said_otherwise(tmp_path):
    assert plan(tmp_path).scenarios[0].declared.methods.pressure_limit == pytest.approx(1.5e9)
    assert plan(tmp_path, more="pressure_limit = inf").scenarios[0].declared.methods.pressure_limit is None


def histogram(profile: Profile, index: float, depth: float = 0.0) -> Histogram:
    """Return a histogram of a tenth of an axle pass per metre, with an index and a depth of a pass in the middle."""
    made = Histogram(profile)
    zero = np.zeros(made.centres.size)
    inside = np.where(np.abs(made.centres) < 5e-3, 0.1, 0.0)
    values = dict.fromkeys([*declared_names()], zero) | {"rcf_forward": index * inside, "wear": depth * inside}
    made.restore(values, 0.1, set(), set())
    return made


def declared_names() -> list[str]:
    from contact.accumulation import MAXIMA, SUMS

    return [*SUMS, *MAXIMA]


def test_fatigue_of_a_rail_adds_up_and_never_falls_below_zero():
    """1e-6 per pass over 1e5 passes is 0.1; the negative branch takes it away again, but no more than there is."""
    rail = Rail("rail", profile.rail_60e1(), 1)
    for index, expected in ((1e-6, 0.1), (-0.4e-6, 0.06), (-1e-5, 0.0), (2e-6, 0.2)):
        rail.wear({0: histogram(rail.present, index)}, 1e6, 2e-3)
        assert rail["fatigue"][-1] == pytest.approx(expected, abs=1e-12)
    assert rail["fatigue_rate"][-1] == pytest.approx(2.0)
    assert rail.fatigue[np.abs(rail.new.y) > 10e-3].max() == 0.0


def thinned(wheel: Profile, depth: float) -> Profile:
    """Return the wheel with a flange face worn laterally, smoothly to zero at its tip and on the tread."""
    shift = depth * np.exp(-(((wheel.y + 38e-3) / 4e-3) ** 2))
    return Profile("wheel", wheel.y - shift, wheel.z, wheel.angle)


def test_a_cut_restores_hollow_treads_by_their_depth_and_flanges_by_their_slope():
    new = profile.s1002()
    hollow = Profile("wheel", new.y, new.z - 2e-3 * np.exp(-((new.y / 0.02) ** 2)), new.angle)
    assert cut(hollow, new) == pytest.approx(2e-3, rel=1e-3)
    assert cut(new, new) == 0.0
    depth = cut(thinned(new, 1e-3), new)
    assert 1.5e-3 < depth < np.tan(np.radians(70.0)) * 1e-3  # the face has 70° over a few millimetres only
    inside = np.interp(new.y, *np.array(sorted(zip(thinned(new, 1e-3).y, thinned(new, 1e-3).z, strict=True))).T)
    assert (new.z - depth <= inside + 2e-5)[new.y > -45e-3].all()


def test_the_forecast_follows_the_trend_to_the_nearest_limit():
    wheel = Wheel("wheel", profile.s1002(), 1)
    index = list(Wheel.columns).index("flange_height")
    for k in range(1, 5):
        row = wheel.rows[0].copy()
        row[index] += 1e-3 * k
        wheel.rows.append(row)
    mileage = 1e7 * np.arange(5)
    assert forecast(wheel, mileage, Flange.limits()) == ("height", pytest.approx(8e7, rel=1e-6))
    assert forecast(wheel, mileage[:2], Flange.limits()) is None


def test_a_worn_out_wheel_is_restored_and_the_study_goes_on(tmp_path):
    new = Flange.measured(profile.s1002())
    limits = f"[limits]\nheight = {new.height + 1e-9}\nthickness = 0.0\nqR = 0.0\n"
    study = plan(tmp_path, more="reprofile = true")
    path = tmp_path / "set.toml"
    path.write_text(path.read_text(encoding="utf-8") + limits, encoding="utf-8")
    life = completed(Life(declared_set.read(path)))
    assert life.ended == "mileage"
    assert life["cut"].any()
    at = int(np.flatnonzero(life["cut"])[0])
    assert life["cut"][at] > 0.0
    worn = [wheel for wheel in life.wheels.values() if wheel["flange_height"][at] >= new.height + 1e-9]
    assert worn
    if at + 1 < len(life.rows):  # the next step began with the unworn wheel
        deepest = displacement(worn[0].new, worn[0].profiles[at + 1]).max()
        assert deepest == pytest.approx(worn[0]["deepest"][at + 1], rel=1e-9)
    assert life.turned_off == pytest.approx(life["cut"].sum())
    nominal = life.plan.first.radius
    assert life._present(0, 9).radius == pytest.approx(nominal - life.turned_off, abs=1e-15)
    again = Life(declared_set.read(path))
    again.restore(life.save())
    assert all(
        a.present is a.new or np.array_equal(a.present.z, b.present.z)
        for a, b in zip(again.parts, life.parts, strict=True)
    )
    path.write_text(path.read_text(encoding="utf-8").replace("reprofile = true", ""), encoding="utf-8")
    ended = completed(Life(declared_set.read(path))).ended
    assert "flange height" in ended
    assert "wheelset" in ended
    assert study.declared.reprofile


@pytest.mark.usefixtures("undrawn")
def test_page_and_result_have_all_wheels_and_rails(life):
    page = wear_report.page_of(life)
    assert "wheelset right" in page
    assert "right left" in page
    assert "nan" not in page.split("<picture>")[0]
    stored = pytest.importorskip("xarray") and wear_result.dataset(life)
    assert stored["wheel_z"].shape[:2] == (len(life.rows), 2)
    assert stored["right_left_fatigue"].values[-1] == life.rails["right", "left"]["fatigue"][-1]
    assert stored["nonlinearity"].shape == (len(life.rows), 1)


@pytest.mark.usefixtures("undrawn")
def test_an_axle_that_does_not_oscillate_about_the_centre_has_no_conicity(tmp_path):
    """A left wheel that is 9 mm smaller pushes the wheelset far to one side. The report says none, not nan."""
    life = Life(plan(tmp_path))
    left = life.wheels["wheelset", "left"]
    left.profiles.append(Profile("wheel", left.new.y, left.new.z - 9e-3, left.new.angle))
    life.conicities[0] = life._conicity()
    assert np.isnan(life.conicities[0]).all()
    text = wear_report.page_of(life).split("<picture>")[0]
    assert "none" in text
    assert "nan" not in text


def test_scenarios_on_the_same_rails_must_have_the_same_rail(tmp_path):
    other = '[[scenarios]]\nfile = "left.toml"\nweight = 1.0\nrails = "right"\n'
    plan(tmp_path, other=other)
    changed = CURVE.format(side="left") + "[profiles]\ninclination = 0.05\n"
    (tmp_path / "left.toml").write_text(changed, encoding="utf-8")
    with pytest.raises(ContactError, match=r"left\.toml has another (wheel|rail), radius, bins or damage than right"):
        declared_set.read(tmp_path / "set.toml")
