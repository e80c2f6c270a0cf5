"""Figure of a wheel that rolls along surfaces: heights, contact points, forces and pressure over the distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from contact.errors import ContactError
from contact.plot.style import INK, LINES, MM, drawn

if TYPE_CHECKING:
    from contact.pair import PairRun

_GPA, _KN = 1e-9, 1e-3


def passage(run: PairRun, title: str = "") -> Figure:
    """Draw height of the wheel, contact points, forces and largest pressure over the distance.

    Areas of points are proportional to the normal forces of their patches; patches are numbered from the field side.

    Raises
    ------
    ContactError
        If there are fewer than two stations.
    """
    if len(run.solutions) < 2:
        raise ContactError(f"{len(run.solutions)} station: a figure over the distance needs at least two")
    rows, at = run.patches(), MM * run["station"]
    with drawn(7.4, 8.4) as figure:
        height, ahead, across, force, pressure = figure.subplots(5, 1, sharex=True)
        height.plot(at, -MM * run["z"], color=INK, lw=1.2)
        height.set(ylabel="wheel rises\n[mm]", title=title)
        largest = max((row["N"] for row in rows), default=1.0)
        for k in sorted({row["patch"] for row in rows}):
            seen = [row for row in rows if row["patch"] == k]
            s = MM * np.array([row["station"] for row in seen])
            area = 4.0 + 30.0 * np.array([row["N"] for row in seen]) / largest
            for ax, name in ((ahead, "x"), (across, "y")):
                ax.scatter(s, MM * np.array([row[name] for row in seen]), s=area, color=LINES[k % len(LINES)], lw=0.0)
            pressing = np.array([row["N"] for row in seen])
            force.plot(s, _KN * pressing, ".", ms=3.0, color=LINES[k % len(LINES)], label=f"N, patch {k + 1}")
            pressure.plot(
                s, _GPA * np.array([row["max_pressure"] for row in seen]), ".", ms=3.0, color=LINES[k % len(LINES)]
            )
        force.plot(at, _KN * run["Q"], color=INK, lw=1.0, label="vertical force Q")
        force.plot(at, _KN * run["Y"], color=INK, lw=1.0, ls=":", label="lateral force Y")
        force.legend(ncols=2)
        ahead.set(ylabel="contact ahead\nof the axle [mm]")
        across.set(ylabel="contact at y\n[mm]")
        force.set(ylabel="force [kN]")
        pressure.set(ylabel="largest\npressure [GPa]", xlabel="station of the axle [mm]", ylim=(0.0, None))
        for ax in (height, ahead, across, force, pressure):
            ax.grid(visible=True)
            ax.margins(x=0.01)
    return figure
