"""Start of the strip half space from the last call: panels, half lengths and offsets that it left in the workspace's memory."""

import math

from contact.core import kernel
from contact.kernels.records import MAX_PATCHES
from contact.kernels.rows import Iterate, Vector

# memory[...]: number of panels, whether all is mirrored, the panels' ends, the outer ends of ANALYN's patches, then ln a and
# offset of every strip in turns
MEM_PANELS, MEM_IMAGE, MEM_ENDS, MEM_START, MEM_LN_A = 0, 1, 2, 2 + 2 * MAX_PATCHES, 4 + 2 * MAX_PATCHES
#: Shift of ANALYN's patch over its width from which on the panels do not move with it.
_FURTHEST = 0.02
#: Ratio of the widths of ANALYN's patches up to which a single panel grows with them.
_WIDEST = 1.25
#: Iterations in which a warm start has to come to rest. From iteration `_SOON` on no end may move by more than `_STIRS` of the
#: width, unless that is less than `_FALLS` of what it was two iterations before. Otherwise the start is ANALYN's solution.
WARM, _SOON, _STIRS, _FALLS = 8, 3, 3e-3, 0.7


@kernel
def forget(memory):
    """Let the next call start from ANALYN's solution."""
    memory[MEM_PANELS] = 0.0


@kernel
def face(image, memory):
    """Forget what was found in the other orientation."""
    if memory[MEM_PANELS] > 0.0 and image != (memory[MEM_IMAGE] > 0.0):
        forget(memory)
    memory[MEM_IMAGE] = 1.0 if image else 0.0


@kernel
def recall(sep, n, low, high, workspace):
    """Fill half lengths, offsets and active set from the memory. Return the ends of the panels, a view of it, and their number.

    The number is 0 if the memory is empty or belongs to another position. `low` and `high` are the outer ends of ANALYN's
    patches; the panels move with them, and a single one grows with them.
    """
    y, memory, vectors = sep.y, workspace.space.memory, workspace.space.vectors
    panels = memory[MEM_ENDS : MEM_ENDS + 2 * MAX_PATCHES]
    n_panels = int(memory[MEM_PANELS])
    start, end = memory[MEM_START], memory[MEM_START + 1]
    shift = 0.5 * (low + high - start - end) if n_panels > 0 else 0.0
    shift = shift if abs(shift) < _FURTHEST * (high - low) else 0.0
    wider = (high - low) / max(end - start, 1e-300) if n_panels == 1 and end > start else 1.0
    wider = wider if 1.0 / _WIDEST < wider < _WIDEST else 1.0
    middle, longer = 0.5 * (start + end), math.log(wider)  # half lengths grow as the width does
    for p in range(n_panels):
        low_end, high_end = panels[2 * p], panels[2 * p + 1]  # the same bits where nothing moves or grows
        panels[2 * p] = max(low_end + (wider - 1.0) * (low_end - middle) + shift, y[0])
        panels[2 * p + 1] = min(high_end + (wider - 1.0) * (high_end - middle) + shift, y[y.size - 1])
        if not panels[2 * p] < panels[2 * p + 1]:
            return panels, 0
    for i in range(n_panels * n):
        vectors[Vector.LN_A, i] = memory[MEM_LN_A + 2 * i] + longer
        vectors[Vector.OFFSET, i] = memory[MEM_LN_A + 2 * i + 1]
        vectors[Vector.ACTIVE, i] = vectors[Vector.P, i] = 1.0
    return panels, n_panels


@kernel
def remember(n_panels, n, low, high, skewed, workspace):
    """Keep half lengths of the panels, whose ends are in the memory already, for the next call. 0 panels empty the memory.

    Offsets are kept if strips are `skewed`, and are 0 otherwise.
    """
    memory, vectors = workspace.space.memory, workspace.space.vectors
    memory[MEM_PANELS], memory[MEM_START], memory[MEM_START + 1] = n_panels, low, high
    for i in range(n_panels * n):
        memory[MEM_LN_A + 2 * i] = vectors[Vector.LN_A, i]
        memory[MEM_LN_A + 2 * i + 1] = vectors[Vector.OFFSET, i] if skewed else 0.0


@kernel
def stirs(number, iterates):
    """Return whether the ends of a warm start still move far in iteration `number`, and hardly less than before."""
    if number < _SOON:
        return False
    return iterates[number, Iterate.MOVED] > max(_STIRS, _FALLS * iterates[number - 2, Iterate.MOVED])
