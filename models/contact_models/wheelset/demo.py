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

import contact
from contact.arrays import Array
from contact.cli import options as opt
from contact.cli.output import deliver, drawing, reported, stop
from contact.cli.progress import progress_bar
from contact.cli.tables import show_table
from contact.geometry.wheelset import Irregularity, Pose, Velocity
from contact.study.files import require_folder
from ..runs.scenario import Scenario
from ..vehicle import linear
from ..vehicle.coupling import QUESTION, AskingVehicle, OpenVehicle
from ..vehicle.declared import INWARDS, SIDES
from . import master
from .contacts import ReportingContact
from .master import MOTION, History, Scheme
from .system import at_start, pair, python_contacts, scenario, simulation

FMUS = ("Wheelset", "WheelRailPair")
_HEADINGS = (("quantity", ""), ("value", ""))
PICTURE = 60  # strips and elements, finer than the run, because pictures show single elements


@dataclass(frozen=True)
class Moment:
    """A communication point to be shown in a picture."""

    name: str
    title: str
    index: int


@reported
def demo(
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("out"),
    seconds: Annotated[float, typer.Option(help="Simulated time in s.")] = 3.0,
    speed: Annotated[float, typer.Option(help="Speed in m/s.")] = 32.0,
    lateral: Annotated[float, typer.Option(help="Lateral offset at the start in m.")] = 5e-3,
    step: Annotated[float, typer.Option(help="Communication step in s.")] = 5e-4,
    friction: Annotated[float, typer.Option(help="Coefficient of friction.")] = 0.3,
    scheme: Annotated[str, typer.Option(help="gauss_seidel or jacobi.")] = "gauss_seidel",
    fmus: Annotated[Path, typer.Option(help="Folder with the FMUs that `contact fmu` made.")] = Path("dist"),
    python: Annotated[bool, typer.Option("--python", help="Couple Python objects instead of FMUs.")] = False,
    as_json: opt.Json = False,
) -> None:
    """Run a wheelset above its critical speed into flange contact: one Wheelset FMU and two WheelRailPair FMUs."""
    require_folder(out)
    plot = drawing()
    console = Console(stderr=True)
    given = scenario(speed, friction)
    with ExitStack() as stack:
        wheelset, contacts = _objects(given, lateral) if python else _fmus(stack, fmus, given, lateral)
        chosen = cast(Scheme, scheme)  # `master.run` refuses other values
        history, durations = _run(wheelset, contacts, step, seconds, chosen)
    out.mkdir(parents=True, exist_ok=True)
    history.write_csv(out / "wheelset.csv")
    _histories(plot, history).savefig(out / "time_histories.png")
    files = ["wheelset.csv", "time_histories.png"]
    for moment in moments(history):
        _picture(plot, history, moment, given).savefig(out / f"{moment.name}.png")
        files.append(f"{moment.name}.png")
    values = _summary(history, given, durations)
    deliver(
        {"summary": values, "files": [str(out / name) for name in files]},
        show=lambda console: show_table("wheelset S1002 on 60E1", _HEADINGS, list(values.items()), console),
        as_json=as_json,
    )
    console.print("wrote " + ", ".join(str(out / name) for name in files))


def _fmus(
    stack: ExitStack, folder: Path, given: Scenario, lateral: float
) -> tuple[AskingVehicle, Sequence[ReportingContact]]:
    """Return the three FMUs, initialised. `stack` frees them."""
    try:
        from .fmu import Fmu, FmuVehicle, InFmu
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
    inputs = {"speed": given.speed(0.0), "friction.coefficient": given.friction.static, "initial.distance": 0.0}
    vehicle = stack.enter_context(Fmu(paths[0], at_start(simulation(given, lateral)) | inputs))
    return FmuVehicle(vehicle), [stack.enter_context(InFmu(paths[1], side)) for side in SIDES]


def _objects(given: Scenario, lateral: float) -> tuple[AskingVehicle, Sequence[ReportingContact]]:
    """Return the same as Python objects."""
    return OpenVehicle(simulation(given, lateral)), python_contacts(given)


def _run(
    wheelset: AskingVehicle, contacts: Sequence[ReportingContact], step: float, seconds: float, scheme: Scheme
) -> tuple[History, Array]:
    """Return the run and the time of each step [s]. The time of the first step includes the start of the components."""
    ends = [time.perf_counter()]
    with progress_bar() as bar:

        def watch(done: int, total: int) -> None:
            ends.append(time.perf_counter())
            if done % 100 == 0 or done == total:
                bar(done / total, f"{done} of {total} steps")

        history = master.run(wheelset, contacts, step=step, duration=seconds, scheme=scheme, watch=watch)
    return history, np.diff(ends)


def moments(history: History) -> list[Moment]:
    """Return the first passage through the centre, and the steepest contact of the right wheel."""
    y = history["pose.y"]
    passage = int(np.argmax(np.diff(np.sign(y)) != 0.0)) if (np.diff(np.sign(y)) != 0.0).any() else 0
    steepest = int(np.argmin(history["right.angle"]))
    return [
        Moment("contacts_tread", "through the centre of the track", passage),
        Moment("contacts_flange", "steepest contact of the right wheel", steepest),
    ]


def _picture(plot: Any, history: History, moment: Moment, given: Scenario) -> Any:
    """Return a figure of both wheels on their rails, seen from behind, and their patches, seen from above.

    The patches are solved again with the resolution of a picture.
    """
    k = moment.index
    pose = Pose(*(float(history[name][k]) for name in MOTION[:4]))
    velocity = Velocity(*(float(history[name][k]) for name in MOTION[4:]))
    wheels = []
    for side in SIDES:
        irregularity = Irregularity(*(float(history[f"{side}.{name}"][k]) for name in QUESTION[len(MOTION) : -1]))
        patches = pair(given, side).contacts(pose, velocity, irregularity=irregularity)
        solutions = [
            contact.solve(
                patch.separation, patch.creepage, approach=patch.approach, friction=given.friction, speed=given.speed(0.0),
                throw=False, n_strips=PICTURE, n_elements=PICTURE,
            )
            for patch in patches
        ]  # fmt: skip
        wheels.append(plot.Wheel(side, given.wheel, given.rail, patches, solutions))
    figure = plot.position(wheels[::-1], pose.roll)
    figure.suptitle(
        f"{history['time'][k]:.3f} s, y = {1e3 * pose.y:+.2f} mm: {moment.title}", x=0.01, ha="left", fontsize=10.0
    )
    return figure


def _histories(plot: Any, history: History) -> Any:
    def both(name: str, factor: float) -> dict[str, Any]:
        return {side: factor * history[f"{side}.{name}"] for side in SIDES}

    panels = {
        "y [mm]": {"lateral": 1e3 * history["pose.y"]},
        "ψ [mrad]": {"yaw": 1e3 * history["pose.yaw"]},
        "contact angle [°]": {side: inwards * history[f"{side}.angle"] for side, inwards in INWARDS.items()},
        "N [kN]": both("normal", 1e-3),
        "$F_y$ [kN]": both("force.y", 1e-3),
        "friction [kW]": both("power.friction", 1e-3),
    }
    return plot.time_histories(
        history["time"], panels, title=f"wheelset S1002 on 60E1 at {history['velocity.x'][0]:.3g} m/s"
    )


def _summary(history: History, given: Scenario, durations: Array) -> dict[str, str]:
    """Return what the run came to, as text with units."""
    y, t = 1e3 * np.abs(history["pose.y"]), history["time"]
    first, last = t <= min(0.5, t[-1]), t >= t[-1] - min(0.5, t[-1])
    angle = max(np.abs(history[f"{side}.angle"]).max() for side in SIDES)
    load = [history[f"{side}.normal"] for side in SIDES]
    pressure = max(history[f"{side}.pressure.max"].max() for side in SIDES)
    dissipated = float(history.creep_power.sum() * history.step)
    residual = float(np.abs(history.power_residual).max())
    return {
        "speed": f"{given.speed(0.0):.4g} m/s",
        "linear critical speed": f"{_critical_speed(given):.3g} m/s",
        "amplitude, first half second": f"{y[first].max():.3g} mm",
        "amplitude, last half second": f"{y[last].max():.3g} mm",
        "steepest contact angle": f"{math.degrees(angle):.3g}°",
        "normal forces": f"{np.min(load) * 1e-3:.3g} … {np.max(load) * 1e-3:.3g} kN",
        "greatest pressure": f"{pressure * 1e-6:.4g} MPa",
        "energy dissipated by friction": f"{dissipated:.4g} J",
        "power residual of the coupling": f"{residual:.2g} J ({100.0 * residual / dissipated:.2g} %)",
        "time per coupled step, median": f"{1e3 * np.median(durations):.2g} ms",
    }


def _critical_speed(given: Scenario) -> float:
    """Return the linear critical speed [m/s]."""
    friction = given.friction.static
    return linear.critical_speed(lambda speed: simulation(scenario(speed, friction), lateral=0.0))
