"""From the motion of a wheelset to the forces of one wheel on one rail: the kernel of `WheelRailPair` and its FMU."""

import math

from contact.core import kernel
from contact.kernels.enumerations import Height, NoAnswer, NormalFamily, Status
from contact.kernels.geometry.prepare import move
from contact.kernels.geometry.search import size_of
from contact.kernels.geometry.settle import DEEPEST, begin, carried, describe, first_depth, settle
from contact.kernels.ledger import enter
from contact.kernels.normal.strip_halfspace import strips_under
from contact.kernels.pair_patches import (
    keeps_ledger,
    prepare_patches,
    press_patch,
    press_patches,
    set_case,
    solve_patches,
    workspace_of,
)
from contact.kernels.records import MAX_PATCHES
from contact.kernels.result import clear
from contact.kernels.root import advance
from contact.kernels.root import begin as begin_root

#: Search of the height for a load or a vertical force: most trials, shortest bracket [m], target and accepted residual over it.
_MOST, _SHORTEST, _TOLERANCE, _ACCEPTABLE = 20, 1e-14, 1e-9, 1e-3
#: First guesses at most, longest step from one to the next, and ratio of forces up to which a guess is the last one but one.
_MOST_GUESSES, _FARTHEST, _ALIKE = 3, 4.0, 2.0
#: So many trials that do not bring the residual down to a share of it mean that the force jumps.
_SHARE, _JUMP = 0.25, 6
#: A trial is brief where the one before has missed the force by more than this share.
_ROUGH = 1e-3
#: Methods that iterate: target, the noise of their force at one height; residual that counts as noise after so many such
#: trials, and where a patch finds no rest, so that another trial of a millisecond would find another force.
_ITERATED, _NOISE, _IDLE, _RESTLESS = 1e-5, 1e-4, 2, 5e-4
#: Iterations up to which a solution is a start for the next trial. What takes more may have two solutions at one height.
_QUICK = 8
#: Most solutions for a load, each of which lays the patch anew, and the change of the force up to which the height may move
#: after the last one: laid once more, 400 random patches then carried 5e-5 more or less at most, the noise of their strips.
_MOST_LAID, _LAID = 5, 3e-4
#: Range of the force's slope over that of a patch that is laid once, and the change of the force by a step of the height up to
#: which steps are too small to tell this slope, and slow strips go on at given heights.
_LEAST_STEEPER, _MOST_STEEPER, _NEAR = 0.5, 4.0, 0.1
#: Target and accepted residual on surfaces that change along the way, the second with friction. On the edge of a fresh flat the
#: force is not smooth in z.
_ROUGHER, _ACCEPTABLE_ROUGH = 1e-7, 1e-2


@kernel
def _begin_under(force, search, root):
    """Begin the search of the height that carries `force` [N]. Return whether the bodies lie above each other, first touch.

    Points of the search are depths below first touch. The third value is for `describe`. The first guess is corrected by
    ANALYN's force there, which is right to some per cent, and again where that is another force altogether, as on a flange.
    """
    motion = search.motion[0]
    above, touch, nodes = begin(search, motion.z)
    if not above:
        return above, touch, nodes
    size = size_of(motion)
    guess = first_depth(force, size)
    for _ in range(_MOST_GUESSES):
        found = carried(describe(search, touch + guess, nodes), search)
        ratio = force / found if found > 0.0 else 1.0
        guess = min(guess * min(ratio ** (2.0 / 3.0), _FARTHEST), DEEPEST * size)
        if ratio < _ALIKE and ratio * _ALIKE > 1.0:
            break
    begin_root(root, guess, force ** (2.0 / 3.0) / guess, 0.0, DEEPEST * size)
    return above, touch, nodes


@kernel
def _start_of(n, quick, arrays):
    """Prepare to solve the `n` patches of a search, which start from the last trial if it was `quick`. Return n."""
    if not quick:
        arrays.memory[:] = 0.0
    return prepare_patches(n, arrays)


@kernel
def _press_for_load(mode, force, touch, nodes, root, arrays):
    """Find the height that carries `force` by solving the normal problem of a single patch for its load.

    Each solution lays the patch at the height that the last one has found, and asks for the load that would have left `force`
    there; the first one is rough. On a flange the plane of the patch turns with the height at which it is laid: from the
    second one on, far steps from this height to the one that is found are a function whose zero is sought by secants.
    With Height.VERTICAL the tangential problem is solved too. Return the number of strips; 0 where there are more patches
    than one, -1 where strips that find no rest quickly have brought `root` near the height.
    """
    search, motion, result, case = arrays.search, arrays.search.motion[0], arrays.result[0], arrays.patch_case[0]
    share, quick, steeper, step_before = 1.0, False, 1.0, 0.0
    for k in range(_MOST_LAID):
        if _start_of(describe(search, touch + root.x, nodes), quick, arrays) != 1:
            return 0
        patch, rough = search.patches[0], k == 0
        set_case(patch, motion, arrays.case[0], case)
        cosine = math.cos(patch.angle) * math.cos(patch.pitch)
        asked = force / (share * cosine)
        samples, of_patch = workspace_of(0, arrays)
        clear(result)
        n_strips = strips_under(asked, rough, samples, case, of_patch, result)
        missed = abs(result.N - asked) > _ROUGH * asked
        if n_strips == 0 or missed or result.status == Status.NOT_CONVERGED or not result.stiffness > 0.0:
            return 0
        growth, rise = result.stiffness / result.N * cosine, (result.approach - patch.approach) / cosine
        motion.z, case.amount, patch.approach = touch + root.x + rise, result.approach, result.approach
        patch.point_z += rise  # the arms of its forces are those of its creepages
        quick, reached = result.iterations <= _QUICK, result.N * cosine
        if mode == Height.VERTICAL:
            solve_patches(1, n_strips, rough, False, arrays)
            reached = -arrays.total[0].Fz
            if not reached > 0.0:
                return 0
        share = reached / (asked * cosine)
        motion.missed = abs(reached - force) / force
        if quick and not rough and abs(rise) * growth <= _LAID and motion.missed <= _ITERATED:
            root.evaluations = k + 1
            return n_strips
        step = rise + 1.5 * ((force / reached) ** (2.0 / 3.0) - 1.0) / growth
        if abs(step_before) * growth > _NEAR:
            steeper = min(max((step_before - step) / (root.x - root.before), _LEAST_STEEPER), _MOST_STEEPER)
        before, depth, step_before = root.x, root.x + step / steeper, step
        if not root.first < depth < root.last:
            return 0
        begin_root(root, depth, 2.0 / 3.0 * force ** (2.0 / 3.0) * growth * steeper, root.first, root.last)
        root.before = before
        if not quick and not rough and (abs(step) * growth <= _NEAR or k == _MOST_LAID - 1):
            return -1
    return 0


@kernel
def _is_restless(n, arrays):
    """Return whether a loaded patch of the last trial found no rest in time: it left no start."""
    piece = (arrays.memory.size - 3) // MAX_PATCHES
    for k in range(n):
        loaded = n == 1 or arrays.search.patches[k].load > 0.0
        if loaded and arrays.memory[1 + k * piece] == 0.0:
            return True
    return False


@kernel
def _solve_under(mode, force, arrays):
    """As `solve_pair` for Height.LOAD and Height.VERTICAL: find the height by bracketed secants over the own forces.

    The force grows with the power 3/2 of the depth, so the secants are those of its power 2/3. The slope at the first trial is
    that of the normal method, right to some per cent. Interacting strips of a single patch need no search: they are solved for
    the load (`_press_for_load`). No trial starts from another pose, and only from a trial before that came to rest quickly, so
    the answer does not depend on the way, and differs from that of the height alone by the noise of the strips. Under a load
    there is no tangential problem before the height is found. Where the force jumps over the load, the nearest height
    found is the answer, with the status NOT_CONVERGED.
    """
    search, total, motion, root = arrays.search, arrays.total[0], arrays.search.motion[0], arrays.roots[2]
    if force <= 0.0:
        n = prepare_patches(settle(mode, force, search), arrays)
        if n >= 0:
            solve_patches(n, -1, False, False, arrays)
        return n
    above, touch, nodes = _begin_under(force, search, root)
    if not above:
        return NoAnswer.NO_OVERLAP.value
    changing = motion.changing
    iterated = arrays.case[0].normal_family == NormalFamily.STRIP_HALFSPACE
    tolerance = max(_ROUGHER if changing else _TOLERANCE, _ITERATED if iterated else 0.0)
    acceptable = _ACCEPTABLE_ROUGH if changing and mode == Height.VERTICAL else _ACCEPTABLE
    best, z_best, mark, missing, idle = math.inf, touch, math.inf, math.inf, 0
    rolls, starts, quick = mode == Height.VERTICAL, iterated and not changing, False
    enters, slow = keeps_ledger(arrays), False
    if starts and not 0.0 < arrays.case[0].pressure_limit < math.inf:
        pressed = _press_for_load(mode, force, touch, nodes, root, arrays)
        if pressed > 0:
            if mode == Height.LOAD:
                solve_patches(1, pressed, False, enters, arrays)
            elif enters:
                enter(search.patches[0], pressed, arrays.damage[0], arrays)
            return 1
        slow = pressed < 0
        missing = 0.0 if slow else missing
    while True:
        z = touch + root.x
        if changing:  # grids that are laid for another height would change the force
            begin(search, z)
        n = _start_of(describe(search, z, nodes), quick, arrays)
        brief = rolls and missing > _ROUGH  # this trial will hardly be the last one
        if rolls:
            pressed = press_patch(0, arrays) if n == 1 else -1
            growth, iterations = solve_patches(n, pressed, brief, False, arrays)
            reached = -total.Fz
        else:
            pressed, reached, growth, iterations = press_patches(n, arrays)
        if root.evaluations == 0 and not slow and reached > 0.0 and growth > 0.0:
            root.slope = 2.0 / 3.0 * reached ** (2.0 / 3.0) * growth
        missing = abs(reached - force) / force
        if missing < best:
            best, z_best = missing, z
        idle += 1
        if missing < _SHARE * mark:
            mark, idle = missing, 0
        goes_on = advance(root, max(reached, 0.0) ** (2.0 / 3.0) - force ** (2.0 / 3.0), _SHORTEST, _MOST)
        noise = best <= _NOISE and (slow or idle >= _IDLE)
        noise = iterated and (noise or (best <= _RESTLESS and _is_restless(n, arrays)))
        quick = starts and iterations <= _QUICK
        if missing <= tolerance or noise or idle >= _JUMP or not goes_on:
            break
    motion.missed = best
    if best > acceptable and root.high == root.last:
        return NoAnswer.NOT_SETTLED.value
    if z != z_best or brief or (n > 1 and (enters or not rolls)):
        if changing:
            begin(search, z_best)
        n = _start_of(describe(search, z_best, nodes), quick, arrays)
        solve_patches(n, -1, False, enters, arrays)
    elif not rolls:
        solve_patches(n, pressed, False, enters, arrays)
    elif enters and pressed > 0:
        enter(search.patches[0], pressed, arrays.damage[0], arrays)
    if best > acceptable:  # the force jumps with the height: on surfaces, and by ANALYN where a lobe appears
        total.status = Status.NOT_CONVERGED.value
    return n


@kernel
def solve_briefly(given, arrays):
    """As `solve_pair` at a given height, for forces, T-gamma and pressure alone, and for damage where it is entered."""
    move(given, arrays.search.motion[0])
    n = prepare_patches(settle(Height.GIVEN.value, 0.0, arrays.search), arrays)
    if n >= 0:
        solve_patches(n, -1, not keeps_ledger(arrays), True, arrays)
    return n


@kernel
def solve_pair(mode, amount, given, arrays):
    """Find the patches, solve each of them, add up.

    `given` is a record GIVEN of `layout`, `mode` and `amount` are those of `settle`. Under a load the height is found at
    which the vertical parts of the normal forces add up to it, with Height.VERTICAL those of all forces, friction included.
    The forces are those of the normal method. Damage is per patch, with its own rolling radius. What adds up does so with
    the patches' shares (`search.combine`), which are 1 nearly always. Fills arrays.contacts and arrays.total, and enters what
    the patches do into arrays.ledger. Returns the number of patches, or a code of `settle` where there is no answer.
    """
    move(given, arrays.search.motion[0])
    if mode == Height.VERTICAL or mode == Height.LOAD:
        return _solve_under(mode, amount, arrays)
    n = prepare_patches(settle(mode, amount, arrays.search), arrays)
    if n >= 0:
        solve_patches(n, -1, False, True, arrays)
    return n
