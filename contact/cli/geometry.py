"""The commands `geometry`, `conicity` and `profiles`: rigid contact points and equivalent conicity of wheels on rails."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import typer
from numpy.typing import NDArray
from rich import box
from rich.console import Console
from rich.table import Table

import contact
from contact.cli import options as opt
from contact.cli.output import drawing, reported, write_csv, write_picture
from contact.geometry import conicity as conicity_of
from contact.geometry import contact_points, equivalent_conicity, profile

Array = NDArray[np.float64]

_SHOWN = 21  # lines of a printed table of contact points; files contain all lines
_CURVE = 121  # amplitudes of a drawn curve
#: Heading, column and factor of the printed table. Files also contain the rolling radii.
_POINTS: Sequence[tuple[str, str, float]] = (
    ("y\nmm", "y", 1e3),
    ("Δr\nmm", "radius_difference", 1e3),
    ("Δγ\n°", "angle_difference", np.degrees(1.0)),
    ("γ right\n°", "right_angle", np.degrees(1.0)),
    ("left\n°", "left_angle", np.degrees(1.0)),
    ("wheel y\nright", "right_on_wheel", 1e3),
    ("mm\nleft", "left_on_wheel", 1e3),
    ("rail y\nright", "right_on_rail", 1e3),
    ("mm\nleft", "left_on_rail", 1e3),
)


@reported
def geometry(
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    left_wheel: opt.LeftWheel = None,
    left_rail: opt.LeftRail = None,
    inclination: opt.Inclination = None,
    unit: opt.Unit = None,
    drawn_side: opt.Drawn = None,
    smoothing: opt.Smoothing = None,
    radius: opt.Radius = 0.46,
    left_radius: opt.LeftRadius = None,
    gauge: opt.Gauge = 1.435,
    back_to_back: opt.BackToBack = 1.360,
    roll: opt.Rolls = False,
    reach: opt.Reach = 0.01,
    step: opt.Step = 1e-4,
    as_json: opt.Json = False,
    table: opt.Csv = None,
    plot: opt.Plot = None,
) -> None:
    """Compute contact points of rigid wheels on rails: rolling radii and contact angles over the lateral displacement.

    Example:  contact geometry --wheel 1/40 --rail UIC60 --inclination 0.05 --max 8e-3 --plot points.png
    """
    if plot is not None:
        drawing()
    reading = opt.reading(inclination, unit, drawn_side, smoothing)
    pair = _pair(wheel, rail, left_wheel, left_rail, reading, radius, left_radius, gauge, back_to_back, roll)
    n = max(1, round(reach / step))
    found = contact_points(**pair, y=np.linspace(-reach, reach, 2 * n + 1))
    columns = found.columns()
    if as_json:
        _print_json(columns)
    else:
        _show_points(columns, _title(pair), Console())
    if table is not None:
        write_csv(_rows(columns), table)
    if plot is not None:
        write_picture(drawing().contact_points(found, pair["wheel"], pair["rail"]), plot)


@reported
def conicity(
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    left_wheel: opt.LeftWheel = None,
    left_rail: opt.LeftRail = None,
    inclination: opt.Inclination = None,
    unit: opt.Unit = None,
    drawn_side: opt.Drawn = None,
    smoothing: opt.Smoothing = None,
    radius: opt.Radius = 0.46,
    left_radius: opt.LeftRadius = None,
    gauge: opt.Gauge = 1.435,
    back_to_back: opt.BackToBack = 1.360,
    roll: opt.Rolls = False,
    amplitude: opt.Amplitudes = None,
    as_json: opt.Json = False,
    table: opt.Csv = None,
    plot: opt.Plot = None,
) -> None:
    """Compute the equivalent conicity over the amplitude by EN 15302, and Klingel's wavelength.

    Example:  contact conicity --wheel s1002 --rail 60e2 --gauge 1.432 --plot conicity.png
    """
    if plot is not None:
        drawing()
    reading = opt.reading(inclination, unit, drawn_side, smoothing)
    pair = _pair(wheel, rail, left_wheel, left_rail, reading, radius, left_radius, gauge, back_to_back, roll)
    found = conicity_of(**pair, amplitudes=amplitude or None)
    wave = found.wavelength(back_to_back + 2.0 * 0.07, radius)
    columns = {"amplitude": found.amplitude, "conicity": found.conicity, "centre": found.centre, "wavelength": wave}
    if as_json:
        _print_json(columns)
    else:
        shown = Table(header_style="bold")
        for heading in ("amplitude [mm]", "tan γe", "wavelength [m]", "centre [mm]"):
            shown.add_column(heading, justify="right")
        for a, c, w, y in zip(found.amplitude, found.conicity, wave, found.centre, strict=True):
            shown.add_row(f"{1e3 * a:g}", f"{c:.3f}", f"{w:.2f}" if np.isfinite(w) else "-", f"{1e3 * y:.2f}")
        Console().print(f"[bold]{_title(pair)}[/bold]", shown, sep="\n")
    if table is not None:
        write_csv(_rows(columns), table)
    if plot is not None:
        curve = equivalent_conicity(found.points, np.linspace(5e-4, found.amplitude.max(), _CURVE))
        write_picture(drawing().conicity(curve, found, _title(pair)), plot)


@reported
def list_profiles() -> None:
    """List the standard profiles for --wheel and --rail."""
    table = Table(header_style="bold")
    for heading in ("name", "kind", "also called"):
        table.add_column(heading)
    for kind in ("wheel", "rail"):
        for name in profile.names(kind):
            others = [alias for alias, known in profile.ALIASES.items() if known == name]
            table.add_row(name, kind, ", ".join(others))
    Console().print(table)


def _pair(
    wheel: str,
    rail: str,
    left_wheel: str | None,
    left_rail: str | None,
    reading: dict[str, Any],
    radius: float,
    left_radius: float | None,
    gauge: float,
    back_to_back: float,
    roll: bool,
) -> dict[str, Any]:
    """Return the arguments of `contact_points` and `conicity`."""
    return {
        "wheel": profile.load(wheel, "wheel", **reading),
        "rail": profile.load(rail, "rail", **reading),
        "left_wheel": left_wheel and profile.load(left_wheel, "wheel", **reading),
        "left_rail": left_rail and profile.load(left_rail, "rail", **reading),
        "nominal_radius": radius,
        "left_radius": left_radius,
        "gauge": gauge,
        "flange_back": back_to_back,
        "roll": roll,
    }


def _title(pair: Mapping[str, Any]) -> str:
    wheels, rails = (
        " and ".join(given.name for given in (pair[kind], pair[f"left_{kind}"]) if given) for kind in ("wheel", "rail")
    )
    return f"{wheels} on {rails}, gauge {1e3 * pair['gauge']:g} mm, back to back {1e3 * pair['flange_back']:g} mm"


def _rows(columns: Mapping[str, Array]) -> list[dict[str, Any]]:
    """Return the rows of a table. Infinite values become None, an empty cell."""
    lines = zip(*(values.tolist() for values in columns.values()), strict=True)
    return [dict(zip(columns, (v if np.isfinite(v) else None for v in line), strict=True)) for line in lines]


def _print_json(columns: Mapping[str, Array]) -> None:
    listed = {name: [v if np.isfinite(v) else None for v in values.tolist()] for name, values in columns.items()}
    typer.echo(json.dumps({"version": contact.__version__, **listed}, indent=2))


def _show_points(columns: Mapping[str, Array], title: str, console: Console) -> None:
    table = Table(header_style="bold", box=box.SIMPLE_HEAD, pad_edge=False)
    for heading, _, _ in _POINTS:
        table.add_column(heading, justify="right")
    n = columns["y"].size
    for k in np.unique(np.linspace(0, n - 1, min(n, _SHOWN)).round().astype(int)):
        table.add_row(*(f"{factor * columns[name][k] + 0.0:.2f}" for _, name, factor in _POINTS))
    console.print(f"[bold]{title}[/bold]", table, sep="\n")
