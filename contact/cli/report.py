"""Solved patches as tables for the terminal and as plain data for JSON."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.markup import escape

from contact.cli.arguments import Output
from contact.cli.document import flat
from contact.cli.output import drawing
from contact.cli.problem import Touch
from contact.cli.tables import show_table
from contact.damage import Damage, evaluate
from contact.geometry.wheelset import Patch
from contact.registry import Methods
from contact.results import Solution
from contact.study.table import number

#: A row of a table: label, unit, name in the results, factor.
Quantity = tuple[str, str, str, float]
PLACE: Sequence[tuple[str, str, Callable[[Patch], float]]] = (
    ("contact angle", "°", lambda p: math.degrees(p.contact_angle)),
    ("position y", "mm", lambda p: 1e3 * p.position[1]),
    ("position z", "mm", lambda p: 1e3 * p.position[2]),
    ("rolling radius", "mm", lambda p: 1e3 * p.rolling_radius),
)
#: Shown if a patch has a share below 1 (`Patch.share`): its forces and damage are multiplied by it.
SHARE: tuple[str, str, Callable[[Patch], float]] = ("share of the patch", "-", lambda p: p.share)
CONTACT: Sequence[tuple[str, str, Callable[[Solution], float]]] = (
    ("longitudinal creepage", "‰", lambda s: 1e3 * s.creepage.longitudinal),
    ("lateral creepage", "‰", lambda s: 1e3 * s.creepage.lateral),
    ("spin creepage", "1/m", lambda s: s.creepage.spin),
    ("normal force", "kN", lambda s: 1e-3 * s.N),
    ("approach", "µm", lambda s: 1e6 * s.approach),
    ("peak pressure", "MPa", lambda s: 1e-6 * s.max_pressure),
    ("contact area", "mm²", lambda s: 1e6 * s.area),
    ("length along x", "mm", lambda s: 1e3 * s.length),
    ("width along y", "mm", lambda s: 1e3 * s.width),
    ("Fx on the wheel", "kN", lambda s: 1e-3 * s.Fx),
    ("Fy on the wheel", "kN", lambda s: 1e-3 * s.Fy),
    ("Mz on the wheel", "N m", lambda s: s.Mz),
    ("used friction", "-", lambda s: s.used_friction),
    ("slip area", "%", lambda s: 100.0 * s.slip_ratio),
)
DAMAGE: Sequence[tuple[str, str, Callable[[Damage], float]]] = (
    ("T-gamma", "N", lambda d: d.T_gamma),
    ("T-gamma with spin", "N", lambda d: d.T_gamma_spin),
    ("dissipation", "N", lambda d: d.dissipation),
    ("Pearce-Sherratt", "mm²/km", lambda d: 1e9 * d.pearce_sherratt),
    ("USFD volume per patch area", "mm³/km/mm²", lambda d: 1e6 * d.usfd),
    ("Burstow", "1e-6/axle", lambda d: 1e6 * d.burstow),
    ("surface fatigue index", "-", lambda d: d.fatigue_index),
)
#: Quantities that need traction and slip over the patch.
LOCAL_DAMAGE: Sequence[tuple[str, str, Callable[[Damage], float]]] = (
    ("Archard volume", "mm³/km", lambda d: 1e12 * d.archard.volume),
    ("Archard depth", "µm/km", lambda d: 1e9 * d.archard.depth_max),
    ("largest stress index", "MPa", lambda d: 1e-6 * d.stress_index.max),
    ("largest energy index", "MPa", lambda d: 1e-6 * d.energy_index.max),
)


def show_columns(
    title: str, name: str, rows: Sequence[Mapping[str, Any]], quantities: Sequence[Quantity], console: Console
) -> None:
    """Print rows, which `name` names, side by side: their quantities and the status."""
    cells = [[label, unit, *(number(factor * row[key]) for row in rows)] for label, unit, key, factor in quantities]
    cells.append(["status", "", *(row["status"].lower().replace("_", " ") for row in rows)])
    show_table(title, side_by_side(row[name] for row in rows), cells, console)


def side_by_side(names: Iterable[str]) -> list[tuple[str, str]]:
    """Return the headings of a table of quantities with a column for each name."""
    return [(name, "") for name in ("quantity", "unit", *names)]


def deliver_patches(
    touches: Sequence[Touch],
    title: str,
    radius: float,
    output: Output,
    figure: Callable[[], Any] | None = None,
) -> None:
    """Print solved patches and write them to files. Without `figure` the picture is that of the patches."""
    patches = [data(touch, radius) for touch in touches]
    if not touches:
        output.without_contact()
    output.deliver(
        {"patches": patches},
        show=lambda console: show(touches, title, radius, console),
        rows=lambda: [flat(row) for row in patches],
        figure=figure or (lambda: drawing().patch([t.solution for t in touches], [t.name for t in touches])),
    )


def show(touches: Sequence[Touch], title: str, wheel_radius: float, console: Console) -> None:
    """Print the patches side by side: place, contact, damage."""
    if not touches:
        console.print(f"[bold]{escape(title)}[/bold]\nno contact: all forces are zero")
        return
    cells: list[list[str]] = []
    if touches[0].patch is not None:
        patches = [t.patch for t in touches if t.patch is not None]
        for label, unit, value in (*PLACE, *((SHARE,) if any(p.share < 1.0 for p in patches) else ())):
            cells.append([label, unit, *(number(value(p)) for p in patches)])
    for label, unit, of_solution in CONTACT:
        cells.append([label, unit, *(number(of_solution(t.solution)) for t in touches)])
    cells.append(["status", "", *(t.solution.status.name.lower().replace("_", " ") for t in touches)])
    damages = [evaluate(t.solution, wheel_radius) for t in touches]
    for label, unit, of_damage in (*DAMAGE, *(LOCAL_DAMAGE if damages[0].has_fields else ())):
        cells.append([label, unit, *(number(of_damage(d)) for d in damages)])
    show_table(title, side_by_side(touch.name for touch in touches), cells, console)


def data(touch: Touch, wheel_radius: float) -> dict[str, Any]:
    """Return all numbers of a patch in SI units, under the names of the Python API. Local damage needs fields."""
    s, damage = touch.solution, evaluate(touch.solution, wheel_radius)
    c = s.creepage
    content: dict[str, Any] = {}
    if touch.patch is not None:
        p = touch.patch
        content = {
            "side": touch.side,
            "angle": p.angle,
            "contact_angle": p.contact_angle,
            "position": list(p.position),
            "rolling_radius": p.rolling_radius,
            "share": p.share,
        }
    names = "N Fx Fy Mz approach max_pressure area slip_ratio length width normal_stiffness power_per_metre n_patches gap_error"
    content |= {name: getattr(s, name) for name in names.split()}
    content["status"] = s.status.name
    content["creepage"] = {"longitudinal": c.longitudinal, "lateral": c.lateral, "spin": c.spin}
    content |= {"friction": s.friction, "speed": s.speed, "normal": s.normal, "tangential": s.tangential}
    numbers = "T_gamma T_gamma_spin dissipation pearce_sherratt burstow usfd fatigue_index"
    content["damage"] = {name: getattr(damage, name) for name in numbers.split()}
    if damage.has_fields:
        content["damage"] |= {
            "archard_depth_max": damage.archard.depth_max,
            "archard_volume": damage.archard.volume,
            "stress_index_max": damage.stress_index.max,
            "energy_index_max": damage.energy_index.max,
        }
    return content


def show_methods(methods: Methods, console: Console) -> None:
    """Print tables of the registered methods."""
    headings = [(name, "") for name in ("name", "method", "source", "can do")]
    for kind, known in methods._asdict().items():
        rows = [[method.name, method.title, method.source, ", ".join(method.abilities)] for method in known.values()]
        show_table(f"{kind} methods", headings, rows, console)


def show_curve(
    values: Iterable[float], relative: Mapping[str, Sequence[float]], axis: str, force: str, console: Console
) -> None:
    """Print creep curves, one column for each method."""
    rows = [[f"{value:.5g}", *(f"{column[k]:.4f}" for column in relative.values())] for k, value in enumerate(values)]
    show_table(f"{force} over {axis}", [(name, "") for name in (axis, *relative)], rows, console)
