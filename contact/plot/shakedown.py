"""The shakedown map with the working points of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from contact.errors import ContactError
from contact.plot.style import DPI, FAINT, INK, colours, style
from contact.solution import Solution

#: Shakedown limit p0/k below the surface over the utilised friction: line contact, max |τxz| with free residual stresses. Own
#: computation with McEwen's fields [V] (constants.md 5), in agreement with Johnson's 4.00 at no friction.
SUBSURFACE = np.array(
    [
        *((0.0, 4.00), (0.05, 3.77), (0.1, 3.56), (0.15, 3.38), (0.2, 3.20), (0.25, 3.04), (0.3, 2.90), (0.35, 2.77)),
        (0.367, 2.72),
    ]
)
_WIDEST = 0.6  # utilisation that the map shows at least


def shakedown(runs: Mapping[str, Sequence[Solution]], title: str = "") -> Figure:
    """Draw the shakedown map: peak pressure over shear yield stress against utilised friction, and solved contacts on it.

    Above 1/utilisation the surface flows (surface fatigue index positive, thesis Eq. 6.6); below it, but above the other
    line, material under the surface of a line contact does.

    Parameters
    ----------
    runs : mapping of str to sequence of Solution
        By name. Those without contact are left out; each has the shear yield stress of its material.
    title : str
        Of the whole.

    Raises
    ------
    ContactError
        If nothing touches.
    """
    points = {
        name: np.array(
            [(np.hypot(s.Fx, s.Fy) / s.N, s.max_pressure / s.material.shear_yield) for s in run if s.N > 0.0]
        )
        for name, run in runs.items()
    }
    if not any(cloud.size for cloud in points.values()):
        raise ContactError("runs has no solution with contact")
    clouds = np.concatenate([cloud for cloud in points.values() if cloud.size])
    right, top = max(_WIDEST, 1.05 * clouds[:, 0].max()), max(5.5, 1.1 * clouds[:, 1].max())
    with style():
        figure = Figure(figsize=(5.6, 4.2), dpi=DPI, layout="constrained")
        ax = figure.subplots()
        meeting = SUBSURFACE[-1, 0]
        surface, beyond = np.linspace(meeting, right, 200), np.linspace(1.0 / top, meeting, 200)
        ax.plot(SUBSURFACE[:, 0], SUBSURFACE[:, 1], color=INK, lw=1.4)
        ax.plot(surface, 1.0 / surface, color=INK, lw=1.4)
        ax.plot(beyond, 1.0 / beyond, color=FAINT, lw=0.9, ls="--")
        for (name, cloud), colour in zip(points.items(), colours(len(points)), strict=True):
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
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10.0)
    return figure
