"""Figures of profiles: outline, tangent and curvature; a measured one with what is wrong with it."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from contact.plot.style import FAINT, GRID, INK, LINES, MM, drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from contact.geometry.files import Inspection
    from contact.geometry.shape import Profile

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
    lines = [line for told in found.told for line in _wrapped(told)] or ["nothing found"]
    with drawn(7.4, 6.4 + 0.17 * len(lines)) as figure:
        top, middle, bottom = figure.subplots(3, 1, sharex=True, height_ratios=[1.4, 1.0, 1.0])
        top.plot(*(MM * found.points.T), color=FAINT, lw=0.0, marker=".", ms=2.5, label="measured points")
        if found.profile is not None:
            _draw(found.profile, (top, middle, bottom), LINES[0], "profile")
        for k, finding in enumerate((*found.findings, *found.repaired)):
            if len(finding.at):
                colour = LINES[1 + k % (len(LINES) - 1)]
                top.plot(
                    *(MM * finding.at.T),
                    color=colour,
                    lw=0.0,
                    marker="o",
                    ms=7.0,
                    mfc="none",
                    label=finding.fault.value + (", dropped" if k >= len(found.findings) else ""),
                )
        top.set_title(f"{found.name}: {found.kind}, {len(found.points)} points", loc="left", color=INK)
        _label(top, middle, bottom)
        figure.supxlabel("\n".join(lines), x=0.02, ha="left", fontsize=8.0, color=INK)
    return figure


def profiles(*shown: Profile) -> Figure:
    """Draw outlines, tangents and curvatures of one or several profiles."""
    lines = [line for one in shown if one.note for line in _wrapped(f"{one.name or one.kind}: {one.note}")]
    with drawn(7.4, 6.4 + 0.17 * len(lines)) as figure:
        axes = figure.subplots(3, 1, sharex=True, height_ratios=[1.4, 1.0, 1.0])
        for k, one in enumerate(shown):
            _draw(one, axes, LINES[k % len(LINES)], one.name or one.kind)
        _label(*axes)
        if lines:
            figure.supxlabel("\n".join(lines), x=0.02, ha="left", fontsize=8.0, color=INK)
    return figure


def _draw(profile: Profile, axes: tuple[Axes, Axes, Axes], color: str, label: str) -> None:
    """Draw outline, tangent and curvature of one profile."""
    y, z, angle = profile.y, profile.z, profile.angle
    top, middle, bottom = axes
    top.plot(MM * y, MM * z, color=color, lw=1.2, label=label)
    middle.plot(MM * y, np.degrees(angle), color=color, lw=1.0)
    bend = np.diff(angle) / np.hypot(np.diff(y), np.diff(z))
    bottom.plot(MM * 0.5 * (y[1:] + y[:-1]), bend, color=color, lw=0.8)
    limit = 1.6 * float(np.quantile(np.abs(bend), 0.97)) or 1.0
    bottom.set_ylim(-limit, limit)


def _label(top: Axes, middle: Axes, bottom: Axes) -> None:
    """Label the axes of outline, tangent and curvature."""
    top.invert_yaxis()
    top.set(ylabel="z, down [mm]")
    top.legend(loc="best")
    middle.set(ylabel="tangent [°]")
    bottom.set(ylabel="curvature [1/m]", xlabel="y, to the field side [mm]")
    for ax in (top, middle, bottom):
        ax.grid(visible=True, color=GRID)


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, _LINE, initial_indent="• ", subsequent_indent="   ")
