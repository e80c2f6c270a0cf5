"""The command `in-time`: a wheel on a rail for each row of a motion, with friction memory and contact damping."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.output import drawing, reported, require_trusted
from contact.cli.problem import carried
from contact.cli.report import show_curve
from contact.errors import ContactError
from contact.pair import ContactDamping, ElasticRail, FrictionMemory, WheelRailPair
from contact.pair.motion import AMOUNTS, LOAD
from contact.reading.columns import table

_SHOWN = 25  # lines of the printed table
File = Annotated[
    Path,
    typer.Argument(help="file of columns: a line of names, then a line per time", show_default=False, metavar="MOTION"),
]
Memory = Annotated[
    tuple[float, float] | None,
    opt.in_loading(
        "--friction-memory",
        help="distance in m over which friction follows --falling, and least sliding velocity in m/s",
        metavar="DISTANCE LEAST",
    ),
]
Damping = Annotated[
    tuple[float, float] | None,
    opt.in_loading(help="contact damping of the normal and the tangential forces in s", metavar="NORMAL TANGENTIAL"),
]

#: Option → column that takes its place.
_COLUMNS = {"y": "pose.y", "roll": "pose.roll", "yaw": "pose.yaw", "speed": "velocity.x"}


@reported
def in_time(
    context: typer.Context,
    motion: File,
    *,
    place: arguments.PlaceOptions,
    side: opt.Sides = opt.SideOption.right,
    load: opt.Load = None,
    vertical: opt.Vertical = None,
    surface: arguments.SlidingFriction,
    friction_memory: Memory = None,
    damping: Damping = None,
    springs: opt.Springs = (math.inf, math.inf),
    preload: opt.Preload = (0.0, 0.0),
    methods: arguments.Methods,
    output: arguments.Output,
) -> None:
    """Solve a wheel on a rail for each line of a file: time, and any inputs of the FMU WheelRailPair by their names.

    Columns that the file does not have are those of the options; without a column pose.z, load,
    vertical or penetration the load is that of the options.

    Example:  contact in-time motion.csv --falling exponential 0.15 0.5 --friction-memory 0.1 0.02 --out forces.png
    """
    if side is opt.SideOption.both:
        raise ContactError("side = 'both': a motion is that of one wheel")
    columns = _read(motion)
    if idle := arguments.used(context, {option for option, name in _COLUMNS.items() if name in columns}):
        raise ContactError(f"{', '.join(idle)}: {motion} has a column for it")
    given = {name: getattr(place, option) for option, name in _COLUMNS.items()}
    heights = [name for name in ("pose.z", LOAD, *AMOUNTS) if name in columns]
    options = [f"--{name} {value:g}" for name, value in (("load", load), ("vertical", vertical)) if value is not None]
    if heights and options:
        raise ContactError(f"{options[0]} and the column {heights[0]!r} exclude each other")
    if len(heights) > 1:
        raise ContactError(f"{motion}: the columns {heights[0]!r} and {heights[1]!r} exclude each other")
    if not heights:
        given |= carried(load, vertical)
    law = surface.law()
    found = WheelRailPair(place.pairs(side.value)[0], **vars(methods)).run(
        {**given, **columns},
        friction=law,
        memory=None if friction_memory is None else FrictionMemory(law, *friction_memory),
        damping=None if damping is None else ContactDamping(*damping),
        rail=ElasticRail(*springs, *preload),
    )
    rows = [dict(zip(found, row, strict=True)) for row in zip(*(x.tolist() for x in found.values()), strict=True)]
    every = max(1, -(-len(rows) // _SHOWN))
    time = found["time"].tolist()
    shown = {f"{name} [kN]": (1e-3 * found[name][::every]).tolist() for name in ("Fx", "Q", "Y")}
    shown |= {"friction": found["friction"][::every].tolist(), "status": found["status"][::every].tolist()}
    curves = {name: 1e-3 * found[name] for name in ("Fx", "Q", "Y")}
    output.deliver(
        {"rows": rows},
        show=lambda console: show_curve(time[::every], shown, "time [s]", "forces", console),
        rows=lambda: rows,
        figure=lambda: drawing().curve(time, curves, xlabel="time [s]", ylabel="force [kN]"),
    )
    require_trusted(found["status"].tolist(), "rows")


def _read(path: Path) -> dict[str, np.ndarray]:
    """Return the columns of a file by name."""
    found = table(path, "motion")
    if not found.names or not len(found.values):
        raise ContactError(f"{path} holds no motion: a line of names and a line for each time are needed")
    if len(set(found.names)) < len(found.names):
        raise ContactError(f"{path}: a name stands twice")
    return dict(zip(found.names, found.values.T, strict=True))
