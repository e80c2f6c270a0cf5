"""Figure of a measured profile and what is wrong with it."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from contact.plot.style import DPI, FAINT, GRID, INK, LINES, MM, style

if TYPE_CHECKING:
    from contact.geometry.files import Inspection

_LINE = 96  # letters of a line of text below the figure


def profile_check(found: Inspection) -> Figure:
    """Draw a profile, its tangent and its curvature, with the faults that `contact.geometry.profile.check` found.

    Parameters
    ----------
    found : contact.geometry.files.Inspection

    Returns
    -------
    Figure
    """
    lines = [line for finding in found.findings for line in _wrapped(str(finding))] or ["nothing found"]
    with style():
        figure = Figure(figsize=(7.4, 6.4 + 0.17 * len(lines)), dpi=DPI, layout="constrained")
        top, middle, bottom = figure.subplots(3, 1, sharex=True, height_ratios=[1.4, 1.0, 1.0])
        top.plot(*(MM * found.points.T), color=FAINT, lw=0.0, marker=".", ms=2.5, label="measured points")
        if found.profile is not None:
            y, z, angle = found.profile.y, found.profile.z, found.profile.angle
            top.plot(MM * y, MM * z, color=LINES[0], lw=1.2, label="profile")
            middle.plot(MM * y, np.degrees(angle), color=LINES[0], lw=1.0)
            arc = np.hypot(np.diff(y), np.diff(z))
            bend = np.diff(angle) / arc
            bottom.plot(MM * 0.5 * (y[1:] + y[:-1]), bend, color=LINES[0], lw=0.8)
            limit = 1.6 * float(np.quantile(np.abs(bend), 0.97)) or 1.0
            bottom.set_ylim(-limit, limit)
        for k, finding in enumerate(found.findings):
            if len(finding.at):
                colour = LINES[1 + k % (len(LINES) - 1)]
                top.plot(
                    *(MM * finding.at.T),
                    color=colour,
                    lw=0.0,
                    marker="o",
                    ms=7.0,
                    mfc="none",
                    label=finding.fault.value,
                )
        top.invert_yaxis()
        top.set(ylabel="z, down [mm]")
        top.set_title(f"{found.name}: {found.kind}, {len(found.points)} points", loc="left", color=INK)
        top.legend(loc="best")
        middle.set(ylabel="tangent [°]")
        bottom.set(ylabel="curvature [1/m]", xlabel="y, to the field side [mm]")
        for ax in (top, middle, bottom):
            ax.grid(visible=True, color=GRID)
        figure.supxlabel("\n".join(lines), x=0.02, ha="left", fontsize=8.0, color=INK)
    return figure


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, _LINE, initial_indent="• ", subsequent_indent="   ")
