"""Records: repr, display in a notebook, copy, pickle, replace, and ownership of their arrays."""

import copy
import dataclasses
import pickle
import pkgutil
from importlib import import_module

import numpy as np
import pytest

import contact
import contact_models
from contact.accumulation import Histogram
from contact.errors import ContactError
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.inputs.material import Thermal
from contact.pair import WheelRailPair
from contact.results import Solution
from contact.view import notebook
from tests.notebooks import drawn, parsed, words

CREEPAGE = contact.Creepage(1e-3, -5e-4, 0.2)
PAIRS = {"strips": {}, "grid": {"normal": "halfspace", "tangential": "halfspace", "n_strips": 12, "n_elements": 12}}
COPIES = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{f"pickle {k}": lambda s, k=k: pickle.loads(pickle.dumps(s, k)) for k in range(2, pickle.HIGHEST_PROTOCOL + 1)},
}


@pytest.fixture(params=PAIRS)
def solution(request, ellipse):
    """Return a new solution whose attributes have not been read."""
    return contact.solve(ellipse, CREEPAGE, load=60e3, **PAIRS[request.param])


@pytest.fixture
def forces_only(ellipse):
    return contact.solve(ellipse, CREEPAGE, load=60e3, tangential="polach")


def arrays(solution):
    """Return every array of a solution by name, including those of its strips and grid."""
    found = {}
    for each in dataclasses.fields(solution):
        value = getattr(solution, each.name)
        if isinstance(value, np.ndarray):
            found[each.name] = value
        elif isinstance(value, tuple):
            found |= {f"{each.name}[{k}]": part for k, part in enumerate(value)}
    strips = {f"strips.{name}": getattr(solution.strips, name) for name in solution.strips.__slots__}
    return found | {name: array for name, array in strips.items() if array is not None}  # None on a plane


def assert_same(a, b):
    """Assert that two solutions are equal in every field, bit for bit."""
    mine, others = arrays(a), arrays(b)
    assert mine.keys() == others.keys()
    for name, array in mine.items():
        np.testing.assert_array_equal(array, others[name], err_msg=name, strict=True)
    for each in dataclasses.fields(a):
        value = getattr(a, each.name)
        if not isinstance(value, np.ndarray | tuple | contact.Strips):
            assert getattr(b, each.name) == value, each.name


# Solution


def test_arrays_of_a_solution_are_read_only_and_own_only_their_data(solution):
    for name, array in arrays(solution).items():
        assert array.base is None, name
        assert array.flags.owndata, name
        assert not array.flags.writeable, name
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_an_unread_solution_keeps_no_workspace(ellipse):
    solver = contact.Solver(n_strips=8, n_elements=8, n_samples=100_000)
    solution = solver.solve(ellipse, CREEPAGE, load=60e3)
    assert len(pickle.dumps(solution)) < 100_000
    for name, array in arrays(solution).items():
        assert array.nbytes <= 8 * 64 or name == "memory", name


@pytest.mark.parametrize("read", [True, False], ids=["read", "not read"])
@pytest.mark.parametrize("way", COPIES)
def test_a_copy_is_equal_and_its_arrays_are_read_only(solution, way, read):
    if read:
        assert solution.damage is not None
    other = COPIES[way](solution)
    assert type(other) is type(solution)
    assert_same(other, solution)
    for name, array in arrays(other).items():
        assert array.base is None, name
        assert not array.flags.writeable, name
    assert other.damage.T_gamma == solution.damage.T_gamma
    np.testing.assert_array_equal(other.pressure([0.0, 1e-3], 0.0), solution.pressure([0.0, 1e-3], 0.0))


@pytest.mark.parametrize("way", COPIES)
def test_a_copy_of_forces_only_has_the_forces_and_no_fields(forces_only, way):
    other = COPIES[way](forces_only)
    assert (other.Fx, other.Fy, other.Mz) == (forces_only.Fx, forces_only.Fy, forces_only.Mz)
    with pytest.raises(ContactError, match="there is no qx"):
        _ = other.qx


def test_replace_changes_only_the_given_fields(solution):
    other = dataclasses.replace(solution, speed=33.0)
    assert (other.speed, solution.speed) == (33.0, 20.0)
    assert type(other) is type(solution)
    assert_same(dataclasses.replace(other, speed=solution.speed), solution)


def test_replace_copies_an_array_that_it_is_given(solution):
    pressure = solution.p.copy()
    other = dataclasses.replace(solution, p=pressure)
    pressure[:] = 0.0
    np.testing.assert_array_equal(other.p, solution.p)
    assert not other.p.flags.writeable


def test_replace_evaluates_the_damage_anew(solution):
    before = solution.damage.T_gamma
    other = dataclasses.replace(solution, power_per_metre=2.0 * solution.power_per_metre)
    assert "damage" not in other.__dict__
    assert solution.damage.T_gamma == before


def test_asdict_holds_every_field_and_those_of_strips_creepage_and_material(solution):
    found = dataclasses.asdict(solution)
    assert list(found) == [each.name for each in dataclasses.fields(solution)]
    assert found["N"] == solution.N
    assert found["creepage"] == {"longitudinal": 1e-3, "lateral": -5e-4, "spin": 0.2}
    assert found["material"]["shear_modulus"] == contact.STEEL.shear_modulus
    np.testing.assert_array_equal(found["strips"]["a"], solution.strips.a)
    np.testing.assert_array_equal(found["p"], solution.p)


@pytest.mark.parametrize(
    "way", [dataclasses.asdict, lambda s: dataclasses.replace(s, speed=1.0)], ids=["asdict", "replace"]
)
def test_asdict_and_replace_refuse_a_solution_without_fields_and_say_why(forces_only, way):
    with pytest.raises(ContactError, match="there is no qx: tangential = 'polach' gives forces only"):
        way(forces_only)


def test_attributes_of_a_solution_cannot_be_set(solution):
    with pytest.raises(dataclasses.FrozenInstanceError):
        solution.N = 0.0


def test_an_unknown_attribute_is_an_attribute_error_even_of_an_empty_record(solution):
    with pytest.raises(AttributeError, match="no attribute 'Nx'"):
        _ = solution.Nx
    with pytest.raises(AttributeError, match="no attribute 'N'"):
        _ = Solution.__new__(Solution).N


def test_a_notebook_shows_the_main_numbers_with_units(solution):
    text = words(solution._repr_html_())
    for number in (
        f"{solution.N:.6g} N",
        f"{solution.Mz:.6g} N m",
        f"{1e-6 * solution.max_pressure:.5g} MPa",
        "mm²",
        "µm",
    ):
        assert number in text
    assert f"{solution.normal} + {solution.tangential}" in text


def test_a_notebook_shows_the_outline_of_the_patch_in_equal_scales(solution):
    outline, pressure = drawn(solution._repr_html_())
    wide, tall = np.ptp(outline, axis=0)
    strips = solution.strips
    assert wide / tall == pytest.approx(np.ptp(strips.y) / (2.0 * strips.a.max()), rel=0.02)
    assert np.ptp(pressure[:, 1]) == pytest.approx(70.0, abs=0.2)  # the greatest pressure takes the full height


def test_a_notebook_shows_forces_only_and_no_contact(forces_only, ellipse):
    assert "polach" in words(forces_only._repr_html_())
    apart = contact.solve(ellipse, CREEPAGE, approach=-1e-3)
    assert "NO_CONTACT" in words(apart._repr_html_())
    assert not drawn(apart._repr_html_())


# The others


def test_methods_have_a_repr_by_name_and_are_shown_with_their_capabilities():
    known = contact.methods()
    assert repr(known).startswith("Methods(normal: analyn, hertz, ")
    assert len(repr(known)) < 600
    assert "halfspace" not in repr(known.batched).replace("strip_halfspace", "")
    rows = [element for element in parsed(known._repr_html_()) if element.tag == "tr"]
    assert len(rows) == len(known.normal) + len(known.tangential) + 2
    shown = {row[0].text: row[3].text for row in rows}
    assert shown["multi_hertz"] == "non-elliptic, several patches, load may step"
    assert "slip field" in (shown["fastrip"] or "")


def test_separation_is_sketched_with_its_least_gap_at_the_axis(ellipse):
    assert repr(ellipse).startswith("Separation(41 points, y = ")
    (gap,) = drawn(ellipse._repr_html_())
    lowest = gap[np.argmax(gap[:, 1])]
    assert lowest == pytest.approx([0.5 * np.ptp(gap[:, 0]), 110.0], abs=0.2)


@pytest.mark.parametrize("g", [[5.0, 0.0, 5.0], [0.0, 0.0, 0.0], [-1e-3, 3.0, 3.0]], ids=["steep", "flat", "at an end"])
def test_any_separation_can_be_sketched(g):
    assert drawn(contact.Separation([-1e-2, 0.0, 1e-2], g, 1.0)._repr_html_())


@pytest.mark.parametrize(
    "friction",
    [
        Friction(0.3),
        Friction.polach(),
        Friction(0.4, gauge_factor=0.5, border=-0.01, velocity="local"),
        Friction(0.4, hot_factor=0.2, thermal=Thermal(conductivity=40.0)),
    ],
)
def test_the_repr_of_friction_can_be_evaluated(friction):
    assert eval(repr(friction), {"Friction": Friction, "Thermal": Thermal}) == friction


def test_the_repr_of_friction_shows_only_changes_from_a_constant_coefficient():
    assert repr(Friction(0.3)) == "Friction(0.3)"
    assert repr(Friction(0.3, border=-0.01)) == "Friction(0.3, border=-0.01)"
    rows = [
        [cell.text for cell in element]
        for element in parsed(Friction(0.3, border=-0.01)._repr_html_())
        if element.tag == "tr"
    ]
    assert rows == [["friction", "value", "unit"], ["static", "0.3", "-"], ["border", "-0.01", "m"]]


def test_a_histogram_with_wear_is_sketched():
    histogram = Histogram(profile.s1002())
    assert repr(histogram).startswith("Histogram(")
    assert drawn(histogram._repr_html_())
    n = histogram.centres.size
    depth = np.where(np.arange(n) == n // 2, 3e-6, 0.0)
    values = {name: histogram[name] for name in ("contact", "volume", "T_gamma", "energy_index")}
    values |= {name: histogram[name] for name in ("stress_exceedance", "fatigue_exceedance", "energy_index_max")}
    values |= {name: histogram[name] for name in ("rcf_forward", "rcf_backward")}
    histogram.restore(values | {"wear": depth}, 1.0, set(), set())
    (bar,) = drawn(histogram._repr_html_())
    assert bar[:, 1].min() == 0.0
    assert "mm³ worn off" in words(histogram._repr_html_())
    assert ">3<" in histogram._repr_html_()  # micrometres


# The helpers


def test_text_is_escaped():
    shown = notebook.table(("a<b",), [("<script>alert(1)</script>",)], "x & y")
    assert "<script>" not in shown
    assert [element.text for element in parsed(shown) if element.tag in ("caption", "th", "td")] == [
        "x & y", "a<b", "<script>alert(1)</script>",
    ]  # fmt: skip
    assert "<b>" not in notebook.Sketch((0.0, 1.0), (0.0, 1.0), ("<b>", "<b>"), "<b>").svg()


def test_lines_and_text_take_the_colour_of_the_page(ellipse):
    """Nothing is drawn black or white, so light and dark pages both work."""
    for element in parsed(ellipse._repr_html_()):
        for name in ("fill", "stroke"):
            assert element.get(name) in (None, "none", "currentColor", notebook.COLOUR)


def test_a_sketch_of_many_points_stays_small():
    y = np.linspace(-0.02, 0.02, 100_001)
    assert len(contact.Separation(y, y**2, 1.0)._repr_html_()) < 20_000


def test_profiles_patches_and_pairs_are_shown_in_a_notebook():
    wheel, rail = profile.s1002(), profile.rail_60e1()
    (outline,) = drawn(wheel._repr_html_(), "polyline")
    wide, tall = np.ptp(outline, axis=0)
    assert wide / tall == pytest.approx(np.ptp(wheel.y) / np.ptp(wheel.z), rel=0.02)
    pair = Pair(wheel, rail)
    (patch,) = pair.contacts(Pose(y=1e-3), load=8e4)
    assert f"{patch.load:.6g} N" in words(patch._repr_html_())
    found = WheelRailPair(pair).solve(Pose(y=1e-3), load=8e4)
    text = words(found._repr_html_())
    assert f"{found.Q:.6g} N" in text
    assert f"{1e-6 * found.contacts[0].max_pressure:.5g}" in text
    assert "NO_CONTACT" in words(WheelRailPair(pair).solve(Pose(z=-1e-3))._repr_html_())


# Every record


def records_of_arrays():
    """Return the classes of records in the packages that a user imports which have members that are arrays."""
    names = [contact.__name__, contact_models.__name__]
    for package in (contact, contact_models):
        names += [m.name for m in pkgutil.walk_packages(package.__path__, f"{package.__name__}.") if m.ispkg]
    public = [
        getattr(import_module(name), one) for name in names for one in getattr(import_module(name), "__all__", ())
    ]
    records = {one for one in public if isinstance(one, type) and dataclasses.is_dataclass(one)}
    records -= {contact.halfspace.Normal}  # its module has kernels: a change of it compiles the half space anew
    return [one for one in records if any("Array" in str(each.type) for each in dataclasses.fields(one))]


@pytest.mark.parametrize("record", sorted(records_of_arrays(), key=str), ids=lambda record: record.__name__)
def test_a_record_of_arrays_compares_without_an_error_and_its_repr_is_written_for_it(record):
    assert record.__eq__ is object.__eq__
    assert not hasattr(record.__repr__, "__wrapped__"), "the repr is that of dataclasses, which writes arrays out"


def test_the_repr_of_results_is_short(solution):
    creepage = np.linspace(0.0, 1e-3, 100), 0.0, 0.0
    found = contact.forces(contact.Separation.hertzian(1.1, 0.8), creepage, load=80e3)
    for record in (found, solution.strips, solution.damage, solution.damage.archard):
        assert len(repr(record)) < 1500, record
    assert "Fx=<100: -11846.1 … 0>" in repr(found)
    assert found == found
    assert found != copy.deepcopy(found)


def test_the_repr_of_a_pair_names_side_and_radius():
    pair = Pair(profile.s1002(), profile.rail_60e1(), side="left")
    assert repr(WheelRailPair(pair)) == "WheelRailPair(Pair(left, nominal_radius=0.46))"


@pytest.mark.parametrize("way", COPIES)
@pytest.mark.parametrize("one", [contact.THESIS, contact.methods()], ids=["thesis", "methods"])
def test_what_a_process_is_given_can_be_copied(one, way):
    assert COPIES[way](one) == one


def test_the_choice_of_methods_cannot_be_changed():
    with pytest.raises(TypeError):
        contact.THESIS["normal"] = "hertz"
