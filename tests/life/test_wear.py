"""Wear over a mileage: step rule, limits, balances, reproducibility."""

import re
from pathlib import Path

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from contact.errors import ContactError
from contact.geometry import profile
from contact_models.life import commands, declared_set, wear_report
from contact_models.life.declared_set import Steps
from contact_models.life.flange import Flange
from contact_models.life.part import DENSITY, Wheel, displacement
from contact_models.life.wear import Life
from tests.life.short_set import CURVE, SET, completed, written

EXAMPLES = Path(__file__).parents[2] / "examples" / "scenarios"


@pytest.fixture
def plan(tmp_path) -> Path:
    return written(tmp_path)


@pytest.fixture(scope="module")
def life(tmp_path_factory) -> Life:
    return completed(Life(declared_set.read(written(tmp_path_factory.mktemp("set")))), go_on=True)


def wheel_of(life: Life) -> Wheel:
    """Return the wheel of a study in which all wear alike."""
    (wheel,) = life.wheels.values()
    return wheel


@pytest.mark.parametrize(
    ("rate", "left", "length"),
    [
        (1e-12, 1e9, 1e7),  # the distance
        (1e-11, 1e9, 5e6),  # the depth: 50 µm
        (1e-11, 2e6, 2e6),  # the end
        (0.0, 1e9, 1e7),
    ],
)
def test_step_ends_at_distance_depth_or_mileage(rate, left, length):
    assert Steps(distance=1e7, depth=5e-5).length(rate, left) == pytest.approx(length, rel=1e-15)


@pytest.mark.parametrize(
    ("height", "thickness", "qR"), [(28e-3, 32.5e-3, 10.8e-3), (30e-3, 32.5e-3, 10.9e-3)], ids=["h 28", "h 30"]
)
def test_unworn_flange_has_the_sizes_of_the_standard(height, thickness, qR):
    """S1002 (EN 13715): h and e are its design dimensions. The published qR of the new profile is 10.8 mm."""
    flange = Flange.measured(profile.s1002(height, thickness))
    assert flange.height == pytest.approx(height, abs=1e-6)
    assert flange.thickness == pytest.approx(thickness, abs=2e-6)
    assert flange.qR == pytest.approx(qR, abs=5e-5)


@pytest.mark.parametrize(
    ("size", "said"),
    [
        (Flange(height=36.5e-3, thickness=30e-3, qR=9e-3), r"flange height 36.50 mm \(limit 36.00 mm\)"),
        (Flange(height=30e-3, thickness=21e-3, qR=6e-3), "flange thickness 21.00 mm .*, qR 6.00 mm"),
    ],
)
def test_exceeded_limits_are_named(size, said):
    assert re.match(said, size.exceeded(Flange.limits()))
    assert Flange(height=30e-3, thickness=30e-3, qR=9e-3).exceeded(Flange.limits()) == ""


def test_wear_goes_on_to_the_mileage_in_steps_that_obey_the_rule(life):
    assert life.ended == "mileage"
    steps, length = life.plan.declared.steps, np.diff(life["mileage"])
    assert life.mileage == pytest.approx(1e6, rel=1e-15)
    assert (length <= steps.distance * (1.0 + 1e-12)).all()
    assert (life["deepest"] <= steps.depth * (1.0 + 1e-9)).all()
    held = np.isclose(length, steps.distance) | np.isclose(life["deepest"][1:], steps.depth)
    assert held[:-1].all()  # the last one ends at the mileage
    assert len(length) >= 3


def test_worn_cross_section_survives_smoothing(life):
    """A Gaussian keeps the area: ∫ depth over the profile before smoothing is the area between the profiles after it."""
    assert (wheel_of(life)["area"][1:] > 0.0).all()
    assert wheel_of(life)["area_smoothed"] == pytest.approx(wheel_of(life)["area"], rel=2e-3)


def test_mass_is_that_of_the_cross_section_around_the_wheel(life):
    """They agree within the spread of the rolling radii."""
    assert life["mass"] == pytest.approx(DENSITY * 2.0 * np.pi * 0.46 * wheel_of(life)["area"], rel=0.01)


def test_depth_is_the_sum_of_the_scenarios(life):
    wheel = wheel_of(life)
    moved = displacement(wheel.new, wheel.last)
    assert wheel.shares.sum(axis=0) == pytest.approx(moved, abs=0.01 * moved.max())
    assert (wheel.shares.max(axis=1) > 0.0).all()


def test_worn_profile_stays_one_curve(life):
    """After many updates, tangents still agree with the points."""
    last = wheel_of(life).last
    y, z, angle = last.y, last.z, last.angle
    fresh = profile.Profile("wheel", y, z)
    inner = slice(5, -5)
    before = profile.Profile("wheel", life.plan.wheel.y, life.plan.wheel.z)
    off = np.abs((angle - fresh.angle) - (life.plan.wheel.angle - before.angle))
    assert off[inner].max() < 1e-4


def test_limit_ends_the_wear(plan):
    plan.write_text(SET + "[limits]\nheight = 28.0e-3\n", encoding="utf-8")
    assert Life(declared_set.read(plan)).ended.startswith("all wheels: flange height 28.00 mm")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (SET.replace("mileage = 1e6", "mileage = 0"), r"set.toml: mileage = 0 is outside the allowed range \]0, "),
        (SET.replace("weight = 1.0", "weight = -1.0"), r"set.toml.scenarios\[1\]: weight = -1 is outside"),
        (
            SET.replace("weight = 1.0", "weight = 0.0"),
            "weight = 0 and tonnes_per_year = 0: the scenario would wear nothing",
        ),
        (SET.replace("weight = 1.0", "weight = 0.0\ntonnes_per_year = 1e6"), "mileage_per_year is missing"),
        (SET.replace('"all"', '"both"'), "alike = 'both' is none of none, sides, all"),
        (SET.replace("distance", "distanse"), r"set.toml.steps.distanse is unknown, did you mean 'distance'"),
        (SET.replace("curve.toml", "none.toml"), r"none.toml' is missing"),
    ],
)
def test_errors_in_a_set_are_named(plan, text, message):
    plan.write_text(text, encoding="utf-8")
    with pytest.raises(ContactError, match=message):
        declared_set.read(plan)


def test_scenarios_must_share_the_wheel(plan):
    (plan.parent / "curve.toml").write_text(CURVE.replace("1/40", "S1002"), encoding="utf-8")
    with pytest.raises(
        ContactError, match=r"curve\.toml has another wheel, radius, bins or damage than straight\.toml"
    ):
        declared_set.read(plan)


def test_the_example_set_is_valid():
    found = declared_set.read(EXAMPLES / "vehicle_wear" / "set.toml")
    assert sum(found.weights) == pytest.approx(1.0)
    assert found.wheel.name == "S1002"


@pytest.mark.usefixtures("undrawn")
def test_command_writes_result_and_page_and_goes_on_from_its_checkpoint(plan, tmp_path, monkeypatch, life):
    xarray = pytest.importorskip("xarray")
    plan.write_text(SET.replace("1e6", "8e5"), encoding="utf-8")
    app = typer.Typer(pretty_exceptions_enable=False)
    app.command()(commands.wear)
    arguments = [str(plan), "--out", str(tmp_path / "out"), "--go-on"]
    step = Life.step

    def interrupted(self, *given, **options):
        if len(self.rows) == 2:
            raise KeyboardInterrupt
        step(self, *given, **options)

    with monkeypatch.context() as patch:
        patch.setattr(Life, "step", interrupted)
        broken = CliRunner().invoke(app, arguments)
    assert broken.exit_code == 130
    assert "step 1," in broken.output
    assert "<h1>short</h1>" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")  # with every checkpoint
    resumed = CliRunner().invoke(app, arguments)
    assert resumed.exit_code == 0, resumed.output
    assert f"continues at {1e-3 * life['mileage'][1]:.0f} km" in resumed.output
    assert "800 km in" in resumed.output
    logged = (tmp_path / "out" / "progress.log").read_text(encoding="utf-8")
    assert all(f"step {k}, " in logged for k in (1, 2))
    assert "warning: The run ends before the end of 1 of its curves" in resumed.output
    stored = xarray.load_dataset(tmp_path / "out" / "result.nc", engine="scipy")
    assert stored["mileage"].values[-1] == pytest.approx(8e5)
    assert stored["conicity"].shape == (stored["mileage"].size, 1, 1)
    last = int(np.searchsorted(life["mileage"], 8e5 * (1.0 - 1e-9)))  # earlier wheels are those of the longer run
    rows = np.array([profile.z for profile in wheel_of(life).profiles[:last]])
    assert (stored["wheel_z"].values[:last, 0] == rows).all()
    assert "<h1>short</h1>" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


@pytest.mark.usefixtures("undrawn")
def test_page_of_an_unworn_wheel_has_no_trend(life):
    page = wear_report.page_of(Life(life.plan))
    assert page.count("<picture>") == 1
