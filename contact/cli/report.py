"""Solved patches as tables for the terminal and as plain data for JSON."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields
from typing import Any

from rich.console import Console
from rich.markup import escape

from contact.cli.arguments import Output
from contact.cli.document import flat
from contact.cli.output import drawing, require_trusted
from contact.cli.problem import Touch
from contact.cli.tables import show_table
from contact.damage import evaluate
from contact.registry import Methods
from contact.study.table import number

#: A row of a table: label, unit, name in the results, factor.
Quantity = tuple[str, str, str, float]
#: Of a patch; what its results do not have is left out.
_SHOWN: Sequence[Quantity] = (
    ("contact angle", "°", "contact_angle", math.degrees(1.0)),
    ("position y", "mm", "position.1", 1e3),
    ("position z", "mm", "position.2", 1e3),
    ("rolling radius", "mm", "rolling_radius", 1e3),
    ("share of the patch", "-", "share", 1.0),
    ("longitudinal creepage", "‰", "creepage.longitudinal", 1e3),
    ("lateral creepage", "‰", "creepage.lateral", 1e3),
    ("spin creepage", "1/m", "creepage.spin", 1.0),
    ("normal force", "kN", "N", 1e-3),
    ("approach", "µm", "approach", 1e6),
    ("peak pressure", "MPa", "max_pressure", 1e-6),
    ("contact area", "mm²", "area", 1e6),
    ("length along x", "mm", "length", 1e3),
    ("width along y", "mm", "width", 1e3),
    ("Fx on the wheel", "kN", "Fx", 1e-3),
    ("Fy on the wheel", "kN", "Fy", 1e-3),
    ("Mz on the wheel", "N m", "Mz", 1.0),
    ("used friction", "-", "used_friction", 1.0),
    ("slip area", "%", "slip_ratio", 100.0),
    ("status", "", "status", 1.0),
    ("T-gamma", "N", "damage.T_gamma", 1.0),
    ("T-gamma with spin", "N", "damage.T_gamma_spin", 1.0),
    ("dissipation", "N", "damage.dissipation", 1.0),
    ("Pearce-Sherratt", "mm²/km", "damage.pearce_sherratt", 1e9),
    ("USFD volume per patch area", "mm³/km/mm²", "damage.usfd", 1e6),
    ("Burstow", "1e-6/axle", "damage.burstow", 1e6),
    ("surface fatigue index", "-", "damage.fatigue_index", 1.0),
    ("Archard volume", "mm³/km", "damage.archard_volume", 1e12),
    ("Archard depth", "µm/km", "damage.archard_depth_max", 1e9),
    ("largest stress index", "MPa", "damage.stress_index_max", 1e-6),
    ("largest energy index", "MPa", "damage.energy_index_max", 1e-6),
)


def show_columns(
    title: str, name: str, rows: Sequence[Mapping[str, Any]], quantities: Sequence[Quantity], console: Console
) -> None:
    """Print rows, which `name` names, side by side: those of the quantities that they have."""
    cells = [
        [label, unit, *(_cell(row[key], factor) for row in rows)]
        for label, unit, key, factor in quantities
        if key in rows[0]
    ]
    show_table(title, [(head, "") for head in ("quantity", "unit", *(row[name] for row in rows))], cells, console)


def _cell(value: Any, factor: float) -> str:
    if isinstance(value, str):
        return value.lower().replace("_", " ")
    return number(None if value is None else factor * value)


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
        show=lambda console: _show(patches, [t.name for t in touches], title, console),
        rows=lambda: [flat(row) for row in patches],
        figure=figure or (lambda: drawing().patch([t.solution for t in touches], [t.name for t in touches])),
    )
    require_trusted([touch.solution.status for touch in touches], "patches")


def _show(patches: Sequence[dict[str, Any]], names: Sequence[str], title: str, console: Console) -> None:
    """Print the patches side by side: place, contact, damage."""
    if not patches:
        console.print(f"[bold]{escape(title)}[/bold]\nno contact: all forces are zero")
        return
    rows = [{"patch": name, **flat(row)} for name, row in zip(names, patches, strict=True)]
    whole = all(row.get("share", 1.0) >= 1.0 for row in rows)
    show_columns(title, "patch", rows, [q for q in _SHOWN if not (whole and q[2] == "share")], console)


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
    names = "N Fx Fy Mz approach max_pressure area slip_ratio used_friction length width"
    more = "normal_stiffness power_per_metre n_patches gap_error"
    content |= {name: getattr(s, name) for name in f"{names} {more}".split()}
    content["status"] = s.status.name
    content["creepage"] = {"longitudinal": c.longitudinal, "lateral": c.lateral, "spin": c.spin}
    content |= {"friction": s.friction, "speed": s.speed, "normal": s.normal, "tangential": s.tangential}
    content["damage"] = {one.name: getattr(damage, one.name) for one in fields(damage) if one.type == "float"}
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
