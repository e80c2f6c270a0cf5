"""The best iterate of the strip half space, which is the answer where none is at rest."""

import math

from contact.core import kernel
from contact.kernels.rows import Vector


@kernel
def keep_best(problem, state, freeze):
    """Store half lengths, offsets and ends of the best iterate since iteration `freeze`, which fixes the ends, in rows BEST."""
    panels, vectors, n = problem.panels, problem.workspace.space.vectors, problem.workspace.rule.across.nodes.size
    if state.anew != 0:
        state.best = math.inf
    if state.number - state.begun < freeze or state.cut != 0 or not state.last_error < state.best:
        return
    state.best = state.last_error
    for i in range(n * state.n_panels):
        vectors[Vector.BEST, i], vectors[Vector.OFFSET_BEST, i] = vectors[Vector.LN_A, i], vectors[Vector.OFFSET, i]
    for p in range(state.n_panels):
        vectors[Vector.BEST, p * n], vectors[Vector.BEST, p * n + n - 1] = panels[2 * p], panels[2 * p + 1]


@kernel
def take_best(problem, state):
    """Restore the half lengths, ends and offsets that `keep_best` stored."""
    panels, vectors, n = problem.panels, problem.workspace.space.vectors, problem.workspace.rule.across.nodes.size
    for p in range(state.n_panels):
        first, last = p * n, p * n + n - 1
        panels[2 * p], panels[2 * p + 1] = vectors[Vector.BEST, first], vectors[Vector.BEST, last]
        for i in range(first, last + 1):
            vectors[Vector.LN_A, i] = vectors[Vector.BEST, min(max(i, first + 1), last - 1)]
            vectors[Vector.OFFSET, i] = vectors[Vector.OFFSET_BEST, i]
        vectors[Vector.ACTIVE, first : last + 1] = 1.0
    state.error, state.load = state.best, 1.0
