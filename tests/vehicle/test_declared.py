"""Declared vehicles: preloads, messages."""

import numpy as np
import pytest

from contact.errors import ContactError
from contact_models.vehicle.assembly import GRAVITY, assemble
from contact_models.vehicle.declared import INCLUDED, read


@pytest.mark.parametrize("name", [path.stem for path in INCLUDED.glob("*.toml")])
def test_static_loads_carry_the_whole_weight(name):
    made = assemble(read(name))
    free = made.bodies["held"][:, 2] == 0
    preload = sum(each.preload * (2 if each.mirrored else 1) for each in read(name).springs)
    weight = GRAVITY * made.bodies["mass"][free].sum() + preload
    assert 2.0 * made.bodies["load"].sum() == pytest.approx(weight, rel=1e-12)


def test_axle_load_of_the_benchmark_vehicle():
    """docs/understand/constants.md 13.4: 109.1 kN."""
    loads = assemble(read("manchester")).bodies["load"]
    assert 2.0 * loads[loads > 0.0] == pytest.approx(np.full(4, 109.1e3), rel=1e-3)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('["bogie 1", "body"]', '["bogey 1", "body"]', r"'bogey 1' is no body.*bogie 1"),
        ("mass = 32000.0", "mass = -1.0", r"mass = -1"),
        ('held = ["x"]', 'held = ["w"]', r"held = 'w' is none of x, y"),
        ('held = ["x"]', "", r"nothing keeps the speed"),
        ("stiffness = [160e3, 160e3, 430e3]", "stiffness = [160e3, 160e3, 0.0]", r"rest on vertical springs"),
        ("force = [0.0, 0.0, 600.0", "force = [1.0, 0.0, 600.0", r"both from 0"),
    ],
)
def test_faults_of_a_file_are_named(tmp_path, old, new, said):
    text = (INCLUDED / "manchester.toml").read_text(encoding="utf-8")
    assert old in text
    (tmp_path / "v.toml").write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(ContactError, match=said):
        assemble(read(tmp_path / "v.toml"))


def test_reprofiled_wheels_are_smaller_and_all_else_stands_lower():
    whole, cut = read("manchester"), 5e-3
    lower = whole.reprofiled(cut)
    before, after = assemble(whole).bodies, assemble(lower).bodies
    assert lower.radius == pytest.approx(whole.radius - cut, abs=1e-15)
    assert before["height"] - after["height"] == pytest.approx(np.full(before.size, cut), abs=1e-12)
    assert after["load"] == pytest.approx(before["load"], rel=1e-12)
    arms = [assemble(each).elements["on_a"] for each in (whole, lower)]
    assert arms[1] == pytest.approx(arms[0], abs=1e-12)
