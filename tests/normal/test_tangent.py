"""The strips follow a small change of gap and approach as if they were iterated (`normal.tangent`)."""

import numpy as np
import pytest

from contact.inputs.material import STEEL
from contact.instance import workspace
from contact.instance.case import cases
from contact.kernels.arrays import Samples
from contact.kernels.normal.tangent import follow, linearise
from contact.kernels.pipeline import press_case
from contact.kernels.records import RESULT
from contact.kernels.rows import Strip
from contact.registry import lookup

N = 20
METHODS = lookup("normal", "strip_halfspace", batched=True), lookup("tangential", "fastrip_mapped", batched=True)
Y = np.linspace(-12e-3, 12e-3, 101)
ROWS = ("Y", "DY", "A", "P0", "XC", "LN_ASPECT")
#: A gap and what is added to it: a slope, a wave, and a change of the curvature along x.
SHAPES = {
    "lopsided": 0.8 * Y**2 + 3e3 * Y**3 + 2e6 * Y**4,
    "image": 0.8 * Y**2 - 3e3 * Y**3 + 2e6 * Y**4,
    "narrow": 40.0 * Y**2,
}


def gap(shape, change=0.0) -> Samples:
    g = SHAPES[shape] + change * (2e-3 * Y + 1e-2 * Y**2 + 2e-6 * np.cos(400.0 * Y))
    return Samples(Y.copy(), g, np.full(Y.size, 1.1 * (1.0 + change)), np.zeros(Y.size), np.zeros(Y.size))


@pytest.fixture
def own():
    return workspace.allocate(*METHODS, 0.28, (N, 20, Y.size))


def iterated(own, sep, approach, tolerance=1e-11):
    """Return strips and load at an approach, from nothing."""
    case, result = cases(1, *METHODS, STEEL), np.zeros(1, RESULT)
    case["load_kind"], case["amount"], case["tolerance"] = 1, approach, tolerance
    own.space.memory[:] = 0.0
    n = press_case(sep, case[0], own, result[0])
    return n, own.strips[:, :n].copy(), result, case


@pytest.mark.parametrize("shape", SHAPES)
def test_without_a_change_nothing_moves(own, shape):
    n, strips, result, case = iterated(own, gap(shape), 6e-5)
    assert linearise(gap(shape), case[0], own, result[0])
    assert follow(gap(shape), 6e-5, own, result[0]) == n
    for row in ROWS:
        scale = np.abs(strips[Strip[row]]).max() + 1e-12
        assert own.strips[Strip[row], :n] / scale == pytest.approx(strips[Strip[row]] / scale, abs=1e-9)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("change", "deeper"), [(0.0, 2e-8), (2e-4, 0.0), (-1e-4, 1e-8)])
def test_strips_and_load_follow(own, shape, change, deeper):
    approach = 6e-5
    sides = [iterated(own, gap(shape, s * change), approach + s * deeper) for s in (1.0, -1.0)]
    n, strips, result, case = iterated(own, gap(shape), approach)
    assert linearise(gap(shape), case[0], own, result[0])
    load = float(result["N"][0])
    assert follow(gap(shape, change), approach + deeper, own, result[0]) == n
    wanted = 0.5 * (sides[0][2]["N"][0] - sides[1][2]["N"][0])
    assert result["N"][0] - load == pytest.approx(wanted, rel=8e-3)
    # the table of influences is linear between its nodes, so slopes over the step and at the point differ by up to 1 %
    for row in ROWS[:4]:
        change_of = 0.5 * (sides[0][1] - sides[1][1])[Strip[row]]
        got = own.strips[Strip[row], :n] - strips[Strip[row]]
        assert got == pytest.approx(change_of, abs=2e-2 * np.abs(change_of).max()), row


def test_a_patch_of_two_panels_has_no_tangent(own):
    two = Samples(Y.copy(), 2e4 * (Y**2 - 2.5e-5) ** 2 / 5e-5, np.full(Y.size, 1.1), np.zeros(Y.size), np.zeros(Y.size))
    n, _, result, case = iterated(own, two, 2e-5, 1e-4)
    assert n > N
    assert not linearise(two, case[0], own, result[0])
