"""The command `stress`: the largest stresses below the patches of a wheel on a rail, and a picture of one patch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import typer
from rich.console import Console

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.document import flat
from contact.cli.output import drawing, reported, require_trusted
from contact.cli.problem import Touch
from contact.cli.report import Quantity, show_columns
from contact.errors import require_number
from contact.stress import Endurance, SurfaceLoad, dang_van, largest
from contact.stress.field import CRITERIA, require_criterion

#: Depths for Dang Van's criterion over the radius of a circle with the contact's area.
_DEPTHS = np.linspace(0.0, 1.5, 16)


@reported
def stress(
    context: typer.Context,
    *,
    place: arguments.PlaceOptions,
    side: opt.Sides = opt.SideOption.right,
    amount: arguments.Amount,
    curvatures: opt.Curvatures = None,
    surface: arguments.SlidingFriction,
    methods: arguments.Methods,
    body: opt.Body = "rail",
    criterion: opt.Criterion = "von_mises",
    slope: opt.DangVanSlope = 1.0 / 3.0,
    endurance: opt.EnduranceLine = None,
    output: arguments.Output,
) -> None:
    """Compute the largest stresses below the contact of a wheel on a rail, or of two curvatures, and their depth.

    Examples:  contact stress --y 3e-3 --out stress.png   ·   contact stress --curvatures 1.1 0.8 --creepage 2e-3 0 0
    """
    require_criterion(criterion)
    require_number("slope", slope, 0.0, 3.0)
    line = None if endurance is None else Endurance(*endurance)
    options = {"friction": surface.law(), **vars(methods)}
    arguments.require_use(context)
    case = curvatures or place.position(side)
    touches = [one for one in amount.touches(case, place.speed, options) if one.solution.N > 0.0]
    found = [stresses(touch, body, slope, line) for touch in touches]
    if not touches:
        output.without_contact()

    def figure() -> Any:
        worst = max(touches, key=lambda touch: largest(touch.solution, criterion, body=body).value)
        return drawing().stress(worst.solution, criterion, body=body, title=f"{body}, {worst.name}")

    output.deliver(
        {"patches": found},
        show=lambda console: _show(found, body, console),
        rows=lambda: [flat(row) for row in found],
        figure=figure,
    )
    require_trusted([touch.solution.status for touch in touches], "patches")


def stresses(touch: Touch, body: str, slope: float, line: Endurance | None) -> dict[str, Any]:
    """Return the largest stresses of a patch [Pa] with their places [m] and passages to failure, as plain data."""
    surface, nu = SurfaceLoad.of(touch.solution), touch.solution.material.poisson_ratio
    content: dict[str, Any] = {"name": touch.name, "body": body, "N": touch.solution.N}
    for name in CRITERIA:
        peak = largest(surface, name, body=body, poisson_ratio=nu)
        content[name] = {"value": peak.value, "x": peak.x, "y": peak.y, "z": peak.z}
    worst = dang_van(surface, surface.radius * _DEPTHS, slope=slope, body=body, poisson_ratio=nu).peak
    content["dang_van"] = {"value": worst.value, "y": worst.y, "z": worst.z}
    if line is not None:
        share = float(line.damage(worst.value))
        content["passages"] = 1.0 / share if share > 0.0 else None
    return content


def _show(found: Sequence[dict[str, Any]], body: str, console: Console) -> None:
    if not found:
        console.print("no contact: no stress")
        return
    shown: list[Quantity] = []
    for name in (*CRITERIA, "dang_van"):
        shown.append((name.replace("_", " "), "MPa", f"{name}.value", 1e-6))
        shown.append(("  depth", "mm", f"{name}.z", 1e3))
    shown.append(("passages to failure", "", "passages", 1.0))
    show_columns(f"Largest stresses in the {body}", "name", [flat(one) for one in found], shown, console)
