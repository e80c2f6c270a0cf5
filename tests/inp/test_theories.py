"""CONTACT's own forms of approximate pressures, of simplified theory, and of lobes that act on each other in shares."""

import math
from functools import partial

import numpy as np
import pytest

from contact import inp
from contact.errors import ContactError
from contact.halfspace import Gap, norm
from contact.halfspace.parts import norm_of_parts
from contact.inp import approximate, lobes
from contact.inp.search import turned
from contact.inputs.material import STEEL
from contact.theory.hertz import hertz
from contact.theory.kalker import piecewise
from tests.inp.data import found

#: An ellipse of 8 × 4 mm under spin and lateral creepage (CONTACT 25.1, fastsim cases 2 to 4).
SPIN = """\
 3 MODULE
  2{B}3100
  022{M}20
 0001341
    80   200    5    1      1e-6
   82000.     0.000     -0.000625   0.000625
   0.300      0.300
   0.000      0.400      30000.
   0.280      0.280      82000.     82000.
   {K} 1.000
   -3
   44   44     8.000      4.000      1.100
 0 MODULE
"""


def spin(tmp_path, B=2, M=3, K="1.000 1.000", *change):
    """Return the result of `SPIN` with pairs of a text and what is written in its place."""
    text = SPIN.format(B=B, M=M, K=K)
    for old, new in change:
        text = text.replace(old, new)
    path = tmp_path / "case.inp"
    path.write_text(text)
    return inp.solve(inp.read(path))[0]


@pytest.mark.parametrize(
    ("B", "M", "force", "moment", "stuck"),
    [(3, 3, -15050.0, -39.00, 738), (2, 3, -14800.0, -48.29, 618), (2, 5, -15830.0, -48.16, 626)],
)
def test_simplified_theory_is_contacts(tmp_path, B, M, force, moment, stuck):
    """fastsim.ref_out, cases 2, 3 and 4: FASTSIM on a paraboloid and an ellipsoid, and the modified FaStrip."""
    values = spin(tmp_path, B, M).patches[0].values
    assert values["FY"] == pytest.approx(force, abs=8e-4 * 82000.0)
    assert values["MZ"] == pytest.approx(moment, rel=2e-3)
    assert values["NADH"] == pytest.approx(stuck, abs=6)


def test_a_reduced_slope_lowers_the_force_and_leaves_full_slip(tmp_path):
    whole, reduced = (spin(tmp_path, K=K).patches[0].values["FY"] for K in ("1.000 1.000", "0.500 1.000"))
    assert abs(reduced) < 0.9 * abs(whole)


@pytest.mark.parametrize("M", [3, 5])
@pytest.mark.parametrize(
    "change",
    [
        [("0.000     -0.000625 ", "1e200 -0.000625 ")],
        [("0.300      0.300", "0.000 0.300 0.000 0.000 0.000\n 0. 0."), ("  022", "  222")],
        [("0.300      0.300", "0.000 0.300 1e-9 0.000 0.000\n 0. 0."), ("  022", "  222")],
    ],
    ids=["creepage", "no half slip", "no friction left"],
)
def test_simplified_theory_refuses_numbers_that_have_no_answer(tmp_path, M, change):
    """Before: NaN at status ok, or a ZeroDivisionError."""
    assert spin(tmp_path, 2, M, "1.000 1.000", *change).refused == "input"


def test_a_slope_of_zero_is_refused_by_name(tmp_path):
    with pytest.raises(ContactError, match="K0_MF = 0"):
        spin(tmp_path, K="0.000 1.000")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("M", [3, 5])
def test_simplified_theory_without_creepage_has_no_force(tmp_path, M):
    change = "0.000     -0.000625   0.000625", "0.000 0.000 0.000"
    values = spin(tmp_path, 2, M, "1.000 1.000", change).patches[0].values
    assert values["FX"] == values["FY"] == values["MZ"] == values["NSLIP"] == 0.0


def test_kalkers_table_is_read_as_contact_reads_it():
    """Published rows at Poisson's ratio 1/4, b/a = .5: C11 4.78, C22 4.50, C23 2.23 stand in the row of .6; between, linear."""
    assert piecewise(0.25, 1.0 / 0.6) == pytest.approx((4.78, 4.50, 2.23))
    assert piecewise(0.25, 0.45) == pytest.approx((0.5 * (3.53 + 3.62), 0.5 * (2.88 + 3.01), 0.5 * (0.823 + 0.929)))
    assert piecewise(0.0, 1.0)[0] == pytest.approx(3.40)


def ellipse(A, B, approach, step=1e-4):
    exact = hertz(A, B, approach=approach, material=STEEL)
    x, y = (np.arange(-round(1.6 * k / step), round(1.6 * k / step) + 1) * step for k in (exact.a, exact.b))
    return Gap(x, y, A * x**2 + B * y[:, None] ** 2), exact


@pytest.mark.parametrize("method", [5, 6])
@pytest.mark.parametrize("B", [0.5, 1.0, 3.0])
def test_approximate_pressures_are_hertz_pressure_on_an_ellipse(method, B):
    gap, exact = ellipse(1.0, B, 4e-5)
    p = approximate.pressure(method, gap, 4e-5, STEEL)
    assert p.sum() * gap.dx * gap.dy == pytest.approx(exact.N, rel=0.02)
    assert p.max() == pytest.approx(1.5 * exact.N / (math.pi * exact.a * exact.b), rel=0.02)
    assert (p > 0.0).sum() * gap.dx * gap.dy == pytest.approx(math.pi * exact.a * exact.b, rel=0.02)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("slope", [0.0, 1e-3], ids=["cylinder", "ramp"])
def test_kpec_refuses_a_patch_without_an_ellipse(slope):
    """A cylinder along y, and a ramp whose patch is the border row (before: inf and a ZeroDivisionError)."""
    x = y = np.linspace(-4e-3, 4e-3, 17)
    h = slope * (y[:, None] - y[0]) + (0.0 if slope else 1.0) * x**2
    with pytest.raises(ContactError, match="B = 5"):
        approximate.pressure(5, Gap(x, y, h), 1e-6, STEEL)


def two(distance):
    """Return the gap of two equal lobes whose overlaps at an approach of 30 µm are about `distance` apart [m]."""
    x, y = np.arange(-40, 41) * 2e-4, np.arange(-60, 61) * 2e-4
    half = math.sqrt(3e-5 / 2.0)
    h = np.minimum(*(x**2 + 2.0 * (y[:, None] - sign * (0.5 * distance + half)) ** 2 for sign in (1.0, -1.0)))
    return Gap(x, y, h)


def carried(gap, full, none):
    parts = lobes.parts(gap, 3e-5, full, none)
    solve = norm if parts is None else partial(norm_of_parts, parts=parts)
    p = solve(gap.h, gap.dx, gap.dy, STEEL, approach=3e-5).p
    return p.sum() * gap.dx * gap.dy


def test_lobes_lose_their_influence_between_both_distances():
    gap = two(6e-3)
    first, second = lobes.lobes(gap, 3e-5)
    distance = second.low - first.high
    assert distance == pytest.approx(6e-3, rel=0.02)
    coupled, apart = carried(gap, 1.0, 2.0), carried(gap, distance - 1e-6, distance - 5e-7)
    assert coupled < 0.98 * apart
    half = carried(gap, distance - 2e-3, distance + 2e-3)
    assert coupled < half < apart
    factor = lobes.parts(gap, 3e-5, distance - 2e-3, distance + 2e-3).factor
    assert factor == pytest.approx(np.array([[1.0, 0.5**0.8], [0.5**0.8, 1.0]]), rel=1e-6)


def test_lobes_apart_carry_what_each_carries_alone():
    gap = two(6e-3)
    alone = gap.h.copy()
    alone[gap.y > 0.0] = 1.0
    one = norm(alone, gap.dx, gap.dy, STEEL, approach=3e-5).p.sum() * gap.dx * gap.dy
    assert carried(gap, 1e-3, 2e-3) == pytest.approx(2.0 * one, rel=1e-6)


def test_lobes_nearer_than_the_first_distance_are_one_patch():
    assert lobes.parts(two(2e-3), 3e-5, 4e-3, 8e-3) is None
    assert lobes.reaches_over(two(6e-3), 3e-5, 5e-3)
    assert not lobes.reaches_over(two(6e-3), 3e-5, 7e-3)


def test_angles_of_near_patches_turn_towards_their_common_mean():
    """Half way between both distances each goes half of its way to the mean by weight."""
    pair = [found(0.74, -0.3, 1.0), found(0.75, -0.1, 3.0)]  # their ends are 8 mm apart
    assert turned(pair, (6e-3, 10e-3, 1.57)) == pytest.approx([-0.225, -0.125])
    assert turned(pair[::-1], (6e-3, 10e-3, 1.57)) == pytest.approx([-0.125, -0.225])
    for limits in ((6e-3, 7e-3, 1.57), (9e-3, 12e-3, 1.57), (6e-3, 10e-3, 0.1)):
        assert turned(pair, limits) == [-0.3, -0.1]
