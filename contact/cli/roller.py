"""The command `roller`: a wheel on a roller of a test rig."""

from __future__ import annotations

from typing import cast

from contact.cli import arguments, report
from contact.cli import options as opt
from contact.cli.output import reported
from contact.cli.problem import Touch, carried
from contact.geometry.records import Patch
from contact.geometry.wheelset import Velocity
from contact.pair import RollerRig
from contact.results import Solution


@reported
def roller(
    roller_radius: opt.RollerRadius,
    *,
    place: arguments.PlaceOptions,
    spin: opt.Spin = None,
    offset: opt.Offset = 0.0,
    load: opt.Load = None,
    vertical: opt.Vertical = None,
    surface: arguments.SlidingFriction,
    methods: arguments.Methods,
    output: arguments.Output,
) -> None:
    """Solve the contact of the right wheel on a roller; the rail profile is that of the roller, --speed that of its surface.

    Example:  contact roller 0.6 --y 3e-3 --load 60e3 --spin -43.5
    """
    case = place.position(opt.SideOption.right)
    (pair,) = case.wheels
    rig = RollerRig(pair, roller_radius, offset=offset, **vars(methods))
    velocity = Velocity(forward=place.speed, spin=spin)
    found = rig.solve(case.pose, velocity, **carried(load, vertical), friction=surface.law())
    touches = [
        Touch(cast(Solution, one.solution), "right", cast(Patch, one.patch), k)
        for k, one in enumerate(found.contacts, 1)
    ]
    title = f"{pair.profiles[0].name or 'wheel'} on a roller of {roller_radius:g} m: y = {1e3 * place.y:g} mm"
    report.deliver_patches(touches, title, place.radius, output)
