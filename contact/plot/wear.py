"""Figures of wear over a profile: stacked histograms, and the profile before and after wear."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from contact.arrays import as_array
from contact.errors import ContactError, require_number
from contact.plot.style import FAINT, INK, LINES, MM, drawn, looks

if TYPE_CHECKING:
    from contact.accumulation import Histogram
    from contact.geometry.profile import Profile


_UM = 1e6
_THOUSAND = 1e3  # metres, or axle passes
_FATIGUE = (
    ("fatigue_exceedance", 1.0, "FI_surf > 0 [-]"),
    ("stress_exceedance", 1.0, "SI > 0 [-]"),
    ("energy_index", 1e-6, "EI [MPa]"),
)


def wear(histograms: Mapping[str, Histogram], title: str = "") -> Figure:
    """Draw stacked wear depths of one profile, and the profile below them.

    The depths are per kilometre of the total distance for a wheel, and per thousand axle passes for a rail.

    Parameters
    ----------
    histograms : mapping of str to contact.accumulation.Histogram
        Histograms over one profile, by name.
    title : str
        Title of the figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there is no histogram, nothing has rolled, or the histograms are over different profiles.
    """
    total = _merged(histograms)
    with drawn(7.4, 4.6, title) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.6, 1.0])
        _stack(above, histograms, "wear", _UM * _THOUSAND / total.distance)
        above.set_ylabel("depth [µm per km]" if total.profile.kind == "wheel" else "depth [µm per 1000 axle passes]")
        above.legend()
        _outline(below, total.profile)
    return figure


def fatigue(histograms: Mapping[str, Histogram], title: str = "") -> Figure:
    """Draw stacked indicators of rolling contact fatigue over one profile, and the profile below them.

    From top to bottom: the share of the distance with a positive surface fatigue index of the patch, the share with a
    positive stress index somewhere along the strip, and the mean energy index.

    Parameters
    ----------
    histograms : mapping of str to contact.accumulation.Histogram
        Histograms over one profile, by name.
    title : str
        Title of the figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there is no histogram, nothing has rolled, or the histograms are over different profiles.
    """
    total = _merged(histograms)
    with drawn(7.4, 6.4, title) as figure:
        *above, below = figure.subplots(4, 1, sharex=True)
        for ax, (quantity, scale, label) in zip(above, _FATIGUE, strict=True):
            _stack(ax, histograms, quantity, scale / total.distance)
            ax.set_ylabel(label)
        above[0].legend()
        _outline(below, total.profile)
    return figure


def shares(profile: Profile, depths: Mapping[str, ArrayLike], title: str = "") -> Figure:
    """Draw stacked wear depths at the points of a profile, and the profile below them.

    Parameters
    ----------
    profile : Profile
        Profile with n points.
    depths : mapping of str to array_like, shape (n,)
        Depth worn off [m], by name of its cause.
    title : str
        Title of the figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        If there are no depths, or an array does not have a value for each point.
    """
    if not depths:
        raise ContactError("depths is empty; at least one is needed")
    with drawn(7.4, 4.6, title) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.6, 1.0])
        base = np.zeros(profile.y.size)
        for (name, depth), (colour, _) in zip(depths.items(), looks(depths).values(), strict=True):
            values = _UM * as_array(f"depths[{name!r}]", depth)
            if values.shape != base.shape:
                raise ContactError(f"depths[{name!r}] has shape {values.shape}; the profile has {base.size} points")
            above.fill_between(MM * profile.y, base, base + values, color=colour, lw=0.0, label=name)
            base = base + values
        above.plot(MM * profile.y, base, color=INK, lw=0.8)
        above.set_ylabel("depth worn off [µm]")
        above.set_ylim(0.0)
        above.legend()
        above.grid(visible=True)
        _outline(below, profile)
    return figure


def worn_profile(before: Profile, after: Profile, *, magnified: float = 1.0, title: str = "") -> Figure:
    """Draw a profile before and after wear, and the depth worn off along its normal.

    Parameters
    ----------
    before, after : Profile
        Profiles with corresponding points, as from `contact.accumulation.worn_profile`.
    magnified : float
        Magnification of the wear in the upper panel, positive. The depth in the lower panel is not magnified.
    title : str
        Title of the figure. It should tell how the depth was smoothed.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        For profiles of different kinds or numbers of points.
    """
    require_number("magnified", magnified, 0.0, open_minimum=True)
    if before.kind != after.kind or before.y.size != after.y.size:
        raise ContactError(f"before = {before!r} and after = {after!r} do not belong point to point")
    y, z = (a + magnified * (b - a) for a, b in ((before.y, after.y), (before.z, after.z)))
    with drawn(7.4, 4.6, title) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.2, 1.0])
        _outline(above, before, FAINT, "before")
        above.plot(
            MM * y, MM * z, color=LINES[1], lw=1.4, label="after" + f" (wear × {magnified:g})" * (magnified != 1.0)
        )
        above.set_xlabel("")
        above.legend()
        below.plot(MM * before.y, MM * np.hypot(after.y - before.y, after.z - before.z), color=LINES[1], lw=1.4)
        below.set(xlabel="y [mm], to the field side", ylabel="depth worn off [mm]")
        below.set_ylim(0.0)
        below.grid(visible=True)
    return figure


def _merged(histograms: Mapping[str, Histogram]) -> Histogram:
    """Return the sum of the histograms. Raise a ContactError if they do not add up or nothing has rolled."""
    if not histograms:
        raise ContactError("histograms is empty; at least one is needed")
    total, *others = histograms.values()
    for other in others:
        total = total + other
    if total.distance <= 0.0:
        raise ContactError("distance = 0: nothing has rolled yet")
    return total


def _stack(ax: Axes, histograms: Mapping[str, Histogram], quantity: str, scale: float) -> None:
    """Draw one quantity of the histograms, stacked. Areas are hatched where lines would be dashed."""
    first = next(iter(histograms.values()))
    edges = MM * np.interp(first.edges, first.arc, first.profile.y)
    base = np.zeros(edges.size - 1)
    for (name, histogram), (colour, dashes) in zip(histograms.items(), looks(histograms).values(), strict=True):
        top = base + scale * histogram[quantity]
        ax.stairs(
            top,
            edges,
            baseline=base,
            fill=True,
            fc=colour,
            ec="white",
            lw=0.0,
            label=name,
            hatch="/////" if dashes != "-" else None,
        )
        base = top
    ax.stairs(base, edges, color=INK, lw=0.8)
    ax.set_ylim(0.0)
    ax.grid(visible=True)


def _outline(ax: Axes, profile: Profile, colour: str = INK, name: str = "") -> None:
    ax.plot(MM * profile.y, MM * profile.z, color=colour, lw=1.4, label=name or profile.name or profile.kind)
    ax.set(xlabel="y [mm], to the field side", ylabel="z [mm], down")
    ax.invert_yaxis()
