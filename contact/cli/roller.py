"""The command `roller`: a wheel on a roller of a test rig."""

from __future__ import annotations

from typing import Any, cast

from contact.cli import arguments, report
from contact.cli import options as opt
from contact.cli.document import flat
from contact.cli.output import deliver, drawing, prepare, reported, require_trusted
from contact.cli.problem import Touch, carried
from contact.geometry.records import Patch
from contact.geometry.wheelset import Pair, Velocity
from contact.pair import RollerRig
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL
from contact.results import Solution


@reported
def roller(
    roller_radius: opt.RollerRadius,
    *,
    place: arguments.PlaceOptions,
    reading: arguments.Reading,
    spin: opt.Spin = None,
    offset: opt.Offset = 0.0,
    load: opt.Load = None,
    vertical: opt.Vertical = None,
    surface: arguments.SlidingFriction,
    normal: opt.Normal = DEFAULT_NORMAL,
    tangential: opt.Tangential = DEFAULT_TANGENTIAL,
    as_json: opt.Json = False,
    out: opt.Files = None,
) -> None:
    """Solve the contact of the right wheel on a roller; the rail profile is that of the roller, --speed that of its surface.

    Example:  contact roller 0.6 --y 3e-3 --load 60e3 --spin -43.5
    """
    prepare(out)
    case = place.position(reading, opt.SideOption.right)
    pair = Pair(
        case.wheel,
        case.rail,
        side=cast(Any, "right"),
        nominal_radius=place.radius,
        gauge=place.gauge,
        flange_back=place.back_to_back,
    )
    rig = RollerRig(pair, roller_radius, offset=offset, normal=normal, tangential=tangential)
    velocity = Velocity(forward=place.speed, spin=spin)
    found = rig.solve(case.pose, velocity, **carried(load, vertical), friction=surface.law())
    touches = [
        Touch(cast(Solution, one.solution), "right", cast(Patch, one.patch), k)
        for k, one in enumerate(found.contacts, 1)
    ]
    title = f"{case.wheel.name or 'wheel'} on a roller of {roller_radius:g} m: y = {1e3 * place.y:g} mm"
    patches = [report.data(touch, place.radius) for touch in touches]
    deliver(
        {"patches": patches},
        show=lambda console: report.show(touches, title, place.radius, console),
        as_json=as_json,
        out=out,
        rows=lambda: [flat(row) for row in patches],
        figure=lambda: drawing().patch([t.solution for t in touches], [t.name for t in touches]),
    )
    require_trusted([touch.solution.status for touch in touches], "patches")
