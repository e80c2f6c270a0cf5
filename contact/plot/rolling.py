"""Figures of rigid contact points and of the equivalent conicity."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import Normal, Stroke

from contact.errors import ContactError
from contact.plot.style import FAINT, INK, LINES, MM, drawn

if TYPE_CHECKING:
    from contact.geometry.en15302 import Conicity
    from contact.geometry.profile import Profile
    from contact.geometry.rigid import ContactPoints

_LIFT = 12.0  # height of the wheel above the rail [mm], so that lines between contact points are visible
_JOINED = 0.5e-3  # displacement from one such line to the next [m]
_LABEL = 3.0  # width of a label [mm]


def contact_points(points: ContactPoints, wheel: Profile, rail: Profile) -> Figure:
    """Draw the contact points of the right wheel and rail, and Δr and contact angles over the lateral displacement.

    Parameters
    ----------
    points : contact.geometry.rigid.ContactPoints
        Contact points at two or more displacements.
    wheel, rail : Profile
        Profiles of the right side.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there are fewer than two displacements.
    """
    _require_several(points)
    with drawn(7.4, 7.2) as figure:
        above, below = figure.subfigures(2, 1, height_ratios=[1.0, 1.1], squeeze=False)[:, 0]
        _joined(above.subplots(), points, wheel, rail)
        difference, angle = below.subplots(2, 1, sharex=True)
        _difference(difference, points)
        for name, touches, colour in (("right", points.right, LINES[0]), ("left", points.left, LINES[1])):
            angle.plot(MM * points.y, np.degrees(touches.angle), color=colour, lw=1.4, label=name)
        angle.set(xlabel="lateral displacement of the wheelset [mm]", ylabel="contact angle [°]")
        angle.legend()
        for ax in (difference, angle):
            ax.grid(visible=True)
            ax.margins(x=0.0)
    return figure


def conicity(curve: Conicity, marked: Conicity | None = None, title: str = "") -> Figure:
    """Draw the equivalent conicity over the amplitude, and Δr over the lateral displacement.

    Parameters
    ----------
    curve : contact.geometry.en15302.Conicity
        Conicity to draw as a line.
    marked : contact.geometry.en15302.Conicity, optional
        Conicity to draw as dots with their values.
    title : str
        Title of the figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there are fewer than two displacements.
    """
    _require_several(curve.points)
    with drawn(7.4, 3.4, title) as figure:
        left, right = figure.subplots(1, 2)
        left.plot(MM * curve.amplitude, curve.conicity, color=LINES[0], lw=1.6)
        if marked is not None:
            left.plot(MM * marked.amplitude, marked.conicity, "o", color=LINES[0], ms=4.0)
            for amplitude, value in zip(marked.amplitude.tolist(), marked.conicity.tolist(), strict=True):
                rise = np.interp(amplitude + 5e-4, curve.amplitude, curve.conicity) - value
                aside = 0.0 if abs(rise) < 2e-3 else math.copysign(4.0, rise)  # below the curve, where it is free
                left.annotate(
                    f"{value:.3f}",
                    (MM * amplitude, value),
                    (aside, -11.0),
                    textcoords="offset points",
                    ha={0.0: "center", 4.0: "left", -4.0: "right"}[aside],
                    size=7.0,
                    path_effects=[Stroke(linewidth=2.5, foreground="white"), Normal()],
                )
        left.set(xlabel="amplitude [mm]", ylabel="tan γe [-]")
        low, high = left.get_ylim()
        left.set_ylim(min(low, 0.0), high + 0.06 * (high - low))
        _difference(right, curve.points)
        reach = MM * curve.amplitude.max()
        seen = np.abs(MM * curve.points.y) <= reach
        right.set(xlim=(-reach, reach))
        right.set_ylim(*(1.08 * MM * np.array([-1.0, 1.0]) * np.abs(curve.points.radius_difference[seen]).max()))
        right.set_xlabel("lateral displacement [mm]")
        for ax in (left, right):
            ax.grid(visible=True)
    return figure


def _difference(ax: Axes, points: ContactPoints) -> None:
    ax.axhline(0.0, color=FAINT, lw=0.6)
    ax.plot(MM * points.y, MM * points.radius_difference, color=INK, lw=1.4)
    ax.set_ylabel("Δr = right − left [mm]")


def _joined(ax: Axes, points: ContactPoints, wheel: Profile, rail: Profile) -> None:
    """Draw the wheel at y = 0, lifted above its rail, and lines between the contact points."""
    middle = int(np.argmin(np.abs(points.y)))
    offset = MM * (points.right.on_rail[middle] - points.right.on_wheel[middle] - points.y[middle])
    tape, crown = MM * np.interp(0.0, wheel.y, wheel.z), MM * rail.z.min()
    wheel_y, wheel_z = MM * wheel.y + offset, MM * wheel.z - tape - _LIFT
    rail_y, rail_z = MM * rail.y, MM * rail.z - crown
    ax.plot(wheel_y, wheel_z, color=INK, lw=1.2)
    ax.plot(rail_y, rail_z, color=INK, lw=1.2)
    each = max(1, round(_JOINED / (points.y[1] - points.y[0])))
    labelled: list[float] = []
    for k in sorted(range(middle % each, points.y.size, each), key=lambda k: abs(points.y[k])):
        y = MM * points.right.on_wheel[k], MM * points.right.on_rail[k]
        z = np.interp(y[0], MM * wheel.y, wheel_z), np.interp(y[1], rail_y, rail_z)
        ax.plot((y[0] + offset, y[1]), z, color=LINES[0], lw=0.7)
        if round(MM * points.y[k], 6) % 1.0 == 0.0 and all(abs(y[1] - other) > _LABEL for other in labelled):
            labelled.append(float(y[1]))
            ax.annotate(
                f"{MM * points.y[k]:.0f}", (y[1], z[1]), (0.0, -10.0), textcoords="offset points", size=7.0, ha="center"
            )
    ax.set(xlim=(rail_y[0] - 22.0, rail_y[-1] + 8.0), ylim=(30.0, -_LIFT - 8.0), aspect="equal")
    ax.set(xlabel="y on the rail [mm]", ylabel="z [mm], down", title="right wheel, lifted: contact points for y [mm]")


def _require_several(points: ContactPoints) -> None:
    if points.y.size < 2 or not (np.diff(points.y) > 0.0).all():
        raise ContactError(f"points.y of shape {points.y.shape}: at least two increasing displacements are needed")
