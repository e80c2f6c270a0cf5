"""Input that is allowed but hardly meant gives a warning that names its unit or its sign; errors name the likely slip."""

import math
import warnings

import numpy as np
import pytest

import contact
from contact import ContactError
from contact.errors import PlausibilityWarning, ProfileWarning
from contact.geometry import profile
from contact.geometry.surfaces import SurfacePair
from contact.geometry.wheelset import Pair, Pose, Velocity, contacts
from contact.pair import HalfspacePair, RollerRig, WheelRailPair

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
LIGHT = r"^{} = 80: a wheel carries 20 to 150 kN; the unit is N$"
BACKWARD = r"^velocity\.spin = 43\.4783: longitudinal creepage = 2: .*spin is negative when rolling forward"


@pytest.fixture(scope="module")
def solver():
    return WheelRailPair(Pair(WHEEL, RAIL), normal="analyn", tangential="fastrip")


def doubts(function, *arguments, **options):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        function(*arguments, **options)
    return [one for one in said if issubclass(one.category, PlausibilityWarning)]


def test_a_wheel_load_in_kilonewton_is_doubted(solver):
    with pytest.warns(PlausibilityWarning, match=LIGHT.format("load")) as said:
        contacts(WHEEL, RAIL, Pose(), load=80)
    assert said[0].filename == __file__
    for name in ("load", "vertical"):
        solver.pair._doubted.clear()
        with pytest.warns(PlausibilityWarning, match=LIGHT.format(name)) as said:
            solver.solve(Pose(), **{name: 80})
        assert said[0].filename == __file__
    for load in (0.0, 1e3, 80e3):
        assert not doubts(contacts, WHEEL, RAIL, Pose(), load=load)


def test_a_run_with_small_loads_warns_once(solver):
    solver.pair._doubted.clear()
    said = [doubts(solver.solve, Pose(), load=load) for load in (80e3, 500.0, 400.0, 300.0)]
    assert [len(one) for one in said] == [0, 1, 0, 0]
    for pose, friction in ((Pose(y=0.03), 0.3), (Pose(), 30.0)):  # another argument is another doubt
        assert [len(doubts(solver.solve, pose, load=500.0, friction=friction)) for _ in range(2)] == [1, 0]


def test_a_wheel_that_lies_a_millimetre_inside_its_rail_is_doubted(solver):
    z = solver.solve(Pose(), load=80e3).z
    assert not doubts(solver.solve, Pose(z=z + 1e-4))
    for told in (1, 0):  # once
        said = doubts(solver.solve, Pose(z=z + 1.5e-3))
        assert [str(one.message).partition(" = ")[0] for one in said] == ["Q"] * told
    for entry in (contact.solve, contact.forces, contact.Solver().solve):
        (said,) = doubts(entry, contact.Separation.hertzian(1.1, 0.8), (1e-3, 0.0, 0.0), approach=1.5e-3)
        assert str(said.message).startswith("N = ")


def test_a_diameter_given_as_a_radius_is_doubted():
    text = "{} = 0.92: a railway wheel has 0.15 to 0.65 m; is it the diameter?"
    sol = contact.solve(contact.Separation.hertzian(1.1, 0.8), (1e-3, 0.0, 0.0), load=80e3)
    for entry, name in ((lambda radius: Pair(WHEEL, RAIL, nominal_radius=radius), "nominal_radius"),
                        (lambda radius: contact.damage.evaluate(sol, radius), "wheel_radius")):  # fmt: skip
        assert [str(said.message) for said in doubts(entry, 0.92)] == [text.format(name)]
        assert not doubts(entry, 0.65)
        assert not doubts(entry, 0.092)  # a roller rig of 1:5


ELEMENTS = SurfacePair(WHEEL, RAIL, rows=20, columns=20)


@pytest.mark.parametrize("of", [WheelRailPair, lambda pair: RollerRig(pair, 0.6), lambda pair: HalfspacePair(ELEMENTS)])
def test_every_pair_doubts_load_friction_and_pose(of):
    pair = of(Pair(WHEEL, RAIL))
    for pose, options, said in (
        (Pose(), {"load": 80}, LIGHT.format("load")),
        (Pose(), {"load": 80e3, "friction": 30}, r"^friction = 30: steel on steel has 0\.05 to 0\.6"),
        (Pose(y=0.02), {"load": 80e3}, r"^pose\.y = 0\.02: a flange touches"),
    ):
        with pytest.warns(PlausibilityWarning, match=said):
            pair.solve(pose, Velocity(20.0), **options)


SEPARATION = contact.Separation.hertzian(1.1, 0.8)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"load": 80}, r"^load = 80: .*is it in kN\?"),
        ({"approach": 0.1}, r"^approach = 0\.1: .*the unit is m"),
        ({"load": 80e3, "speed": 300}, r"^speed = 300: .*km/h"),
        ({"load": 80e3, "friction": 30}, r"^friction = 30: "),
        ({"load": 80e3, "creepage": (2, 0, 0)}, r"^creepage\.longitudinal = 2: .*per mille"),
    ],
)
@pytest.mark.parametrize("of", ["solve", "forces", "Solver"])
def test_every_entry_doubts_the_same_arguments(of, options, said):
    arguments = {"creepage": (1e-3, 0.0, 0.0)} | options
    entry = contact.Solver().solve if of == "Solver" else getattr(contact, of)
    throw = {} if entry is contact.forces else {"throw": False}
    with pytest.warns(PlausibilityWarning, match=said) as found:
        entry(SEPARATION, **arguments, **throw)
    doubted = [each for each in found if each.category is PlausibilityWarning]
    assert {each.filename for each in doubted} == {__file__}
    if of == "Solver":
        assert not doubts(entry, SEPARATION, **arguments, **throw)  # a run in time is told once
    else:
        assert not doubts(entry, SEPARATION, (1e-3, 0.0, 0.0), load=80e3)


def test_rolling_in_steps_doubts_them_too():
    patch = contact.Transient(SEPARATION, load=80.0, speed=300.0, spacing=1e-3)
    for step, said in (
        (lambda: patch.shift(5e-3), ["load", "speed", "shift"]),
        (lambda: patch.roll((2.0, 0.0, 0.0), distance=1e-4), ["creepage.longitudinal"]),
        (lambda: patch.roll_on((2.0, 0.0, 0.0)), []),
    ):
        assert [str(one.message).partition(" = ")[0] for one in doubts(step)] == said


def test_a_solver_doubts_every_call_and_each_argument_once():
    solve, rolling = contact.Solver().solve, (1e-3, 0.0, 0.0)
    each = [
        {"load": 80e3},
        {"load": 80.0},
        {"load": 70.0},
        {"load": 80e3, "speed": 300.0},
        {"load": 80.0, "speed": 300.0},
    ]
    assert [len(doubts(solve, SEPARATION, rolling, **options)) for options in each] == [0, 1, 0, 1, 0]


def test_arrays_are_doubted_once_with_the_place_and_the_number():
    with pytest.warns(PlausibilityWarning, match=r"^load\[1, 0\] = 80: .*\(2 of 4 values\)$") as said:
        contact.forces(SEPARATION, (1e-3, 0, 0), load=[[80e3, 90e3], [80, 90]])
    assert len(said) == 1


def test_lengths_in_millimetres_are_doubted_in_a_separation():
    with pytest.warns(PlausibilityWarning, match=r"^A = 0\.001: .*the unit is 1/m"):
        contact.Separation.hertzian(0.001, 0.0008)
    with pytest.warns(PlausibilityWarning, match=r"^extent of y = 20: .*the unit is m"):
        contact.Separation([-10.0, 0.0, 10.0], [1.0, 0.0, 1.0], 1.1)
    with pytest.warns(PlausibilityWarning, match=r"^shear_modulus = 82: .*the unit is Pa"):
        contact.Material(82.0, 0.28)


@pytest.mark.parametrize(
    ("kind", "change", "said"),
    [
        ("wheel", lambda y, z: (y, -z), "wheel is upside down, its flange points upwards; z points down: give -z"),
        ("rail", lambda y, z: (y, -z), "rail is upside down, its crown lies lowest; z points down: give -z"),
        ("wheel", lambda y, z: (-y[::-1], z[::-1]), r"flange lies on the field side, .*give -y\[::-1\] and z\[::-1\]"),
        ("wheel", lambda y, z: (y[::-1], z[::-1]), "y falls from the first point to the last"),
        ("wheel", lambda y, z: (1e3 * y, 1e3 * z), "129 m wide, .*the unit is m"),
        ("rail", lambda y, z: (y / 0.0254, z / 0.0254), "m wide, .*the unit is m"),
    ],
)
def test_arrays_that_lie_wrong_are_doubted_in_a_profile(kind, change, said):
    shape = WHEEL if kind == "wheel" else RAIL
    with pytest.warns(PlausibilityWarning, match=said) as found:
        profile.Profile(kind, *change(shape.y, shape.z))
    assert len(found) == 1
    assert found[0].filename == __file__


def test_a_profile_of_the_other_kind_is_doubted():
    with pytest.warns(PlausibilityWarning, match="shape of a wheel: .*kind = 'rail' must be 'wheel'"):
        profile.Profile("rail", WHEEL.y, WHEEL.z)


@pytest.mark.parametrize("kind", ["wheel", "rail"])
def test_no_standard_profile_is_doubted(kind):
    for name in profile.names(kind):
        found = profile.named(name, kind=kind)
        assert not doubts(profile.Profile, kind, found.y, found.z, found.angle)
        assert not doubts(profile.Profile, kind, found.y, found.z)


def test_solve_and_forces_take_the_same_forms_of_creepage():
    forms = contact.Creepage(1e-3, 2e-3, 0.1), (1e-3, 2e-3, 0.1), [1e-3, 2e-3, 0.1], np.array([1e-3, 2e-3, 0.1])
    known = contact.solve(SEPARATION, forms[0], load=80e3)
    for form in forms:
        one, many = contact.solve(SEPARATION, form, load=80e3), contact.forces(SEPARATION, form, load=80e3)
        assert (one.Fx, one.Fy, one.Mz) == (known.Fx, known.Fy, known.Mz) == (many.Fx, many.Fy, many.Mz)
        assert contact.Solver().forces(SEPARATION, form, load=80e3).Fx == known.Fx
    assert contact.forces(SEPARATION, [forms[0]] * 2, load=80e3).Fx.tolist() == [known.Fx] * 2
    for entry in (contact.solve, contact.forces):
        for wrong in (None, 1e-3, (1e-3, 0.0), "abc", np.zeros(2), np.array(1e-3)):
            with pytest.raises(ContactError, match=r"^creepage"):
                entry(SEPARATION, wrong, load=80e3)


def test_a_wrong_sign_of_the_axles_spin_is_doubted(solver):
    motion = Velocity(forward=20.0, spin=20.0 / 0.46)
    with pytest.warns(PlausibilityWarning, match=BACKWARD):
        contacts(WHEEL, RAIL, Pose(), motion, load=80e3)
    solver.pair._doubted.clear()
    with pytest.warns(PlausibilityWarning, match=BACKWARD):
        solver.solve(Pose(), motion, load=80e3)
    for spin in (-20.0 / 0.46, -28.0 / 0.46, None):  # free, driven with a slip of .4
        assert not doubts(contacts, WHEEL, RAIL, Pose(), Velocity(forward=20.0, spin=spin), load=80e3)
    assert not doubts(contacts, WHEEL, RAIL, Pose(), Velocity(forward=0.0, spin=1.0), load=80e3)


def test_velocities_in_other_units_are_doubted(solver):
    for part, value in (("y", 5.0), ("z", -20.0), ("roll", 5.0), ("yaw", -8.0)):  # mm/s, degrees/s
        solver.pair._doubted.clear()
        with pytest.warns(PlausibilityWarning, match=rf"^velocity\.{part} = {value:g}: .*the unit is "):
            solver.solve(Pose(), Velocity(forward=20.0, **{part: value}), load=80e3)
    assert not doubts(contacts, WHEEL, RAIL, Pose(), Velocity(20.0, y=0.5, z=0.5, roll=0.5, yaw=0.5), load=80e3)


def test_errors_name_the_likely_slip():
    with pytest.raises(ContactError, match=r"^pose\.y = 3: .*\]-0\.\d+, 0\.\d+\[ m; is it in mm\?$"):
        contacts(WHEEL, RAIL, Pose(y=3), load=80e3)
    with pytest.raises(ContactError, match=r"^pose\.y = nan is not finite$"):
        Pose(y=math.nan)
    (patch,) = contacts(WHEEL, RAIL, Pose(), load=80e3)
    with pytest.raises(ContactError, match=r"^separation is a Patch; use patch\.separation$"):
        contact.solve(patch, patch.creepage, load=80e3)


@pytest.mark.parametrize(("unit", "size"), [("inch", 0.0254), ("cm", 1e-2)])
def test_the_unit_of_a_file_is_found_where_another_one_is_given(tmp_path, unit, size):
    points = "\n".join(f"{y / size:.9f} {z / size:.9f}" for y, z in zip(WHEEL.y, WHEEL.z, strict=True))
    (path := tmp_path / "wheel.txt").write_text(points)
    read = profile.read(path, kind="wheel", unit=unit, side="right")
    assert abs(read.z - WHEEL.z).max() < 1e-9
    with pytest.raises(ContactError, match=rf"m wide, outside the range .*set unit to '{unit}'"):
        profile.read(path, kind="wheel", unit="m", side="right")
    with pytest.warns(ProfileWarning, match=rf"narrow: .*set unit to '{unit}'"):
        profile.read(path, kind="wheel", unit="mm", side="right")
