"""Arrays that a user gives: real numbers that are there, or an error that names the argument."""

import re
import warnings
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest

import contact
from contact import Creepage, Separation, damage, stress
from contact.accumulation import Section
from contact.arrays import as_array, require_numbers
from contact.errors import ContactError, require_number
from contact.friction import Friction
from contact.geometry import en15302, profile, rigid
from contact.geometry.steering import steering
from contact.geometry.surfaces import RailSurface, WheelSurface
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.halfspace.gap import Gap
from contact.pair import WheelRailPair, over_poses
from contact.stress import Endurance, SurfaceLoad
from contact.study.lookup import lookup_table

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
Y = np.linspace(-0.02, 0.02, 5)
GAP = Separation(Y, 0.8 * Y**2, 1.1)
SOLUTION = contact.solve(Separation.hertzian(1.1, 0.8), Creepage(1e-3), load=8e4)
GRID = contact.solve(
    Separation.hertzian(1.1, 0.8), Creepage(1e-3), load=8e4, normal="halfspace", tangential="halfspace", spacing=2e-3
)
POINTS = rigid.contact_points(WHEEL, RAIL, np.linspace(-6e-3, 6e-3, 25))
ONE = WheelRailPair(Pair(WHEEL, RAIL))
SLICE = np.column_stack((RAIL.y, RAIL.z))[::20]
BOX = np.zeros((5, 5))

#: What takes an array of 5 numbers → a call with it.
TAKERS = {
    "Separation y": lambda a: Separation(a, 0.8 * Y**2, 1.1),
    "Separation g": lambda a: Separation(Y, a, 1.1),
    "Separation A": lambda a: Separation(Y, 0.8 * Y**2, a),
    "Separation tilt": lambda a: Separation(Y, 0.8 * Y**2, 1.1, tilt=a),
    "with_gap": lambda a: GAP.with_gap(a, 1.1),
    "Gap x": lambda a: Gap(a, Y, BOX),
    "Gap h": lambda a: Gap(Y, Y, [a] * 5),
    "forces load": lambda a: contact.forces(GAP, Creepage(), load=a),
    "forces creepage": lambda a: contact.forces(GAP, (a, 0.0, 0.0), load=8e4),
    "forces friction": lambda a: contact.forces(GAP, Creepage(), load=8e4, friction=a),
    "forces speed": lambda a: contact.forces(GAP, Creepage(), load=8e4, speed=a),
    "over_poses y": lambda a: over_poses(ONE, y=a, load=8e4),
    "over_poses load": lambda a: over_poses(ONE, load=a),
    "run column": lambda a: ONE.run({"time": np.arange(5.0), "load": a}),
    "run time": lambda a: ONE.run({"time": a, "load": 8e4}),
    "Pair samples": lambda a: Pair(WHEEL, RAIL, samples=a),
    "Profile y": lambda a: profile.Profile("rail", a, Y),
    "Profile z": lambda a: profile.Profile("rail", Y, a),
    "Profile angle": lambda a: profile.Profile("rail", Y, Y, a),
    "contact_points": lambda a: rigid.contact_points(WHEEL, RAIL, a),
    "amplitudes": lambda a: en15302.equivalent_conicity(POINTS, a),
    "steering": lambda a: steering(POINTS, a),
    "RailSurface s": lambda a: RailSurface(a, [SLICE] * 5),
    "RailSurface slice": lambda a: RailSurface([0.0], [np.ma.stack((a, a), axis=1)]),
    "RailSurface features": lambda a: RailSurface([0.0], [SLICE], features=[a]),
    "from_deviations y": lambda a: WheelSurface.from_deviations([0.0], a, [Y]),
    "from_deviations dr": lambda a: WheelSurface.from_deviations([0.0], Y, [a]),
    "friction over speed": lambda a: Friction(0.3).coefficient(a),
    "friction over y": lambda a: Friction(0.3).factor(a),
    "pressure of strips": lambda a: SOLUTION.pressure(a, 0.0),
    "pressure of elements": lambda a: GRID.pressure(0.0, a),
    "stress": lambda a: stress.at(SOLUTION, a, 0.0, 1e-3),
    "depth": lambda a: stress.at(SOLUTION, 0.0, 0.0, a),
    "load p": lambda a: SurfaceLoad(Y, Y, [a] * 5),
    "load qx": lambda a: SurfaceLoad(Y, Y, BOX, [a] * 5),
    "endurance": lambda a: Endurance(3e8, 10.0, 1e6).damage(a),
    "section": lambda a: Section(RAIL, Endurance(3e8, 10.0, 1e6), a),
    "burstow": damage.burstow,
    "usfd": lambda a: damage.usfd(a, 1e-4),
    "T gamma": lambda a: damage.t_gamma(a, 0.0, 1e-3, 0.0),
    "breakpoints": lambda a: lookup_table(ONE, {"y": a}, load=8e4),
}
MASKED = np.ma.masked_array([1.0, 2.0, 3.0, 4.0, 5.0], mask=[0, 0, 1, 0, 0])
WRONG = {
    "masked": MASKED,
    "complex": np.arange(1.0, 6.0) + 1j,
    "text": np.array(["1", "2", "3", "4", "5"]),
    "bool": np.array([True, False, True, True, True]),
    "missing": np.array([1.0, None, 3.0, 4.0, 5.0], dtype=object),
    "text among numbers": np.array([1.0, "2", 3.0, 4.0, 5.0], dtype=object),
    "dates": np.array(["2020-01-01"] * 5, dtype="M8[D]"),
    "ragged": [1.0, [2.0, 3.0], 4.0, 5.0, 6.0],
}


@pytest.fixture(autouse=True)
def _no_warning_of_numpy():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", contact.errors.PlausibilityWarning)
        yield


@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("taker", TAKERS)
def test_what_is_no_array_of_numbers_is_refused_by_name(taker, wrong):
    if taker == "RailSurface slice" and wrong == "ragged":
        pytest.skip("the test itself stacks the columns")
    with pytest.raises(ContactError, match=r"\w.* is (masked|not an array of numbers)|= .* is not a number"):
        TAKERS[taker](WRONG[wrong])


def test_a_masked_array_without_masked_values_is_taken():
    g = np.ma.masked_array(0.8 * Y**2, mask=False)
    plain = contact.solve(Separation(Y, 0.8 * Y**2, 1.1), Creepage(), load=2e3).max_pressure
    assert contact.solve(Separation(np.ma.asarray(Y), g, 1.1), Creepage(), load=2e3).max_pressure == plain
    assert not isinstance(as_array("g", g), np.ma.MaskedArray)


@pytest.mark.parametrize(
    "nothing", [np.ma.masked, np.ma.masked_array(1.0, mask=True), np.ma.masked_array([1.0, 2.0], mask=True)[0]]
)
def test_a_masked_number_is_refused(nothing):
    for call in (
        lambda: contact.solve(GAP, Creepage(), load=nothing),
        lambda: Creepage(nothing),
        lambda: Pose(y=nothing),
        lambda: Velocity(nothing),
        lambda: Friction(nothing),
    ):
        with pytest.raises(ContactError, match="is masked"):
            call()


@pytest.mark.parametrize(
    "value", [True, np.True_, 1 + 0j, np.complex64(1), np.array(1j), np.array(True), "1", b"1", None, [1.0]]
)
def test_what_is_no_real_number_is_refused_by_name(value):
    with pytest.raises(ContactError, match=r"^load = .* is not a number"):
        require_number("load", value)


def test_numbers_of_any_library_are_taken():
    for values in ([1, 2.5], (1, Decimal("2.5")), np.float32([1, 2.5]), np.array([1, 2.5], dtype=object), range(1, 3)):
        assert as_array("a", values).dtype == np.float64
    pandas = pytest.importorskip("pandas")
    np.testing.assert_array_equal(as_array("a", pandas.Series([1.0, 2.5])), [1.0, 2.5])
    np.testing.assert_array_equal(as_array("a", pandas.Series([1, 2], dtype="Int64")), [1.0, 2.0])
    with pytest.raises(ContactError, match=r"^a\[1\] = (<NA>|nan) is not (a number|finite)"):
        require_numbers("a", pandas.Series([1.0, None], dtype="Float64"))
    with pytest.raises(ContactError, match=r"^a\[1\] = nan is not finite"):
        require_numbers("a", pandas.Series([1.0, None]))


def test_points_whose_shapes_do_not_broadcast_are_refused():
    for call in (SOLUTION.pressure, GRID.pressure, lambda x, y: stress.at(SOLUTION, x, y, 1e-3)):
        with pytest.raises(ContactError, match=r"shapes do not broadcast: x \(2,\), y \(3,\)"):
            call([0.0, 0.0], [0.0, 0.0, 0.0])


#: Conversions of what is no array of a user.
OWN = (
    "contact/arrays.py", "contact/reading/columns.py", "contact/view/notebook.py",
    "contact/accumulation/histogram.py", "contact/halfspace/bent.py", "contact/halfspace/step.py",
    "models/contact_models/wheelset/fmu.py",
)  # fmt: skip


def test_arrays_of_users_have_one_way_in():
    """np.asarray(…, float) drops masks and imaginary parts, reads text and counts truth values; as_array does not."""
    converted = re.compile(
        r"np\.(asarray|array|asanyarray|ascontiguousarray)\(\w[\w.\[\]'\"]*, (dtype=)?(np\.float64|float)\b"
    )
    root = Path(contact.__file__).parents[1]
    found = set()
    for folder in ("contact", "models"):
        for path in (root / folder).rglob("*.py"):
            name = path.relative_to(root).as_posix()
            if "/kernels/" not in name and converted.search(path.read_text(encoding="utf-8")):
                found.add(name)
    assert found <= set(OWN)
    assert converted.search("np.asarray(values[name], dtype=np.float64)")


def test_an_array_given_is_copied():
    given = np.array(Y)
    assert not np.shares_memory(as_array("y", given), given)
