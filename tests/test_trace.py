"""The table of iterations."""

import re

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from tests.command_line import call

NO_CREEP = contact.Creepage()


def flange_patch():
    (patch,) = Pair(profile.s1002(), profile.rail_60e1()).contacts(Pose(y=4.7e-3), load=8e4)
    return patch


def rows(text):
    return [line for line in text.splitlines() if re.match(r" *\d+ ", line)]


@pytest.mark.parametrize("image", [False, True])
def test_the_trace_ends_where_the_solution_does(capsys, image):
    s = flange_patch().separation
    if image:
        s = contact.Separation(-s.y[::-1], s.g[::-1], s.A[::-1], -s.x_c[::-1])
    solution = contact.solve(s, NO_CREEP, load=8e4, trace=True)
    shown = rows(capsys.readouterr().out)
    assert len(shown) == solution.iterations > 2
    *_, last = shown
    numbers = [float(part) for part in re.findall(r"-?\d+\.\d+", last.split("µm")[1])]
    assert numbers == pytest.approx(1e3 * np.sort(solution.patch_edges.ravel())[[0, -1]], abs=2e-2)
    residuals = [float(line.split()[1]) for line in shown]
    assert residuals[-1] < 0.1 * residuals[0]


def test_the_trace_is_shown_before_the_error(capsys):
    y = np.linspace(-8e-3, 8e-3, 301)
    rough = contact.Separation(y, 0.8 * y**2 + 4e-6 * np.random.default_rng(3).normal(size=y.size), 1.1)
    with pytest.raises(contact.ContactError):
        contact.solve(rough, NO_CREEP, load=4e4, max_iterations=3, trace=True)
    assert len(rows(capsys.readouterr().out)) == 3


def test_other_methods_say_that_they_have_none(capsys):
    contact.solve(contact.Separation.hertzian(1.1, 0.8), NO_CREEP, load=8e4, **contact.THESIS, trace=True)
    assert capsys.readouterr().out.splitlines()[-1] == "tangential = 'fastrip': no iterations; status OK"
    both = {"normal": "halfspace", "tangential": "halfspace", "n_strips": 12, "n_elements": 12}
    contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3), load=8e4, **both, trace=True)
    assert "tangential = 'halfspace': step 1, residual" in capsys.readouterr().out


def test_the_command_line_keeps_json_apart():
    shown = call("solve", "--curvatures", 1.1, 0.8, "--load", 8e4, "--trace")
    assert "gap residual" in shown.stdout
    as_json = call("solve", "--curvatures", 1.1, 0.8, "--load", 8e4, "--trace", "--json")
    assert "gap residual" not in as_json.stdout
    assert "gap residual" in as_json.stderr
