"""Strip half space: steps with the Jacobians of ellipses, elimination, and displacement outside the panels."""

import math

import numpy as np
import pytest

from contact.instance import workspace
from contact.kernels.normal.descent import FEWEST, MOST, N_LAYERS, descend, has_one_run
from contact.kernels.normal.elimination import eliminate
from contact.kernels.normal.ends import end_moves, have_idle_part
from contact.kernels.normal.panels import _is_overlapped, _summarise
from contact.kernels.normal.partition import remove_unloaded
from contact.kernels.rows import N_VECTOR_ROWS, Vector
from contact.theory import strips


@pytest.mark.parametrize("m", [1, 2, 5, 14, 16, 31])
def test_elimination_solves_both_sides(m):
    rng = np.random.default_rng(1)
    matrix = rng.random((m, m)) + m * np.eye(m)
    first, second = rng.random(m), rng.random(m)
    expected = np.linalg.solve(matrix, np.stack((first, second), axis=1))
    eliminate(matrix.T.copy(), m, first, second)
    np.testing.assert_allclose(np.stack((first, second), axis=1), expected, rtol=1e-10)


@pytest.mark.parametrize("n", [FEWEST, 16, MOST])
def test_jacobians_are_mirror_symmetric(n):
    layers = workspace.rule(n, 10, True).descent
    assert len(layers) == N_LAYERS
    assert np.isfinite(layers).all()
    np.testing.assert_array_equal(layers, layers[:, ::-1, ::-1])


@pytest.mark.parametrize("n", [FEWEST - 1, MOST + 1])
def test_too_few_and_too_many_strips_have_no_jacobians(n):
    assert workspace.rule(n, 10, True).descent.size == 1


@pytest.mark.parametrize("move", [0.01, 0.2])
@pytest.mark.parametrize("first", [0, 16])
@pytest.mark.parametrize("frozen", [False, True])
def test_mirrored_residuals_have_mirrored_steps(move, first, frozen):
    """Of a panel that begins at strip `first`; the other panel, which is longer, stays as it is."""
    n = 16
    own = slice(first, first + n)
    rng = np.random.default_rng(2)
    steps = []
    residuals = rng.normal(0, 0.01, n)
    residuals[0], residuals[-1] = -move, 0.001
    for side in (1, -1):
        vectors = np.zeros((N_VECTOR_ROWS, 2 * n))
        vectors[Vector.A], vectors[Vector.R] = 7.0, 3.0
        vectors[Vector.A, own], vectors[Vector.R, own] = 1.5, residuals[::side]
        if side < 0:  # the entries of the end strips are displacements along y
            vectors[Vector.R, [first, first + n - 1]] *= -1
        descend(first, n, 1.0, workspace.rule(n, 10, True).descent, vectors, frozen)
        assert (np.delete(vectors[Vector.R], own) == 3.0).all()
        steps.append(vectors[Vector.R, own].copy())
    steps[1][[0, -1]] *= -1
    np.testing.assert_allclose(steps[0], steps[1][::-1], rtol=1e-12, atol=1e-15)
    if move > 0.1 or frozen:  # a large move follows the rule of the ends
        assert steps[0][0] == pytest.approx(-move)
    if frozen:
        assert steps[0][-1] == pytest.approx(0.001)


@pytest.mark.parametrize(
    ("idle", "part"),
    [
        ([0, 0, 0], False),
        ([2, 0, 0], False),
        ([3, 0, 0], True),
        ([0, 3, 0], True),
        ([2, 2, 0], False),
        ([0, 0, 2], False),
        ([0, 0, 3], True),
        ([0, 0, 20], False),
    ],
)
@pytest.mark.parametrize("side", [1, -1])
def test_idle_sevenths_are_found_at_either_end_of_loaded_panels(idle, part, side):
    """Of two panels of 20 strips: idle strips at both ends of the first one, and at the beginning of the second one."""
    pressures = np.ones(40)
    pressures[: idle[0]] = pressures[20 - idle[1] : 20] = pressures[20 : 20 + idle[2]] = 0.0
    vectors = np.zeros((N_VECTOR_ROWS, 40))
    vectors[Vector.P] = pressures[::side]
    assert have_idle_part(20, 2, vectors) == part


def test_a_removed_panel_leaves_nothing_to_the_next_one():
    """The end of a panel whose peak lies beside it moves by its first two pressures, wherever the panel stands in the lists."""
    n, y = 8, np.array([-10.0, 10.0])
    cosines = -np.cos(np.arange(n + 1) * math.pi / n)
    moves = []
    for unloaded in (0, 1):
        vectors, panels = np.zeros((N_VECTOR_ROWS, 2 * n)), np.array([-3.0, -2.0, 1.0, 2.0])[2 - 2 * unloaded :]
        own = slice(unloaded * n, (unloaded + 1) * n)
        vectors[Vector.P, own] = [0.7, 1.5, 1.4, 1.0, 0.8, 0.6, 0.4, 0.2]
        vectors[Vector.END] = -1.0
        vectors[Vector.END, own] = vectors[Vector.P, own]
        assert remove_unloaded(n, 1 + unloaded, panels, vectors) == 1
        end_moves(y, n, 1, panels, cosines, vectors, False, False, False)
        moves.append(vectors[Vector.R, 0])
    assert moves[0] == moves[1] != 0.0


@pytest.mark.parametrize(("pressures", "one"), [([0, 1, 1, 0], True), ([1, 0, 1, 1], False), ([1, 1, 1, 1], True)])
def test_runs_of_loaded_strips(pressures, one):
    assert has_one_run(4, np.array(pressures, dtype=float)) == one


def _two_panels(n):
    """Return panels from -1 to 1 and from 4 to 5 with elliptic pressures."""
    cosines = -np.cos(np.arange(n + 1) * math.pi / n)
    vectors = np.zeros((N_VECTOR_ROWS, 2 * n))
    for first, centre, half in ((0, 0.0, 1.0), (n, 4.5, 0.5)):
        middles = 0.5 * (cosines[:-1] + cosines[1:])
        own = slice(first, first + n)
        vectors[Vector.Y, own], vectors[Vector.HALF, own] = centre + half * middles, 0.5 * half * np.diff(cosines)
        vectors[Vector.A, own] = vectors[Vector.P, own] = half * np.sqrt(1 - middles**2)
        vectors[Vector.LN_LENGTH, own] = np.log(vectors[Vector.A, own])
    return vectors


@pytest.mark.parametrize("locus", [0.0, 2.0, 9.0])
@pytest.mark.parametrize("at", [-2.0, -1.001, 1.2, 2.5, 3.9, 5.01, 9.0])
def test_overlap_outside_the_panels_is_that_of_the_displacement(at, locus):
    """The point lies beside the strips' line too: on a yawed wheel two lobes are up to 30 mm apart along x."""
    n, (centre, plane) = 12, strips.tables()
    vectors = _two_panels(n)
    vectors[Vector.XC, n:] = -1.0
    _summarise(n, 2, vectors, 1.0)
    away, aside = np.abs(at - vectors[Vector.Y]), np.abs(locus - vectors[Vector.XC])
    u = 0.0
    for y, x, h, a, p in zip(away, aside, *vectors[[Vector.HALF, Vector.A, Vector.P]], strict=True):
        s = np.cos((np.arange(400) + 0.5) * math.pi / 400)
        along = np.abs(x / a - s) + 1e-12
        column = np.arcsinh((y + h) / a / along) - np.arcsinh((y - h) / a / along)
        u += p * a * math.pi / 400 * ((1 - s**2) * column).sum()
    assert _is_overlapped(at, locus, u * (1 + 1e-3), n, 2, vectors, centre, plane, 1.0)
    assert not _is_overlapped(at, locus, u * (1 - 1e-3), n, 2, vectors, centre, plane, 1.0)
