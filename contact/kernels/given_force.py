"""The creepages under a given tangential force.

The force falls with the creepage (B of TANG is positive definite), towards friction times load. The residual does not compare
forces f = F/(mu N) but the creepages that Vermeulen and Johnson's law assigns to them on a circle, proportional to
1 - (1 - f)^⅓. In these the problem is nearly linear up to saturation. One unknown is found by secants inside a bracket
(`contact.kernels.root`), two by Broyden's iteration.

The solver is not an argument. `begin` prepares a search. The caller solves at ``search.vx``, ``search.vy`` and passes the
force to `go_on`, as long as this returns True. The last solution is the answer; ``search.status`` is 0 or replaces its status.
"""

import math

from contact.core import entry, kernel
from contact.kernels import root
from contact.kernels.arrays import ForceSearch
from contact.kernels.enumerations import Status, Tangential
from contact.kernels.friction import of_case
from contact.kernels.pipeline import press_case, roll_case

#: Members of the force that are given.
LONGITUDINAL, LATERAL = 1, 2
#: Forces must agree to this share of friction times load. A larger error, up to `_LEFT`, is accepted if the force jumps.
_TOLERANCE, _LEFT = 2e-6, 1e-4
#: Largest creepage [-]: the wheel slides as fast as it rolls. A force that needs more is unreachable.
LARGEST = 1.0
#: Limits: solutions, trials of a step, each half as long as the one before, and growth of a creepage in one step.
_MOST, _MOST_TRIALS, _GROWTH = 60, 8, 4.0
#: Step of the difference quotients over the creepage.
_DIFFERENCE = 1e-4
#: A Jacobian whose condition number is larger is singular; above the second number the force hardly depends on one creepage.
_SINGULAR, _FLAT = 1e9, 1e6
#: Kalker's C11 of a circle, roughly; it only scales the first step.
_C11 = 4.0
#: What the next force is for: steps of Broyden's iteration, either column of the Jacobian, or only the answer.
_STEP, _COLUMN_X, _COLUMN_Y, _LAST = 0, 1, 2, 3


@kernel
def _length(x, y):
    """Return the length of a vector, also where its square would overflow."""
    most = max(abs(x), abs(y))
    if not most > 0.0:
        return abs(x) + abs(y)  # 0 or NaN
    x, y = x / most, y / most
    return most * math.sqrt(x * x + y * y)


@entry
def begin(
    search: ForceSearch,
    given: int,
    Fx: float,
    Fy: float,
    vx: float,
    vy: float,
    limit: float,
    stiffness: float,
    bounded: bool,
) -> None:
    """Start a search at the creepages `vx`, `vy` [-].

    Parameters
    ----------
    given : 1 for a given `Fx`, 2 for `Fy`, 3 for both; a creepage without a force stays
    limit : friction times normal force [N], not negative
    stiffness : shear modulus times area of contact [N]
    bounded : whether the force never exceeds `limit`
    """
    search.given, search.vx, search.vy, search.limit, search.bounded = given, vx, vy, limit, int(bounded)
    search.wanted_x = Fx if given & LONGITUDINAL != 0 else 0.0
    search.wanted_y = Fy if given & LATERAL != 0 else 0.0
    search.unit = 3.0 * limit * math.pi / (stiffness * _C11)
    search.status, search.stage, search.solutions, search.trials, search.fresh = 0, _STEP, 0, 0, 0
    if limit > 0.0:
        for i in range(4):
            search.jacobian[i] = 1.0 / search.unit if i % 3 == 0 else 0.0
        root.begin(search, vx if given == LONGITUDINAL else vy, 1.0 / search.unit, -LARGEST, LARGEST)


@kernel
def _straight(search, Fx, Fy):
    """Return minus the creepages over `unit` that give a force by Vermeulen and Johnson's law."""
    size = _length(Fx, Fy) / search.limit
    if search.bounded == 0 or size <= 0.0:
        return Fx / (3.0 * search.limit), Fy / (3.0 * search.limit)
    share = (1.0 - (1.0 - min(size, 1.0 - 1e-12)) ** (1.0 / 3.0)) / (size * search.limit)
    return Fx * share, Fy * share


@kernel
def _finish(search, status):
    """Return whether the answer must still be solved at the creepages in `search`. A status other than 0 replaces its own."""
    search.status = status
    search.stage = _LAST
    return True


@kernel
def _go_beyond(search):
    """Set the largest creepage, against the force."""
    size = max(_length(search.wanted_x, search.wanted_y), 1e-300)
    if search.given & LONGITUDINAL != 0:
        search.vx = -LARGEST * search.wanted_x / size
    if search.given & LATERAL != 0:
        search.vy = -LARGEST * search.wanted_y / size
    return _finish(search, Status.UNREACHABLE)


@entry
def go_on(search: ForceSearch, Fx: float, Fy: float) -> bool:
    """Set the next creepages from the force at the present ones [N]. Return False if the last solution is the answer."""
    if search.stage == _LAST:
        return False
    search.solutions += 1
    Fx = Fx if search.given & LONGITUDINAL != 0 else 0.0
    Fy = Fy if search.given & LATERAL != 0 else 0.0
    error = _length(Fx - search.wanted_x, Fy - search.wanted_y)
    if not search.limit > 0.0:  # nor NaN
        return error > 0.0 and _go_beyond(search)
    wanted = _length(search.wanted_x, search.wanted_y)
    if search.bounded != 0 and wanted > search.limit * (1.0 + _TOLERANCE):
        return _go_beyond(search)
    x, y = _straight(search, Fx, Fy)
    to_x, to_y = _straight(search, search.wanted_x, search.wanted_y)
    error /= search.limit
    if search.given != LONGITUDINAL + LATERAL:
        return _go_on_with_one(search, to_x - x + to_y - y, error)
    return _go_on_with_two(search, to_x - x, to_y - y, error)


@kernel
def _go_on_with_one(search, residual, error):
    if root.advance(search, residual if error > _TOLERANCE else 0.0, 1e-9 * search.unit, _MOST):
        if search.given == LONGITUDINAL:
            search.vx = search.x
        else:
            search.vy = search.x
        return True
    if error > _LEFT:
        search.status = Status.UNREACHABLE if search.beyond != 0 else Status.NOT_CONVERGED
    return False


@kernel
def _go_on_with_two(search, rx, ry, error):
    if search.stage == _COLUMN_X:
        moved = search.vx - search.best_x
        search.jacobian[0], search.jacobian[2] = (rx - search.rx) / moved, (ry - search.ry) / moved
        search.vx, search.vy, search.stage = search.best_x, search.best_y + moved, _COLUMN_Y
        return True
    if search.stage == _COLUMN_Y:
        moved = search.vy - search.best_y
        search.jacobian[1], search.jacobian[3] = (rx - search.rx) / moved, (ry - search.ry) / moved
        search.stage, search.fresh = _STEP, 1
        return _step(search)
    first = search.solutions == 1
    if not first:
        _update(search, rx, ry)
    if first or _length(rx, ry) < _length(search.rx, search.ry):
        search.best_x, search.best_y, search.rx, search.ry = search.vx, search.vy, rx, ry
        search.error, search.trials, search.fresh = error, 0, 0
        if error <= _TOLERANCE or search.solutions >= _MOST:
            search.status = _judgement(search)
            return False
        return _step(search)
    search.trials += 1
    if search.solutions < _MOST and search.trials < _MOST_TRIALS:
        search.vx, search.vy = 0.5 * (search.vx + search.best_x), 0.5 * (search.vy + search.best_y)
        return True
    search.vx, search.vy = search.best_x, search.best_y
    if search.fresh != 0 or search.solutions >= _MOST:
        return _finish(search, _judgement(search))
    search.vx += _DIFFERENCE * max(search.unit, _length(search.vx, search.vy))
    search.trials, search.stage = 0, _COLUMN_X
    return True


@kernel
def _update(search, rx, ry):
    """Let the Jacobian reproduce the last change of the residual (Broyden)."""
    j, dx, dy = search.jacobian, search.vx - search.best_x, search.vy - search.best_y
    square = dx * dx + dy * dy
    if square > 0.0:
        of_x = (rx - search.rx - j[0] * dx - j[1] * dy) / square
        of_y = (ry - search.ry - j[2] * dx - j[3] * dy) / square
        j[0], j[1] = j[0] + of_x * dx, j[1] + of_x * dy
        j[2], j[3] = j[2] + of_y * dx, j[3] + of_y * dy


@kernel
def _step(search):
    """Go to the root of the linear residual, at most `_GROWTH` times as far as the creepages are large, and to `LARGEST`.

    The inverse of a singular Jacobian is that of a matrix of rank 1 (Moore and Penrose).
    """
    j, rx, ry = search.jacobian, search.rx, search.ry
    determinant = j[0] * j[3] - j[1] * j[2]
    square = j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3]
    if _SINGULAR * abs(determinant) > square:
        dx, dy = (j[1] * ry - j[3] * rx) / determinant, (j[2] * rx - j[0] * ry) / determinant
    else:
        dx, dy = -(j[0] * rx + j[2] * ry) / square, -(j[1] * rx + j[3] * ry) / square
    longest = _GROWTH * max(_length(search.best_x, search.best_y), 0.5 * search.unit)
    shorter = min(1.0, longest / max(_length(dx, dy), 1e-300))
    search.vx, search.vy = search.best_x + shorter * dx, search.best_y + shorter * dy
    shorter = min(1.0, LARGEST / max(_length(search.vx, search.vy), 1e-300))
    search.vx, search.vy = shorter * search.vx, shorter * search.vy
    return True


@kernel
def _judgement(search):
    """Return the status of the best creepages; 0 where their force is the given one."""
    if search.error <= _LEFT:
        return 0
    j = search.jacobian
    square = j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3]
    flat = _FLAT * abs(j[0] * j[3] - j[1] * j[2]) < square
    reached = _length(search.best_x, search.best_y) >= 0.99 * LARGEST
    return Status.UNREACHABLE if reached or flat else Status.NOT_CONVERGED


@kernel
def solve_under_force(sep, cases, workspace, results, searches, given, Fx, Fy):
    """As `pipeline.solve_case`, for creepages that give a force [N]; they are written into the case. Return the strip count.

    The search starts at the creepages of the case. The normal problem, which does not depend on them, is solved once.
    ``results[1]`` is scratch.
    """
    case, result, search = cases[0], results[0], searches[0]
    n = press_case(sep, case, workspace, result)
    if n == 0:
        return 0
    results[1] = results[0]
    roll_case(sep, n, case, workspace, result)
    bounded = case.tangential != Tangential.LINEAR
    begin(search, given, Fx, Fy, case.vx, case.vy, of_case(case) * result.N, case.G * result.area, bounded)
    while go_on(search, result.Fx, result.Fy):
        case.vx, case.vy = search.vx, search.vy
        results[0] = results[1]
        roll_case(sep, n, case, workspace, result)
    if search.status != 0:
        result.status = search.status
    return n
