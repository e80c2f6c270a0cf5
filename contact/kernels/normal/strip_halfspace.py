"""Strip half space: longitudinal strips with semi-elliptic pressure and exact half-space influence between them.

The unknowns are the peak pressure and the half length of every strip and, for a prescribed load, the approach. There
are two conditions per strip: the gap closes at its middle and, in the mean, at its ends (strip_halfspace.md 2, "C1";
after Knothe and Le The 1984). Hertz's ellipse satisfies both exactly for every aspect ratio. Under yaw the middle of a
strip is a third unknown, and the gap closes at both of its ends alike (strip_halfspace.md Eq. skew). Strips are
cosine-spaced between moving ends, with one panel of strips for every patch of the start solution. All panels interact. No
second derivative of the profile is used.

Half lengths and ends are iterated together (`iteration`). Ends follow their rule for 16 iterations, the last of them within
brackets (`brackets`), and are then fixed. The active set ends the patch inside them. The best iterate since then is kept.
Where this finds no rest, as for lobes that a thin bridge joins, the iteration begins once more from what it found, with ends
that move again.

A later call starts from the last solution, but only where a few iterations bring it to rest (`start`). Otherwise the answer
would depend on the start.
"""

import math

from contact.core import kernel
from contact.kernels.cubic import locate
from contact.kernels.enumerations import LoadKind, Status
from contact.kernels.normal.analyn import analyn, prepare
from contact.kernels.normal.begin import begin, begin_again
from contact.kernels.normal.between_panels import is_shared
from contact.kernels.normal.descent import COARSE
from contact.kernels.normal.ends import SPUR
from contact.kernels.normal.iteration import (
    ACCEPTABLE,
    CLOSE,
    FREEZE,
    TOLERANCE,
    Problem,
    finish,
    step,
)
from contact.kernels.normal.orientation import is_image, turn_back, turn_samples
from contact.kernels.normal.panels import is_between_loaded
from contact.kernels.normal.residuals import AT_END, AT_PEAK, is_spike_at_end, level_light, stands_alone
from contact.kernels.normal.sections import largest_pressure
from contact.kernels.normal.start import face, forget, recall, remember
from contact.kernels.normal.turned import turn_aspects
from contact.kernels.records import MAX_PATCHES
from contact.kernels.rows import Sample, Strip, Vector

#: Most iterations, if the case does not say another number. They cap the time. With this number or more, what is not at rest
#: gets as many once more.
MAX_ITERATIONS = 60
#: An iterate that did not converge is returned if it changes by less than this; otherwise ANALYN's solution is.
USABLE = 0.02
#: Tolerance of a solution that is only a start for the next one.
BRIEF = 1e-2
#: Largest mean slope of the line of the strips' middles at which strips count as in line.
SLIGHT = 0.045
#: Pressure of a strip over that on the line through its neighbours', up to which a narrow one is believed, and the width over
#: the half length at which it may be 1 higher.
OVER_LINE, NARROW = 1.1, 0.024
#: Distance of a patch from the end of the data, over its width, below which the data cut it off.
_CUT_OFF = 0.01


@kernel
def write_strips(sep, n_panels, panels, skewed, workspace, result):
    """Fill `workspace.strips` with the loaded strips in ascending order of y. Return their number.

    Runs of neighbours are the patches. The row INDEX of the vectors keeps each one's number in the panels.
    """
    cosines, vectors = workspace.rule.cosines, workspace.space.vectors
    work, strips = workspace.space.grid, workspace.strips
    y, n, size = sep.y, cosines.size - 1, sep.y.size
    count, patch = 0, -1
    done, bears = -math.inf, False
    k = 0
    for _ in range(n_panels):  # panels in ascending order
        p = -1
        for q in range(n_panels):
            if panels[2 * q] > done and (p < 0 or panels[2 * q] < panels[2 * p]):
                p = q
        if p < 0:
            break
        done = panels[2 * p]
        centre, half = 0.5 * (panels[2 * p] + panels[2 * p + 1]), 0.5 * (panels[2 * p + 1] - panels[2 * p])
        contiguous = bears and is_shared(2 * p, n_panels, panels)
        for i in range(n):
            row = p * n + i
            if vectors[Vector.P, row] <= 0.0:
                contiguous = False
                continue
            if not contiguous and patch < MAX_PATCHES - 1:
                patch += 1
                result.edges[2 * patch] = centre + half * cosines[i]
            contiguous = True
            result.edges[2 * patch + 1] = centre + half * cosines[i + 1]
            at = vectors[Vector.Y, row]
            k = locate(y, size, at, k)
            t = (at - y[k]) / (y[k + 1] - y[k])
            strips[Strip.Y, count] = at
            strips[Strip.DY, count] = 2.0 * vectors[Vector.HALF, row]
            strips[Strip.XC, count] = (1.0 - t) * sep.x_c[k] + t * sep.x_c[k + 1]
            strips[Strip.OFFSET, count] = vectors[Vector.OFFSET, row] if skewed else 0.0
            strips[Strip.XC, count] += strips[Strip.OFFSET, count]
            strips[Strip.A, count] = vectors[Vector.A, row]
            strips[Strip.P0, count] = vectors[Vector.P, row]
            strips[Strip.LN_ASPECT, count] = (1.0 - t) * work[Sample.LOG_ASPECT, k] + t * work[Sample.LOG_ASPECT, k + 1]
            strips[Strip.PATCH, count] = patch
            vectors[Vector.INDEX, count] = row
            count += 1
        bears = contiguous
    return count


@kernel
def _skew(n, strips):
    """Return the share, from 0 to 1, of the strips' offsets along x that counts in their influence on each other.

    At a slope s of the line of their middles, strips lie √(1 + s²) times as far apart as in line: .001 more at
    `SLIGHT`. Below this slope the offsets do not count, because they double the time. From twice that slope on they
    count in full, with a smooth transition.
    """
    slope, load = 0.0, 0.0
    for i in range(1, n):
        if strips[Strip.PATCH, i] == strips[Strip.PATCH, i - 1]:
            weight = strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
            weight += strips[Strip.P0, i - 1] * strips[Strip.A, i - 1] * strips[Strip.DY, i - 1]
            away = strips[Strip.Y, i] - strips[Strip.Y, i - 1]
            slope += weight * abs(strips[Strip.XC, i] - strips[Strip.XC, i - 1]) / away
            load += weight
    t = min(max(slope / (load * SLIGHT) - 1.0, 0.0), 1.0) if load > 0.0 else 0.0
    return t * t * (3.0 - 2.0 * t)


@kernel
def _level_spurs(n, n_panels, vectors):
    """Return whether the last strip at an end of a panel has the largest pressure, far above that of its neighbours.

    The end then lies inside the contact. Where the neighbours' pressures do not rise towards it, as they do at the corner of
    a punch, the strip gets the pressure of the second next one. It would tell no peak.
    """
    largest, found = 0.0, False
    for i in range(n * n_panels):
        largest = max(largest, vectors[Vector.P, i])
    for p in range(n_panels):
        for end, inwards in ((p * n, 1), (p * n + n - 1, -1)):
            k = 0
            while k < n - 3 and vectors[Vector.P, end] <= 0.0:
                end += inwards
                k += 1
            near, far = vectors[Vector.P, end + inwards], vectors[Vector.P, end + 2 * inwards]
            if vectors[Vector.P, end] >= largest and vectors[Vector.P, end] > SPUR * max(near, far):
                found = True
                if near < far:
                    vectors[Vector.P, end] = far
    return found


@kernel
def _level_lone(n, n_panels, vectors):
    """Lower the largest pressure while its strip stands out of its neighbours though it is far narrower than long.

    It is a zigzag at the end of a slender lobe, where half lengths hardly tell; the strips beside it carry what is right.
    Return whether there was one.
    """
    for k in range(n):
        top = 0
        for i in range(n * n_panels):
            top = i if vectors[Vector.P, i] > vectors[Vector.P, top] else top
        if not is_between_loaded(top, n, vectors):
            return k > 0
        y, before, after = vectors[Vector.Y, top], vectors[Vector.Y, top - 1], vectors[Vector.Y, top + 1]
        line = (after - y) * vectors[Vector.P, top - 1] + (y - before) * vectors[Vector.P, top + 1]
        width = 2.0 * vectors[Vector.HALF, top] / (NARROW * vectors[Vector.A, top])
        believed = line / (after - before) * (OVER_LINE + width * width)
        if vectors[Vector.P, top] <= believed:
            return k > 0
        vectors[Vector.P, top] = believed
    return True


@kernel
def _report(problem, carries, delta, n_panels):
    """Write the strips and their resultants, where ANALYN's still are. Return the number of strips.

    If `carries`, they carry the load of the problem exactly; otherwise what the approach leaves them.
    """
    workspace, strips, result, sep = problem.workspace, problem.workspace.strips, problem.result, problem.sep
    if problem.by_load and delta > 0.0:  # local aspect ratios at this approach, which is not ANALYN's
        prepare(sep.y, sep.g, sep.A, sep.y.size, problem.touch, delta, workspace.space.grid)
    count = write_strips(sep, n_panels, problem.panels, problem.skew > 0.0, workspace, result)
    if problem.skew > 0.0:
        turn_aspects(count, problem.skew, strips)
    N = 0.0
    for i in range(count):
        N += 0.5 * math.pi * strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
    if carries and N > 0.0:  # end strips under tension carry nothing, so 1e-5 of the load goes to the others
        for i in range(count):
            strips[Strip.P0, i] *= problem.amount / N
    N = problem.amount if carries else N
    # d(ln N)/d(ln delta) of ANALYN, exact in Hertz contact; semi-ellipses cannot represent the edge pressure of a punch
    result.stiffness *= (result.approach - problem.touch) / result.N * N / delta if delta > 0.0 else 0.0
    result.N = N
    result.approach = delta + problem.touch
    return count


@kernel
def _is_usable(problem, state):
    """Return whether the pressures may be the answer: they hardly change and lie below the modulus."""
    vectors, total = problem.workspace.space.vectors, problem.workspace.rule.across.nodes.size * state.n_panels
    peak = 0.0
    for i in range(total):
        peak = max(peak, vectors[Vector.P, i])
    settled = state.converged != 0 or (total > 0 and state.error < USABLE * state.load)
    return settled and peak * math.pi * problem.unit < 1.0


@kernel
def _is_at_rest(problem, state):
    """Return whether the unknowns are at rest, or nearly, and no strip stands out. One that does at an end is levelled."""
    n, vectors, skewed = problem.workspace.rule.across.nodes.size, problem.workspace.space.vectors, problem.skew > 0.0
    acceptable = max(CLOSE * math.sqrt(problem.tolerance), ACCEPTABLE) if skewed else ACCEPTABLE
    rough = _level_spurs(n, state.n_panels, vectors) or state.error > acceptable * state.load
    alone = problem.skew >= 1.0 and stands_alone(n * state.n_panels, vectors)
    return not alone and state.at_peak < AT_PEAK and (state.converged != 0 or not rough)


@kernel
def _iterate(problem, state, most):
    """Make at most `most` iterations. Return whether the pressures may be the answer and whether they are at rest."""
    first = state.number
    for k in range(most):
        state.number = first + k
        if step(problem, state):
            break
    finish(problem, state)
    usable = _is_usable(problem, state)
    return usable, usable and _is_at_rest(problem, state)


@kernel
def _solve(sep, case, load, brief, workspace, result):
    """Solve the normal problem in the given orientation. Load and `brief` are those of `strips_under`."""
    space, strips, memory = workspace.space, workspace.strips, workspace.space.memory
    n_strips = analyn(sep, case, workspace.rule.across, space.grid, strips, result)
    if n_strips == 0:
        forget(memory)
        return 0
    n = workspace.rule.across.nodes.size
    modulus = case.G / (1.0 - case.nu)
    by_load = load > 0.0 or case.load_kind != LoadKind.APPROACH
    amount = load if load > 0.0 else case.amount if by_load else case.amount - result.touch
    tolerance = case.tolerance if case.tolerance > 0.0 else TOLERANCE
    tolerance = max(tolerance, BRIEF) if brief else tolerance
    skew, unit = _skew(n_strips, strips), 1.0 / (math.pi * modulus)
    start_low, start_high = result.edges[0], result.edges[2 * int(strips[Strip.PATCH, n_strips - 1]) + 1]
    panels, n_panels = recall(sep, n, start_low, start_high, workspace)
    problem = Problem(sep, workspace, result, n_strips, panels, result.touch, skew, unit, by_load, amount, tolerance)
    state = space.iteration[0]
    begin(problem, n_panels, case.max_iterations, state)
    usable, rests = _iterate(problem, state, case.max_iterations)
    # panels of many strips more often have ends that are fixed before they arrive
    fine = skew > 0.0 and n > COARSE
    spike = rests and fine and is_spike_at_end(n, state.n_panels, space.vectors, AT_END * n)
    if (spike or not rests) and state.load > 0.0 and state.error < math.inf and case.max_iterations >= MAX_ITERATIONS:
        begin_again(problem, state)
        usable, rests = _iterate(problem, state, case.max_iterations)
    rests = rests and not (fine and is_spike_at_end(n, state.n_panels, space.vectors, 0.0))
    levelled = not rests and level_light(n * state.n_panels, space.vectors)

    result.iterations = state.number + 1
    if not usable:
        # `strips` and `result` still hold ANALYN's solution, and its status if the data end within the patch
        if result.status != Status.OUT_OF_RANGE:
            result.status = Status.NOT_CONVERGED
        forget(memory)
        return n_strips
    n_panels = state.n_panels
    left = state.last != 0 and state.converged == 0  # nearly at rest: no call starts from it
    early = not left and state.number - state.begun < FREEZE
    remember(n_panels if early else 0, n, start_low, start_high, skew > 0.0, workspace)
    lone = skew > 0.0 and _level_lone(n, n_panels, space.vectors)
    count = _report(problem, case.load_kind != LoadKind.APPROACH, state.approach, n_panels)
    # parts of strips would make up for the pressure that was taken away
    result.pmax = 0.0 if lone or levelled or brief else largest_pressure(count, problem)
    low, high = panels[0], panels[1]
    for p in range(1, n_panels):
        low, high = min(low, panels[2 * p]), max(high, panels[2 * p + 1])
    margin = _CUT_OFF * (high - low)  # ends come close to the end of the data, but do not reach it
    if low < sep.y[0] + margin or high > sep.y[sep.y.size - 1] - margin:
        result.status = Status.OUT_OF_RANGE  # ANALYN's patch, the start, may have ended before
    else:
        result.status = Status.OK if rests else Status.NOT_CONVERGED
    return count


@kernel
def strips_under(load, brief, sep, case, workspace, result):
    """As `strip_halfspace`, for a `load` > 0 [N] with ANALYN's start at the approach of the case.

    Its strips carry more by what end strips under tension would take off, as they do at this approach. A `brief` solution ends
    at `BRIEF`, and no peak is read.
    """
    image, space = is_image(sep.g), workspace.space
    face(image, space.memory)
    n = _solve(turn_samples(sep, image, space.turned), case, load, brief, workspace, result)
    if image:
        turn_back(n, workspace.strips, result.edges)
    return n


@kernel
def strip_halfspace(sep, case, workspace, result):
    """Solve the normal problem. Results are those of `analyn`, which gives the start and the local aspect ratios.

    If `space.memory` is filled, it is the start instead of ANALYN's patch. It is left filled for the next call if the
    ends came to rest. With the status NOT_CONVERGED the result is the best iterate if its changes were small, and
    ANALYN's solution otherwise. Mirror images have mirrored answers (`orientation`).
    """
    return strips_under(0.0, False, sep, case, workspace, result)
