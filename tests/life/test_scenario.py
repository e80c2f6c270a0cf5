"""Scenarios: valid and invalid files, and the resulting track."""

from pathlib import Path

import numpy as np
import pytest

from contact.damage import DamageParameters, Usfd
from contact.errors import ContactError
from contact.friction import Friction
from contact.geometry import profile
from contact_models.runs import scenario
from contact_models.runs.run import VehicleRun
from contact_models.vehicle.track import Curve

EXAMPLES = Path(__file__).parents[2] / "examples" / "scenarios"
LEAST = 'name = "x"\nlength = 100.0\nspeed = 20.0\n'


def written(folder: Path, text: str) -> Path:
    path = folder / "case.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("length = 100.0\nspeed = 20.0", r"case.toml.name is missing"),
        (LEAST + "sped = 3", r"case.toml.sped is unknown, did you mean 'speed'\?; allowed: name, length"),
        (LEAST.replace("20.0", '"fast"'), r"case.toml.speed = 'fast' is not a number or a table"),
        (LEAST.replace("20.0", "0.05"), r"case.toml: speed = 0.05 is outside the allowed range \[0.1, 150\]"),
        (
            LEAST.replace("20.0", "-20.0"),
            r"case.toml: speed = -20 is outside the allowed range \[0.1, 150\].*Simulation",
        ),
        (LEAST.replace("100.0", "10.0"), r"length = 10: nothing .* The first 30 m .* at least 30.25 m"),
        (LEAST + "seed = 1.5", r"case.toml.seed = 1.5 is not an integer"),
        (LEAST + "friction = -0.1", r"case.toml: friction = -0.1 is outside"),
        (
            LEAST + "[friction]\nstatic = 0.3\nlaw = 'falling'",
            r"case.toml.friction: friction.law = 'falling' is unknown",
        ),
        (
            LEAST + "[[track.curves]]\nstart = 0.0\nradius = 10.0\nlength = 10.0",
            r"case.toml.track.curves\[0\]: radius = 10 is outside the allowed range \[15, 100000\]",
        ),
        (LEAST + "[track]\ncurves = 3", r"case.toml.track.curves = 3 is not an array"),
        (
            LEAST + "[track.alignment]\nspectrum = 'ERRI B176 medium'",
            r"case.toml.track.alignment: spectrum = 'ERRI B176 medium' is unknown",
        ),
        (LEAST + "vehicle = 'manchster'", r"manchster"),
        (
            LEAST + "[wheelset]\nmass = 0.0",
            r"case.toml.wheelset is unknown, did you mean .wheels.\?; allowed: name, length",
        ),
        (LEAST + "[profiles]\nwheel = 'S1003'", r"case.toml.profiles: wheel = 'S1003' is no profile"),
        (LEAST + "[methods]\ntangential = 'polach'", r"case.toml.methods: tangential = 'polach' gives forces only"),
        (LEAST + "[methods]\npressure_limit = -1.0", r"case.toml.methods: .*pressure_limit = -1 is outside"),
        (
            LEAST + "[damage]\nwear_law = 'reye'",
            r"case.toml.damage: wear_law = 'reye' is unknown; allowed: archard, usfd",
        ),
        (LEAST + "[damage]\nwear_law = 3", r"case.toml.damage.wear_law = 3 is not a text"),
        (LEAST + "[damage.usfd]\nsevere_branch = 'steep'", r"severe_branch = 'steep' is unknown; allowed: continuous"),
        (LEAST + "[damage.archard]\nmild = -1.0", r"case.toml.damage.archard: archard.mild = -1 is outside"),
        (
            LEAST + "[recording]\nstep = 0.1",
            r"case.toml.recording: step = 0.1 is outside the allowed range \[1e-05, 0.005\]",
        ),
        (LEAST + "seed = one\n", r"case.toml is not TOML: .*line 4"),
        (LEAST.replace("20.0", "{ at = [0.0, 0.0], values = [20.0, 10.0] }"), r"at\[1\] = 0 is outside .*\]0, inf\["),
    ],
)
def test_errors_name_key_value_and_range(tmp_path, text, message):
    with pytest.raises(ContactError, match=message):
        scenario.read(written(tmp_path, text))


def test_missing_file_is_named(tmp_path):
    with pytest.raises(ContactError, match=r"none\.toml"):
        scenario.read(tmp_path / "none.toml")


@pytest.mark.parametrize(
    "path",
    [path for path in sorted(EXAMPLES.rglob("*.toml")) if not path.stem.startswith("set")],
    ids=lambda path: path.stem,
)
def test_examples_are_scenarios(path):
    found = scenario.read(path)
    assert found.slowest <= found.speed(0.0) <= found.fastest
    assert len(found.wheels) == 2 * len(found.vehicle.wheelsets)


def test_least_scenario_takes_the_defaults_of_the_models(tmp_path):
    found = scenario.read(written(tmp_path, LEAST))
    assert found.friction == Friction(0.3)
    assert (found.wheel.name, found.rail.name) == ("S1002", "60E1")
    assert found.vehicle.name == "single wheelset"
    assert found.wheel_names == (("wheelset", "right"), ("wheelset", "left"))


def test_wear_law_of_a_scenario_is_that_of_its_histograms(tmp_path):
    fast = "[methods]\nnormal = 'analyn'\ntangential = 'fastrip'\nstrips = 20\nelements = 12\n"
    text = LEAST + fast + "[damage]\nwear_law = 'usfd'\n[damage.usfd]\nsevere_branch = 'proportional'"
    found = scenario.read(written(tmp_path, text))
    parameters = {histogram.parameters for histogram in VehicleRun(found).histograms.values()}
    assert parameters == {DamageParameters(usfd=Usfd(severe_branch="proportional"), wear_law="usfd")}


@pytest.mark.parametrize(
    ("table", "law"),
    [("", "usfd"), ("[damage]\nwith_spin = true", "usfd"), ("[damage.archard]\nmild = 1e-4", "archard")],
)
def test_profiles_wear_by_sheffields_law_unless_archards_constants_are_given(tmp_path, table, law):
    path = tmp_path / "case.toml"
    path.write_text(LEAST + table, encoding="utf-8")
    assert scenario.read(path).declared.damage.wear_law == law


def test_fingerprint_follows_input_profiles_and_draw(tmp_path):
    one = scenario.read(written(tmp_path, LEAST))
    assert scenario.read(written(tmp_path, "# a comment\n" + LEAST)).fingerprint == one.fingerprint
    others = [scenario.read(written(tmp_path, LEAST + more)) for more in ("seed = 1", "[profiles]\nwheel = '1/40'")]
    assert (
        len({one.fingerprint, *(other.fingerprint for other in others), one.worn(one.wheels, one.rails, 1).fingerprint})
        == 4
    )


def test_curve_has_transitions_and_a_circle():
    curve = Curve(start=10.0, radius=500.0, length=40.0, transition=20.0, cant=0.15, direction="left")
    for s, share in ((0.0, 0.0), (10.0, 0.0), (20.0, 0.5), (30.0, 1.0), (70.0, 1.0), (85.0, 0.25), (90.0, 0.0)):
        assert curve.share(s) == pytest.approx(-share)


def test_profiles_of_a_scenario_take_every_option_that_the_reader_asks_for(tmp_path):
    wheel = profile.s1002()
    rows = "\n".join(f"{-1e3 * (y + 0.07):.5f} {1e3 * z:.5f}" for y, z in zip(wheel.y, wheel.z, strict=True))
    (tmp_path / "wheel.txt").write_text(rows)
    text = 'name = "a"\nlength = 100.0\nspeed = 20.0\n[profiles]\nwheel = "wheel.txt"\ninclination = "1/20"\n{}'
    path = tmp_path / "case.toml"
    path.write_text(text.format(""))
    with pytest.raises(ContactError, match=r"unit = None, side = None: .wheel\.txt. does not say its unit, side; give"):
        scenario.read(path)
    path.write_text(text.format('unit = "mm"\nside = "left"\nzero = "flange_back"\n'))
    found = scenario.read(path)
    np.testing.assert_allclose(found.wheel.z, wheel.z, atol=1e-8)
    np.testing.assert_array_equal(found.rail.z, profile.rail_60e1(0.05).z)
    path.write_text(text.replace("wheel.txt", "S1002").format('unit = "mm"\n'))
    with pytest.raises(
        ContactError, match=r"profiles: unit = 'mm' says how a file is read, and the profiles are those of"
    ):
        scenario.read(path)
    path.write_text(text.replace("wheel.txt", "wheel18.txt").format(""))
    with pytest.raises(ContactError, match=r"wheel18\.txt' is missing"):
        scenario.read(path)


def test_all_mistakes_of_a_file_are_named_at_once(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(
        'name = "s"\nlength = 10.0\nspeed = "fast"\nsped = 3\n[methods]\nstrips = 2\npace = 99\n[recording]\nspacing = 0.0\n',
        encoding="utf-8",
    )
    with pytest.raises(ContactError) as found:
        scenario.read(path)
    said = str(found.value).splitlines()
    for text in ("sped is unknown", "speed = 'fast' is not", "n_strips = 2", "pace = 99", "spacing = 0 is outside"):
        assert sum(text in line for line in said) == 1, (text, said)
    assert len(said) == 5


def test_curves_of_trams_and_slow_runs_are_allowed(tmp_path):
    path = tmp_path / "case.toml"
    curve = "[[track.curves]]\nstart = 5.0\nradius = 25.0\nlength = 9.0\n"
    path.write_text(f'name = "s"\nlength = 60.0\nspeed = 0.5\n{curve}', encoding="utf-8")
    found = scenario.read(path)
    assert (found.slowest, found.declared.track.curves[0].radius) == (0.5, 25.0)
