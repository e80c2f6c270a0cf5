"""Figure of the shakedown map with the working points of runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from contact.damage.shakedown import ELLIPSE, LINE, shakedown_limit
from contact.errors import ContactError
from contact.plot.style import FAINT, INK, drawn, looks
from contact.results import Solution

_WIDEST = 0.6  # least upper end of the utilisation axis


def shakedown(runs: Mapping[str, Sequence[Solution]], title: str = "") -> Figure:
    """Draw the shakedown map, p0/k over utilised friction, with solved contacts as points.

    Above the line 1/utilisation the surface flows (positive surface fatigue index, thesis Eq. 6.6). Below it, but above the
    other line, the material under the surface of a line contact flows (`contact.damage.shakedown_limit`). The mark on the
    left is the limit of a circle without friction.

    Parameters
    ----------
    runs : mapping of str to sequence of Solution
        Solutions by name. Those without contact are left out. The shear yield stress k is that of each solution's material.
    title : str
        Title of the figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If no solution has contact.
    """
    points = {
        name: np.array([(s.used_friction, s.max_pressure / s.material.shear_yield) for s in run if s.N > 0.0])
        for name, run in runs.items()
    }
    if not any(cloud.size for cloud in points.values()):
        raise ContactError("runs has no solution with contact")
    clouds = np.concatenate([cloud for cloud in points.values() if cloud.size])
    right, top = max(_WIDEST, 1.05 * clouds[:, 0].max()), max(5.5, 1.1 * clouds[:, 1].max())
    with drawn(5.6, 4.2, title) as figure:
        ax = figure.subplots()
        meeting = LINE[-1, 0]
        utilised, beyond = np.linspace(0.0, right, 400), np.linspace(1.0 / top, meeting, 200)
        ax.plot(utilised, shakedown_limit(utilised), color=INK, lw=1.4)
        ax.plot(0.0, ELLIPSE[1.0], "o", color=INK, mfc="none", ms=5.0, clip_on=False)
        ax.plot(beyond, 1.0 / beyond, color=FAINT, lw=0.9, ls="--")
        for (name, cloud), (colour, _) in zip(points.items(), looks(points).values(), strict=True):
            if cloud.size:
                ax.plot(*cloud.T, "o", color=colour, ms=2.6, mew=0.0, alpha=0.6, label=name)
        for x, y, text in (
            (0.02, 0.96, "flow below\nthe surface\n(line contact)"),
            (0.98, 0.55, "flow at the surface"),
            (0.02, 0.08, "shakedown"),
        ):
            side = "left" if x < 0.5 else "right"
            ax.annotate(text, (x, y), xycoords="axes fraction", size=8.0, color=FAINT, ha=side, va="top")
        ax.set(xlim=(0.0, right), ylim=(0.0, top))
        ax.set(xlabel="utilised friction √(Fx² + Fy²)/N [-]", ylabel="p₀/k [-]")
        ax.legend(loc="upper right")
    return figure
