"""Forces with their derivatives, d(Fx, Fy, Mz, N, approach, power)/d(creepages, load or approach, friction).

The normal problem does not depend on creepages and friction. So their columns are differences of the tangential problem
alone, on the same strips. For the column of the load or approach the strips follow their tangent (`normal.tangent`). Where
there is none, it is the difference of two solutions, both iterated until their own error is far below the step. The second of
them is the answer, so all numbers belong together.

All differences are one-sided, to the side of larger values. Where forces have a kink (a strip changes between stick and slip)
this is the slope on that side.
"""

import math

from contact.core import kernel
from contact.kernels.enumerations import FrictionLaw, LoadKind, NormalFamily
from contact.kernels.normal.tangent import follow, linearise
from contact.kernels.pipeline import press_case, roll_case
from contact.kernels.result import clear_forces
from contact.kernels.together import COPIES, fits_together, roll_together, sum_copy

#: Rows and columns.
ROWS, COLUMNS = 6, 5
AMOUNT, MU, POWER = 3, 4, 5
#: Step of creepages and friction, over those at which the whole patch slips. Elements hardly ever change their state within it.
_STEP = 1e-6
#: Step of the load or the penetration, over itself: where strips follow by a tangent or without iteration, and where both
#: solutions are iterated, to this tolerance. Its noise over the step is about what the curvature over a larger step would be.
SMALL, ITERATED, TOLERANCE = 3e-5, 1e-4, 1e-8
#: Steps of creepage [-], spin [1/m] and friction [-] where there is no friction.
_LEAST, _LEAST_SPIN, _LEAST_FRICTION = 1e-9, 1e-6, 1e-12


@kernel
def scale_friction(case, mu):
    """Set the coefficient of friction; a friction law changes as a whole."""
    case.kinetic = case.kinetic * (mu / case.mu) if case.mu > 0.0 else mu
    case.mu = mu


@kernel
def creepage_step(mu, N, G, area):
    """Return a small step of the longitudinal and the lateral creepage [-], and of the spin [1/m].

    Linear theory reaches mu N at mu N/(G a b C), where C is about 4 and a b = area/π.
    """
    bound = mu * N
    if not (bound > 0.0 and area > 0.0):
        return _LEAST, _LEAST_SPIN
    step = _STEP * bound / (G * area)
    return step, step / math.sqrt(area / math.pi)


@kernel
def move_column(case, j, step):
    """Add `step` to what column j means: a creepage, the load or approach, or the friction. Return what was added."""
    if j == 0:
        before, case.vx = case.vx, case.vx + step
        return case.vx - before
    if j == 1:
        before, case.vy = case.vy, case.vy + step
        return case.vy - before
    if j == 2:
        before, case.phi = case.phi, case.phi + step
        return case.phi - before
    if j == AMOUNT:
        before, case.amount = case.amount, case.amount + step
        return case.amount - before
    before = case.mu
    scale_friction(case, before + step)
    return case.mu - before


@kernel
def roll_moved(sep, n, j, step, cases, workspace, results):
    """Solve the tangential problem on the same `n` strips with one creepage or the friction moved.

    ``cases[0]`` and ``results[0]`` are the problem and what the normal problem has found. ``cases[1]`` and ``results[1]`` get
    those of the moved problem.
    """
    cases[1], results[1] = cases[0], results[0]
    move_column(cases[1], j, step)
    clear_forces(results[1])
    roll_case(sep, n, cases[1], workspace, results[1])


@kernel
def _press_closely(sep, share, cases, workspace, result):
    """Solve the normal problem of ``cases[0]`` with a small tolerance, and with its load or penetration larger by a share.

    ``cases[1]`` gets this problem. Return the strip count.
    """
    cases[1] = cases[0]
    cases[1].tolerance = TOLERANCE
    move_column(cases[1], AMOUNT, share)
    return press_case(sep, cases[1], workspace, result)


@kernel
def _copy_strips(strips, n, at, to):
    """Copy `n` strips from place `at` to place `to`. Only a solution with one patch has a tangent, so there is room."""
    for row in range(strips.shape[0]):
        for i in range(n):
            strips[row, to + i] = strips[row, at + i]


@kernel
def _follow(sep, n, amount, cases, workspace, results, jacobian):
    """Fill the column of the load or approach from the tangent of the solution, for a change `amount` of the approach.

    The strips of the solution are kept.
    """
    cases[1], results[1] = cases[0], results[0]
    _copy_strips(workspace.strips, n, 0, n)
    follow(sep, results[0].approach + amount, workspace, results[1])
    roll_case(sep, n, cases[1], workspace, results[1])
    _copy_strips(workspace.strips, n, n, 0)
    _store(results[1], AMOUNT, jacobian)


@kernel
def has_tangent(sep, case, workspace, result):
    """Find the tangent of the solution, unless its strips change after the normal problem. Return whether there is one."""
    if case.normal_family != NormalFamily.STRIP_HALFSPACE or case.conformal != 0 or result.limited != 0:
        return False
    return linearise(sep, case, workspace, result)


@kernel
def _store(result, j, jacobian):
    """Write the results into column j."""
    jacobian[0, j], jacobian[1, j], jacobian[2, j] = result.Fx, result.Fy, result.Mz
    jacobian[3, j], jacobian[4, j], jacobian[5, j] = result.N, result.approach, result.power


@kernel
def _subtract(result, j, step, jacobian):
    """Make the results in column j, which are those of a problem moved by `step`, derivatives at `result`."""
    jacobian[0, j], jacobian[1, j] = (jacobian[0, j] - result.Fx) / step, (jacobian[1, j] - result.Fy) / step
    jacobian[2, j], jacobian[3, j] = (jacobian[2, j] - result.Mz) / step, (jacobian[3, j] - result.N) / step
    jacobian[4, j], jacobian[5, j] = (jacobian[4, j] - result.approach) / step, (jacobian[5, j] - result.power) / step


@kernel
def step_of(j, case, amount, result):
    """Return the step of column j; `amount` is that of the load or approach."""
    if j == AMOUNT:
        return amount
    if j == MU:
        return max(_STEP * case.mu, _LEAST_FRICTION)
    creepage, spin = creepage_step(case.mu, result.N, case.G, result.area)
    return spin if j == 2 else creepage


@kernel
def is_even(case):
    """Return whether forces grow with the creepages as with the friction: no coefficient that falls, and a plane."""
    return case.law == FrictionLaw.COULOMB and not case.drop > 0.0 and case.conformal == 0


@kernel
def _set_friction(case, result, jacobian):
    """Fill the column of the friction by Euler's theorem: F(λ creepages, λ mu) = λ F, and the power grows with λ²."""
    for i in range(ROWS):
        along = case.vx * jacobian[i, 0] + case.vy * jacobian[i, 1] + case.phi * jacobian[i, 2]
        value = 0.0
        if i < 3:
            value = result.Fx if i == 0 else (result.Fy if i == 1 else result.Mz)
        elif i == POWER:
            value = 2.0 * result.power
        jacobian[i, MU] = (value - along) / case.mu if i < 3 or i == POWER else 0.0


@kernel
def roll_creepages(sep, n, cases, workspace, results, jacobian):
    """Write the results with each creepage moved into its column, on the same `n` strips.

    `subtract_creepages` makes derivatives of them.
    """
    if fits_together(n, cases[0], results[0], workspace.strips):
        creepage, spin = creepage_step(cases[0].mu, results[0].N, cases[0].G, results[0].area)
        roll_together(n, creepage, spin, cases[0], workspace)
        for j in range(COPIES):
            jacobian[0, j], jacobian[1, j], jacobian[2, j], jacobian[5, j] = sum_copy(n, j, workspace.strips)
            jacobian[3, j], jacobian[4, j] = results[0].N, results[0].approach
        return
    for j in range(COPIES):
        roll_moved(sep, n, j, step_of(j, cases[0], 0.0, results[0]), cases, workspace, results)
        _store(results[1], j, jacobian)


@kernel
def _subtract_moved(j, amount, cases, results, jacobian):
    """Make column j derivatives; `amount` is the step of the load or approach."""
    cases[1] = cases[0]
    step = move_column(cases[1], j, step_of(j, cases[0], amount, results[0]))
    if step > 0.0:
        _subtract(results[0], j, step, jacobian)
    else:
        jacobian[:, j] = 0.0


@kernel
def subtract_creepages(cases, results, jacobian):
    """Make the columns that `roll_creepages` has written derivatives at ``results[0]``."""
    for j in range(COPIES):
        _subtract_moved(j, 0.0, cases, results, jacobian)


@kernel
def derive_solved(sep, n, cases, workspace, results, jacobian):
    """Fill the jacobian, shape (6, 5), of ``cases[0]``, whose normal problem is solved. Return the strip count, before `n`.

    If it has no tangent, it is solved again with a small tolerance, and of the solution before only the approach counts.
    """
    jacobian[:, :] = 0.0
    clear_forces(results[0])
    by_load = cases[0].load_kind != LoadKind.APPROACH
    over = results[0].approach - results[0].touch
    if has_tangent(sep, cases[0], workspace, results[0]):
        _follow(sep, n, SMALL * max(over, 0.0), cases, workspace, results, jacobian)
        amount = jacobian[3, AMOUNT] - results[0].N if by_load else jacobian[4, AMOUNT] - results[0].approach
    else:
        share = ITERATED if cases[0].normal_family == NormalFamily.STRIP_HALFSPACE else SMALL
        amount = share * max(cases[0].amount if by_load else over, 0.0)
        n = _press_closely(sep, amount, cases, workspace, results[1])
        if n > 0:
            roll_case(sep, n, cases[1], workspace, results[1])
            _store(results[1], AMOUNT, jacobian)
        n = _press_closely(sep, 0.0, cases, workspace, results[0])
    if n == 0:
        jacobian[:, :] = 0.0
        return 0
    even = is_even(cases[0]) and cases[0].mu > 0.0
    roll_creepages(sep, n, cases, workspace, results, jacobian)
    if not even:
        roll_moved(sep, n, MU, step_of(MU, cases[0], amount, results[0]), cases, workspace, results)
        _store(results[1], MU, jacobian)
    roll_case(sep, n, cases[0], workspace, results[0])
    for j in range(MU if even else COLUMNS):
        _subtract_moved(j, amount, cases, results, jacobian)
    if even:
        _set_friction(cases[0], results[0], jacobian)
    return n


@kernel
def solve_with_jacobian(sep, cases, workspace, results, jacobian):
    """Solve ``cases[0]`` into ``results[0]``, and fill the jacobian, shape (6, 5). Return the strip count.

    ``cases[1]`` and ``results[1]`` are scratch. Without contact all derivatives are zero. If there is a tangent, the answer is
    that of `solve_case`. Otherwise it is iterated further; the two agree within the tolerance of the method.
    """
    n = 1
    if cases[0].normal_family == NormalFamily.STRIP_HALFSPACE or cases[0].load_kind == LoadKind.APPROACH:
        n = press_case(sep, cases[0], workspace, results[0])  # else `derive_solved` needs no solution
    if n == 0:
        jacobian[:, :] = 0.0
        return 0
    return derive_solved(sep, n, cases, workspace, results, jacobian)
