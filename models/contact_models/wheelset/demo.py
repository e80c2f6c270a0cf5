"""`contact demo`: simulate a wheelset with S1002 wheels on 60E1 rails by FMUs, and write pictures of its contacts."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, cast

import numpy as np
import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from contact.arrays import Array
from contact.cli import options as opt
from contact.cli.output import deliver, drawing, reported, stop
from contact.geometry.wheelset import Pair, Pose
from contact.results import Solution
from . import master
from .components import Component, DirectContact, SolveOptions, direct
from .master import History, Scheme
from .parameters import WheelsetParameters
from .ports import CONTACT_PORTS, INWARDS, SIDES, WHEELSET_PORTS
from .stability import critical_speed

FMUS = ("Wheelset", "WheelRailContact", "WheelRailContact")
PICTURE: SolveOptions = {"n_strips": 60, "n_elements": 60}  # finer than the run, because pictures show single elements


@dataclass(frozen=True)
class Moment:
    """A communication point to be shown in a picture."""

    name: str
    title: str
    index: int


@reported
def demo(
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("out"),
    seconds: Annotated[float, typer.Option(help="Simulated time in s.")] = 5.0,
    speed: Annotated[float, typer.Option(help="Speed in m/s.")] = 28.0,
    lateral: Annotated[float, typer.Option(help="Lateral offset at the start in m.")] = 5e-3,
    step: Annotated[float, typer.Option(help="Communication step in s.")] = 1e-3,
    friction: Annotated[float, typer.Option(help="Coefficient of friction.")] = 0.3,
    scheme: Annotated[str, typer.Option(help="gauss_seidel, jacobi or iterated.")] = "gauss_seidel",
    fmus: Annotated[Path, typer.Option(help="Folder with the FMUs that `contact fmu` made.")] = Path("dist"),
    python: Annotated[bool, typer.Option("--python", help="Couple Python objects instead of FMUs.")] = False,
    as_json: opt.Json = False,
) -> None:
    """Run a wheelset above its critical speed into flange contact: one Wheelset FMU and two WheelRailContact FMUs."""
    plot = drawing()
    console = Console(stderr=True)
    try:
        parameters = WheelsetParameters(speed=speed, lateral=lateral)
        with ExitStack() as stack:
            wheelset, contacts = direct(parameters, friction) if python else _fmus(stack, fmus, parameters, friction)
            chosen = cast(Scheme, scheme)  # `master.run` refuses other values
            history, durations = _run(console, wheelset, contacts, parameters, step, seconds, chosen)
        out.mkdir(parents=True, exist_ok=True)
        history.write_csv(out / "wheelset.csv")
        _histories(plot, history).savefig(out / "time_histories.png")
        files = ["wheelset.csv", "time_histories.png"]
        for moment in moments(history):
            _picture(plot, history, moment, parameters, friction).savefig(out / f"{moment.name}.png")
            files.append(f"{moment.name}.png")
        values = _summary(history, parameters, friction, durations)
        deliver(
            {"summary": values, "files": [str(out / name) for name in files]},
            show=lambda console: console.print(_table(values)),
            as_json=as_json,
        )
        console.print("wrote " + ", ".join(str(out / name) for name in files))
    except OSError as error:
        stop(f"{error.filename}: {error.strerror}", 1)


def _fmus(
    stack: ExitStack, folder: Path, parameters: WheelsetParameters, friction: float
) -> tuple[Component, Sequence[Component]]:
    """Return the three FMUs, initialised. `stack` frees them."""
    try:
        from .fmu import FmuComponent
    except ImportError as missing:
        stop(f"{missing}; pip install 'wheelrail-contact[fmu]', or use --python", 1)
    paths = [folder / "python" / f"{name}.fmu" for name in FMUS]
    for path in paths:
        if not path.is_file():
            stop(
                f"{path} is missing; make it with  python build_fmu.py --packaging python --out {folder}  in a checkout, with  "
                f"contact fmu --packaging python --out {folder}  elsewhere, or use --python",
                1,
            )
    wheelset = {"speed": parameters.speed, "initial.lateral": parameters.lateral}
    contact = {"speed": parameters.speed, "friction.coefficient": friction, "wheel.radius": parameters.radius}
    first, *others = (
        stack.enter_context(FmuComponent(path, ports, start))
        for path, ports, start in (
            (paths[0], WHEELSET_PORTS, wheelset),
            (paths[1], CONTACT_PORTS, contact),
            (paths[2], CONTACT_PORTS, contact),
        )
    )
    return first, others


def _run(
    console: Console,
    wheelset: Component,
    contacts: Sequence[Component],
    parameters: WheelsetParameters,
    step: float,
    seconds: float,
    scheme: Scheme,
) -> tuple[History, Array]:
    """Return the run and the time of each step [s]. The time of the first step includes the start of the components."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console) as progress:
        task = progress.add_task(f"wheelset at {parameters.speed:g} m/s, steps", total=None)

        ends = [time.perf_counter()]

        def watch(done: int, total: int) -> None:
            ends.append(time.perf_counter())
            if done % 20 == 0 or done == total:
                progress.update(task, completed=done, total=total)

        history = master.run(
            wheelset, contacts, speed=parameters.speed, step=step, duration=seconds, scheme=scheme, watch=watch
        )
    return history, np.diff(ends)


def moments(history: History) -> list[Moment]:
    """Return the first passage through the centre, and the steepest contact of the right wheel."""
    y = history["lateral"]
    passage = int(np.argmax(np.diff(np.sign(y)) != 0.0)) if (np.diff(np.sign(y)) != 0.0).any() else 0
    steepest = int(np.argmin(history["right.contact.angle"]))
    return [
        Moment("contacts_tread", "through the centre of the track", passage),
        Moment("contacts_flange", "steepest contact of the right wheel", steepest),
    ]


def _solutions(history: History, index: int, parameters: WheelsetParameters, friction: float) -> list[Solution]:
    """Return both contacts at a communication point, solved again with the resolution of a picture."""
    solutions = []
    for problem in history.problems[index]:
        contact = DirectContact(parameters, friction, **PICTURE)
        contact.write("problem", problem)
        contact.step(0.0, 0.0)
        solutions.append(contact.solution)
    return solutions


def _picture(plot: Any, history: History, moment: Moment, parameters: WheelsetParameters, friction: float) -> Any:
    """Return a figure of both wheels on their rails, seen from behind, and both patches, seen from above."""
    p, k = parameters, moment.index
    y, yaw, z, roll = (float(history[name][k]) for name in ("lateral", "yaw", "vertical", "roll"))
    wheels = []
    for side, solution in zip(SIDES, _solutions(history, k, p, friction), strict=True):
        pair = Pair(
            p.wheel,
            p.rail,
            side=side,
            nominal_radius=p.radius,
            gauge=p.gauge,
            gauge_point=p.gauge_point,
            flange_back=p.flange_back,
            combine_distance=1.0,
        )
        wheels.append(plot.Wheel(side, p.wheel, p.rail, pair.contacts(Pose(y, z, roll, yaw)), [solution]))
    figure = plot.position(wheels[::-1], roll)
    figure.suptitle(
        f"{history['time'][k]:.3f} s, y = {1e3 * y:+.2f} mm: {moment.title}", x=0.01, ha="left", fontsize=10.0
    )
    return figure


def _histories(plot: Any, history: History) -> Any:
    sides = {side: side for side in SIDES}

    def both(name: str, factor: float) -> dict[str, Any]:
        return {side: factor * history[f"{side}.{name}"] for side in sides}

    panels = {
        "y [mm]": {"lateral": 1e3 * history["lateral"]},
        "ψ [mrad]": {"yaw": 1e3 * history["yaw"]},
        "contact angle [°]": {side: inwards * history[f"{side}.contact.angle"] for side, inwards in INWARDS.items()},
        "N [kN]": both("load.normal_force", 1e-3),
        "$F_y$ [kN]": both("force.y", 1e-3),
        "friction [kW]": both("power.friction", 1e-3),
    }
    return plot.time_histories(history["time"], panels, title=f"wheelset S1002 on 60E1 at {history.speed:g} m/s")


def _summary(history: History, parameters: WheelsetParameters, friction: float, durations: Array) -> dict[str, str]:
    """Return what the run came to, as text with units."""
    y, t = 1e3 * np.abs(history["lateral"]), history["time"]
    first, last = t <= min(0.5, t[-1]), t >= t[-1] - min(0.5, t[-1])
    angle = max(np.abs(history[f"{side}.contact.angle"]).max() for side in SIDES)
    load = [history[f"{side}.load.normal_force"] for side in SIDES]
    pressure = max(history[f"{side}.pressure.max"].max() for side in SIDES)
    dissipated = float(history.creep_power.sum() * history.step)
    residual = float(np.abs(history.power_residual).max())
    return {
        "speed": f"{history.speed:.4g} m/s",
        "linear critical speed": f"{critical_speed(parameters, friction):.3g} m/s",
        "amplitude, first half second": f"{y[first].max():.3g} mm",
        "amplitude, last half second": f"{y[last].max():.3g} mm",
        "steepest contact angle": f"{math.degrees(angle):.3g}°",
        "normal load": f"{np.min(load) * 1e-3:.3g} … {np.max(load) * 1e-3:.3g} kN",
        "greatest pressure": f"{pressure * 1e-6:.4g} MPa",
        "energy dissipated by friction": f"{dissipated:.4g} J",
        "power residual of the coupling": f"{residual:.2g} J ({100.0 * residual / dissipated:.2g} %)",
        "time per coupled step, median": f"{1e3 * np.median(durations):.2g} ms",
    }


def _table(values: dict[str, str]) -> Table:
    table = Table("quantity", "value", title="wheelset S1002 on 60E1")
    table.columns[1].justify = "right"
    for name, value in values.items():
        table.add_row(name, value)
    return table
