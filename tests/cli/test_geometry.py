"""Command line: profiles, contact points and conicity."""

import csv
import json

import numpy as np
import pytest

from contact.geometry import conicity, contact_points, profile, wheelset

typer = pytest.importorskip("typer")


from tests.command_line import call  # noqa: E402


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
    without = call("solve", "--wheel", path, code=2).stderr
    assert "contact: --profile-unit, --profile-side: 'wheel.txt' does not say its unit, side" in without
    assert "  repair dropped 1 of 593 points (spikes)" in call(*words, "--profile-repair").stdout
    result = call("check", tmp_path, tmp_path / "no.whl", *words[2:], code=2)
    assert "no.whl' is missing" in result.stderr
    assert "spikes" in result.stdout
    pytest.importorskip("matplotlib")
    call(*words, "--out", tmp_path / "check.png")
    assert (tmp_path / "check.png").stat().st_size > 5000
