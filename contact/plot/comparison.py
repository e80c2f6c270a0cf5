"""Solutions of one problem by several methods: pressure in the upper row, traction with stick and slip in the lower."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure, FigureBase

from contact.errors import ContactError
from contact.plot.mesh import PatchMesh
from contact.plot.patches import Scale, arrows, heading, slip_share, window, zones
from contact.plot.style import FAINT, colour_map, drawn, nice
from contact.results import Solution

#: Largest side of a picture [inch]; programs cannot show larger ones.
_LARGEST = 400.0
#: Space [inch] for colour bars and labels beside a row of panels, between panels, and for titles and labels.
_BESIDE, _GAP, _ABOVE = 1.6, 0.15, 2.4


def comparison(
    groups: Sequence[tuple[str, Sequence[Solution]]], *, reference: bool = True, columns: int = 8, panel: float = 3.6
) -> Figure:
    """Draw solutions side by side, one group below the other. All panels of a group have the same scales.

    Parameters
    ----------
    groups : sequence of (str, sequence of Solution)
        Title of each problem, and its solutions by several methods. The methods are the titles of the panels.
    reference : bool
        Take the first solution of each group as the reference: draw its outline as a dotted line in all panels.
    columns : int
        Largest number of panels in a row, at least 1. More solutions are divided evenly into rows.
    panel : float
        Longer side of a panel [inch].

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there is no group, a group has no solution, or the picture would be too large.
    """
    if not groups or not all(solutions for _, solutions in groups):
        raise ContactError("groups is empty or holds an empty one; at least one solution is needed")
    if columns < 1:
        raise ContactError(f"columns = {columns} is outside the allowed range [1, inf[")
    most = max(len(solutions) for _, solutions in groups)
    columns = math.ceil(most / math.ceil(most / columns))
    rows: list[tuple[str, Sequence[Solution], Solution | None, Scale]] = []
    for title, solutions in groups:
        scale, true = Scale(solutions, together=True), solutions[0] if reference else None
        rows += [
            (title if first == 0 else "", solutions[first : first + columns], true, scale)
            for first in range(0, len(solutions), columns)
        ]
    width = max(scale.figure_size(columns, panel)[0] for *_, scale in rows)
    panel_width = (width - _BESIDE) / columns - _GAP
    heights = [2.0 * min(panel_width * scale.half_x / scale.half_y, panel) + _ABOVE for *_, scale in rows]
    if sum(heights) > _LARGEST:
        raise ContactError(f"{len(rows)} rows of panels are more than a picture holds; compare fewer methods or cases")
    with drawn(width, sum(heights)) as figure:
        parts = figure.subfigures(len(rows), 1, height_ratios=heights, squeeze=False)[:, 0]
        for part, row in zip(parts, rows, strict=True):
            _row(part, *row, columns)
    return figure


def _row(
    figure: FigureBase, title: str, solutions: Sequence[Solution], true: Solution | None, scale: Scale, columns: int
) -> None:
    """Draw one row of panels with two axes each."""
    grid = figure.subplots(2, columns, squeeze=False, sharex=True, sharey=True)
    if title:
        figure.suptitle(title, x=0.01, ha="left", fontsize=11.0, weight="bold")
    for column in grid.T[len(solutions) :]:
        for ax in column:
            ax.set_axis_off()
    for (above, below), solution in zip(grid.T, solutions, strict=False):
        pressure = _pressure(above, solution, scale)
        traction = _traction(below, solution, scale)
        if true is not None and true is not solution:
            for ax in (above, below):
                for k in range(true.n_patches):
                    ax.plot(*PatchMesh(true, k).outline(), color=FAINT, lw=1.0, ls=":")
        below.set_xlabel("y [mm]")
    for axes, colours, label in zip(grid, (pressure, traction), ("pressure [MPa]", "traction [MPa]"), strict=True):
        axes[0].set_ylabel("x [mm], rolling ↑")
        figure.colorbar(colours, ax=list(axes), label=label, pad=0.02, aspect=20.0)


def _pressure(ax: Axes, s: Solution, scale: Scale) -> ScalarMappable:
    numbers = "no contact"
    if s.p.size:
        numbers = f"$p_0$ = {s.max_pressure * 1e-6:.4g} MPa\narea {s.area * 1e6:.3g} mm²"
    heading(ax, f"{s.normal}\n+ {s.tangential}", numbers)
    return window(ax, s, s.p * 1e-6, colour_map("Blues", 0.75), scale.pressure, scale)


def _traction(ax: Axes, s: Solution, scale: Scale) -> ScalarMappable:
    """Draw magnitude and arrows of the traction, stick and slip. A method without fields gets only its forces."""
    limits = 0.0, nice(max(scale.traction, 1.0) * 1e-6)
    numbers = f"$F_x$ = {s.Fx * 1e-3:.3g} kN,  $F_y$ = {s.Fy * 1e-3:.3g} kN".replace("-", "−")
    known = s.has_fields
    share = slip_share(s) if s.p.size else ""
    ax.set_title(f"{numbers}\n{share}", loc="left", fontsize=8.0)
    values = np.hypot(s.qx, s.qy) * 1e-6 if known else np.zeros(s.p.shape)
    colours = window(ax, s, values, colour_map("YlOrRd", 0.7), limits, scale)
    if known:
        arrows(ax, s, scale)
        zones(ax, s, scale)
    return colours
