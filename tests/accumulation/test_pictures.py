"""Pictures of accumulated damage show the data of the histograms and solutions."""

import numpy as np
import pytest

import contact
from contact.accumulation import Histogram, worn_profile
from contact.damage import shakedown_limit
from contact.errors import ContactError
from contact.geometry.profile import rail_60e1, s1002
from contact.geometry.wheelset import Pair, Pose

pytest.importorskip("matplotlib")

from contact import plot

WHEEL, RAIL = s1002(), rail_60e1()


@pytest.fixture(scope="module")
def runs():
    """Return name → (wheel, rail, solutions) after 50 m and 100 m with two poses."""
    pair, made = Pair(WHEEL, RAIL), {}
    for name, pose, distance in (("middle", Pose(yaw=2e-3), 50.0), ("flange", Pose(y=5e-3, yaw=4e-3), 100.0)):
        patches = pair.contacts(pose, load=60e3)
        solutions = [contact.solve(p.separation, p.creepage, load=p.load, speed=30.0) for p in patches]
        made[name] = Histogram(WHEEL), Histogram(RAIL), solutions
        for histogram in made[name][:2]:
            histogram.add(patches, solutions, distance=distance)
    return made


@pytest.mark.parametrize("body", [0, 1])
def test_stacks_end_at_the_depth_of_the_merged_histogram(runs, body):
    parts = {name: run[body] for name, run in runs.items()}
    above = plot.wear(parts, "wear").axes[0]
    total = parts["middle"] + parts["flange"]
    first, second, outline = (patch.get_data() for patch in above.patches)
    expected = 1e9 * total.per("metre")["wear"]  # µm per km, or per thousand passes
    np.testing.assert_allclose(outline.values, expected, rtol=1e-13)
    np.testing.assert_allclose(second.values, expected, rtol=1e-13)
    np.testing.assert_array_equal(second.baseline, first.values)
    assert first.values.max() > 0.0


def test_shares_are_stacked_over_the_points_of_the_profile():
    depths = {"one": 1e-6 * np.cos(WHEEL.y) ** 2, "two": np.full(WHEEL.y.size, 3e-6)}
    above = plot.shares(WHEEL, depths, "shares").axes[0]
    np.testing.assert_allclose(above.lines[0].get_ydata(), 1e6 * (depths["one"] + depths["two"]), rtol=1e-13)
    tops = [collection.get_paths()[0].vertices[:, 1].max() for collection in above.collections]
    assert tops == pytest.approx([1e6 * depths["one"].max(), above.lines[0].get_ydata().max()])
    with pytest.raises(ContactError, match=r"depths\['one'\] has shape \(3,\)"):
        plot.shares(WHEEL, {"one": np.ones(3)})
    with pytest.raises(ContactError, match="depths is empty"):
        plot.shares(WHEEL, {})


def test_worn_profile_is_drawn_with_its_wear_magnified(runs):
    histogram = runs["flange"][0]
    worn = worn_profile(histogram, 1e-4 / histogram.depth.max())
    above, below = plot.worn_profile(WHEEL, worn, magnified=5.0, title="smoothed over 2 mm").axes
    before, after = above.lines
    np.testing.assert_allclose(after.get_ydata() - before.get_ydata(), 5e3 * (worn.z - WHEEL.z), rtol=1e-9, atol=1e-12)
    deepest = 1e3 * np.hypot(worn.y - WHEEL.y, worn.z - WHEEL.z).max()
    assert below.lines[0].get_ydata().max() == pytest.approx(deepest, rel=1e-12)
    assert "× 5" in after.get_label()


def test_working_points_lie_where_utilisation_and_pressure_say(runs):
    clouds = {name: run[2] for name, run in runs.items()}
    (ax,) = plot.shakedown(clouds).axes
    drawn = {line.get_label(): line for line in ax.lines}
    for name, (solution,) in clouds.items():
        x, y = drawn[name].get_xydata()[0]
        assert x == pytest.approx(np.hypot(solution.Fx, solution.Fy) / solution.N, rel=1e-15)
        assert y == pytest.approx(solution.max_pressure / 300e6, rel=1e-15)
        assert solution.damage.fatigue_index == pytest.approx(x - 1.0 / y, rel=1e-12), "positive above 1/x"


def test_fatigue_is_stacked_over_the_profile(runs):
    parts = {name: run[1] for name, run in runs.items()}
    total = parts["middle"] + parts["flange"]
    above = plot.fatigue(parts, "fatigue").axes[:3]
    for ax, quantity, scale in zip(
        above, ("fatigue_exceedance", "stress_exceedance", "energy_index"), (1.0, 1.0, 1e-6), strict=True
    ):
        outline = ax.patches[-1].get_data()
        np.testing.assert_allclose(
            outline.values, scale * total[quantity] / total.distance, rtol=1e-12, err_msg=quantity
        )
    assert above[0].patches[-1].get_data().values.max() > 0.0


def test_the_limit_of_the_map_is_drawn(runs):
    (ax,) = plot.shakedown({"middle": runs["middle"][2]}).axes
    utilised, limit = ax.lines[0].get_xydata().T
    np.testing.assert_array_equal(limit, shakedown_limit(utilised))


def test_pictures_refuse_what_they_cannot_draw(runs):
    wheel, rail = runs["middle"][:2]
    apart = contact.solve(contact.Separation.hertzian(1.0, 1.0), contact.Creepage(), approach=-1e-5)
    for draw, message in (
        (lambda: plot.wear({}), "histograms is empty"),
        (lambda: plot.wear({"new": Histogram(WHEEL)}), "nothing has rolled"),
        (lambda: plot.wear({"a": wheel, "b": rail}), "different profiles"),
        (lambda: plot.fatigue({}), "histograms is empty"),
        (lambda: plot.worn_profile(WHEEL, RAIL), "point to point"),
        (lambda: plot.worn_profile(WHEEL, WHEEL, magnified=0.0), "magnified"),
        (lambda: plot.shakedown({"air": [apart]}), "no solution with contact"),
    ):
        with pytest.raises(ContactError, match=message):
            draw()
