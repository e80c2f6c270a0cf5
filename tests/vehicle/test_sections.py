"""Rails of slices in the vehicle and in scenarios (docs/vehicle.md, 7)."""

from dataclasses import replace

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import RailSurface
from examples.crossing import turnout
from models.vehicle.declared import read
from models.vehicle.kernels.layout import Book
from models.vehicle.sections import RailSection
from tests.vehicle.parts import simulation

RAIL = np.stack((profile.rail_60e1().y, profile.rail_60e1().z), axis=1)


def dip(depth=1e-3, length=0.6):
    """A rail 60E1 with a dip of one cosine [m]."""
    s = np.linspace(0.0, length, 31)
    down = 0.5 * depth * (1.0 - np.cos(2.0 * np.pi * s / length))
    return RailSurface(s, [RAIL + np.array([0.0, each]) for each in down], name="dip")


def elastic(vehicle="wheelset"):
    """A vehicle on the rails of the Manchester vehicle: 300 kg on springs."""
    return replace(read(vehicle), rail=read("manchester").rail)


def over(surface, steps, h=1e-4, at=0.5, sides=("right", "left"), **options):
    """Return a run over slices, and normal forces of the first wheels [N] and residual [J] at every step."""
    sections = [RailSection(surface=surface, side=side, at=at, name=f"of the {side}") for side in sides]
    run = simulation(elastic(), speed=20.0, sections=sections, **options)
    rows = []
    for _ in range(steps):
        run.advance(h)
        rows.append((run.distance, *run.wheels["normal"][:2], run.state.books[Book.RESIDUAL], run.on_surfaces[0]))
    return run, np.array(rows)


def test_slices_of_the_rail_are_the_rail():
    straight = RailSurface([0.0, 0.3, 0.6], [RAIL] * 3)
    run, rows = over(straight, 700)
    plain = simulation(elastic(), speed=20.0)
    on_profiles = np.empty(700)
    for k in range(700):
        plain.advance(1e-4)
        on_profiles[k] = plain.wheels["normal"][0]
    assert rows[:, 4].sum() * 1e-4 * 20.0 == pytest.approx(0.8, abs=0.005)  # 0.6 m and 0.1 m on both sides
    # the paths of the slices lie every 0.5 mm: where they begin, the force has a step of 0.16 %
    assert rows[:, 1] == pytest.approx(on_profiles, rel=2e-3)
    assert run.state.q == pytest.approx(plain.state.q, abs=2e-6)


def test_a_wheel_follows_a_dip_and_leaves_with_its_static_load():
    run, rows = over(dip(), 1800)
    s, right, left = rows[:, :3].T
    static = right[0]
    before, after = s < 0.4, s > 3.2
    assert right[before] == pytest.approx(static, rel=2e-3)
    assert right == pytest.approx(left, rel=1e-6)
    assert right.max() > 1.5 * static
    assert right.min() < 0.6 * static
    assert right[after] == pytest.approx(static, rel=0.03)
    assert run.state.books[Book.UNTRUSTED] == 0.0


def test_energy_is_kept_over_a_dip():
    run, rows = over(dip(), 900)
    kept = np.abs(rows[:, 3]).max()
    # the wheelset's weight, 109 kN, falls by 1 mm in the dip: 109 J are exchanged
    assert kept < 0.5


def test_a_dip_under_one_wheel_rolls_the_wheelset():
    _, rows = over(dip(), 500, sides=("left",))
    right, left = rows[:, 1:3].T
    assert np.ptp(left) > 3.0 * np.ptp(right)


def test_load_goes_from_the_wing_rail_to_the_nose_and_energy_is_kept():
    run, rows = over(turnout.surface(), 1400, at=0.3, sides=("right",))
    right = rows[:, 1]
    assert run.distance > 2.7
    assert not run.on_surfaces.any()
    assert 0.5 * right[0] < right.min() < 0.9 * right[0]
    assert 1.3 * right[0] < right.max() < 2.0 * right[0]
    assert np.abs(right[-100:] / right[0] - 1.0).max() < 0.1
    # the wheelset falls by 1 mm and climbs again: 109 J are exchanged
    assert np.abs(rows[:, 3]).max() < 2.5


def test_sections_that_do_not_continue_the_rail_are_refused():
    step = RailSurface([0.0, 0.5], [RAIL, RAIL + np.array([0.0, 5e-5])])
    with pytest.raises(ContactError, match=r"of the right: on its last slice a wheel stands -0.05 mm higher.*0.02 mm"):
        over(step, 0)


def test_sections_that_overlap_are_refused():
    sections = [RailSection(surface=dip(), side="left", at=at, name=f"[{at}]") for at in (3.0, 3.7)]
    with pytest.raises(
        ContactError, match=r"\[3.7\]: on the left rail it begins at 3.6 m, before \[3.0\] ends at 3.7 m"
    ):
        simulation(sections=sections)
