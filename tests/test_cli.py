"""Command line: the same numbers as the Python API, clear error messages, pictures, plug-ins."""

import csv
import json
import subprocess
import sys
from importlib.metadata import EntryPoint

import numpy as np
import pytest

import contact
import contact.stress
from contact import damage
from contact.friction import Friction
from contact.geometry import conicity, contact_points, profile, wheelset

typer = pytest.importorskip("typer")

from typer.testing import CliRunner  # noqa: E402

from contact.cli import app as cli  # noqa: E402
from contact.cli.plugins import GROUP, add_plugins  # noqa: E402
from tests.command_line import call  # noqa: E402


def test_solve_gives_the_numbers_of_the_python_api():
    words = ("--curvatures", 1.1, 0.8, "--creepage", -1e-3, 2e-3, 0.1, "--load", 60e3, "--friction", 0.4)
    answer = json.loads(call("solve", *words, "--json").stdout)["patches"]
    s = contact.solve(
        contact.Separation.hertzian(1.1, 0.8), contact.Creepage(-1e-3, 2e-3, 0.1), load=60e3, friction=0.4
    )
    d = damage.evaluate(s)
    assert len(answer) == 1
    for name in ("N", "Fx", "Fy", "Mz", "approach", "max_pressure", "area", "slip_ratio"):
        assert answer[0][name] == getattr(s, name), name
    assert answer[0]["status"] == "OK"
    assert answer[0]["damage"]["T_gamma"] == d.T_gamma
    assert answer[0]["damage"]["archard_volume"] == d.archard.volume


def test_the_options_of_friction_are_those_of_the_python_api():
    words = ("--curvatures", 1.1, 0.8, "--creepage", 0.05, 0.0, 0.1, "--friction", 0.4, "--speed", 30.0)
    falling = ("--falling", "rational", 0.2, 2.0, "--slip-velocity", "local")
    hot = ("--hot", 0.5, 320.0, 150.0, "--temperature", 300.0)
    answer = json.loads(call("solve", *words, *falling, *hot, "--json").stdout)["patches"][0]
    surface = Friction(
        0.4, 0.2, 2.0, "rational", velocity="local",
        hot_factor=0.5, reference_temperature=320.0, temperature_range=150.0, background_temperature=300.0,
    )  # fmt: skip
    separation, creepage = contact.Separation.hertzian(1.1, 0.8), contact.Creepage(0.05, 0.0, 0.1)
    s = contact.solve(separation, creepage, load=80e3, friction=surface, speed=30.0)
    assert (answer["Fx"], answer["Mz"]) == (s.Fx, s.Mz)


def test_a_law_without_fields_shows_its_forces(tmp_path):
    """There is no wear depth and no index over the patch, and a picture of it is refused by name."""
    words = ("--curvatures", 1.1, 0.8, "--creepage", 1e-3, 0.0, 0.1, "--tangential", "polach")
    answer = json.loads(call("solve", *words, "--json").stdout)["patches"][0]
    assert answer["Fx"] < 0.0 < answer["damage"]["T_gamma"]
    assert "archard_volume" not in answer["damage"]
    table = call("solve", *words).stdout
    assert "T-gamma" in table
    assert "Archard" not in table
    refused = call("patch", "--tangential", "polach", "--out", tmp_path / "patch.png", code=2)
    assert "'polach' gives forces only" in " ".join(refused.stderr.split())


def test_solve_on_rails_gives_the_numbers_of_the_geometry_and_the_solver():
    words = ("--y", 2e-3, "--yaw", 1e-3, "--load", 70e3, "--side", "left", "--speed", 30.0)
    answer = json.loads(call("solve", *words, "--json").stdout)["patches"]
    found = wheelset.contacts(
        profile.s1002(),
        profile.rail_60e1(),
        wheelset.Pose(y=2e-3, yaw=1e-3),
        wheelset.Velocity(forward=30.0),
        side="left",
        load=70e3,
    )
    assert [p["angle"] for p in answer] == [p.angle for p in found]
    for p, a in zip(found, answer, strict=True):
        s = contact.solve(p.separation, p.creepage, load=p.load, speed=30.0)
        assert (a["N"], a["Fx"], a["Fy"], a["Mz"]) == (s.N, s.Fx, s.Fy, s.Mz)
        assert a["creepage"]["lateral"] == p.creepage.lateral
        assert a["side"] == "left"


def test_table_shows_the_solution_in_the_engineers_units():
    output = call("solve", "--curvatures", 1.1, 0.8, "--creepage", 1e-3, 0, 0).output
    s = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3, 0.0, 0.0), load=80e3)
    line = next(row for row in output.splitlines() if "peak pressure" in row)
    assert f"{s.max_pressure * 1e-6:.1f}" in line
    assert "MPa" in line
    for word in ("normal force", "T-gamma", "Burstow", "Archard", "status"):
        assert word in output


def test_both_wheels_are_shown_side_by_side():
    output = call("solve", "--side", "both", "--y", 1e-3).output
    assert "left 1" in output
    assert "right 1" in output


def test_no_contact_is_a_valid_result():
    assert "no contact" in call("solve", "--penetration", 0.0).output
    answer = json.loads(call("solve", "--curvatures", 1.0, 1.0, "--penetration", -1e-5, "--json").stdout)
    assert answer["patches"][0]["status"] == "NO_CONTACT"
    assert answer["patches"][0]["N"] == 0.0


def test_no_contact_draws_nothing_and_says_so(tmp_path):
    result = call("patch", "--penetration", 0.0, "--out", tmp_path / "none.png")
    assert "no picture" in result.stderr
    assert not (tmp_path / "none.png").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("solve", "--load", "-1"), "load = -1 is outside the allowed range [0, inf["),
        (("solve", "--friction", "nan"), "friction = nan"),
        (("solve", "--curvatures", "0", "1"), "A = 0 is outside the allowed range ]0, inf["),
        (
            ("solve", "--curvatures", "1", "1", "--wheel", "s1002", "--y", "0"),
            "--wheel, --y: --curvatures replaces wheel, rail and position",
        ),
        (
            ("compare", "--curvatures", "1", "1", "--profile-smoothing", "2e-6"),
            "--profile-smoothing: --curvatures replaces",
        ),
        (("solve", "--normal", "magic"), "normal = 'magic' is not a registered method"),
        (("solve", "--wheel", "round"), "wheel = 'round' is no profile of the standards; they are S1002, 1/40"),
        (("solve", "--wheel", "S1003"), "wheel = 'S1003' is no profile of the standards, did you mean 'S1002'"),
        (("solve", "--wheel", "missing.prw"), "missing.prw' is missing: there is no such file"),
        (("solve", "--rail", "rail A", "--inclination", "0.05"), "EN 15302 rail A has no inclination"),
        (
            ("solve", "--rail", "some.prr", "--inclination", "0.05"),
            "the rail in the file 'some.prr' is taken as it lies",
        ),
        (("conicity", "--amplitude", "3"), "amplitudes = 3 is outside the allowed range [0.0001, 0.02]"),
        (("conicity", "--left-radius", "0.4"), "has the same sign"),
        (("geometry", "--gauge", "1435"), "gauge = 1435 is outside"),
        (("solve", "--load", "1", "--penetration", "1e-5"), "exclude each other"),
        (("solve", "--y", "1.0"), "pose.y = 1"),
        (("solve", "--penetration", "-1e-5"), "penetration = -1e-05"),
        (("solve", "--curvatures", "1", "1", "--out", "nowhere/at/all.png"), "all.png cannot be written"),
        (("solve", "--curvatures", "1", "1", "--out", "picture.nonsense"), "picture.nonsense cannot be written"),
        (("curve", "--out", "nowhere/at/all.csv"), "all.csv cannot be written"),
        (("curve", "--max", "inf"), "max = inf is not finite"),
        (("curve", "--tangential", "magic"), "tangential = 'magic'"),
        (("patch", "--yaw", "3"), "pose.yaw = 3"),
    ],
)
def test_bad_input_ends_with_a_message_on_stderr_and_code_2(words, message):
    result = call(*words, code=2)
    assert message in result.stderr
    assert "Traceback" not in result.output


def test_unknown_commands_and_options_end_with_code_2():
    assert "No such command" in call("solv", code=2).output
    assert "No such option" in call("solve", "--lode", "1", code=2).output


@pytest.mark.slow
def test_patch_draws_both_wheels(tmp_path):
    mpl = pytest.importorskip("matplotlib")
    path = tmp_path / "flange.png"
    result = call("patch", "--y", 6e-3, "--yaw", 2e-3, "--out", path)
    image = mpl.image.imread(path)
    assert image.shape[0] > 600
    assert image.std() > 0.05
    assert str(path) in result.stderr
    assert "left 1" in result.output


def test_solve_draws_what_it_solved(tmp_path):
    mpl = pytest.importorskip("matplotlib")
    path = tmp_path / "patch.png"
    result = call("solve", "--curvatures", 1, 1, "--creepage", 1e-3, 0, 0, "--out", path, "--json")
    assert json.loads(result.stdout), "JSON alone on stdout"
    assert mpl.image.imread(path).std() > 0.05


def test_curve_is_odd_in_creepage_ends_at_the_friction_limit_and_is_written(tmp_path):
    pytest.importorskip("matplotlib")
    paths = [tmp_path / name for name in ("curve.csv", "curve.png")]
    words = ("--points", 5, "--max", 0.02, "--tangential", "fastrip", "--tangential", "fastsim", "--friction", 0.25)
    result = call("curve", *words, "--out", paths[0], "--out", paths[1])
    rows = list(csv.DictReader(paths[0].open(encoding="utf-8")))
    assert [row["tangential"] for row in rows] == ["fastrip"] * 5 + ["fastsim"] * 5
    force = np.array([float(row["Fx"]) / float(row["N"]) for row in rows]).reshape(2, 5)
    assert force[:, 0] == pytest.approx(0.0, abs=1e-12)
    assert force[:, -1] == pytest.approx(-0.25, rel=2e-3), "full slip"
    assert (np.diff(force) <= 1e-9).all(), "positive creepage, negative force"
    s = contact.solve(contact.Separation.hertzian(1.09, 0.83), contact.Creepage(0.005), load=80e3, friction=0.25)
    assert float(rows[1]["Fx"]) == pytest.approx(s.Fx, rel=1e-12)
    assert "0.2500" in result.output
    assert paths[1].stat().st_size > 5000


def test_curve_over_spin_holds_the_other_creepages(tmp_path):
    path = tmp_path / "spin.csv"
    call("curve", "--over", "spin", "--points", 3, "--creepage", 1e-3, -2e-3, 9.0, "--out", path)
    rows = list(csv.DictReader(path.open(encoding="utf-8")))
    assert [float(row["spin"]) for row in rows] == [0.0, 0.5, 1.0]
    assert {(float(row["longitudinal"]), float(row["lateral"])) for row in rows} == {(1e-3, -2e-3)}


def test_methods_lists_the_whole_registry():
    output = call("methods").output
    for known in contact.methods():
        for name in known:
            assert name in output


@pytest.mark.slow
def test_conicity_gives_the_numbers_of_the_python_api(tmp_path):
    pytest.importorskip("matplotlib")
    paths = [tmp_path / name for name in ("conicity.csv", "conicity.png")]
    words = ("--wheel", "wheel A", "--left-wheel", "wheel B", "--rail", "rail A", "--gauge", 1.4351645)
    result = call("conicity", *words, "--out", paths[0], "--out", paths[1])
    rail, a, b = (profile.named(name) for name in ("rail A", "wheel A", "wheel B"))
    found = conicity(a, rail, left_wheel=b, gauge=1.4351645)
    rows = list(csv.DictReader(paths[0].open(encoding="utf-8")))
    assert [float(row["conicity"]) for row in rows] == found.conicity.tolist()
    assert [float(row["wavelength"]) for row in rows] == found.wavelength().tolist()
    assert all(f"{value:.3f}" in result.output for value in found.conicity)
    assert paths[1].stat().st_size > 5000
    answer = json.loads(call("conicity", *words, "--amplitude", 3e-3, "--json").stdout)
    assert answer["conicity"] == pytest.approx([found.conicity[2]], rel=1e-4)


def test_files_have_no_wavelength_without_conicity(tmp_path):
    path = tmp_path / "conicity.csv"
    words = ("--wheel", "wheel I", "--rail", "rail A", "--gauge", 1.4351645, "--amplitude", 1e-3)
    assert json.loads(call("conicity", *words, "--json", "--out", path).stdout)["wavelength"] == [None]
    assert next(csv.DictReader(path.open(encoding="utf-8")))["wavelength"] == ""


def test_geometry_gives_the_contact_points_of_old_names(tmp_path):
    pytest.importorskip("matplotlib")
    paths = [tmp_path / name for name in ("points.csv", "points.png")]
    words = ("--wheel", "1:40", "--rail", "UIC 60", "--inclination", 0.05, "--max", 2e-3, "--step", 1e-3, "--roll")
    result = call("geometry", *words, "--out", paths[0], "--out", paths[1])
    wheel, rail = profile.named("1/40"), profile.rail_60e1(0.05)
    found = contact_points(wheel, rail, np.linspace(-2e-3, 2e-3, 5), roll=True)
    rows = list(csv.DictReader(paths[0].open(encoding="utf-8")))
    for name, values in found.columns().items():
        assert [float(row[name]) for row in rows] == values.tolist(), name
    assert "1/40 on 60E1" in result.output
    assert paths[1].stat().st_size > 5000
    assert json.loads(call("geometry", *words, "--json").stdout)["right_angle"] == found.right.angle.tolist()


def test_profiles_lists_the_whole_library():
    output = call("profiles").output
    assert all(name in output for name in (*profile.names(), "UIC60", "BS113A"))


def test_profile_files_are_smoothed_on_request(tmp_path):
    rail = profile.named("49E1")
    path = tmp_path / "rail.txt"
    noise = 2e-6 * np.random.default_rng(2).standard_normal(rail.y.size)
    path.write_text("\n".join(f"{y:.9f} {z:.9f}" for y, z in zip(rail.y, rail.z + noise, strict=True)))
    words = ("geometry", "--rail", path, "--profile-unit", "m", "--profile-side", "right", "--max", 1e-3, "--json")
    raw, smooth = (
        json.loads(call(*words, *more).stdout)["right_angle"] for more in ((), ("--profile-smoothing", 2e-6))
    )
    true = contact_points(profile.s1002(), rail, np.linspace(-1e-3, 1e-3, 21)).right.angle
    assert np.abs(smooth - true).mean() < 0.5 * np.abs(raw - true).mean()


@pytest.mark.parametrize(
    "words",
    [
        *(("--help",), ("solve", "--help"), ("patch", "-h"), ("curve", "-h"), ("methods", "-h")),
        *(("geometry", "-h"), ("conicity", "-h"), ("profiles", "-h")),
    ],
)
def test_help_explains_every_option(words):
    output = call(*words).output
    assert "Usage: " in output
    assert all("--creepage" in output for _ in range(words[0] in ("solve", "patch", "curve")))


def test_version_is_that_of_the_package():
    assert call("--version").output.strip() == contact.__version__


def test_plug_in_becomes_a_command(tmp_path, monkeypatch):
    (tmp_path / "a_plug_in.py").write_text("def greet(name: str = 'nobody'):\n    print('hello', name)\n")
    monkeypatch.syspath_prepend(tmp_path)
    app = typer.Typer()
    app.command("other")(lambda: None)
    assert add_plugins(app, [EntryPoint("greet", "a_plug_in:greet", GROUP)]) == []
    result = CliRunner().invoke(app, ["greet", "--name", "rail"])
    assert result.output == "hello rail\n"


def test_a_broken_plug_in_is_named_and_does_not_stop_other_commands():
    app = typer.Typer()
    app.command("one")(lambda: None)
    app.command("two")(lambda: None)
    problems = add_plugins(app, [EntryPoint("broken", "no_such_module:f", GROUP), EntryPoint("bare", "json:no", GROUP)])
    assert [("bare" in line or "broken" in line) for line in problems] == [True, True]
    assert "no_such_module" in " ".join(problems)
    assert CliRunner().invoke(app, ["one"]).exit_code == 0


def test_own_commands_do_not_load_plug_ins(monkeypatch):
    loaded = []
    monkeypatch.setattr(cli, "add_plugins", lambda app: loaded.append(app) or [])
    monkeypatch.setattr(cli, "app", FakeApp(cli.app))
    cli.run(["solve", "--y", "0"])
    assert loaded == []
    cli.run(["--help"])
    cli.run(["demo"])
    assert len(loaded) == 2


class FakeApp:
    """The commands of an app, without running them."""

    def __init__(self, app):
        self.registered_commands = app.registered_commands

    def __call__(self, args, prog_name):
        assert prog_name == "contact"


def test_missing_dependency_is_named_and_ends_with_code_1():
    code = (
        "import sys; sys.modules['typer'] = None; sys.argv = ['contact', 'methods']; import contact.cli as c; c.main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr == "contact: typer is missing; pip install wheelrail-contact installs it\n"
    assert "Traceback" not in done.stderr


def test_missing_matplotlib_ends_a_plot_with_code_1(monkeypatch, tmp_path):
    for name in [name for name in sys.modules if name.startswith("contact.plot")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr(contact, "plot", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    result = call("solve", "--curvatures", 1, 1, "--out", tmp_path / "no.png", code=1)
    assert "wheelrail-contact[plot]" in result.stderr


def test_json_has_version_command_inputs_and_units():
    words = ("--curvatures", 1.1, 0.8, "--creepage", 1e-3, 0.0, 0.1, "--load", 60e3, "--json")
    answer = json.loads(call("solve", *words).stdout)
    assert (answer["version"], answer["command"]) == (contact.__version__, "solve")
    given = {
        "load": 60e3,
        "curvatures": [1.1, 0.8],
        "creepage": [1e-3, 0.0, 0.1],
        "pressure_limit": None,
        "side": "right",
    }
    assert {name: answer["inputs"][name] for name in given} == given
    wanted = {
        "load": "N",
        "curvatures": "1/m",
        "creepage": "1, 1, 1/m",
        "max_pressure": "Pa",
        "Mz": "N m",
        "area": "m²",
    }
    assert {name: answer["units"][name] for name in wanted} == wanted


def test_json_has_the_values_in_effect_where_a_default_is_used():
    def inputs(*words):
        return json.loads(call("solve", *words, "--y", 3e-3, "--json").stdout)["inputs"]

    assert (inputs()["load"], inputs()["inclination"]) == (80e3, 0.025)
    assert inputs("--inclination", "1/20")["inclination"] == "1/20"
    assert inputs("--penetration", 1e-4)["load"] is None
    assert inputs("--rail", "EN 15302 rail A")["inclination"] is None  # it is drawn as it lies


def test_the_kind_of_a_checked_file_has_the_name_of_the_other_options(tmp_path):
    path = tmp_path / "wheel.txt"
    wheel = profile.s1002()
    path.write_text("\n".join(f"{1e3 * y:.6f} {1e3 * z:.6f}" for y, z in zip(wheel.y, wheel.z, strict=True)))
    rest = ("check", path, "--profile-unit", "mm", "--profile-side", "right")
    for name in ("--profile-kind", "--kind"):
        assert "nothing found" in call(*rest, name, "wheel").stdout
    assert "--profile-kind is missing: 'wheel.txt' does not say its kind" in call(*rest, code=2).stdout


def test_every_number_of_a_solution_has_a_unit_or_is_a_count():
    answer = json.loads(call("solve", "--json").stdout)
    (patch,) = answer["patches"]
    names = {name for name, value in (patch | patch["damage"]).items() if not isinstance(value, str | dict)}
    assert names - set(answer["units"]) == {"n_patches"}


@pytest.mark.parametrize(
    "words",
    [
        ("patch", "--out", "{}/patch.json"),
        ("curve", "--points", 2),
        ("geometry", "--max", 1e-3, "--step", 1e-3),
        ("conicity", "--amplitude", 1e-3),
        ("profiles",),
        ("methods",),
        ("compare", "--curvatures", 1, 1, "--no-reference"),
    ],
)
def test_every_command_has_json(words, tmp_path):
    answer = json.loads(call(*(str(word).format(tmp_path) for word in words), "--json").stdout)
    assert (answer["version"], answer["command"]) == (contact.__version__, words[0])
    assert {"inputs", "units"} < set(answer)


def test_results_are_written_as_json_and_csv_with_any_command(tmp_path):
    paths = [tmp_path / name for name in ("a.json", "a.csv")]
    shown = json.loads(call("solve", "--json", "--out", paths[0], "--out", paths[1]).stdout)
    assert json.loads(paths[0].read_text(encoding="utf-8")) == shown
    (row,) = csv.DictReader(paths[1].open(encoding="utf-8"))
    assert float(row["damage.T_gamma"]) == shown["patches"][0]["damage"]["T_gamma"]
    assert float(row["position.1"]) == shown["patches"][0]["position"][1]


def test_gauge_and_back_to_back_move_the_contact():
    def on_wheel(*words):
        return json.loads(call("solve", *words, "--json").stdout)["patches"][0]["rolling_radius"]

    wheel, rail = profile.s1002(), profile.rail_60e1()
    (patch,) = wheelset.contacts(wheel, rail, wheelset.Pose(), load=80e3, gauge=1.437, flange_back=1.357)
    assert on_wheel("--gauge", 1.437, "--back-to-back", 1.357) == patch.rolling_radius != on_wheel()


def test_the_contact_angle_has_one_sign_on_both_sides_and_in_all_commands():
    answers = json.loads(call("solve", "--side", "both", "--json").stdout)["patches"]
    left, right = (answer["contact_angle"] for answer in answers)
    points = json.loads(call("geometry", "--max", 1e-3, "--step", 1e-3, "--json").stdout)
    assert left == right > 0.0
    assert min(points["right_angle"][1], points["left_angle"][1]) > 0.0
    shown = next(line for line in call("solve", "--side", "both").stdout.splitlines() if "contact angle" in line)
    assert "-" not in shown


def test_units_of_headings_are_not_swallowed_by_markup():
    assert "spin creepage [1/m]" in call("curve", "--over", "spin", "--points", 2).stdout
    assert "amplitude [mm]" in call("conicity", "--amplitude", 1e-3).stdout


def test_absurd_input_is_answered_with_a_warning_on_one_line():
    for words, wanted in (
        (("--y", -0.02), "contact: warning: pose.y = -0.02: a flange touches at about 0.007 m; the unit is m"),
        (("--load", 80, "--side", "both"), "contact: warning: load = 80: a wheel carries 20 to 150 kN; the unit is N"),
        (("--friction", 30), "contact: warning: friction = 30: steel on steel has 0.05 to 0.6"),
        (("--creepage", -0.128, 0, 0), "contact: warning: creepage.longitudinal = -0.128: a rolling wheel has less"),
    ):
        result = call("solve", *words)
        assert wanted in result.stderr
        assert result.stderr.count("\n") == 1, "and nothing else"
    assert call("solve").stderr == ""


def test_an_inclination_may_be_a_ratio_on_the_command_line():
    by_ratio, by_number = (call("solve", "--inclination", value, "--json").stdout for value in ("1/20", "0.05"))
    assert json.loads(by_ratio)["patches"] == json.loads(by_number)["patches"]
    assert "neither a number nor a ratio" in call("solve", "--inclination", "steep", code=2).stderr


def test_check_names_faults_and_draws_them(tmp_path):
    wheel = profile.s1002()
    z = wheel.z.copy()
    z[350] += 1e-4
    path = tmp_path / "wheel.txt"
    path.write_text("\n".join(f"{1e3 * a:.4f} {1e3 * b:.4f}" for a, b in zip(wheel.y, z, strict=True)))
    words = ("check", path, "--kind", "wheel", "--profile-unit", "mm", "--profile-side", "right")
    assert "spikes: 1 point up to 100 µm off" in call(*words).stdout
    answer = json.loads(call(*words, "--json").stdout)
    assert answer["files"][0]["findings"][0]["fault"] == "spikes"
    assert "; --profile-repair drops them" in call(*words).stdout, "the option of this command line"
    assert "; --profile-repair drops them" in call("solve", "--wheel", path, *words[4:]).stderr
    assert (
        "contact: --profile-unit is missing: 'wheel.txt' does not say" in call("solve", "--wheel", path, code=2).stderr
    )
    assert "nothing found" in call(*words, "--profile-repair").stdout
    result = call("check", tmp_path, tmp_path / "no.whl", *words[2:], code=2)
    assert "no.whl' is missing" in result.stdout
    assert "spikes" in result.stdout
    pytest.importorskip("matplotlib")
    call(*words, "--out", tmp_path / "check.png")
    assert (tmp_path / "check.png").stat().st_size > 5000


def test_a_file_that_cannot_be_written_is_refused_before_the_computation(tmp_path, monkeypatch):
    monkeypatch.setattr("contact.cli.problem.solve_position", None)
    assert "there is no folder" in call("solve", "--out", tmp_path / "no/a.csv", code=2).stderr
    assert "a file ends in one of" in call("solve", "--out", tmp_path / "a.docx", code=2).stderr


def test_stress_gives_the_numbers_of_the_python_api(tmp_path):
    words = ("--curvatures", 1.1, 0.8, "--creepage", 2e-3, 0.0, 0.1, "--load", 60e3)
    picture = tmp_path / "stress.png"
    found = json.loads(call("stress", *words, "--body", "wheel", "--json", "--out", picture).stdout)["patches"]
    s = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(2e-3, 0.0, 0.1), load=60e3)
    peak = contact.stress.largest(s, body="wheel")
    assert (found[0]["von_mises"]["value"], found[0]["von_mises"]["z"]) == (peak.value, peak.z)
    assert found[0]["dang_van"]["value"] > 0.0
    assert picture.stat().st_size > 10_000
    assert "largest principal" in call("stress", *words).stdout


def test_stress_refuses_bad_options():
    words = ("--curvatures", 1.1, 0.8)
    assert "body = 'ground' is unknown" in call("stress", *words, "--body", "ground", code=2).stderr
    assert "criterion = 'x' is unknown" in call("stress", *words, "--criterion", "x", code=2).stderr
    assert "slope = 9 is outside" in call("stress", *words, "--slope", 9, code=2).stderr
    assert "--y: --curvatures replaces" in " ".join(call("stress", *words, "--y", 0, code=2).stderr.split())


def test_solve_takes_forces_instead_of_creepages():
    words = ("--curvatures", 1.1, 0.8, "--creepage", 0, 5e-4, 0.1, "--fx", 12e3)
    answer = json.loads(call("solve", *words, "--json").stdout)["patches"][0]
    s = contact.solve(
        contact.Separation.hertzian(1.1, 0.8), contact.Creepage(0.0, 5e-4, 0.1), load=80e3, force=(12e3, None)
    )
    assert answer["creepage"] == {"longitudinal": s.creepage.longitudinal, "lateral": 5e-4, "spin": 0.1}
    assert answer["Fx"] == pytest.approx(12e3, abs=1.0)
    both = json.loads(call("solve", *words, "--fy", 30e3, "--json").stdout)["patches"][0]
    assert both["status"] == "UNREACHABLE"
    assert "force = nan" in call("solve", *words[:-1], "nan", code=2).stderr


def test_transient_gives_the_numbers_of_the_python_api(tmp_path):
    words = ("--curvatures", 1.1, 0.8, "--shift", -4e-6, 0, 0, "--creepage", 1e-3, 0, 0.1, "--spacing", 1e-3)
    file, picture = tmp_path / "steps.csv", tmp_path / "steps.png"
    call("transient", *words, "--distance", 4e-3, "--out", file, "--out", picture)
    rows = list(csv.DictReader(file.open(encoding="utf-8")))
    patch = contact.Transient(contact.Separation.hertzian(1.1, 0.8), load=80e3, spacing=1e-3)
    forces = [patch.shift(-4e-6).Fx]
    forces += [patch.roll(contact.Creepage(1e-3, 0.0, 0.1), distance=1e-3).Fx for _ in range(4)]
    assert [float(row["Fx"]) for row in rows] == forces
    assert picture.stat().st_size > 10_000
    assert "step = 0 is outside" in call("transient", *words, "--step", 0, code=2).stderr
    assert "needs 1e+07 steps" in call("transient", *words, "--distance", 1e4, code=2).stderr


def test_the_bodies_of_the_command_line_are_those_of_the_python_api():
    bodies = (60e9, 0.31, 210e9, 0.28)
    words = ("--curvatures", 1.1, 0.8, "--bodies", *bodies, "--normal", "halfspace", "--tangential", "halfspace")
    answer = json.loads(call("solve", *words, "--creepage", 0, 0, 0, "--json").stdout)["patches"][0]
    s = contact.solve(
        contact.Separation.hertzian(1.1, 0.8), contact.Creepage(), load=80e3, normal="halfspace",
        tangential="halfspace", material=contact.Material.from_pair(*bodies),
    )  # fmt: skip
    assert answer["Fx"] == s.Fx != 0.0
    assert "nu1 = 0.7 is outside" in call("solve", *words[:3], "--bodies", 1e9, 0.7, 1e9, 0.3, code=2).stderr


def test_the_layer_of_the_command_line_is_that_of_the_python_api():
    words = ("--curvatures", 1.1, 0.8, "--creepage", 2e-3, 0, 0, "--normal", "halfspace", "--tangential", "halfspace")
    layer = (2e-13, 150e6, 1e11)
    answer = json.loads(call("solve", *words, "--layer", *layer, "--json").stdout)["patches"][0]
    s = contact.solve(
        contact.Separation.hertzian(1.1, 0.8), contact.Creepage(2e-3), load=80e3, normal="halfspace",
        tangential="halfspace", layer=contact.ThirdBody(*layer),
    )  # fmt: skip
    assert answer["Fx"] == s.Fx
    assert "layer.yield_stress = 0" in call("solve", *words, "--layer", 0, 0, 0, code=2).stderr
