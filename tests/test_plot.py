"""Pictures: they show the solution at the right places, with common scales and without global side effects."""

import copy
import os
import subprocess
import sys

import numpy as np
import pytest

import contact

mpl = pytest.importorskip("matplotlib")

from contact import plot  # noqa: E402
from contact.geometry import conicity, contact_points, equivalent_conicity, profile  # noqa: E402
from contact.geometry.surfaces import SurfacePair  # noqa: E402
from contact.geometry.wheelset import Pair, Pose, Velocity  # noqa: E402
from contact.pair import WheelRailPair  # noqa: E402
from contact.plot.mesh import PatchMesh  # noqa: E402
from contact.plot.style import nice  # noqa: E402

NO_CREEPAGE = contact.Creepage()


@pytest.fixture(scope="module")
def solution():
    wheel = contact.Separation.hertzian(A=1.1, B=0.8)
    return contact.solve(wheel, contact.Creepage(2e-3, 1e-3, 0.4), load=80e3)


@pytest.fixture(scope="module")
def apart():
    return contact.solve(contact.Separation.hertzian(A=1.1, B=0.8), NO_CREEPAGE, approach=-1e-5)


@pytest.fixture(scope="module")
def two_patches():
    y = np.linspace(-25e-3, 25e-3, 201)
    g = np.minimum(6.0 * (y + 12e-3) ** 2, 2.0 * (y - 9e-3) ** 2 + 3e-5)
    separation = contact.Separation(y, g - g.min(), 1.1)
    solved = contact.solve(separation, contact.Creepage(-1e-3, -5e-4, 0.15), load=120e3)
    assert solved.n_patches == 2
    return solved


def colour_limits(ax):
    """Return the colour limits of the field on these axes."""
    return next(part.get_clim() for part in ax.collections if isinstance(part, mpl.collections.QuadMesh))


def test_outline_encloses_the_contact_area(solution, two_patches):
    for solved in (solution, two_patches):
        area = 0.0
        for k in range(solved.n_patches):
            y, x = PatchMesh(solved, k).outline()
            area += 0.5 * abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1)))
        assert area == pytest.approx(1e6 * solved.area, rel=8e-3), "polygon through 20 strips"


def test_drawn_boundary_is_the_leading_edge_shifted_back_by_strip_theory(ellipse):
    solved = contact.solve(ellipse, contact.Creepage(1.5e-3, 0.0, 0.0), load=80e3, **contact.THESIS)
    mesh = PatchMesh(solved, 0)
    partly = mesh.stick.any(axis=1) & ~mesh.stick.all(axis=1)
    boundary = np.array(
        [np.interp(0.0, d, x) for d, x in zip(mesh.slip_distance()[partly], mesh.x[partly], strict=True)]
    )
    shift = boundary + mesh.a[partly]  # 2d, the same on all strips (theory.md 2.4)
    assert partly.sum() > 10
    assert np.ptp(shift) < 0.03 * mesh.a.max(), "sub-element: one element here is 0.1 a"


def test_zone_names_stand_in_their_own_zones(solution, two_patches, ellipse):
    elements = {"normal": "halfspace", "tangential": "halfspace", "n_strips": 20, "n_elements": 20}
    on_elements = contact.solve(ellipse, contact.Creepage(-1e-3, 5e-4, 0.1), load=60e3, **elements)
    for solved in (solution, two_patches, on_elements):
        for k in range(solved.n_patches):
            mesh = PatchMesh(solved, k)
            labels = mesh.labels()
            assert set(labels) == {"stick", "slip"}
            for name, (y, x) in labels.items():
                nearest = np.argmin((mesh.x - x) ** 2 + (mesh.y[:, None] - y) ** 2)
                assert mesh.stick.ravel()[nearest] == (name == "stick")


def test_arrows_are_the_tractions_at_their_feet(solution):
    mesh = PatchMesh(solution, 0)
    y, x, qy, qx = mesh.arrows(1.0)
    assert 60 < y.size < 250, "about one per square millimetre of 134"
    half = np.interp(y, mesh.y, mesh.a)
    assert (np.abs(x) <= half).all()
    for point in range(0, y.size, 7):
        i, k = np.unravel_index(np.argmin((mesh.x - x[point]) ** 2 + (mesh.y[:, None] - y[point]) ** 2), mesh.x.shape)
        near = np.hypot(solution.qx[i, k] - qx[point], solution.qy[i, k] - qy[point])
        assert near < 0.15 * np.hypot(solution.qx, solution.qy).max()


def test_patches_of_one_figure_share_their_scales(solution, two_patches):
    figure = plot.patch([solution, two_patches], ["one", "two"])
    pressure, energy = figure.axes[:2], figure.axes[2:4]
    spans = {tuple(np.round([np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim())], 9)) for ax in pressure + energy}
    assert len(spans) == 1, "one length scale"
    for row, top in ((pressure, max(solution.max_pressure, two_patches.max_pressure) * 1e-6), (energy, None)):
        limits = {colour_limits(ax) for ax in row}
        assert len(limits) == 1, "one colour scale a row"
        if top is not None:
            assert limits.pop()[1] >= top
    assert two_patches.length * 1e3 < np.ptp(pressure[1].get_ylim())


def test_negative_energy_is_shown_and_not_cut_off(solution):
    field = contact.damage.evaluate(solution).energy_index.field
    assert field.min() < -0.01 * field.max(), "this case must gain energy somewhere"
    figure = plot.patch(solution)
    low, high = colour_limits(figure.axes[1])
    assert low <= field.min() * 1e-6
    assert high >= field.max() * 1e-6


@pytest.mark.slow
def test_pictures_are_written_and_not_blank(tmp_path, solution, apart, two_patches):
    blank = tmp_path / "blank.png"
    mpl.figure.Figure(figsize=(2.0, 2.0)).savefig(blank)
    for k, solved in enumerate((solution, apart, [two_patches, apart])):
        path = tmp_path / f"{k}.png"
        plot.patch(solved, "case" if k < 2 else ["two", "apart"]).savefig(path)
        image = mpl.image.imread(path)
        assert image.shape[0] > 300
        assert image.std() > 0.01
    assert plot.patch(apart).axes[0].get_title(loc="left") == "no contact"


def test_given_axes_show_only_the_pressure(solution):
    figure = mpl.figure.Figure()
    ax = figure.subplots()
    assert plot.patch(solution, ax=ax) is figure
    assert len(figure.axes) == 2, "the axes and their colour bar"


def test_the_users_matplotlib_settings_stay(solution, apart):
    before = dict(mpl.rcParams)
    plot.patch([solution, apart])
    plot.curve([0.0, 1.0], {"a": [0.0, 1.0]})
    assert dict(mpl.rcParams) == before
    assert "matplotlib.pyplot" not in sys.modules or not mpl.pyplot.get_fignums()


def test_friction_limit_is_drawn_where_the_curves_are():
    figure = plot.curve([0.0, 0.5, 1.0], {"fastrip": [0.0, -0.2, -0.3], "fastsim": [0.0, -0.1, -0.25]}, limit=0.3)
    dashed = [line for line in figure.axes[0].lines if line.get_linestyle() == "--"]
    assert [line.get_ydata()[0] for line in dashed] == [-0.3]
    assert [t.get_text() for t in figure.axes[0].get_legend().get_texts()] == ["fastrip", "fastsim"]


def test_time_histories_keep_one_colour_for_one_name():
    t = np.linspace(0.0, 1.0, 50)
    figure = plot.time_histories(t, {"y [mm]": {"left": t, "right": -t}, "F [kN]": {"right": t**2}})
    first, second = figure.axes
    assert first.lines[1].get_color() == second.lines[0].get_color() != first.lines[0].get_color()
    assert [ax.get_ylabel() for ax in figure.axes] == ["y [mm]", "F [kN]"]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: plot.patch([]), "solution is empty"),
        (lambda s: plot.patch(s, ["a", "b"]), "titles has 2 entries for 1 solutions"),
        (lambda s: plot.patch([s, s], ax=object()), "ax takes one solution"),
        (lambda s: plot.curve([0.0, 1.0], {"short": [1.0]}), r"'short' has shape \(1,\)"),
        (lambda s: plot.time_histories([0.0], {}), "panels is empty"),
        (lambda s: plot.position([]), "wheels holds no contact patch"),
        (lambda s: plot.Wheel("middle", None, None, (), ()), "side = 'middle'"),
    ],
)
def test_bad_input_is_refused(solution, call, message):
    with pytest.raises(contact.ContactError, match=message):
        call(solution)


@pytest.mark.parametrize(
    ("top", "end"), [(893.0, 1000.0), (1000.0, 1000.0), (1001.0, 1200.0), (0.26, 0.3), (8.1, 10.0)]
)
def test_scales_end_at_round_numbers(top, end):
    assert nice(top) == pytest.approx(end, rel=1e-12)


def test_matplotlib_is_loaded_by_contact_plot_alone_and_its_absence_names_the_extra():
    code = (
        "import sys, contact, contact.damage, contact.geometry\n"
        "assert not {'matplotlib', 'typer', 'rich', 'xarray', 'PIL'} & set(sys.modules), 'the core loads an extra'\n"
        "sys.modules['matplotlib'] = None\n"
        "try:\n    import contact.plot\n"
        "except ImportError as error:\n    assert 'wheelrail-contact[plot]' in str(error), error\n"
        "else:\n    raise SystemExit('contact.plot imported without matplotlib')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_contact_points_are_joined_where_they_touch_and_the_differences_drawn():
    wheel, rail = profile.s1002(), profile.rail_60e1()
    points = contact_points(wheel, rail, np.linspace(-4e-3, 4e-3, 17))
    joined, difference, angle = plot.contact_points(points, wheel, rail).axes
    outlines, lines = joined.lines[:2], joined.lines[2:]
    assert len(lines) == 17
    np.testing.assert_allclose(sorted(line.get_xdata()[1] for line in lines), np.sort(1e3 * points.right.on_rail))
    for line in lines:
        for outline, y, z in zip(outlines, line.get_xdata(), line.get_ydata(), strict=True):
            assert np.interp(y, outline.get_xdata(), outline.get_ydata()) == pytest.approx(z, abs=1e-9)
    np.testing.assert_allclose(difference.lines[1].get_ydata(), 1e3 * points.radius_difference)
    np.testing.assert_allclose(angle.lines[1].get_ydata(), np.degrees(points.left.angle))
    with pytest.raises(contact.ContactError, match="at least two increasing"):
        plot.contact_points(contact_points(wheel, rail, [0.0]), wheel, rail)


def test_conicity_is_drawn_over_the_amplitude_beside_the_difference():
    found = conicity(profile.s1002(), profile.rail_60e1(), [1e-3, 3e-3], step=1e-4)
    curve = equivalent_conicity(found.points, np.linspace(1e-3, 3e-3, 9))
    left, right = plot.conicity(curve, found, "S1002").axes
    np.testing.assert_array_equal(left.lines[0].get_ydata(), curve.conicity)
    np.testing.assert_array_equal(left.lines[1].get_xdata(), 1e3 * found.amplitude)
    assert [text.get_text() for text in left.texts] == [f"{value:.3f}" for value in found.conicity]
    np.testing.assert_allclose(right.lines[1].get_ydata(), 1e3 * found.points.radius_difference)


def test_sides_and_methods_look_the_same_in_every_figure():
    both = [
        plot.time_histories([0.0, 1.0], {"a": {"lateral": [0, 1]}, "b": {"left": [0, 1], "right": [1, 0]}}),
        plot.time_histories([0.0, 1.0], {"b": {"right": [0, 1], "left": [1, 0]}}),
    ]
    seen = [{line.get_label(): line.get_color() for ax in figure.axes for line in ax.lines} for figure in both]
    assert {side: seen[0][side] for side in ("right", "left")} == seen[1]
    assert seen[0]["lateral"] not in seen[1].values()
    alone, together = (
        plot.curve([0, 1], {name: [0, 1] for name in names}) for names in (["polach"], ["fastsim", "polach"])
    )
    look = [
        next((line.get_color(), line.get_linestyle()) for line in figure.axes[0].lines if line.get_label() == "polach")
        for figure in (alone, together)
    ]
    assert look[0] == look[1]


def test_all_tangential_methods_are_told_apart_and_the_legend_stands_beside_them():
    names = list(contact.methods().tangential)
    figure = plot.curve([0.0, 1.0], {name: [0.0, 1.0] for name in names})
    looks = {(line.get_color(), line.get_linestyle()) for line in figure.axes[0].lines if line.get_label() in names}
    assert len(looks) == len(names) >= 16
    figure.canvas.draw()
    legend = figure.axes[0].get_legend().get_window_extent()
    assert legend.x0 >= figure.axes[0].get_window_extent().x1


def test_the_slip_in_the_title_is_that_of_the_drawn_zones():
    s = contact.solve(
        contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3, 0.0, 0.3), load=80e3, n_strips=40, n_elements=40
    )
    inside = s.p > 0.0
    share = s.dA[inside & ~s.stick].sum() / s.dA[inside].sum()
    assert 0.05 < share < 0.95
    assert f"slip {100.0 * share:.0f} %" in plot.patch(s).axes[0].get_title(loc="left")


NOTEBOOK = """
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
from contact import plot
shown, _ = shell.display_formatter.format(plot.curve([0.0, 1.0], {"a": [0.0, 1.0]}, xlabel="x", ylabel="y"))
print(*shown)
"""


def test_a_notebook_draws_figures_without_pyplot(tmp_path):
    pytest.importorskip("IPython")
    environment = {**os.environ, "IPYTHONDIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", NOTEBOOK], capture_output=True, text=True, env=environment, check=True)
    assert "image/png" in done.stdout.split()


@pytest.mark.slow
def test_a_pair_is_drawn_with_the_patches_that_it_finds():
    pair = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)))
    figure = pair.plot(Pose(y=6.6e-3), Velocity(20.0), load=8e4)
    found = pair.solve(Pose(y=6.6e-3), Velocity(20.0), load=8e4)
    told = " ".join(text.get_text() for part in figure.subfigs for ax in part.axes for text in ax.texts)
    shown = sum(1 for ax in figure.subfigs[0].axes for text in ax.texts if text.get_text().isdigit())
    assert shown == len(found.contacts)
    assert told
    with pytest.raises(contact.ContactError, match="changes along the way"):
        WheelRailPair(SurfacePair(profile.s1002(), profile.rail_60e1())).plot(Pose(), load=8e4)


def test_profiles_are_drawn_over_one_another():
    wheel = profile.s1002()
    outline, *_ = wheel.plot(wheel.rotated(0.01)).axes
    first, second = (line.get_ydata() for line in outline.lines)
    np.testing.assert_allclose(first, 1e3 * wheel.z)
    assert np.ptp(second - first) > 0.5


@pytest.mark.parametrize("note", ["", "3 rows sorted, 12 spikes dropped", "3 rows sorted, 1 of 2 scans kept, " * 6])
def test_titles_of_a_position_and_notes_on_a_repair_lie_within_the_picture(note):
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    wheel, rail = copy.copy(profile.s1002()), profile.rail_60e1()
    object.__setattr__(wheel, "note", note)
    patches = Pair(wheel, rail).contacts(Pose(y=3e-3), Velocity(20.0), load=8e4)
    solutions = [contact.solve(one.separation, one.creepage, load=one.load) for one in patches]
    figure = plot.position([plot.Wheel("right", wheel, rail, patches, solutions)], 0.0)
    FigureCanvasAgg(figure).draw()
    texts = [ax.title for ax in figure.get_axes()] + [text for part in figure.subfigs for text in part.texts]
    for text in texts:
        box = text.get_window_extent()
        assert 0.0 <= box.y0 <= box.y1 <= figure.bbox.height, text.get_text()
        assert 0.0 <= box.x0 <= box.x1 <= figure.bbox.width, text.get_text()
