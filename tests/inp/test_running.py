"""Cases of CONTACT's input files run here: numbers that CONTACT 25.1 prints for its examples, signs, order, refusals."""

import numpy as np
import pytest

import contact
from contact import inp
from contact.geometry import profile
from contact.inp.reasons import REASONS
from tests import damaged
from tests.inp import files
from tests.inp.data import CARTER, HEAD, PRINTED

#: Unlike bodies in free rolling, towards -x; first with given creepage and one turn (CONTACT 25.1, bentall cases 1 and 5).
BENTALL = (
    HEAD.format(word="203100", second="022020", third="0001341", maxout=1)
    + """ 16201.9 0.00052 0. 0.
 1e-4 1e-4
 180d 0.001 1000.
 0.31 0.28 23000. 82000.
 1
 216 1 -0.108 -500. 0.001 1000.
 1 1
 0.02 0 0 0 0 0
"""
    + HEAD.format(word="203110", second="000000", third="0001341", maxout=10)
    + """ 16201.9 0.75 0. 0.
 0.05 0.05
 0 MODULE
"""
)


def run(tmp_path, text, **options):
    path = tmp_path / "case.inp"
    path.write_text(text, encoding="latin-1")
    return inp.solve(inp.read(path), **options)


def test_one_row_of_elements_is_contacts_carter(tmp_path):
    """carter2d.ref_out: FX 6955 N, approach 6.492e-3 mm, PMAX 113.9 MPa, energy .1162 J, power -47.62 W."""
    (result,) = run(tmp_path, CARTER)
    values = result.patches[0].values
    assert values["FX"] == pytest.approx(6955.0, abs=1.0)
    assert values["APPROACH"] == pytest.approx(6.492e-6, rel=1e-4)
    assert values["PMAX"] == pytest.approx(113.9e6, rel=2e-4)
    assert values["ELAST.EN."] == pytest.approx(0.1162, rel=1e-3)
    assert values["FRIC.POWER"] == pytest.approx(-47.62, rel=1e-3)


def test_unlike_cylinders_rolling_backwards_are_contacts(tmp_path):
    """bentall.ref_out case 5 (friction .05, FX .75): FX 607.6 N, creepage 2.108e-4, approach 2.080e-3 mm."""
    first, fifth = run(tmp_path, BENTALL)
    assert first.status in ("ok", "saturated")
    values = fifth.patches[0].values
    assert values["FX"] == pytest.approx(607.6, abs=0.1)
    assert values["CKSI"] == pytest.approx(2.108e-4, rel=5e-4)
    assert values["APPROACH"] == pytest.approx(2.080e-6, rel=1e-3)


def test_rolling_backwards_is_rolling_forwards_turned(tmp_path):
    text = files.CONTACT.replace("0.0040 0.0 0.0105   0.0", "0.0040 0.0 0.0105 0.001").replace(
        "0.0 0.0    ", "0.002 0.0  "
    )
    turned = text.replace("   0.0     0.5   30d3 ", "   180d  0.5   30d3 ").replace("0.0105 0.001", "0.0105 -0.001")
    turned = turned.replace("0.002 0.0  ", "-0.002 0.0  ").replace("-.001   0.0   .2-03", ".001   0.0   .2-03")
    ahead, back = run(tmp_path, text)[0].patches[0].values, run(tmp_path, turned)[0].patches[0].values
    for name in ("FX", "FY"):
        assert back[name] == pytest.approx(-ahead[name], rel=1e-6, abs=1e-3)
    assert back["MZ"] == pytest.approx(ahead["MZ"], rel=1e-5)


def test_rows_have_contacts_names_and_signs_or_ours(tmp_path):
    results = run(tmp_path, files.CONTACT)
    theirs, ours = inp.table(results, "contact"), inp.table(results)
    assert [(row["case"], row["patch"]) for row in theirs] == [(1, 0), (1, 1), (2, 0), (2, 1)]
    one, other = theirs[1], ours[1]
    assert one["FX [N]"] == -other["Fx [N]"]
    assert one["PMAX [MPa]"] == pytest.approx(1e-6 * other["max_pressure [Pa]"])
    assert one["CKSI"] == pytest.approx(-0.001)
    assert other["longitudinal"] == pytest.approx(0.001)
    assert one["CPHI [rad/mm]"] == pytest.approx(2e-4)
    assert one["NCON"] == one["NADH"] + one["NSLIP"]
    with pytest.raises(contact.ContactError, match="signs = 'mine'"):
        inp.table(results, "mine")


def test_strips_are_near_the_half_space(tmp_path):
    grid, strips = run(tmp_path, files.CONTACT), run(tmp_path, files.CONTACT, fast=True)
    for one, other in zip(grid, strips, strict=True):
        a, b = one.patches[0].values, other.patches[0].values
        miss = np.hypot(a["FX"] - b["FX"], a["FY"] - b["FY"])
        assert miss < 0.02 * 0.3 * a["FN"]
        assert b["PMAX"] == pytest.approx(a["PMAX"], rel=0.02)
    assert inp.read(tmp_path / "case.inp")[1].solve().patches[0].values == grid[1].patches[0].values


def test_cases_on_several_processes_are_those_of_one(tmp_path):
    one, two = run(tmp_path, files.CONTACT), run(tmp_path, files.CONTACT, workers=2)
    assert inp.table(one) == inp.table(two)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("  022020     L-D-C-M-Z-E", "  023020", "bilinear"),
        ("  203100     P", "  243100     P", "given pressure"),
        ("   0.0     0.5   30d3 ", "   45d   0.5   30d3 ", "direction"),
        ("   0.0     0.5   30d3 ", "   0.0     0.5   30d3  0.0 ", "place of spin"),
        ("   0.0     0.5   30d3 ", "   0.0     0.5   30d3  .1667 ", ""),
        ("  20 12 ", "  1900 1900 ", "memory"),
        ("   1  1\n", "   1  1\n", ""),
    ],
)
def test_what_cannot_run_is_refused_by_a_named_reason(tmp_path, old, new, reason):
    assert old in files.CONTACT
    result = run(tmp_path, files.CONTACT.replace(old, new, 1))[0]
    assert result.refused == reason
    if reason:
        assert reason in REASONS
        assert "case.inp, line 3, case 1" in result.message
        assert "\n" not in result.message
        assert result.rows("contact")[0]["refused"] == reason


def test_a_contact_that_its_grid_cuts_off_is_out_of_range_with_a_reason(tmp_path):
    for old, new in (("20 12  -8.0", "8 12  -3.2"), ("20 12  -8.0 = -4.8", "20 12  -8.0 = -1.6")):
        first, *_ = run(tmp_path, files.CONTACT.replace(old, new))
        assert first.status == "out of range"
        assert "reaches the end of the grid" in first.message
    first, *_ = run(tmp_path, files.CONTACT)
    assert (first.status, first.message) == ("ok", "")


def test_cases_that_continue_a_refused_case_are_refused(tmp_path):
    text = files.CONTACT.replace("  022020     L-D-C-M-Z-E", "  023020", 1)
    text = text.replace("  203100\n  100000", "  001100\n  100000")
    assert [result.refused for result in run(tmp_path, text)] == ["bilinear", "follows a refused case"]


def test_damaged_files_end_in_a_result_or_one_line(tmp_path):
    path, told = tmp_path / "case.inp", 0
    for copy in damaged.of_text(files.CONTACT.encode(), 20):
        path.write_bytes(copy)
        try:
            results = inp.solve(inp.read(path), memory=1e7)
        except contact.ContactError as error:
            told += "\n" not in str(error)
            continue
        for result in results:
            assert result.refused in REASONS or (
                result.refused == "" and bool(result.message) == (result.status == "out of range")
            )
            assert "\n" not in result.message
            for patch in result.patches:
                assert all(np.isfinite(value) for value in patch.values.values())
    assert told > 5


def test_differences_are_those_from_the_printed_numbers_worst_first(tmp_path):
    results, out = run(tmp_path, CARTER), tmp_path / "case.out"
    out.write_text(PRINTED.format(approach="6.492E-03"))
    differences = inp.compare(results, inp.read_printed(out))
    assert [one.error for one in differences] == sorted((one.error for one in differences), reverse=True)
    assert differences[0].error < 2e-4
    assert inp.worst_of(differences) == {1: differences[0].error}
    out.write_text(PRINTED.format(approach="6.592E-03"))
    worst = inp.compare(results, inp.read_printed(out))[0]
    assert (worst.name, worst.case, worst.patch) == ("APPROACH", 1, 1)
    assert worst.error == pytest.approx(0.0152, abs=1e-4)
    out.write_text(PRINTED.format(approach="6.492E-03").replace("Case     1", "Case     7"))
    with pytest.raises(contact.ContactError, match="no case is in the printed results"):
        inp.compare(results, inp.read_printed(out))


def test_files_of_elements_have_a_row_for_each_element_in_contact(tmp_path):
    results = run(tmp_path, files.CONTACT, fields=True)
    first, second = inp.write_elements(results, tmp_path)
    assert (first.name, second.name) == ("case.0001.mat", "case.0002.mat")
    lines = [line for line in first.read_text().splitlines() if not line.startswith("%")]
    head, rows = lines[:6], np.array([[float(word) for word in line.split()] for line in lines[6:]])
    assert [len(line.split()) for line in head] == [11] * 6
    values = results[0].patches[0].values
    assert rows.shape == (int(values["NCON"]), 11)
    assert (rows[:, 1] == 1).sum() == values["NADH"]
    assert rows[:, 4].sum() * 0.8 * 0.8 == pytest.approx(values["FN"], rel=1e-6)
    assert rows[:, 5].sum() * 0.8 * 0.8 == pytest.approx(values["FX"], rel=1e-5)
    mu = rows[:, 3]
    assert (np.hypot(rows[:, 5], rows[:, 6]) <= mu * rows[:, 4] * (1 + 1e-6)).all()
    with pytest.raises(contact.ContactError, match="is not a folder"):
        inp.write_elements(results, tmp_path / "none")


def test_fastsim_has_kalkers_slope_and_saturates(tmp_path):
    """CONTACT 25.1, tractcurv.ref_out cases 61, 70, 75: FX -250.9, -34910, -35210 N."""
    text = HEAD.format(word="233100", second="022320", third="0001341", maxout=1)
    text += """ 106700. {} 0. 0.
 0.33 0.33
 0. 0.5 10000.
 0.28 0.28 82000. 82000.
 1. 1. 1.
 -2
 48 44 0.0008 0.5 1.1
 0 MODULE
"""
    for creepage, force in ((1e-5, -250.9), (0.0036, -34910.0), (0.0056, -35210.0)):
        (result,) = run(tmp_path, text.format(creepage))
        assert result.patches[0].values["FX"] == pytest.approx(force, rel=3e-4)


def columns(one):
    return "\n".join(f"{1e3 * y:.9f} {1e3 * z:.9f}" for y, z in zip(one.y, one.z, strict=True))


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """Return the results of a left and a right wheel at mirrored poses, and that of `contact.pair` of the latter."""
    folder = tmp_path_factory.mktemp("pair")
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=0)
    for name, one in (("wheel.txt", wheel), ("rail.txt", rail)):
        (folder / name).write_text(columns(one))
    text = files.PAIR.replace("profiles/rail.prr", "rail.txt").replace("profiles/wheel.prw", "wheel.txt")
    text = text.replace("0.0  2.0  125000. 0.000  -0.1d", "0.0  -2.5  80000. 0.000  0.001")
    text = text.replace("0.0  2.5  125000. 0.000  0.000   -26.0d", "0.0  2.5  80000. 0.000  -0.001   0.0").replace(
        "1.0   0.0\n  0.0", "1.0   0.0   -1\n  0.0"
    )
    text = text.replace("0.400   0.400", "0.600   0.600").replace("-4.08190679", "-4.34")
    (folder / "pair.inp").write_text(text)
    return inp.solve(inp.read(folder / "pair.inp")), wheel, rail


def test_left_and_right_wheel_mirror_each_other(pair):
    (left, right), _, _ = pair
    assert left.values["FX(TR)"] == pytest.approx(right.values["FX(TR)"], rel=1e-6)
    assert left.values["FY(TR)"] == pytest.approx(-right.values["FY(TR)"], rel=1e-6)
    a, b = left.patches[0].values, right.patches[0].values
    for name, sign in (("FX", 1), ("FY", -1), ("MZ", -1), ("CKSI", 1), ("CETA", -1), ("CPHI", -1), ("YCP(R)", -1)):
        assert a[name] == pytest.approx(sign * b[name], rel=1e-6, abs=1e-12)


def test_a_pair_of_a_file_carries_its_vertical_force_on_canted_rails(pair):
    (_, right), wheel, rail = pair
    assert right.values["FZ(TR)"] == pytest.approx(80e3, rel=2e-4)
    made = contact.geometry.wheelset.Pair(wheel, rail.rotated(-0.02), nominal_radius=0.46)
    velocity = contact.geometry.wheelset.Velocity(2.0, spin=-4.34)
    pose = contact.geometry.wheelset.Pose(y=2.5e-3, yaw=-0.001)
    strips = contact.pair.WheelRailPair(made).solve(pose, velocity, vertical=80e3, friction=0.3)
    assert right.values["Z_WS"] == pytest.approx(strips.z, abs=1e-6)
    assert right.values["FX(TR)"] == pytest.approx(-strips.force[0], abs=0.01 * 24e3)
    assert right.values["FY(TR)"] == pytest.approx(-strips.force[1], abs=0.01 * 24e3)


def test_strips_on_slices_are_not_trusted(tmp_path):
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=0)
    (tmp_path / "rail.txt").write_text(columns(rail))
    (tmp_path / "slice.txt").write_text(columns(wheel))
    (tmp_path / "wheel.slcw").write_text("0.0 1.0\n2\n0 0 0\n1\n-0.1 'slice.txt'\n0.1 'slice.txt'\n")
    text = files.PAIR.replace("profiles/rail.prr", "rail.txt").replace(
        "'profiles/wheel.prw'   0   1.0   0.0", "'wheel.slcw' 0 1.0 0.0 -1"
    )
    text = text.replace("0.0  2.0  125000. 0.000  -0.1d", "0.0  -2.5  80000. 0.000  0.001")
    grid, strips = run(tmp_path, text)[0], run(tmp_path, text, fast=True)[0]
    assert grid.status in ("ok", "saturated")
    assert strips.status == "doubtful gap"
    assert strips.patches[0].values["FN"] == pytest.approx(grid.patches[0].values["FN"], rel=1e-3)


def test_a_missing_profile_is_told_with_its_line(tmp_path):
    result = run(tmp_path, files.PAIR)[0]
    assert result.refused == "input"
    assert "WFNAME in line 13" in result.message
    assert "\n" not in result.message
