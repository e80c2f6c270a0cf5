"""Command line: given forces, stresses below the surface, transients, materials and layers."""

import csv
import json

import pytest

import contact
import contact.stress

typer = pytest.importorskip("typer")


from tests.command_line import call  # noqa: E402


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


def test_solve_takes_forces_instead_of_creepages():
    words = ("--curvatures", 1.1, 0.8, "--creepage", 0, 5e-4, 0.1, "--fx", 12e3)
    answer = json.loads(call("solve", *words, "--json").stdout)["patches"][0]
    s = contact.solve(
        contact.Separation.hertzian(1.1, 0.8), contact.Creepage(0.0, 5e-4, 0.1), load=80e3, force=(12e3, None)
    )
    assert answer["creepage"] == {"longitudinal": s.creepage.longitudinal, "lateral": 5e-4, "spin": 0.1}
    assert answer["Fx"] == pytest.approx(12e3, abs=1.0)
    both = json.loads(call("solve", *words, "--fy", 30e3, "--json", code=3).stdout)["patches"][0]
    assert both["status"] == "UNREACHABLE"
    assert "--fx nan" in call("solve", *words[:-1], "nan", code=2).stderr


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
    assert "--step 0 is outside" in call("transient", *words, "--step", 0, code=2).stderr
    assert "warning: --step 0.004 m is 4 of the 12 elements" in call("transient", *words, "--step", 4e-3).stderr
    assert "needs 1e+07 steps" in call("transient", *words, "--distance", 1e4, code=2).stderr


BODIES, LAYER = (60e9, 0.31, 210e9, 0.28), (2e-13, 150e6, 1e11)


@pytest.mark.parametrize(
    ("words", "options", "wrong", "message"),
    [
        (("--bodies", *BODIES), {"material": contact.Material.from_pair(*BODIES)},
         ("--bodies", 1e9, 0.7, 1e9, 0.3), "nu1 = 0.7 is outside"),
        (("--layer", *LAYER), {"layer": contact.ThirdBody(*LAYER)}, ("--layer", 0, 0, 0), "layer.yield_stress = 0"),
    ],
    ids=["bodies", "layer"],
)  # fmt: skip
def test_bodies_and_layers_of_the_command_line_are_those_of_the_python_api(words, options, wrong, message):
    both = {"normal": "halfspace", "tangential": "halfspace"}
    at = ("--curvatures", 1.1, 0.8, "--creepage", 1e-3, 0, 0, "--normal", "halfspace", "--tangential", "halfspace")
    answer = json.loads(call("solve", *at, *words, "--json").stdout)["patches"][0]
    s = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3), load=80e3, **both, **options)
    assert (
        answer["Fx"] == s.Fx != contact.solve(contact.Separation.hertzian(1.1, 0.8), (1e-3, 0, 0), load=80e3, **both).Fx
    )
    assert message in call("solve", *at, *wrong, code=2).stderr
