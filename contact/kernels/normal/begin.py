"""Begin of the iteration of the strip half space, from the last solution, ANALYN's patches or the present unknowns."""

import math

from contact.core import kernel
from contact.kernels.normal.notes import note_event
from contact.kernels.normal.panels import start_panels
from contact.kernels.normal.partition import divide
from contact.kernels.normal.start import WARM
from contact.kernels.normal.turned import turn_panels
from contact.kernels.rows import Event, Sample, Vector


@kernel
def _reset(problem, warm, state):
    """Set what belongs to a new start."""
    state.begun, state.warm = state.number, warm
    state.approach = problem.result.approach - problem.touch  # ANALYN's, until the first pressures are known
    state.mixed, state.descending, state.stuck, state.searched, state.parted, state.stiff = 0, 0, 0, 0, 0, 0
    state.last_error, state.best = math.inf, math.inf


@kernel
def divide_at_ridges(problem, state):
    """Part and join panels where the gap has ridges or none any more. Return whether anything changed."""
    workspace, before = problem.workspace, state.n_panels
    slopes, vectors, rule = workspace.space.grid[Sample.GAP_SLOPE], workspace.space.vectors, workspace.rule
    n, cosines = rule.across.nodes.size, rule.cosines
    state.n_panels, changed = divide(problem.sep, slopes, state.approach, n, before, problem.panels, cosines, vectors)
    if changed:
        state.mixed, state.best = 0, math.inf
        note_event(problem, state, Event.PARTED.value if state.n_panels >= before else Event.JOINED.value)
    return changed


@kernel
def start_afresh(problem, state):
    """Start from ANALYN's patches, under yaw from turned ellipses instead of them."""
    workspace, panels = problem.workspace, problem.panels
    strips, vectors, n = workspace.strips, workspace.space.vectors, workspace.rule.across.nodes.size
    state.n_panels = start_panels(problem.n_strips, n, strips, problem.result, panels, workspace.rule.cosines, vectors)
    if problem.skew > 0.0:
        turn_panels(problem.sep, state.n_panels, n, strips, problem.skew, problem.by_load, panels, vectors)
    _reset(problem, 0, state)
    divide_at_ridges(problem, state)


@kernel
def begin(problem, n_panels, most, state):
    """Set the state before the first of `most` iterations. The last solution left `n_panels` panels, 0 for a cold start."""
    state.number, state.error, state.load, state.last, state.converged = 0, math.inf, 0.0, 0, 0
    # a warm start that finds no rest leaves the cold one at least as many iterations, or takes all
    state.patience = WARM if most >= 2 * WARM else 2 * WARM
    if n_panels > 0:
        state.n_panels = n_panels
        _reset(problem, 1, state)
        divide_at_ridges(problem, state)
    else:
        start_afresh(problem, state)


@kernel
def begin_again(problem, state):
    """Begin anew from the present unknowns, with ends that move again. Middles stay as much straightened as they are."""
    approach, stiff = state.approach, state.stiff
    state.number += 1
    _reset(problem, 0, state)
    state.approach, state.stiff, state.last, state.converged = approach, stiff, 0, 0
    problem.workspace.space.vectors[Vector.ACTIVE] = 1.0
