"""Colours, fonts and scales of all figures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.colors import Colormap, LinearSegmentedColormap
from matplotlib.figure import Figure

from contact.registry import methods

MM = 1e3  # per metre
INK, FAINT, GRID = "#22262b", "#8a9099", "#eceef1"
LINES = ("#1f5fa8", "#d1602c", "#2b8a57", "#8a4fa3", "#b8911f", "#5b6770")
DPI = 150.0

_STYLE: Any = {
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": FAINT,
    "ytick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
}


def style() -> AbstractContextManager[None]:
    """Return a context manager in which new axes have the project's style. The user's settings are not changed."""
    return mpl.rc_context(_STYLE)


@contextmanager
def drawn(width: float, height: float, title: str = "") -> Iterator[Figure]:
    """Context manager with a new figure in the project's style, `width` by `height` [inch]; in the end it gets its title."""
    with style():
        figure = Figure(figsize=(width, height), dpi=DPI, layout="constrained")
        yield figure
        if title:
            figure.suptitle(title, x=0.01, ha="left", fontsize=10.0)


class Look(NamedTuple):
    """Colour and dashes of a line."""

    colour: str
    dashes: str


def looks(names: Iterable[str]) -> dict[str, Look]:
    """Return name → look of lines that are drawn together. Sides and methods look the same in every figure.

    The right side is blue and the left orange. A method has the look of its place in the registry. Other names take the
    colours that are left, in their order, and other dashes when the colours are used up.
    """
    wanted = list(dict.fromkeys(names))
    sides = {name: LINES[_SIDES.index(word)] for name in wanted if (word := name.split(" ")[0]) in _SIDES}
    registered = [*methods().tangential, *methods().normal]
    if wanted and all(name in registered for name in wanted):
        kinds = methods().tangential if wanted[0] in methods().tangential else methods().normal
        return {name: _look(LINES, list(kinds).index(name)) for name in wanted}
    free = [colour for colour in LINES if colour not in sides.values()]
    others = [name for name in wanted if name not in sides]
    return {name: Look(colour, "-") for name, colour in sides.items()} | {
        name: _look(free, k) for k, name in enumerate(others)
    }


def _look(among: Sequence[str], k: int) -> Look:
    return Look(among[k % len(among)], _DASHES[k // len(among) % len(_DASHES)])


_SIDES = ("right", "left")
_DASHES = ("-", "--", ":", "-.")


def colour_map(name: str, to: float, low: float = 0.0, high: float = 1.0) -> Colormap:
    """Return a colour map that is white at zero and ends at the share `to` of the sequential map `name` at `high`.

    Dark arrows are readable on all its colours. From zero down to `low` it goes from white to violet.
    """
    positive = [(0.0, "white"), *((s, mpl.colormaps[name](0.1 + (to - 0.1) * s)) for s in np.linspace(0.1, 1.0, 12))]
    stops = [((s * high - low) / (high - low), colour) for s, colour in positive]
    if low < 0.0:
        stops.insert(0, (0.0, mpl.colormaps["Purples"](min(1.0, 0.25 - low / high))))
    return LinearSegmentedColormap.from_list(name, stops, N=512)


def nice(top: float) -> float:
    """Return the upper end of a scale for `top` > 0: the next of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of 10."""
    power = 10.0 ** np.floor(np.log10(top))
    steps = np.array([1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0])
    return float(power * steps[np.searchsorted(steps, top / power * (1.0 - 1e-9))])
