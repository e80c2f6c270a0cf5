"""Module 1 of CONTACT's files in time and beyond a rigid wheel on a rail: against module 3, steady rolling, closed forms."""

import numpy as np
import pytest

from contact import inp
from contact.inp.reasons import REASONS
from contact.theory.hertz import hertz
from tests.inp.data import HEAD

#: A wheel of 100 mm radius with a plane tread, alone on a rail with a circular top of 100 mm. Blocks of a first case, and of
#: one that follows; {} are the control words and the lines of position, velocity and flexible wheel.
FIRST = """ {words}
  999 100 30 1 1e-6
  0.3 0.3
  0.28 0.28 82000. 82000.
{layer}  0.2 0.2 {dqrel} 90d 8.0 4.0
  0.0 0.0 0.0 {cant}
  'circle.txt' 0 1.0 0.0 -1
  {rail}
{springs}  0.0 0.0 100.0
  'plane.txt' 0 1.0 0.0 -1
"""
OPTIONS = {"layer": "", "dqrel": "1.0", "cant": "0.0", "rail": "0. 0. 0. 0. 0. 0.", "springs": ""}
REST = "0. 0. 0. 0. 0. 0."
#: Positions with an approach of .04 mm and under 300 N, and rolling at 1 m/s.
NEAR, LOADED = "0. 0. 0.04 0. 0. 0.", "0. 0. 300. 0. 0. 0."
ROLLING = "1000. 0. 0. 0. 0. -10.0"


def points(y, z):
    return "\n".join(f"{a:.9f} {b:.9f}" for a, b in zip(y, z, strict=True))


def sequence(folder, *cases, change=(), wheel=None, **options):
    """Return the results of cases that follow each other: first word, lines of position and velocity, of a flexible wheel too.

    `change` holds pairs of a text and what is written in its place, `wheel` the points of another wheel.
    """
    t = np.linspace(-0.3, 0.3, 121)
    folder.joinpath("circle.txt").write_text(points(100 * np.sin(t), 100 - 100 * np.cos(t)))
    folder.joinpath("plane.txt").write_text(wheel or points(np.linspace(30, -30, 121), np.zeros(121)))
    text = " 1\n"
    for k, (first, *lines) in enumerate(cases):
        second = ("0111002", "0111004", "0022033", "0022035")[2 * (k == 0) + (len(lines) > 2)]
        control = f"{first}\n {second}\n {'00' if k == 0 else '01'}0032{int(k + 1 == len(cases))}"
        text += FIRST.format(words=control, **(OPTIONS | options)) if k == 0 else f" {control}\n"
        text += "".join(f"  {line}\n" for line in lines)
    for old, other in change:
        assert old in text
        text = text.replace(old, other)
    path = folder / "case.inp"
    path.write_text(text + " 0\n")
    return inp.solve(inp.read(path))


def test_shifts_of_a_wheel_are_those_of_the_same_gap_in_module_3(tmp_path):
    again = ("1001000", NEAR, "0. 0.001 0. 0. 0. -3e-5")
    found = sequence(tmp_path, ("1201000", NEAR, "0. 0. 0. 0. 0. 2e-5"), again, again)
    text = HEAD.format(word="201000", second="022020", third="0000321", maxout=1)
    text += " 0.04 -0.002 0. 0.\n 0.3 0.3\n 0.28 0.28 82000. 82000.\n 1\n 29 29 -2.9 -2.9 0.2 0.2\n 1 1\n 0.005 0 0.005 0 0 0\n"
    text += " 3\n 001000\n 100000\n 0100321\n 0.04 0.003 -0.001 0.\n" * 2
    path = tmp_path / "single.inp"
    path.write_text(text + " 0\n")
    same = inp.solve(inp.read(path))
    assert [one.refused for one in (*found, *same)] == [""] * 6
    for one, other in zip(found, same, strict=True):
        a, b = one.patches[0].values, other.patches[0].values
        for name in ("FN", "FX", "FY"):
            assert a[name] == pytest.approx(b[name], abs=1e-3 * b["FN"])
        assert (a["CKSI"], a["PMAX"]) == pytest.approx((b["CKSI"], b["PMAX"]), rel=1e-3)


@pytest.mark.slow
def test_transient_rolling_of_a_wheel_ends_in_steady_rolling(tmp_path):
    lines = LOADED, "1000. 0.5 0. 0. 0. -10.01"
    found = sequence(tmp_path, ("1202100", *lines), *[("1002100", *lines)] * 25, ("1203100", *lines))
    assert not any(one.refused for one in found)
    first, last, steady = (found[k].values for k in (0, -2, -1))
    assert abs(first["FX(TR)"]) < 0.7 * abs(steady["FX(TR)"])
    assert last["FX(TR)"] == pytest.approx(steady["FX(TR)"], rel=0.02)
    assert last["FZ(TR)"] == pytest.approx(300.0, rel=2e-4)


def test_steps_on_a_layer_yield_and_the_shear_stays(tmp_path):
    moves = ("1201000", NEAR, "0. 0. 0. 0. 0. 1e-4"), ("1001000", NEAR, "0. 0. 0. 0. 0. -5e-5")
    hard = sequence(tmp_path, *moves)
    change = ("0022033", "0022433"), ("0111002", "0111402")
    soft = sequence(tmp_path, *moves, change=change, layer="  8200. 0.02 100. 0.\n")
    assert not any(one.refused for one in soft)
    assert abs(soft[0].values["FX(TR)"]) < abs(hard[0].values["FX(TR)"])
    assert soft[0].patches[0].values["NPLAST"] > 0


def test_a_wheel_turned_by_DROLLW_stands_on_its_lowest_point(tmp_path):
    """A plane tread of a wheel that turns about its lowest point is that of a rolled wheelset whose centre is moved."""
    roll, R = 0.02, 100.0
    at = f"0. {R * np.sin(roll):.9f} {0.04 + R * (1.0 - np.cos(roll)):.9f} {roll} 0. 0."
    (rolled,) = sequence(tmp_path, ("1203000", at, ROLLING))
    (flexible,) = sequence(tmp_path, ("1203000", NEAR, ROLLING, f"0. 0. 0. {roll} 0. 0.", REST))
    a, b = rolled.patches[0].values, flexible.patches[0].values
    for name in ("PMAX", "DELTCP(TR)", "FN", "APPROACH", "YCP(R)"):
        assert b[name] == pytest.approx(a[name], rel=1e-6, abs=1e-9)
    assert a["CPHI"] == pytest.approx(10.0 * np.sin(roll - a["DELTCP(TR)"]), abs=1e-6)
    assert b["CPHI"] == pytest.approx(-10.0 * np.sin(b["DELTCP(TR)"]), abs=1e-4)  # it turns with the wheelset


def test_rates_of_a_flexible_wheel_are_those_of_its_lowest_point(tmp_path):
    a = sequence(tmp_path, ("1203000", NEAR, ROLLING, REST, "0. 1. 0. 0.01 0. 0.002"))[0].patches[0].values
    assert a["CETA"] == pytest.approx(-1e-3, rel=1e-3)
    assert a["CKSI"] == pytest.approx(0.0, abs=1e-6)


def test_a_wheel_on_a_roller_has_the_curvature_and_the_creepage_of_both(tmp_path):
    """A roller of 150 mm under the wheel of 100 mm; CONTACT refers creepages to the mean of both surfaces' speeds."""
    (found,) = sequence(
        tmp_path, ("5203000", NEAR, "6.68 0. 0. 0. 0. -10.0"), change=[("  0.0 0.0 0.0 0.0\n", "  0.0 0.0 0.0 150.\n")]
    )
    assert found.refused == ""
    values = found.patches[0].values
    wheel, roller = 10.0 * 0.1, 6.68 * 0.15
    assert values["CKSI"] == pytest.approx((wheel - roller) / (0.5 * (wheel + roller)), abs=2e-5)
    exact = hertz(0.5 / 0.1 + 0.5 / 0.15, 0.5 / 0.1, load=values["FN"])
    assert exact.approach == pytest.approx(4e-5, rel=5e-3)


@pytest.mark.slow
def test_given_forces_and_springs_are_in_balance(tmp_path):
    (pulled,) = sequence(tmp_path, ("1203110", "0. 0. 300. 0. 0.01 0.", "1000. 0. 0. 0. 0. 40."))
    assert pulled.values["FX(WS)"] == pytest.approx(40.0, abs=0.05)
    lines = "0. 0. 300. 0. 0.002 0.", ROLLING
    (held,) = sequence(tmp_path, ("1203130", *lines), springs="  1000. 2. 2000. 5. \n")
    assert held.refused == ""
    (rigid,) = sequence(tmp_path, ("1203100", *lines))
    assert held.values["Z_WS"] - rigid.values["Z_WS"] == pytest.approx((300.0 + 5.0) / 2e6, rel=0.01)


def test_a_rail_in_a_curve_moves_under_the_wheel(tmp_path):
    straight, curved = (
        sequence(tmp_path, ("1203000", NEAR, ROLLING), cant=cant)[0].patches[0].values for cant in ("0.0", "0.0 1e-5")
    )
    assert curved["CPHI"] - straight["CPHI"] == pytest.approx(-1e-2, rel=1e-3)


@pytest.mark.parametrize("kind", ["1203000", "1202000"])
@pytest.mark.parametrize("search", [2, 4])
def test_rolling_backwards_is_rolling_forwards_in_a_mirror_across_the_track(tmp_path, kind, search):
    ahead = "0. 0.5 0.03 0.01 0.003 0.", "1000. 1. 0. 0. 0. -10.01"
    back = "0. 0.5 0.03 0.01 -0.003 0.", "-1000. 1. 0. 0. 0. 10.01"
    change = [("0022033", f"00{search}2033")]
    a, b = (
        sequence(tmp_path, (kind, *lines), (kind.replace("120", "100", 1), *lines), change=change)[-1].patches[0].values
        for lines in (ahead, back)
    )
    for name, sign in (("FX", -1.0), ("FY", 1.0), ("FN", 1.0), ("CKSI", -1.0), ("CETA", 1.0), ("CPHI", -1.0)):
        assert b[name] == pytest.approx(sign * a[name], rel=1e-5, abs=1e-9), name


def test_strips_refuse_what_needs_the_half_space_by_name(tmp_path):
    sequence(tmp_path, ("1201000", NEAR, REST))
    cases = inp.read(tmp_path / "case.inp")
    assert inp.solve(cases, fast=True)[0].refused == "strips"
    assert set(inp.refusals(cases, fast=True)) <= set(REASONS)


@pytest.mark.parametrize("search", [3, 4])
def test_a_search_on_true_surfaces_gives_a_narrow_patch_the_forces_of_its_plane(tmp_path, search):
    case = "1203000", "0. 0. 0.004 0. 0. 0.", "1000. 0.1 0. 0. 0. -10.002"
    plane = sequence(tmp_path, case)[0].values
    (found,) = sequence(tmp_path, case, change=[("0022033", f"00{search}2033")])
    assert (found.case["SEARCH"], found.refused) == (search, "")
    for name in ("FX(TR)", "FY(TR)", "FZ(TR)"):
        assert found.values[name] == pytest.approx(plane[name], abs=0.01 * plane["FZ(TR)"])


def test_a_sphere_on_a_rail_has_the_same_contact_at_any_roll(tmp_path):
    t, forces = np.linspace(0.4, -0.4, 201), []
    for roll in (0.0, 0.1, 0.25):
        case = "1203000", f"0. 0. 0.03 {roll} 0. 0.", "1000. 0. 0. 0. 0. -10."
        (found,) = sequence(tmp_path, case, wheel=points(100 * np.sin(t), 100 * np.cos(t) - 100))
        assert found.refused == ""
        values = found.patches[0].values
        forces.append(values["FN"])
        assert values["CPHI"] == pytest.approx(10.0 * np.sin(roll) / (0.5 + 0.5 * np.cos(roll)), rel=2e-3, abs=1e-6)
    assert forces[1:] == pytest.approx(forces[:1] * 2, rel=1e-3)


def test_a_yaw_beyond_the_search_is_refused(tmp_path):
    (found,) = sequence(tmp_path, ("1203000", "0. 0. 0.03 0. 0.15 0.", "1000. 0. 0. 0. 0. -10."))
    assert found.refused == "input"
