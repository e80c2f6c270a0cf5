"""Command line: one contact, with the numbers of the Python API."""

import csv
import json

import numpy as np
import pytest

import contact
import contact.stress
from contact import damage
from contact.friction import Friction
from contact.geometry import profile, wheelset

typer = pytest.importorskip("typer")


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


def test_no_contact_is_a_valid_result():
    assert "no contact" in call("solve", "--penetration", 0.0).output
    answer = json.loads(call("solve", "--curvatures", 1.0, 1.0, "--penetration", -1e-5, "--json").stdout)
    assert answer["patches"][0]["status"] == "NO_CONTACT"
    assert answer["patches"][0]["N"] == 0.0


def test_no_contact_draws_nothing_and_says_so(tmp_path):
    result = call("patch", "--penetration", 0.0, "--out", tmp_path / "none.png")
    assert "no picture" in result.stderr
    assert not (tmp_path / "none.png").exists()


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


def test_the_kind_of_a_checked_file_has_the_name_of_the_other_options(tmp_path):
    path = tmp_path / "wheel.txt"
    wheel = profile.s1002()
    path.write_text("\n".join(f"{1e3 * y:.6f} {1e3 * z:.6f}" for y, z in zip(wheel.y, wheel.z, strict=True)))
    rest = ("check", path, "--profile-unit", "mm", "--profile-side", "right")
    for name in ("--profile-kind", "--kind"):
        assert "nothing found" in call(*rest, name, "wheel").stdout
    output = call("check", path, code=2).stderr
    assert "--profile-kind, --profile-unit, --profile-side: 'wheel.txt' does not say its kind, unit, side" in output
    alone = call(*rest, code=2).stderr
    assert "--profile-kind 'x' is none of 'wheel', 'rail'" in call(*rest, "--kind", "x", code=2).stderr
    assert "--profile-kind: 'wheel.txt' does not say its kind; give kind 'wheel' or 'rail'" in alone


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


def test_a_creep_curve_is_that_of_two_curvatures_or_of_a_wheel_on_a_rail():
    ellipse = json.loads(call("curve", "--points", 3, "--json").stdout)
    assert ellipse["inputs"]["curvatures"] == [1.09, 0.83]
    place = "--y", 3e-3, "--yaw", 1e-3
    curve = json.loads(call("curve", *place, "--points", 3, "--max", 2e-3, "--json").stdout)["rows"]
    creepage = curve[1]["longitudinal"], curve[1]["lateral"], curve[1]["spin"]
    assert creepage[0] == 1e-3
    assert creepage[1] != 0.0
    (solved,) = json.loads(call("solve", *place, "--creepage", *creepage, "--json").stdout)["patches"]
    assert curve[1]["Fx"] == solved["Fx"]
    assert "--curvatures replaces" in call("curve", *place, "--curvatures", 1, 1, code=2).stderr
