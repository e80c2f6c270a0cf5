"""Strip half space: longitudinal strips with semi-elliptic pressure and exact half-space influence between them.

The unknowns are the peak pressure and the half length of every strip and, for a prescribed load, the approach. There
are two conditions per strip: the gap closes at its middle and, in the mean, at its ends (strip_halfspace.md 2, "C1";
after Knothe and Le The 1984). Hertz's ellipse satisfies both exactly for every aspect ratio. Under yaw the middle of a
strip is a third unknown, and the gap closes at both of its ends alike (strip_halfspace.md Eq. skew). Strips are
cosine-spaced between moving ends, with one panel of strips for every patch of the start solution. All panels interact. No
second derivative of the profile is used.

Half lengths and ends are mixed together. Ends follow their rule for 16 iterations, the last of them within brackets
(`brackets`), and are then fixed. The active set ends the patch inside them. The best iterate since then is kept. A panel
steps by the Jacobian of the ellipse with its a/b (`descent`).

A later call starts from the last solution, but only where a few iterations bring it to rest (`start`). Otherwise the answer
would depend on the start.
"""

import math
from typing import Any, NamedTuple

from contact.core import kernel
from contact.kernels.cubic import locate
from contact.kernels.enumerations import LoadKind, Status
from contact.kernels.normal.analyn import analyn
from contact.kernels.normal.between_panels import distances
from contact.kernels.normal.brackets import damp_turns, halve_turns, keep_between, note_sides
from contact.kernels.normal.descent import STRAIGHTEN, descend, descend_offsets, has_one_run
from contact.kernels.normal.mixing import advance, mix
from contact.kernels.normal.orientation import is_image, turn_back, turn_samples
from contact.kernels.normal.panels import (
    EARLY_GHOST,
    GHOST,
    cut_idle,
    end_moves,
    extend_to_ghosts,
    half_lengths,
    have_idle_part,
    is_between_loaded,
    join_panels,
    lay_panels,
    place_middles,
    remove_unloaded,
    start_panels,
)
from contact.kernels.normal.peak import peak_between_strips
from contact.kernels.normal.start import face, forget, recall, remember
from contact.kernels.normal.strip_system import (
    assemble,
    edge_displacements,
    solve_active,
)
from contact.kernels.normal.turned import turn_aspects, turn_panels
from contact.kernels.records import MAX_PATCHES
from contact.kernels.rows import Event, Iterate, Sample, Strip, Vector

#: Most iterations, if the case does not say another number. They cap the time.
MAX_ITERATIONS = 40
#: Load-weighted mean change of ln a, and change of the ends over the width, at which the iteration stops, if the case does
#: not say another one.
TOLERANCE = 1e-4
#: Limits at which steps by the Jacobian of an ellipse stop: what mixing leaves of the step, over the tolerance, and the
#: residuals, over its square root.
LEFT, CLOSE = 4.0, 0.4
#: Load-weighted mean change of ln a that counts as converged at the limit of iterations.
ACCEPTABLE = 1e-3
#: Iteration from which on the ends are fixed. At the corner of a punch and on rough gaps their rule has no steady solution.
FREEZE = 16
#: Iteration from which on the residuals are the steps, without mixing, which may go round in circles on rough gaps.
PLAIN = 22
#: The same of strips whose offsets count in full, which need longer then.
PLAIN_SKEWED = 18
#: Iteration from which on the ends keep between the places from which they moved outwards and inwards.
BRACKET = 12
#: Iterations in which a warm start has to come to rest. Then the iteration starts again from ANALYN's solution.
WARM = 8
#: An iterate that did not converge is returned if it changes by less than this; otherwise ANALYN's solution is.
USABLE = 0.02
#: Pressure of the last strip at an end over those of the next two, from which on it is a spur: the end has found no rest.
SPUR = 1.2

#: Largest mean slope of the line of the strips' middles at which strips count as in line.
SLIGHT = 0.045
#: Distance of a patch from the end of the data, over its width, below which the data cut it off.
AT_END = 0.01


class Problem(NamedTuple):
    """What stays the same while the normal problem is solved."""

    sep: Any
    own: Any
    touch: Any  # approach at first touch [m]
    skew: Any  # share of the strips' offsets along x that counts
    unit: Any  # 1/(pi E*)
    by_load: Any
    amount: Any  # load [N] or approach above first touch [m]


@kernel
def write_strips(sep, n_panels, panels, skewed, own, result):
    """Fill `own.strips` with the loaded strips in ascending order of y. Return their number.

    Runs of neighbours are the patches.
    """
    cosines, vectors, work, strips = own.rule.cosines, own.space.vectors, own.space.grid, own.strips
    y, n, size = sep.y, cosines.size - 1, sep.y.size
    count, patch = 0, -1
    done = -math.inf
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
        contiguous = False
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
            count += 1
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
def _keep_best(n, n_panels, panels, vectors):
    """Store half lengths and ends in Vector.BEST, and the offsets."""
    for i in range(n * n_panels):
        vectors[Vector.BEST, i], vectors[Vector.OFFSET_BEST, i] = vectors[Vector.LN_A, i], vectors[Vector.OFFSET, i]
    for p in range(n_panels):
        vectors[Vector.BEST, p * n], vectors[Vector.BEST, p * n + n - 1] = panels[2 * p], panels[2 * p + 1]


@kernel
def _take_best(n, n_panels, panels, vectors):
    """Restore the half lengths, ends and offsets that `_keep_best` stored."""
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        panels[2 * p], panels[2 * p + 1] = vectors[Vector.BEST, first], vectors[Vector.BEST, last]
        for i in range(first, last + 1):
            vectors[Vector.LN_A, i] = vectors[Vector.BEST, min(max(i, first + 1), last - 1)]
            vectors[Vector.OFFSET, i] = vectors[Vector.OFFSET_BEST, i]
        vectors[Vector.ACTIVE, first : last + 1] = 1.0


@kernel
def _can_descend(n, n_panels, vectors):
    """Return whether every panel has its loaded strips side by side."""
    runs = 0
    for p in range(n_panels):
        runs += 1 if has_one_run(n, vectors[Vector.P, p * n : p * n + n]) else 0
    return runs == n_panels


@kernel
def _find_pressures(problem, delta, panels, n_panels):
    """Lay the strips between the ends of the panels and find their pressures. Return the approach above first touch [m].

    `delta` is the approach so far, which bounds the half lengths.
    """
    own = problem.own
    n = own.rule.across.nodes.size
    lay_panels(problem.sep, problem.touch, problem.skew, panels, n_panels, own)
    if problem.skew > 0.0:
        place_middles(own.space.vectors, n, n_panels, delta)
    distances(panels, n_panels, own)
    half_lengths(own.space.vectors, n, n_panels, delta)
    assemble(panels, n_panels, own, problem.skew > 0.0, problem.unit)
    return solve_active(n, n_panels, own.space, problem.by_load, problem.amount)


@kernel
def _bend(i, vectors):
    """Return how far a strip's middle would have to move to lie in line with its neighbours' [m]."""
    before, after = vectors[Vector.Y, i] - vectors[Vector.Y, i - 1], vectors[Vector.Y, i + 1] - vectors[Vector.Y, i]
    in_line = after * vectors[Vector.XC, i - 1] + before * vectors[Vector.XC, i + 1]
    return in_line / (before + after) - vectors[Vector.XC, i]


@kernel
def _fill_residuals(n, total, delta, cut, skewed, vectors):
    """Fill the residuals of all half lengths in Vector.R. Return the sum of their magnitudes, and of the strips' loads.

    A residual is the change of ln a that stretches a strip by the ratio of the overlap at its ends to that of a parabola.
    Both sums count the loads up to a factor. If idle strips are `cut` off, there are no residuals. If strips are `skewed`,
    their offsets have residuals too, the changes that close the gap at both ends alike.
    """
    error, load = math.inf if cut else 0.0, 0.0
    for i in range(total):
        vectors[Vector.R, i] = vectors[Vector.OFFSET_R, i] = 0.0
        weight = vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i]
        load += weight
        if weight > 0.0 and 0 < i % n < n - 1 and not cut:  # the ends of a panel follow their own rule
            overlap = delta - vectors[Vector.GAP, i] - vectors[Vector.U, i]
            ratio = overlap / (vectors[Vector.CURVATURE, i] * vectors[Vector.A, i] ** 2)
            least = (vectors[Vector.FLOOR, i] / vectors[Vector.A, i]) ** 2
            vectors[Vector.R, i] = 0.5 * math.log(min(max(ratio, 0.2, least), 5.0))
            error += weight * abs(vectors[Vector.R, i])
            if skewed and is_between_loaded(i, n, vectors):
                a = vectors[Vector.A, i]
                centred = -vectors[Vector.DIFFERENCE, i] / (4.0 * vectors[Vector.CURVATURE, i] * a)
                change = centred - vectors[Vector.OFFSET, i] + STRAIGHTEN * _bend(i, vectors)
                change = min(max(change, -a), a)
                vectors[Vector.OFFSET_R, i] = change
                error += weight * abs(change) / a
    return error, load


@kernel
def _has_spur(n, n_panels, vectors):
    """Return whether the last strip at an end of a panel has the largest pressure, far above that of its neighbours."""
    largest = 0.0
    for i in range(n * n_panels):
        largest = max(largest, vectors[Vector.P, i])
    for p in range(n_panels):
        for end, inwards in ((p * n, 1), (p * n + n - 1, -1)):
            k = 0
            while k < n - 3 and vectors[Vector.P, end] <= 0.0:
                end += inwards
                k += 1
            inner = max(vectors[Vector.P, end + inwards], vectors[Vector.P, end + 2 * inwards])
            if vectors[Vector.P, end] >= largest and vectors[Vector.P, end] > SPUR * inner:
                return True
    return False


@kernel
def _report(problem, delta, panels, n_panels, result):
    """Write the strips and their resultants. `result` still has ANALYN's. Return the number of strips."""
    own, strips = problem.own, problem.own.strips
    count = write_strips(problem.sep, n_panels, panels, problem.skew > 0.0, own, result)
    if problem.skew > 0.0:
        turn_aspects(count, problem.skew, strips)
    N = 0.0
    for i in range(count):
        N += 0.5 * math.pi * strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
    if problem.by_load and N > 0.0:  # end strips under tension carry nothing, so 1e-5 of the load goes to the others
        for i in range(count):
            strips[Strip.P0, i] *= problem.amount / N
    N = problem.amount if problem.by_load else N
    # d(ln N)/d(ln delta) of ANALYN, exact in Hertz contact; semi-ellipses cannot represent the edge pressure of a punch
    result.stiffness *= (result.approach - problem.touch) / result.N * N / delta if delta > 0.0 else 0.0
    result.N = N
    result.approach = delta + problem.touch
    return count


@kernel
def _note(iteration, error, moved, delta, n_panels, panels, events, iterates):
    """Keep what an iteration found, for who wants to see it (`contact.trace`)."""
    row = iterates[min(iteration, iterates.shape[0] - 1)]
    row[Iterate.ERROR], row[Iterate.MOVED], row[Iterate.APPROACH] = error, moved, delta
    row[Iterate.PANELS], row[Iterate.EVENTS] = n_panels, events
    for k in range(2 * n_panels):
        row[Iterate.ENDS + k] = panels[k]


@kernel
def _solve(sep, case, own, result):
    """Solve the normal problem in the given orientation."""
    rule, space, strips = own.rule, own.space, own.strips
    memory, vectors = space.memory, space.vectors
    n_strips = analyn(sep, case, rule.across, space.grid, strips, result)
    if n_strips == 0:
        forget(memory)
        return 0
    n = rule.across.nodes.size
    modulus = case.G / (1.0 - case.nu)
    unit = 1.0 / (math.pi * modulus)
    by_load = case.load_kind != LoadKind.APPROACH
    g_least = result.touch
    amount = case.amount if by_load else case.amount - g_least
    start_low, start_high = result.edges[0], result.edges[2 * int(strips[Strip.PATCH, n_strips - 1]) + 1]
    skew = _skew(n_strips, strips)
    problem = Problem(sep, own, g_least, skew, unit, by_load, amount)
    panels, n_panels = recall(sep, n, start_low, start_high, own)
    warm = n_panels > 0
    if not warm:
        n_panels = start_panels(n_strips, n, strips, result, panels, rule.cosines, vectors)
        if skew > 0.0:
            turn_panels(sep, n_panels, n, strips, skew, by_load, panels, vectors)
    # a warm start that finds no rest leaves the cold one at least as many iterations, or takes all
    patience = WARM if case.max_iterations >= 2 * WARM else case.max_iterations

    plain = PLAIN_SKEWED if skew >= 1.0 else PLAIN
    tolerance = case.tolerance if case.tolerance > 0.0 else TOLERANCE
    left_limit, close = LEFT * tolerance, CLOSE * math.sqrt(tolerance)
    converged, exact, descending, searched, best = False, False, False, False, math.inf
    delta = result.approach - g_least  # ANALYN's, until the first pressures are known
    iteration, begun, known, error, load, last_error = 0, 0, 0, math.inf, 0.0, math.inf
    for iteration in range(case.max_iterations):
        events = 0
        if warm and iteration == patience:
            events = Event.AGAIN.value
            n_panels = start_panels(n_strips, n, strips, result, panels, rule.cosines, vectors)
            if skew > 0.0:
                turn_panels(sep, n_panels, n, strips, skew, by_load, panels, vectors)
            delta = result.approach - g_least
            warm, begun, descending, searched = False, iteration, False, False
            known, best, last_error = 0, math.inf, math.inf
        _note(iteration, math.inf, 0.0, 0.0, 0, panels, events, space.iterates)
        age = iteration - begun
        delta = _find_pressures(problem, delta, panels, n_panels)
        error, load = math.inf, 0.0
        if not abs(delta) < math.inf:
            if not warm:
                break
            patience = iteration + 1
            continue
        cut = age < FREEZE and have_idle_part(n, n_panels, vectors)
        if not cut:  # otherwise the next iteration has other strips, and only the pressures count
            edge_displacements(panels, n_panels, own, skew > 0.0, unit)
        error, load = _fill_residuals(n, n * n_panels, delta, cut, skew > 0.0, vectors)
        before = n_panels
        n_panels = remove_unloaded(n, n_panels, panels, vectors)
        if n_panels == 0:
            if not warm:
                break
            patience = iteration + 1
            continue
        events += (Event.CUT.value if cut else 0) + (Event.LOST.value if n_panels < before else 0)
        events += Event.FIXED.value if age == FREEZE else 0
        moved = end_moves(sep.y, n, n_panels, panels, rule.cosines, vectors, age >= FREEZE)
        if not cut:
            note_sides(n, n_panels, panels, vectors, known == 0 or n_panels < before)
        by_jacobian = descending
        descending = rule.descent.shape[1] == n and age < plain and not cut
        descending = descending and _can_descend(n, n_panels, vectors)
        anew = n_panels < before or age == FREEZE
        if anew or error > 2.0 * last_error * load or descending != by_jacobian or age >= plain:
            known = 0
        last_error = error / load
        _note(iteration, last_error, moved, delta, n_panels, panels, events, space.iterates)
        if anew:
            best = math.inf
        if age >= FREEZE and not cut and last_error < best:
            best = last_error
            _keep_best(n, n_panels, panels, vectors)
        if descending:
            if known > 0:
                damp_turns(n, n_panels, panels, vectors)
            for p in range(n_panels):
                descend(p * n, n, panels[2 * p + 1] - panels[2 * p], rule.descent, vectors, age >= FREEZE)
                if skew > 0.0:
                    descend_offsets(p * n, n, panels[2 * p + 1] - panels[2 * p], rule.descent, vectors)
        elif age > plain and skew > 0.0 and not cut:
            halve_turns(n * n_panels, vectors)
        left = 0.0 if cut else mix(n, n_panels, panels, vectors, load, known, skew > 0.0, space.lu)
        exact = not cut and error < tolerance * load and moved < 2.0 * tolerance
        settled = exact or (descending and left < left_limit and error < close * load and moved < close)
        calm = skew > 0.0 and age >= FREEZE and not cut and error < ACCEPTABLE * load  # more would be slow
        ghosts, held = False, n_panels
        if settled or calm or not (searched or cut):
            searched = True
            least = GHOST if settled or calm else EARLY_GHOST
            n_panels, ghosts = extend_to_ghosts(sep, g_least, delta, least, unit, n_panels, panels, own)
            if (settled or calm) and not ghosts:
                converged = settled
                break
        if ghosts:
            known, best = 0, math.inf
            if n_panels > held:  # the other panels need not wait for the new one
                advance(n, held, panels, vectors, skew > 0.0)
        elif cut:
            cut_idle(n, n_panels, panels, rule.cosines, vectors)
            known = 0
        else:
            if BRACKET <= age < FREEZE and not settled:
                keep_between(n, n_panels, panels, vectors)
            advance(n, n_panels, panels, vectors, skew > 0.0)
            known += 1
        n_panels, joined = join_panels(n, n_panels, panels, rule.cosines, vectors)
        last = space.iterates[min(iteration, space.iterates.shape[0] - 1)]
        last[Iterate.EVENTS] += (Event.FOUND.value if ghosts else 0) + (Event.JOINED.value if joined else 0)
        if joined:
            known, best = 0, math.inf

    result.iterations = iteration + 1
    if converged and not exact:
        advance(n, n_panels, panels, vectors, skew > 0.0)
    elif not converged and n_panels > 0 and best * load < error:
        _take_best(n, n_panels, panels, vectors)
        error, load = best, 1.0
    if not (converged and exact):  # lengths, ends or panels have changed since the pressures were found
        delta = _find_pressures(problem, delta, panels, n_panels)
    peak = 0.0
    for i in range(n_panels * n):
        peak = max(peak, vectors[Vector.P, i])
    usable = converged or (n_panels > 0 and error < USABLE * load)
    if not (usable and peak < modulus):
        # `strips` and `result` still hold ANALYN's solution, and its status if the data end within the patch
        if result.status != Status.OUT_OF_RANGE:
            result.status = Status.NOT_CONVERGED
        forget(memory)
        return n_strips
    remember(n_panels if iteration - begun < FREEZE else 0, n, start_low, start_high, skew > 0.0, own)
    count = _report(problem, delta, panels, n_panels, result)
    result.pmax = peak_between_strips(sep, count, unit, own)
    rough = error > ACCEPTABLE * load or _has_spur(n, n_panels, vectors)
    if not converged and rough and result.status != Status.OUT_OF_RANGE:
        result.status = Status.NOT_CONVERGED
    elif result.status == Status.OUT_OF_RANGE:
        low, high = panels[0], panels[2 * n_panels - 1]
        margin = AT_END * (high - low)  # ends come close to the end of the data, but do not reach it
        if low > sep.y[0] + margin and high < sep.y[sep.y.size - 1] - margin:
            result.status = Status.OK
    return count


@kernel
def strip_halfspace(sep, case, own, result):
    """Solve the normal problem. Results are those of `analyn`, which gives the start and the local aspect ratios.

    If `space.memory` is filled, it is the start instead of ANALYN's patch. It is left filled for the next call if the
    ends came to rest. With the status NOT_CONVERGED the result is the best iterate if its changes were small, and
    ANALYN's solution otherwise. Mirror images have mirrored answers (`orientation`).
    """
    image, space = is_image(sep.g), own.space
    face(image, space.memory)
    n = _solve(turn_samples(sep, image, space.turned), case, own, result)
    if image:
        turn_back(n, own.strips, result.edges)
    return n
