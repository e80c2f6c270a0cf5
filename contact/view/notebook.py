"""Small HTML tables and SVG sketches for notebooks, made without other libraries.

Text, axes and outlines have the colour of the page's text, so they are legible on light and dark pages. All text is
escaped.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array

#: Fill of areas. Its medium lightness is visible on white and on black.
COLOUR = "#3b8bd0"
#: Maximum number of points of a curve and of bars in a sketch.
MOST = 240

_CELL = "text-align:left;padding:1px 10px 1px 0;border:0;vertical-align:top"


#: What `draw_with` was given.
_FIGURES: list[Callable[[], Any]] = []


def draw_with(figures: Callable[[], Any]) -> None:
    """Let methods of records draw with what `figures()` returns: functions by their names."""
    _FIGURES[:] = [figures]


def figures() -> Any:
    """Return the functions that draw. `contact` gives its `plot`, imported when a figure is asked for: it needs matplotlib.

    Raises
    ------
    ImportError
        If matplotlib is missing; the message names the extra.
    """
    return _FIGURES[0]()


def table(headings: Sequence[str], rows: Iterable[Sequence[str]], caption: str = "") -> str:
    """Return an HTML table. Every cell is text and is escaped."""
    title = (
        f'<caption style="text-align:left;font-weight:bold;color:inherit">{escape(caption)}</caption>'
        if caption
        else ""
    )
    head = "".join(f'<th style="{_CELL}">{escape(heading)}</th>' for heading in headings)
    body = "".join(
        "<tr>" + "".join(f'<td style="{_CELL}">{escape(cell)}</td>' for cell in row) + "</tr>" for row in rows
    )
    top = f"<thead><tr>{head}</tr></thead>" if head else ""
    style = "border-collapse:collapse;background:transparent;color:inherit"
    return f'<table style="{style}">{title}{top}<tbody>{body}</tbody></table>'


def beside(*parts: str) -> str:
    """Return HTML parts side by side."""
    cells = "".join(f"<div>{part}</div>" for part in parts)
    return f'<div style="display:flex;flex-wrap:wrap;gap:24px;align-items:flex-start;color:inherit">{cells}</div>'


class Sketch:
    """Axes with areas, bars and curves, as an SVG.

    Parameters
    ----------
    x, y : (float, float)
        Ranges to show, in the units of `labels`.
    labels : (str, str)
        Labels below the horizontal axis and above the vertical axis.
    title : str
        Title for screen readers.
    width, height : float
        Size of the axes [px].
    equal : bool
        Use one scale for both axes. The height then follows from the width.
    """

    def __init__(
        self,
        x: tuple[float, float],
        y: tuple[float, float],
        labels: tuple[str, str],
        title: str,
        *,
        width: float = 260.0,
        height: float = 110.0,
        equal: bool = False,
    ) -> None:
        (self._left, right), (self._low, high) = _range(x), _range(y)
        if equal:
            height = width * (high - self._low) / (right - self._left)
            if height > width:  # a tall sketch: the given width becomes its height
                width, height = width * width / height, width
        self._scale = width / (right - self._left), height / (high - self._low)
        self._size, self._ends, self._labels, self._title = (width, height), (right, high), labels, title
        self._parts: list[str] = []

    def area(self, x: ArrayLike, y: ArrayLike, opacity: float = 0.35) -> None:
        """Fill the polygon with the corners `x`, `y` and draw its outline."""
        self._parts.append(
            f'<polygon points="{self._points(x, y)}" fill="{COLOUR}" fill-opacity="{opacity:.2f}" '
            'stroke="currentColor" stroke-width="1"/>'
        )

    def curve(self, x: ArrayLike, y: ArrayLike) -> None:
        """Draw a curve through the points `x`, `y`."""
        self._parts.append(
            f'<polyline points="{self._points(x, y)}" fill="none" stroke="currentColor" stroke-width="1.2"/>'
        )

    def bars(self, x: Array, width: Array, low: Array, high: Array, opacity: Array) -> None:
        """Draw bars centred at `x` from `low` to `high`, each with its `opacity`. If there are many, draw fewer, wider bars."""
        step = -(-x.size // MOST)
        for k in range(0, x.size, step):
            half = 0.5 * width[k] * step
            left, top = self._place(x[k] - half, high[k])
            right, bottom = self._place(x[k] + half, low[k])
            self._parts.append(
                f'<rect x="{left:.1f}" y="{top:.1f}" width="{max(right - left, 0.1):.1f}" '
                f'height="{max(bottom - top, 0.1):.1f}" fill="{COLOUR}" fill-opacity="{opacity[k]:.2f}"/>'
            )

    def svg(self) -> str:
        """Return the sketch as an SVG element."""
        width, height = self._size
        wide, tall = width + 60.0, height + 52.0
        style = 'fill="currentColor" font-size="11" font-family="sans-serif"'
        x_end, y_end = self._ends
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" role="img" width="{wide:.0f}" height="{tall:.0f}" '
            f'viewBox="-44 -20 {wide:.0f} {tall:.0f}" style="color:inherit;overflow:visible">'
            f"<title>{escape(self._title)}</title>{''.join(self._parts)}"
            f'<path d="M0 0V{height:.1f}H{width:.1f}" fill="none" stroke="currentColor" stroke-width="1" stroke-opacity="0.6"/>'
            f'<text x="0" y="{height + 14:.1f}" text-anchor="middle" {style}>{self._left:.4g}</text>'
            f'<text x="{width:.1f}" y="{height + 14:.1f}" text-anchor="middle" {style}>{x_end:.4g}</text>'
            f'<text x="{0.5 * width:.1f}" y="{height + 27:.1f}" text-anchor="middle" {style}>{escape(self._labels[0])}</text>'
            f'<text x="-4" y="{height:.1f}" text-anchor="end" {style}>{self._low:.3g}</text>'
            f'<text x="-4" y="8" text-anchor="end" {style}>{y_end:.3g}</text>'
            f'<text x="0" y="-8" {style}>{escape(self._labels[1])}</text></svg>'
        )

    def _place(self, x: float, y: float) -> tuple[float, float]:
        """Return the position of a point in pixels."""
        return (x - self._left) * self._scale[0], self._size[1] - (y - self._low) * self._scale[1]

    def _points(self, x: ArrayLike, y: ArrayLike) -> str:
        """Return the positions of points in pixels, as text for SVG. If there are many, keep only every n-th."""
        both = np.column_stack((np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)))
        step = max(1, -(-len(both) // (2 * MOST)))
        kept = np.unique(np.r_[0 : len(both) : step, len(both) - 1])
        return " ".join(f"{u:.1f},{v:.1f}" for u, v in (self._place(*both[k]) for k in kept))


def _range(ends: tuple[float, float]) -> tuple[float, float]:
    """Return the range as floats. An empty range gets the length 1."""
    low, high = float(ends[0]), float(ends[1])
    return (low, high) if high > low else (low, low + 1.0)
