"""What an iteration of the strip half space found and did, kept for who wants to see it (`contact.view.trace`)."""

from contact.core import kernel
from contact.kernels.rows import Iterate


@kernel
def note(problem, state, error, moved, approach, n_panels):
    """Keep what an iteration found, for who wants to see it (`contact.view.trace`)."""
    iterates, panels = problem.workspace.space.iterates, problem.panels
    row = iterates[min(state.number, iterates.shape[0] - 1)]
    row[Iterate.ERROR], row[Iterate.MOVED], row[Iterate.APPROACH] = error, moved, approach
    row[Iterate.PANELS], row[Iterate.EVENTS] = n_panels, state.events
    for k in range(2 * n_panels):
        row[Iterate.ENDS + k] = panels[k]


@kernel
def note_event(problem, state, event):
    """Keep an event of this iteration, which changes the panels for the next one."""
    iterates = problem.workspace.space.iterates
    state.events += event
    iterates[min(state.number, iterates.shape[0] - 1), Iterate.EVENTS] = state.events
