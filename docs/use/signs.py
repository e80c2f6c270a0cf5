"""Drawing of the page on signs and frames."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Rectangle

from contact.geometry import profile
from contact.plot.style import FAINT, INK, LINES, style

X, Y, Z = LINES[1], LINES[0], LINES[2]
_TAPE = 0.75  # from the centre of the track to a tape circle [m]
_HALF = 0.68  # half the distance of the wheels' backs [m]


def drawing() -> Figure:
    """Return a wheelset from behind, from above, and its right contact."""
    with style():
        figure = Figure(figsize=(9.0, 7.0), layout="constrained")
        behind, (above, contact) = figure.subfigures(2, 1, height_ratios=[1.0, 1.25]), (None, None)
        top = behind[0].subplots()
        above, contact = behind[1].subplots(1, 2, width_ratios=[1.15, 1.0])
        _behind(top)
        _above(above)
        _contact(contact)
        for ax, title in ((top, "from behind"), (above, "from above"), (contact, "right wheel and rail, from behind")):
            ax.set_aspect("equal")
            ax.axis("off")
            ax.set_title(title, loc="left", color=INK)
    return figure


def _arrow(
    ax: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    colour: str,
    text: str,
    dx: float = 0.0,
    dy: float = 0.0,
) -> None:
    ax.annotate(
        "", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0}
    )
    ax.text(end[0] + dx, end[1] + dy, text, color=colour, ha="center", va="center", fontsize=9.5)


def _turn(
    ax: Axes, centre: tuple[float, float], size: float, start: float, end: float, text: str, at: tuple[float, float]
) -> None:
    """Draw an arc with an arrow at `end` [degrees]. The axes may point down."""
    ax.add_patch(Arc(centre, size, size, theta1=min(start, end), theta2=max(start, end), color=INK, lw=1.3))
    a = np.radians(end)
    step = np.radians(6.0) * np.sign(end - start)
    tip = centre[0] + 0.5 * size * np.cos(a), centre[1] + 0.5 * size * np.sin(a)
    tail = centre[0] + 0.5 * size * np.cos(a - step), centre[1] + 0.5 * size * np.sin(a - step)
    ax.annotate("", tip, tail, arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.3, "shrinkA": 0, "shrinkB": 0})
    ax.text(*at, text, color=INK, ha="center", va="center", fontsize=8.5)


def _behind(ax: Axes) -> None:
    wheel, rail = profile.s1002(), profile.rail_60e1()
    for sign, name in ((-1.0, "left"), (1.0, "right")):
        ax.plot(sign * (_TAPE + wheel.y), wheel.z, color=INK, lw=1.4)
        inner, outer = sign * (_TAPE + wheel.y[0]), sign * (_TAPE + wheel.y[-1])
        ax.plot([inner, inner], [wheel.z[0], -0.46], color=INK, lw=1.0)
        ax.plot([outer, outer], [wheel.z[-1], -0.46], color=INK, lw=1.0)
        ax.plot([inner, outer], [-0.46, -0.46], color=INK, lw=1.0)
        ax.plot(sign * (_TAPE + rail.y), rail.z - rail.z.min(), color=FAINT, lw=1.4)
        ax.text(sign * (_TAPE + 0.19), -0.2, f"{name}\nwheel", ha="center", va="center", color=INK, fontsize=8.5)
        c, s = np.cos(0.035), np.sin(0.035) * -sign
        start = (sign * _TAPE, 0.0)
        _arrow(ax, start, (start[0] + 0.2 * c, 0.2 * s), Y, "y", 0.03)
        _arrow(ax, start, (start[0] - 0.2 * s, 0.2 * c), Z, "z", 0.03, 0.03)
    ax.plot([-_HALF, _HALF], [-0.25, -0.25], color=INK, lw=5.0, solid_capstyle="butt", alpha=0.25)
    ax.plot([-1.05, 1.05], [0.0, 0.0], color=FAINT, lw=0.6, ls="--")
    _arrow(ax, (0.0, 0.0), (0.28, 0.0), Y, "y right", 0.1)
    _arrow(ax, (0.0, 0.0), (0.0, 0.24), Z, "z down", 0.11, 0.02)
    ax.plot(0.0, 0.0, marker="o", ms=9, mfc="white", mec=X, mew=1.4)
    ax.plot([-0.009, 0.009], [-0.009, 0.009], color=X, lw=1.2)
    ax.plot([-0.009, 0.009], [0.009, -0.009], color=X, lw=1.2)
    ax.text(-0.03, 0.06, "x forward,\ninto the page", color=X, ha="right", va="center", fontsize=8.5)
    _turn(ax, (0.0, -0.25), 0.3, -60.0, 40.0, "roll > 0", (0.27, -0.33))
    ax.set(xlim=(-1.1, 1.1), ylim=(0.3, -0.5))


def _above(ax: Axes) -> None:
    for side in (-1.0, 1.0):
        ax.plot([side * _TAPE] * 2, [-0.75, 0.85], color=FAINT, lw=4.0, alpha=0.5, solid_capstyle="butt")
    yaw = np.radians(-9.0)  # drawn with x up, so that steering to the right turns clockwise
    c, s = np.cos(yaw), np.sin(yaw)
    ax.plot([-_TAPE * c, _TAPE * c], [-_TAPE * s, _TAPE * s], color=INK, lw=4.0, alpha=0.35)
    for side in (-1.0, 1.0):
        ax.add_patch(
            Rectangle(
                (side * _TAPE * c - 0.06, side * _TAPE * s - 0.4),
                0.12,
                0.8,
                angle=np.degrees(yaw),
                rotation_point="center",
                fill=False,
                ec=INK,
                lw=1.3,
            )
        )
    _arrow(ax, (0.0, 0.0), (0.0, 0.75), X, "x forward", 0.22)
    _arrow(ax, (0.0, 0.0), (0.5, 0.0), Y, "y right", 0.0, 0.09)
    ax.text(-0.08, -0.17, "z down, into the page", color=Z, ha="center", fontsize=8.5)
    _turn(ax, (0.0, 0.0), 0.8, 125.0, 60.0, "yaw > 0", (-0.3, 0.45))
    ax.text(_TAPE - 0.12, -0.6, "right rail", color=INK, ha="right", fontsize=8.5)
    ax.text(-_TAPE + 0.12, -0.6, "left rail", color=INK, ha="left", fontsize=8.5)
    ax.set(xlim=(-1.0, 1.0), ylim=(-0.8, 0.95))


def _contact(ax: Axes) -> None:
    """Draw the contact at a flange root, where the angle is large enough to be seen."""
    wheel, rail = profile.s1002(), profile.rail_60e1()
    angle = np.radians(-40.0)
    k, j = (int(np.flatnonzero((one.angle < angle) & (one.y < 0.0)).max()) for one in (wheel, rail))
    shift = 1e3 * np.array([wheel.y[k] - rail.y[j], wheel.z[k] - rail.z[j]])
    ax.plot(1e3 * wheel.y, 1e3 * wheel.z, color=INK, lw=1.5)
    ax.plot(1e3 * rail.y + shift[0], 1e3 * rail.z + shift[1], color=FAINT, lw=1.5)
    at = 1e3 * wheel.y[k], 1e3 * wheel.z[k]
    c, s, length = np.cos(angle), np.sin(angle), 17.0
    _arrow(ax, at, (at[0] + length * c, at[1] + length * s), Y, "y, Fy", 6.0, -1.0)
    _arrow(ax, at, (at[0] - length * s, at[1] + length * c), Z, "z", 2.5, 2.0)
    ax.plot([at[0], at[0] + 16.0], [at[1], at[1]], color=FAINT, lw=0.8, ls="--")
    _turn(ax, at, 22.0, 0.0, -40.0, "angle < 0", (at[0] + 15.0, at[1] + 3.5))
    ax.text(24.0, -5.0, "wheel", color=INK, fontsize=8.5)
    ax.text(6.0, 12.0, "rail", color=FAINT, fontsize=8.5)
    ax.text(-68.0, -8.0, "track's centre ←", color=INK, fontsize=8.5)
    ax.set(xlim=(-72.0, 42.0), ylim=(34.0, -14.0))
