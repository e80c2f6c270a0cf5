"""The command `transient`: a shift, then rolling step by step, of two curvatures."""

from __future__ import annotations

from typing import Any

from contact.cli import arguments, report
from contact.cli import options as opt
from contact.cli.output import drawing, reported, require_trusted
from contact.cli.problem import load_or_standard
from contact.errors import ContactError, require_number
from contact.halfspace import Transient
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation

_MOST = 100_000  # steps
_SHOWN = 25  # lines of the printed table


@reported
def transient(
    *,
    curvatures: opt.Ellipse = (1.09, 0.83),
    load: opt.Load = None,
    friction: opt.Friction = 0.3,
    shift: opt.Shift = None,
    creepage: opt.Creep = None,
    spacing: opt.Spacing = 0.5e-3,
    distance: opt.Rolled = 0.02,
    step: opt.RollingStep = None,
    output: arguments.Output,
) -> None:
    """Shift a contact, then roll it step by step on the half space: forces over the distance.

    Example:  contact transient --shift -5e-6 0 0 --creepage 1e-3 0 0 --distance 0.03 --out transient.png
    """
    length = require_number("step", spacing if step is None else step, 0.0, open_minimum=True)
    count = require_number("distance", distance, 0.0) / length
    if count > _MOST:
        raise ContactError(
            f"distance = {distance:g} needs {count:.3g} steps of {length:g} m; at most {_MOST} are allowed"
        )
    N = load_or_standard(load)
    patch = Transient(Separation.hertzian(*curvatures), load=N, friction=friction, spacing=spacing)
    require_number("step", length, 0.0, patch.longest_step)
    solutions = [] if shift is None else [(0.0, patch.shift(*shift))]
    motion = Creepage() if creepage is None else Creepage(*creepage)
    for _ in range(round(count)):
        solution = patch.roll(motion, distance=length)
        solutions.append((patch.distance, solution))
    rows: list[dict[str, Any]] = [
        {
            "distance": x,
            "N": s.N,
            "Fx": s.Fx,
            "Fy": s.Fy,
            "Mz": s.Mz,
            "slip_ratio": s.slip_ratio,
            "status": s.status.name,
        }
        for x, s in solutions
    ]
    at = [row["distance"] for row in rows]
    curves = {name: [row[name] / N for row in rows] for name in ("Fx", "Fy")}
    every = max(1, -(-len(rows) // _SHOWN))
    shown = {name: values[::every] for name, values in curves.items()}
    axes = {"xlabel": "distance rolled [m]", "ylabel": "force on the wheel over N [-]"}
    output.deliver(
        {"rows": rows},
        show=lambda console: report.show_curve(
            at[::every], shown, "distance rolled [m]", "force on the wheel/N", console
        ),
        rows=lambda: rows,
        figure=lambda: drawing().curve(at, curves, limit=friction, **axes),
    )
    require_trusted([solution.status for _, solution in solutions], "steps")
