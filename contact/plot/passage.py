"""Figures of a wheel that rolls along surfaces: heights, contact points, forces and patches over the distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contact.errors import ContactError
from contact.plot.style import DPI, INK, LINES, MM, colour_map, style

if TYPE_CHECKING:
    from matplotlib.collections import QuadMesh

    from contact.passage import Passage
    from contact.solution import Solution
    from contact.surface_pair import SurfaceSolution

_GPA, _KN, _MPA = 1e-9, 1e-3, 1e-6


def passage(run: Passage, title: str = "") -> Figure:
    """Draw height of the wheel, contact points, forces and largest pressure over the distance.

    Areas of points are proportional to the normal forces of their patches; patches are numbered from the field side.

    Raises
    ------
    ContactError
        If there are fewer than two stations.
    """
    if run.station.size < 2:
        raise ContactError(f"{run.station.size} station: a figure over the distance needs at least two")
    rows, columns = run.rows(), run.columns()
    at = MM * columns["station"]
    with style():
        figure = Figure(figsize=(7.4, 8.4), dpi=DPI, layout="constrained")
        height, ahead, across, force, pressure = figure.subplots(5, 1, sharex=True)
        height.plot(at, -MM * columns["z"], color=INK, lw=1.2)
        height.set(ylabel="wheel rises\n[mm]", title=title)
        largest = max((row["N"] for row in rows), default=1.0)
        for k in sorted({row["patch"] for row in rows}):
            own = [row for row in rows if row["patch"] == k]
            s = MM * np.array([row["station"] for row in own])
            area = 4.0 + 30.0 * np.array([row["N"] for row in own]) / largest
            for ax, name in ((ahead, "x"), (across, "y")):
                ax.scatter(s, MM * np.array([row[name] for row in own]), s=area, color=LINES[k % len(LINES)], lw=0.0)
            pressing = np.array([row["N"] for row in own])
            force.plot(s, _KN * pressing, ".", ms=3.0, color=LINES[k % len(LINES)], label=f"N, patch {k + 1}")
            pressure.plot(
                s, _GPA * np.array([row["max_pressure"] for row in own]), ".", ms=3.0, color=LINES[k % len(LINES)]
            )
        force.plot(at, _KN * columns["Q"], color=INK, lw=1.0, label="vertical force Q")
        force.plot(at, _KN * columns["Y"], color=INK, lw=1.0, ls=":", label="lateral force Y")
        force.legend(ncols=2)
        ahead.set(ylabel="contact ahead\nof the axle [mm]")
        across.set(ylabel="contact at y\n[mm]")
        force.set(ylabel="force [kN]")
        pressure.set(ylabel="largest\npressure [GPa]", xlabel="station of the axle [mm]", ylim=(0.0, None))
        for ax in (height, ahead, across, force, pressure):
            ax.grid(visible=True)
            ax.margins(x=0.01)
    return figure


def patches_on_track(one: SurfaceSolution, title: str = "") -> Figure:
    """Draw the pressure of all patches of one instant, each in its own plane, with its place on the track.

    Raises
    ------
    ContactError
        Without contact.
    """
    if not one.contacts:
        raise ContactError("there is no contact to draw")
    wide, long = (0.55 * MM * max(float(np.ptp(getattr(c.solution, k))) for c in one.contacts) for k in ("y", "x"))
    with style():
        figure = Figure(figsize=(7.4, 3.8), dpi=DPI, layout="constrained")
        axes = figure.subplots(1, len(one.contacts), squeeze=False, sharey=True)[0]
        top = _MPA * one.max_pressure
        for k, (ax, contact) in enumerate(zip(axes, one.contacts, strict=True)):
            image = _pressure(ax, contact.solution, top)
            x, y, _ = contact.patch.position
            ax.set(
                title=f"patch {k + 1}: N = {_KN * contact.solution.N:.1f} kN\nat x = {MM * x:.1f}, y = {MM * y:.1f} mm\n"
                f"contact angle {np.degrees(contact.patch.angle):.1f}°",
                xlabel="across [mm]",
                ylabel="along [mm]" if k == 0 else "",
                xlim=(-wide, wide),
                ylim=(-long, long),
            )
        figure.colorbar(image, ax=axes.tolist(), label="pressure [MPa]")
        figure.suptitle(title)
    return figure


def _pressure(ax: Axes, solution: Solution, top: float) -> QuadMesh:
    y, x, p = solution.y, solution.x, solution.p
    image = ax.pcolormesh(
        MM * y, MM * x, _MPA * p, cmap=colour_map("YlOrRd", 0.9), vmin=0.0, vmax=top, shading="nearest", rasterized=True
    )
    ax.set_aspect("equal")
    return image
