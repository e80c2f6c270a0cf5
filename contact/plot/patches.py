"""Contact patches seen from above, in millimetres and MPa. The rolling direction x points up, y to the right."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure, FigureBase
from matplotlib.ticker import MultipleLocator

from contact.arrays import Array
from contact.damage import evaluate
from contact.errors import ContactError
from contact.plot.mesh import PatchMesh
from contact.plot.style import DPI, FAINT, INK, colour_map, nice, style
from contact.results import Solution


def patch(
    solution: Solution | Sequence[Solution],
    titles: str | Sequence[str] = (),
    *,
    ax: Axes | None = None,
    figure: FigureBase | None = None,
) -> FigureBase:
    """Draw contact patches: pressure with stick/slip boundary and traction arrows, and below them the energy index.

    All patches share the scales of lengths, colours and arrows.

    Parameters
    ----------
    solution : Solution or sequence of Solution
        Each solution is drawn in a column.
    titles : str or sequence of str
        Titles of the columns.
    ax : matplotlib Axes, optional
        Draw only the pressure of one solution on these axes.
    figure : matplotlib Figure or SubFigure, optional
        Draw into this empty figure; default a new figure of suitable size.

    Returns
    -------
    Figure
        The figure of `ax`, `figure`, or the new figure.

    Raises
    ------
    ContactError
        If there is no solution, the number of titles differs from that of the solutions, or `ax` is given with several
        solutions.
    """
    solutions = [solution] if isinstance(solution, Solution) else list(solution)
    titles = [titles] if isinstance(titles, str) else list(titles)
    if not solutions:
        raise ContactError("solution is empty; at least one is needed")
    if titles and len(titles) != len(solutions):
        raise ContactError(f"titles has {len(titles)} entries for {len(solutions)} solutions")
    if ax is not None and len(solutions) > 1:
        raise ContactError(f"ax takes one solution; {len(solutions)} are given")
    titles = titles or [""] * len(solutions)
    scale = EnergyScale(solutions)
    with style():
        if ax is not None:
            figure = ax.figure
            figure.colorbar(_pressure(ax, solutions[0], titles[0], scale), ax=ax, label="pressure [MPa]", pad=0.02)
            ax.set(xlabel="y [mm]", ylabel="x [mm], rolling ↑")
            return figure
        if figure is None:
            figure = Figure(figsize=scale.figure_size(len(solutions)), dpi=DPI, layout="compressed")
        grid = figure.subplots(2, len(solutions), squeeze=False, sharex="col", sharey=True)
        for column, solved, title in zip(grid.T, solutions, titles, strict=True):
            pressure = _pressure(column[0], solved, title, scale)
            energy = _energy(column[1], solved, scale)
            column[1].set_xlabel("y [mm]")
        for row, colours, label in zip(grid, (pressure, energy), ("pressure [MPa]", scale.energy_label), strict=True):
            row[0].set_ylabel("x [mm], rolling ↑")
            slender = max(20.0, 8.0 * scale.half_x / (len(row) * scale.half_y))
            figure.colorbar(colours, ax=list(row), label=label, pad=0.02, aspect=slender)
        figure.supxlabel(scale.caption(len(solutions)), fontsize=8.0, color=FAINT)
    return figure


class Scale:
    """Common scales of the panels of one figure. With `together`, all panels show the same region."""

    def __init__(self, solutions: Sequence[Solution], together: bool = False) -> None:
        touching = [s for s in solutions if s.p.size]
        meshes = [PatchMesh(s, k) for s in touching for k in range(s.n_patches)]
        self.pressure = 0.0, nice(max((s.max_pressure for s in touching), default=1e6) * 1e-6)
        self.traction = max((float(np.hypot(s.qx, s.qy).max()) for s in touching if s.has_fields), default=0.0)
        # half the size [mm] of a window that contains every solution with a margin
        boxes = np.array([box(s) for s in (touching if together and touching else solutions)])
        if together:
            boxes = np.stack([boxes[:, 0::2].min(axis=0), boxes[:, 1::2].max(axis=0)]).T.reshape(1, 4)
        self.box = boxes[0] if together else None
        sizes = boxes[:, 1::2] - boxes[:, 0::2]
        self.half_y, self.half_x = 0.5 * sizes.max(axis=0) + 0.1 * sizes.max()
        largest = max((m.dA.sum() for m in meshes), default=0.0)
        main = [m for m in meshes if m.dA.sum() > 0.1 * largest]
        narrowest = min((min(np.ptp(m.edges), 2.0 * m.a.max()) for m in main), default=1.0)
        window = max(self.half_x, self.half_y)
        self.spacing = max(min(0.17 * window, 0.25 * narrowest), 0.06 * window)

    def figure_size(self, n: int, panel: float = 3.6) -> tuple[float, float]:
        """Return width and height [inch] for n columns of panels whose longer side is at most `panel` [inch]."""
        inch = min(0.5 * panel / max(self.half_y, self.half_x), 5.5 / (n * self.half_y), 0.25)  # per mm
        width, height = max(2.0 * self.half_y * inch, 2.2), max(2.0 * self.half_x * inch, 1.6)
        return max(n * (width + 0.15) + 1.6, 4.6), 2.0 * height + 1.75

    def caption(self, n: int) -> str:
        """Return the meaning of lines and arrows, in two lines for a single column."""
        longest = f"longest arrow: traction on the wheel {self.traction * 1e-6:.4g} MPa"
        separator = "\n" if n == 1 else "  ·  "
        return separator.join((longest if self.traction else "no traction", "dashed: boundary of stick and slip"))


class EnergyScale(Scale):
    """Scales with the limits of the energy index."""

    def __init__(self, solutions: Sequence[Solution]) -> None:
        super().__init__(solutions)
        energies = [evaluate(s).energy_index.field for s in solutions if s.p.size]
        top = max((float(e.max()) for e in energies), default=0.0)
        bottom = min((float(e.min()) for e in energies), default=0.0)
        self.energy_unit, self.energy_factor = ("MPa", 1e-6) if top >= 0.1e6 else ("kPa", 1e-3)
        high, low = (nice(max(e, 1.0) * self.energy_factor) for e in (top, -bottom))
        self.energy = (-low if bottom < -0.01 * top else 0.0, high)
        returned = "\nviolet: elastic energy comes back" if self.energy[0] < 0.0 else ""
        self.energy_label = f"energy index [{self.energy_unit}]{returned}"


def _pressure(ax: Axes, solution: Solution, title: str, scale: Scale) -> ScalarMappable:
    """Draw pressure and tractions of one solution. Return the colours for the colour bar."""
    numbers = "no contact"
    if solution.p.size:
        numbers = (
            f"N = {solution.N * 1e-3:.3g} kN,  $p_0$ = {solution.max_pressure * 1e-6:.0f} MPa\n"
            f"area {solution.area * 1e6:.3g} mm²,  {slip_share(solution)}"
        )
    heading(ax, title, numbers)
    colours = window(ax, solution, solution.p * 1e-6, colour_map("Blues", 0.75), scale.pressure, scale)
    arrows(ax, solution, scale)
    return colours


def slip_share(solution: Solution) -> str:
    """Return the share of the drawn slip zone in the patch, as text; "forces only" if a method gives no fields.

    It is counted on the elements, so it agrees with the drawn boundary. `Solution.slip_ratio` is that of the strips.
    """
    meshes = [PatchMesh(solution, k) for k in range(solution.n_patches)]
    if not all(mesh.has_fields for mesh in meshes):
        return "forces only"
    whole = sum(float(mesh.dA[mesh.inside].sum()) for mesh in meshes)
    slipping = sum(float(mesh.dA[mesh.inside & ~mesh.stick].sum()) for mesh in meshes)
    return f"slip {100.0 * slipping / whole:.0f} %"


def heading(ax: Axes, title: str, numbers: str) -> None:
    """Write a bold title, and below it two lines of numbers."""
    ax.set_title(numbers, loc="left", fontsize=8.0, linespacing=1.35)
    ax.annotate(title, (0.0, 1.0), (0.0, 32.0), xycoords="axes fraction", textcoords="offset points", weight="bold")


def arrows(ax: Axes, solution: Solution, scale: Scale) -> None:
    """Draw the tractions on the wheel as arrows on a square raster."""
    for k in range(solution.n_patches):
        y, x, qy, qx = PatchMesh(solution, k).arrows(scale.spacing)
        seen = np.hypot(qx, qy) > 0.1 * scale.traction  # shorter arrows would be dots
        if seen.any():
            ax.quiver(
                *(row[seen] for row in (y, x, qy, qx)),
                angles="xy",
                scale_units="xy",
                scale=scale.traction / (1.25 * scale.spacing),
                pivot="mid",
                color=INK,
                width=0.055 * scale.spacing,
                units="xy",
                headwidth=4.0,
                headlength=5.0,
                headaxislength=4.5,
                zorder=3,
            )


def _energy(ax: Axes, solution: Solution, scale: EnergyScale) -> ScalarMappable:
    """Draw the energy index of one solution and the names of its zones. Return the colours for the colour bar."""
    values = evaluate(solution).energy_index.field * scale.energy_factor
    colours = window(ax, solution, values, colour_map("YlOrRd", 0.85, *scale.energy), scale.energy, scale)
    zones(ax, solution, scale)
    return colours


def zones(ax: Axes, solution: Solution, scale: Scale) -> None:
    """Write the names of the zones of stick and slip."""
    halo = [patheffects.withStroke(linewidth=2.5, foreground="white", alpha=0.8)]
    for k in range(solution.n_patches):
        for name, place in PatchMesh(solution, k).labels(least_room=0.04 * scale.half_y).items():
            ax.text(*place, name, ha="center", va="center", fontsize=8.0, clip_on=True, path_effects=halo)


def window(
    ax: Axes, solution: Solution, values: Array, colours: Colormap, limits: tuple[float, float], scale: Scale
) -> ScalarMappable:
    """Draw a field, the outline and the stick/slip boundary of every patch. Return the colours for the colour bar."""
    norm = Normalize(*limits)
    for k in range(solution.n_patches):
        mesh = PatchMesh(solution, k)
        ax.pcolormesh(
            *mesh.closed(mesh.of(values), edge=0.0),
            shading="gouraud",
            cmap=colours,
            norm=norm,
            rasterized=True,
        )
        if mesh.has_fields and mesh.stick[mesh.inside].any() and not mesh.stick[mesh.inside].all():
            ax.contour(*mesh.closed(mesh.slip_distance()), levels=[0.0], colors=INK, linewidths=1.1, linestyles="--")
        ax.plot(*mesh.outline(), color=INK, lw=1.0)
    low_y, high_y, low_x, high_x = box(solution) if scale.box is None else scale.box
    centre_y, centre_x = 0.5 * (low_y + high_y), 0.5 * (low_x + high_x)
    ax.set(
        xlim=(centre_y - scale.half_y, centre_y + scale.half_y),
        ylim=(centre_x - scale.half_x, centre_x + scale.half_x),
        aspect="equal",
    )
    step = 5.0 if max(scale.half_x, scale.half_y) > 6.0 else 2.0
    ax.xaxis.set_major_locator(MultipleLocator(step))
    ax.yaxis.set_major_locator(MultipleLocator(step))
    ax.grid(visible=True)
    return ScalarMappable(norm, colours)


def box(solution: Solution) -> tuple[float, float, float, float]:
    """Return the lowest and highest y, then the lowest and highest x of all patches [mm]; ±5 mm without contact."""
    if not solution.p.size:
        return -5.0, 5.0, -5.0, 5.0
    meshes = [PatchMesh(solution, k) for k in range(solution.n_patches)]
    return (
        min(float(m.edges[0]) for m in meshes),
        max(float(m.edges[1]) for m in meshes),
        min(float((m.centre - m.a).min()) for m in meshes),
        max(float((m.centre + m.a).max()) for m in meshes),
    )
