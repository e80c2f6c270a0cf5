"""Iteration of the strip half space: pressures, residuals, step (strip_halfspace.md 2).

The unknowns are ln a of every strip and both ends of every panel, under yaw also the strips' offsets along x. For given
unknowns (a) of Eq. c1 gives pressures p and approach delta (`find_pressures`). The other conditions leave residuals r
(`residuals`):

    half lengths  r = 1/2 ln[(delta - g - u)/(A a²)], with the displacement u at the ends of a strip
    offsets       r = -(u+ - u-)/(4 A a) - d + straightening
    ends          r = what the rule of the ends moves

The iteration is the record `ITERATION`. A `step` evaluates these, takes as step s = -J⁻¹ r, with the Jacobian of an ellipse
or with J = -1, and mixes it with the last steps. `accept` says whether that was the last one, and otherwise takes it.
"""

import math
from typing import Any, NamedTuple

from contact.core import kernel
from contact.kernels.normal.begin import divide_at_ridges, start_afresh
from contact.kernels.normal.best import keep_best, take_best
from contact.kernels.normal.brackets import damp_turns, keep_between, note_sides
from contact.kernels.normal.descent import COARSE, descend, descend_offsets, has_one_run, straightening
from contact.kernels.normal.ends import end_moves, go_far, have_idle_part, is_far
from contact.kernels.normal.mixing import advance, largest_step, mix
from contact.kernels.normal.notes import note, note_event
from contact.kernels.normal.panels import EARLY_GHOST, GHOST, extend_to_ghosts
from contact.kernels.normal.partition import cut_idle, have_gap, join_panels, part_panels, remove_unloaded
from contact.kernels.normal.residuals import AT_PEAK, fill_residuals, find_pressures, is_stiff, stands_alone
from contact.kernels.normal.start import WARM, stirs
from contact.kernels.normal.strip_system import edge_displacements
from contact.kernels.rows import Event, Vector

#: Load-weighted mean change of ln a, and change of the ends over the width, at which the iteration stops, if the case does
#: not say another one.
TOLERANCE = 1e-4
#: Limits at which the iteration stops: what mixing leaves of the step, over the tolerance, which tells the error of the force,
#: and, with steps by the Jacobian of an ellipse, the residuals, over its square root.
LEFT, CLOSE = 1.0, 0.4
#: Share of this limit for the ends: where several strips at an end are wrong together, its rule tells too little.
ENDS_CLOSE = 0.25
#: Share of the tolerance below which a warm start is the answer as it is. Up to all of it small steps of a way would leave
#: the start behind.
STILL = 0.3
#: Load-weighted mean change of ln a that counts as converged at the limit of iterations.
ACCEPTABLE = 1e-3
#: Iteration up to which a strip whose ln a steps by ZIGZAG is not at rest, however little of the load that changes.
LATE, ZIGZAG = 12, 0.05
#: Iteration from which on the ends are fixed. At the corner of a punch and on rough gaps their rule has no steady solution.
FREEZE = 16
#: Iteration from which on the residuals are the steps, without mixing, which may go round in circles on rough gaps.
PLAIN = 22
#: The same of strips whose offsets count in full. Skewed strips are mixed then too, as long as their residuals fall.
PLAIN_SKEWED = 18
#: Iteration from which on a mean residual above the first number, which has fallen by less than the second one, means that the
#: steps by the Jacobian of an ellipse lead round in circles, and the residual below which they are tried again.
_EARLIEST, _LARGE, _FALLS, _SMALL = 4, 0.05, 0.8, 0.02
#: Iteration from which on strips that are not in line take half the step, and few of them are straightened more: some swing.
DAMPED = 24
#: Iteration from which on the ends keep between the places from which they moved outwards and inwards.
BRACKET = 12
#: Iteration from which on ends of skewed patches that are far from their place of rest are sought by the gap, and how often.
SEEK, EVERY = 5, 3
#: How often panels are parted from one start: parts that grow together again would be parted for ever.
MOST_PARTED = 3


class Problem(NamedTuple):
    """What stays the same while the normal problem is solved."""

    sep: Any
    workspace: Any
    result: Any  # ANALYN's, with `n_strips` strips in `workspace.strips`
    n_strips: Any
    panels: Any  # ends of the panels [m], which change
    touch: Any  # approach at first touch [m]
    skew: Any  # share of the strips' offsets along x that counts
    unit: Any  # 1/(pi E*)
    by_load: Any
    amount: Any  # load [N] or approach above first touch [m]
    tolerance: Any


@kernel
def _evaluate(problem, state):
    """Find pressures p, approach delta and residuals r of the present unknowns. Return whether they are finite numbers.

    Where a seventh of a panel is idle, it is cut off and the next iteration has other strips. Then only the pressures
    count, and the residuals of the ends. Panels without load are removed.
    """
    workspace, panels, skewed = problem.workspace, problem.panels, problem.skew > 0.0
    vectors, n, age = workspace.space.vectors, workspace.rule.across.nodes.size, state.number - state.begun
    state.error, state.load = math.inf, 0.0
    state.approach = find_pressures(problem, state.approach, state.n_panels)
    if not abs(state.approach) < math.inf:
        return False
    cut = age < FREEZE and have_idle_part(n, state.n_panels, vectors)
    if not cut:
        edge_displacements(panels, state.n_panels, workspace, skewed, problem.unit)
    weight = straightening(n, state.stiff) if skewed else 0.0
    fill_residuals(n, cut, skewed, weight, vectors, state)
    before = state.n_panels
    state.n_panels = remove_unloaded(n, before, panels, vectors)
    if state.n_panels == 0:
        return False
    lost = state.n_panels < before
    calm = not skewed or state.error < CLOSE * math.sqrt(problem.tolerance) * state.load
    state.moved = end_moves(
        problem.sep.y, n, state.n_panels, panels, workspace.rule.cosines, vectors, age >= FREEZE, calm, skewed
    )
    if not cut:
        note_sides(n, state.n_panels, panels, vectors, state.mixed == 0 or lost)
    state.cut, state.anew = 1 if cut else 0, 1 if lost or age == FREEZE else 0
    state.events += (Event.CUT.value if cut else 0) + (Event.LOST.value if lost else 0)
    state.events += Event.FIXED.value if age == FREEZE else 0
    note(problem, state, state.error / state.load, state.moved, state.approach, state.n_panels)
    return True


@kernel
def _can_descend(problem, state):
    """Return whether there is a Jacobian for every panel: its loaded strips lie side by side, and none is cut off now."""
    rule, vectors = problem.workspace.rule, problem.workspace.space.vectors
    n = rule.across.nodes.size
    plain = PLAIN_SKEWED if problem.skew >= 1.0 else PLAIN
    if rule.descent.shape[1] != n or state.number - state.begun >= plain or state.cut != 0 or state.stuck != 0:
        return False
    runs = 0
    for p in range(state.n_panels):
        runs += 1 if has_one_run(n, vectors[Vector.P, p * n : p * n + n]) else 0
    return runs == state.n_panels


@kernel
def _fill_step(problem, state):
    """Fill the step s of all unknowns.

    s = -J⁻¹ r with the Jacobian J of the ellipse with a panel's a/b. s = r from iteration 22 (18) on, with idle strips between
    loaded ones, and while that Jacobian leads round in circles. Both fixed-point steps are mixed with the last ones by
    Anderson's method. The mixing begins anew where the unknowns or the kind of step change, and where the residual has
    doubled; from iteration 22 (18) on where it rises, and without skew always. In circles there is none.
    """
    workspace, panels, skewed = problem.workspace, problem.panels, problem.skew > 0.0
    rule, vectors = workspace.rule, workspace.space.vectors
    n, age = rule.across.nodes.size, state.number - state.begun
    plain = PLAIN_SKEWED if problem.skew >= 1.0 else PLAIN
    frozen, before, residual = age >= FREEZE, state.descending, state.error / state.load
    if state.stuck != 0:
        state.stuck = 1 if residual > _SMALL else 0
    elif age >= _EARLIEST and state.cut == 0 and state.mixed > 0:  # the same unknowns as before
        state.stuck = 1 if residual > max(_LARGE, _FALLS * state.last_error) else 0
    state.descending = 1 if _can_descend(problem, state) else 0
    most = 2.0 if age < plain else 1.0
    grown = state.error > most * state.last_error * state.load
    if state.anew != 0 or grown or state.descending != before or state.stuck != 0 or (age >= plain and not skewed):
        state.mixed = 0
    if state.descending != 0:
        if state.mixed > 0:
            damp_turns(n, state.n_panels, panels, vectors)
        for p in range(state.n_panels):
            width = panels[2 * p + 1] - panels[2 * p]
            descend(p * n, n, width, rule.descent, vectors, frozen)
            if skewed and not is_stiff(straightening(n, state.stiff)):
                descend_offsets(p * n, n, width, rule.descent, vectors)
    state.at_strip = largest_step(n, n * state.n_panels, state.load, vectors) if state.cut == 0 else 0.0
    if skewed and age >= DAMPED:
        for i in range(n * state.n_panels):
            vectors[Vector.R, i] *= 0.5 if 0 < i % n < n - 1 else 1.0
            vectors[Vector.OFFSET_R, i] *= 0.5
    state.left = 0.0
    if state.cut == 0:
        state.left = mix(n, state.n_panels, panels, vectors, state.load, state.mixed, skewed, workspace.space.lu)


@kernel
def _move(problem, n_panels):
    """Change the unknowns of the first `n_panels` panels by the step that the mixing has found."""
    workspace, vectors, skewed = problem.workspace, problem.workspace.space.vectors, problem.skew > 0.0
    n = workspace.rule.across.nodes.size
    if skewed:
        go_far(n, n_panels, problem.panels, workspace.rule.cosines, vectors)
    advance(n, n_panels, problem.panels, vectors, skewed)


@kernel
def _search(problem, state, least):
    """Look for missed contact: an overlap above `least` times the approach outside the panels, which then grow.

    Return whether there is any. Where a panel is added, the others take their step and need not wait for it.
    """
    workspace, panels, before = problem.workspace, problem.panels, state.n_panels
    state.searched = 1
    state.n_panels, found = extend_to_ghosts(
        problem.sep, problem.touch, state.approach, least, problem.unit, problem.skew, before, panels, workspace
    )
    if found:
        state.found, state.mixed, state.best = 1, 0, math.inf
        note_event(problem, state, Event.FOUND.value)
        if state.n_panels > before:
            _move(problem, before)
    return found


@kernel
def _part(problem, state):
    """Part panels that are idle between loaded strips. Return whether there are any.

    The ends of skewed parts need some iterations before they are fixed.
    """
    workspace, panels, vectors = problem.workspace, problem.panels, problem.workspace.space.vectors
    n, age = workspace.rule.across.nodes.size, state.number - state.begun
    if (
        age >= (BRACKET if problem.skew > 0.0 else FREEZE)
        or state.cut != 0
        or state.parted == MOST_PARTED
        or not have_gap(n, state.n_panels, panels, workspace.rule.cosines, vectors)
    ):
        return False
    state.n_panels = part_panels(n, state.n_panels, panels, workspace.rule.cosines, vectors)
    state.parted, state.mixed, state.best = state.parted + 1, 0, math.inf
    note_event(problem, state, Event.PARTED.value)
    return True


@kernel
def _take(problem, state):
    """Take the step, or cut off idle parts. The ends stay within their brackets. Panels that overlap are joined."""
    workspace, panels, vectors = problem.workspace, problem.panels, problem.workspace.space.vectors
    n, age = workspace.rule.across.nodes.size, state.number - state.begun
    if state.cut != 0:
        cut_idle(n, state.n_panels, panels, workspace.rule.cosines, vectors)
        state.mixed = 0
    elif state.found == 0:
        if BRACKET <= age < FREEZE:
            keep_between(n, state.n_panels, panels, vectors)
        _move(problem, state.n_panels)
        state.mixed += 1
    state.n_panels, joined = join_panels(n, state.n_panels, panels, workspace.rule.cosines, vectors)
    if joined:
        state.mixed, state.best = 0, math.inf
        note_event(problem, state, Event.JOINED.value)
        divide_at_ridges(problem, state)


@kernel
def _stiffen(state):
    """Straighten the middles of skewed strips more from here on. The residuals are others then."""
    state.stiff, state.mixed, state.best = 1, 0, math.inf


@kernel
def _swings(problem, state):
    """Return whether one strip stands alone, which may be a zigzag of the middles and no peak, where offsets count in full."""
    vectors, n = problem.workspace.space.vectors, problem.workspace.rule.across.nodes.size
    return problem.skew >= 1.0 and state.stiff == 0 and stands_alone(n * state.n_panels, vectors)


@kernel
def _seeks(problem, state):
    """Return whether the gap outside the panels is searched now, though they are not at rest.

    That is once, and in skewed patches again while an end is far from its place of rest. Where a thin bridge joins two
    lobes, the rule of the ends would need dozens of iterations to cross it.
    """
    rule, age = problem.workspace.rule, state.number - state.begun
    if state.cut != 0 or state.searched == 0:
        return state.cut == 0
    due = problem.skew > 0.0 and age >= SEEK and (age - SEEK) % EVERY == 0
    return due and is_far(rule.across.nodes.size, rule.cosines, state.moved)


@kernel
def accept(problem, state):
    """Return whether the unknowns are at rest and nothing lies outside the panels. Otherwise change them by the step.

    With the load-weighted mean |r| of half lengths and offsets, the largest move m of an end over its width, and the
    tolerance ε, they are at rest if |r| < ε and m < 2ε, with steps by the Jacobian, whose error is a quarter of r, if |r| <
    .4√ε and m < .1√ε, and in both cases if the mixing leaves less than ε of the step. The last step is taken, but for a start
    with less than `STILL` of ε: a call that is repeated has the same bits. Skewed strips with fixed ends are left at |r| <
    `ACCEPTABLE`. The panel with the largest pressure must be at rest by itself, and before every strip.
    """
    age, error, moved, tolerance = state.number - state.begun, state.error, state.moved, problem.tolerance
    close = CLOSE * math.sqrt(tolerance)
    done = state.cut == 0 and state.left < LEFT * tolerance
    exact = done and error < tolerance * state.load and moved < 2.0 * tolerance
    settled = done and state.descending != 0 and error < close * state.load and moved < ENDS_CLOSE * close
    calm = problem.skew > 0.0 and age >= FREEZE and state.cut == 0
    calm = calm and error < ACCEPTABLE * state.load and moved < close
    state.found = 0
    if _part(problem, state):
        return False
    if (exact or settled or calm) and state.at_peak < AT_PEAK and (age >= LATE or state.at_strip < ZIGZAG):
        if _swings(problem, state):
            _stiffen(state)
        elif divide_at_ridges(problem, state):
            return False
        elif not _search(problem, state, GHOST):
            state.converged = 1 if exact or settled else 0
            still = exact and age == 0 and max(error / state.load, 0.5 * moved) < STILL * tolerance
            state.last = 1 if state.converged == 0 or still else 0
            return True
    elif _seeks(problem, state):
        _search(problem, state, GHOST if state.searched != 0 else EARLY_GHOST)
    _take(problem, state)
    return False


@kernel
def step(problem, state):
    """Make one iteration. Return whether it is the last one.

    A warm start that does not come to rest, or has no solution, is given up for a cold one.
    """
    state.events = 0
    if state.warm != 0 and state.number == state.patience:
        start_afresh(problem, state)
        state.events = Event.AGAIN.value
    note(problem, state, math.inf, 0.0, 0.0, 0)
    few = problem.workspace.rule.across.nodes.size <= COARSE  # more strips are straightened much already
    if problem.skew > 0.0 and few and state.stiff == 0 and state.number - state.begun == DAMPED:
        _stiffen(state)
    if not _evaluate(problem, state):
        state.patience = state.number + 1
        return state.warm == 0
    if state.warm != 0 and state.patience == WARM and stirs(state.number, problem.workspace.space.iterates):
        state.patience = state.number + 1
    _fill_step(problem, state)
    state.last_error = state.error / state.load
    keep_best(problem, state, FREEZE)
    return accept(problem, state)


@kernel
def finish(problem, state):
    """Leave the pressures of the final unknowns: those at rest, or else the best ones."""
    if state.last != 0:
        return
    n, vectors = problem.workspace.rule.across.nodes.size, problem.workspace.space.vectors
    if state.converged != 0:
        advance(n, state.n_panels, problem.panels, vectors, problem.skew > 0.0)
    elif state.n_panels > 0 and state.best * state.load < state.error:
        take_best(problem, state)
    state.approach = find_pressures(problem, state.approach, state.n_panels)
