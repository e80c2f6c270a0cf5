"""Creep curves and time histories."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike, NDArray

from contact.arrays import as_array
from contact.errors import ContactError
from contact.plot.style import DPI, FAINT, drawn, looks, style

INSIDE = 4  # most curves whose legend finds a place among them
Lines = Mapping[str, ArrayLike]


def curve(
    creepage: ArrayLike,
    curves: Lines,
    *,
    xlabel: str = "creepage [-]",
    ylabel: str = "creep force over normal force [-]",
    limit: float | None = None,
    title: str = "",
    ax: Axes | None = None,
) -> FigureBase:
    """Draw creep curves.

    Parameters
    ----------
    creepage : array_like, shape (n,)
        Abscissa.
    curves : mapping of str to array_like, shape (n,)
        Ordinates by name.
    xlabel, ylabel : str
        Labels of the axes.
    limit : float, optional
        Friction limit, drawn as a dashed line on each side of zero that has curves.
    title : str
        What all curves have in common, above them.
    ax : matplotlib Axes, optional
        Axes to draw on; default those of a new figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If a curve is not as long as the abscissa.
    """
    abscissa = as_array("creepage", creepage)
    with style():
        if ax is None:
            width = 5.6 if len(curves) <= INSIDE else 7.6
            ax = Figure(figsize=(width, 3.6), dpi=DPI, layout="constrained").subplots()
        sides = set()  # signs of the ordinates
        for name, look in looks(curves).items():
            ordinate = _ordinate(name, curves[name], abscissa)
            ax.plot(abscissa, ordinate, color=look.colour, lw=1.6, ls=look.dashes, label=name)
            sides.update(np.sign(ordinate[ordinate != 0.0]).tolist())
        if limit is not None:
            for side in sides:
                ax.axhline(side * limit, color=FAINT, lw=0.9, ls="--", zorder=0)
        ax.axhline(0.0, color=FAINT, lw=0.6, zorder=0)
        ax.set(xlabel=xlabel, ylabel=ylabel)
        ax.set_title(title, loc="left", fontsize=8.0)
        ax.margins(x=0.0)
        if len(curves) <= INSIDE:
            ax.legend()
        else:  # beside the curves, which it would cover
            ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    return ax.figure


def time_histories(
    time: ArrayLike, panels: Mapping[str, Lines], *, xlabel: str = "time [s]", title: str = ""
) -> Figure:
    """Draw time histories in panels, one below the other, over a common abscissa.

    Parameters
    ----------
    time : array_like, shape (n,)
        Abscissa.
    panels : mapping of str to mapping of str to array_like
        Label of the ordinate with its unit → name of the line → values, shape (n,). Lines of the same name have the same
        colour.
    xlabel, title : str
        Label of the abscissa and title of the figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there is no panel, or a line is not as long as the abscissa.
    """
    if not panels:
        raise ContactError("panels is empty; at least one is needed")
    abscissa = as_array("time", time)
    names = list(dict.fromkeys(name for lines in panels.values() for name in lines))
    look = looks(names)
    with drawn(7.4, 0.9 + 1.5 * len(panels), title) as figure:
        axes = figure.subplots(len(panels), 1, squeeze=False, sharex=True)[:, 0]
        for ax, (label, lines) in zip(axes, panels.items(), strict=True):
            for name, values in lines.items():
                ax.plot(
                    abscissa,
                    _ordinate(name, values, abscissa),
                    color=look[name].colour,
                    ls=look[name].dashes,
                    lw=1.2,
                    label=name,
                )
            ax.set_ylabel(label)
            ax.yaxis.set_major_locator(MaxNLocator(4))
            ax.grid(visible=True)
            ax.margins(x=0.0)
            if len(lines) > 1:
                ax.legend(loc="lower right", bbox_to_anchor=(1.0, 0.96), borderaxespad=0.0, ncols=len(lines))
        axes[-1].set_xlabel(xlabel)
        figure.align_ylabels(axes)
    return figure


def _ordinate(name: str, values: ArrayLike, abscissa: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return `values` as an array. Raise a ContactError if it is not as long as the abscissa."""
    ordinate = as_array(f"line {name!r}", values)
    if ordinate.shape != abscissa.shape:
        raise ContactError(
            f"line {name!r} has shape {ordinate.shape}; that of the abscissa, {abscissa.shape}, is needed"
        )
    return ordinate
