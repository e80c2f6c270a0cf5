"""Figure of the stresses below the surface: a section along the rolling direction, and profiles over the depth."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contact.arrays import Array
from contact.errors import ContactError
from contact.plot.style import FAINT, INK, MM, colour_map, drawn, looks, nice
from contact.results import Solution
from contact.stress import SurfaceLoad, at, below, largest
from contact.stress.field import CRITERIA, Peak

_NAMES = dict(zip(CRITERIA, ("von Mises", "Tresca", "largest principal", "|τ xz|", "|τ yz|"), strict=True))
#: Depths of the figure, and the deepest over the radius of a circle with the contact's area.
_DEPTHS, _DEEPEST = 60, 2.0


def stress(
    load: Solution | SurfaceLoad,
    criterion: str = "von_mises",
    *,
    body: str = "rail",
    poisson_ratio: float | None = None,
    title: str = "",
) -> Figure:
    """Draw the stresses below a contact: the section y = const. through the largest value, and depth profiles there.

    Parameters
    ----------
    load, body, poisson_ratio
        As in `contact.stress.at`.
    criterion : str
        The scalar of the section, as in `contact.stress.largest`.
    title : str
        Title of the figure.

    Returns
    -------
    Figure

    Raises
    ------
    ContactError
        As `contact.stress.largest`.
    """
    surface = SurfaceLoad.of(load) if isinstance(load, Solution) else load
    if not isinstance(surface, SurfaceLoad):
        raise ContactError(f"load = {load!r} is neither a contact.Solution nor a contact.stress.SurfaceLoad")
    if isinstance(load, Solution) and poisson_ratio is None:
        poisson_ratio = load.material.poisson_ratio
    peak = largest(surface, criterion, body=body, poisson_ratio=poisson_ratio)
    z = surface.radius * _DEEPEST * np.linspace(0.0, 1.0, _DEPTHS) ** 1.5  # closer at the surface
    field = below(surface, z, body=body, poisson_ratio=poisson_ratio)
    row = int(np.abs(field.y[0, :, 0] - peak.y).argmin())
    section = 1e-6 * getattr(field, criterion)[:, row]
    profile = at(surface, peak.x, peak.y, z, body=body, poisson_ratio=poisson_ratio)
    with drawn(8.0, 3.4, title) as figure:
        left, right = figure.subplots(1, 2, width_ratios=(1.7, 1.0))
        _section(left, MM * field.x[0, row], MM * z, section, peak, criterion)
        for name, (colour, _) in looks(CRITERIA[:4]).items():
            right.plot(1e-6 * getattr(profile, name), MM * z, color=colour, lw=1.4, label=_NAMES[name])
        right.plot(1e-6 * peak.value, MM * peak.z, "o", color=INK, ms=4.0)
        right.axvline(0.0, color=FAINT, lw=0.6, zorder=0)
        right.set(xlabel="stress [MPa]", ylabel="depth [mm]", ylim=(MM * z[-1], 0.0))
        right.set_title(f"at x = {MM * peak.x:.2f}, y = {MM * peak.y:.2f} mm", loc="left", fontsize=8.0)
        right.grid(visible=True)
        right.legend(loc="lower left")
    return figure


def _section(ax: Axes, x: Array, z: Array, values: Array, peak: Peak, criterion: str) -> None:
    """Draw the scalar in the section through its peak; x, z and values in mm and MPa."""
    top = nice(max(float(values.max()), 1e-9))
    levels, name = np.linspace(0.0, top, 41), _NAMES[criterion]
    filled = ax.contourf(x, z, np.maximum(values, 0.0), levels=levels, cmap=colour_map("YlOrRd", 0.9))
    ax.contour(x, z, values, levels=levels[4::4], colors=INK, linewidths=0.4)
    ax.plot(MM * peak.x, MM * peak.z, "o", color=INK, ms=4.0)
    ax.set(xlabel="x [mm], rolling →", ylabel="depth [mm]", ylim=(z[-1], z[0]), aspect="equal")
    place = f"y = {MM * peak.y:.2f} mm, largest {1e-6 * peak.value:.4g} MPa, {MM * peak.z:.2f} mm deep"
    ax.set_title(f"{name} at {place}", loc="left", fontsize=8.0)
    ax.figure.colorbar(filled, ax=ax, label=f"{name} [MPa]", pad=0.02, format="%.0f")
