"""Iterations as text, to understand a status: a table for interacting strips."""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

from contact.kernels.rows import Event, Iterate

_EVENTS = {
    Event.AGAIN: "from ANALYN's patch again",
    Event.CUT: "idle strips cut off",
    Event.LOST: "panel without load removed",
    Event.FIXED: "ends fixed from here on",
    Event.FOUND: "new panel on a lobe",
    Event.JOINED: "panels joined",
    Event.PARTED: "panel parted where it is idle",
}


def show(text: str) -> None:
    """Print a text, at the request of the user."""
    sys.stdout.write(f"{text}\n")


def show_step(step: int, residual: float) -> None:
    """Print a step of the half space's tangential iteration and its residual."""
    show(f"tangential = 'halfspace': step {step}, residual {residual:.2e}")


def of_strips(iterates: NDArray[np.float64], count: int, mirrored: bool) -> str:
    """Return the table.

    Parameters
    ----------
    iterates : array, shape (n, len(Iterate) + …)
        `Space.iterates` of the workspace.
    count : int
        Iterations made. If there is no row for all of them, the last row is that of the last one.
    mirrored : bool
        The mirror image was solved, so the ends are those of the image.
    """
    lines = ["  k   gap residual    ends move   approach   ends of the panels [mm]"]
    for k in range(min(count, len(iterates))):
        row = iterates[k]
        ends = 1e3 * row[Iterate.ENDS : Iterate.ENDS + 2 * int(row[Iterate.PANELS])]
        ends = np.sort(-ends if mirrored else ends)
        panels = " | ".join(f"{low:8.4f} {high:8.4f}" for low, high in ends.reshape(-1, 2))
        said = ", ".join(text for bit, text in _EVENTS.items() if int(row[Iterate.EVENTS]) & bit)
        number = count if k == len(iterates) - 1 else k + 1
        lines.append(
            f"{number:3d}   {row[Iterate.ERROR]:12.2e} {row[Iterate.MOVED]:12.2e} {1e6 * row[Iterate.APPROACH]:7.2f} µm"
            f"   {panels}{'   ' + said if said else ''}"
        )
    return "\n".join(lines)
