"""A vehicle as declared, drawn from the side: bodies, wheelsets, springs, dampers and stops, with numbers for a table."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from contact.study.table import Table, number
from .declared import Damper, Joint, Spring, Stop, VehicleDeclaration

_WIDTH, _MARGIN = 900.0, 1.2  # [px], [m] around the outermost bodies
_APART = 16.0  # distance of symbols at one place [px]
_DEEP = 0.35  # half height at which a body is drawn [m]
_INK, _ACCENT = "#22262b", "#3b8bd0"
_AXES = "xyz"


def joints_of(vehicle: VehicleDeclaration) -> list[Joint]:
    """Return springs, dampers and stops in the order of their numbers in drawing and table, from 1 on."""
    return [*vehicle.springs, *vehicle.dampers, *vehicle.stops]


def drawing(vehicle: VehicleDeclaration) -> str:
    """Return an SVG: the vehicle from the right side, front to the right. Numbers are those of `elements`."""
    places = {body.name: body.at for body in vehicle.bodies} | {axle.name: axle.at for axle in vehicle.wheelsets}
    reach = {name: [at] for name, at in places.items()}
    for joint in joints_of(vehicle):
        for one, other in joint.between:
            for name in (one, other):
                reach[name].append(places[one] + joint.at[0])
    low, high = min(min(r) for r in reach.values()) - _MARGIN, max(max(r) for r in reach.values()) + _MARGIN
    heights = (2.0 * vehicle.radius, *(body.height for body in vehicle.bodies), *(j.at[2] for j in joints_of(vehicle)))
    top, scale = max(heights) + 1.5 * _DEEP, _WIDTH / (high - low)

    def x(metres: float) -> float:
        return (metres - low) * scale

    def y(metres: float) -> float:
        return (top - metres) * scale

    parts = [f'<path d="M0 {y(0.0):.1f}H{_WIDTH:g}" stroke="{_INK}" stroke-width="2"/>']
    parts += (
        f'<circle cx="{x(axle.at):.1f}" cy="{y(vehicle.radius):.1f}" r="{vehicle.radius * scale:.1f}" fill="none" '
        f'stroke="{_INK}" stroke-width="1.5"/>'
        for axle in vehicle.wheelsets
    )
    low_bodies = 2.0 * vehicle.radius + _DEEP  # the names of those behind wheels stand below the rail
    for body in vehicle.bodies:
        left, right = min(reach[body.name]) - 0.5 * _MARGIN, max(reach[body.name]) + 0.5 * _MARGIN
        parts.append(
            f'<rect x="{x(left):.1f}" y="{y(body.height + _DEEP):.1f}" width="{(right - left) * scale:.1f}" '
            f'height="{2.0 * _DEEP * scale:.1f}" rx="4" fill="{_ACCENT}" fill-opacity="0.15" stroke="{_INK}"/>'
            f'<text x="{x(body.at):.1f}" y="{y(body.height if low_bodies < body.height else -0.45):.1f}" '
            f'text-anchor="middle">{escape(body.name)}, {1e-3 * body.mass:.4g} t</text>'
        )
    drawn: dict[int, int] = {}  # elements at one place stand side by side
    for k, joint in enumerate(joints_of(vehicle), 1):
        for one, _ in joint.between:
            place = round(x(places[one] + joint.at[0]) / _APART)
            drawn[place] = drawn.get(place, -1) + 1
            parts += _symbol(joint, k, x(places[one] + joint.at[0]) + _APART * drawn[place], y(joint.at[2]))
    return (
        f'<svg role="img" viewBox="0 0 {_WIDTH:g} {y(-0.7):.0f}" '
        'style="width:100%;min-width:40rem;max-width:60rem;height:auto;font:12px system-ui,sans-serif">'
        f"<title>{escape(vehicle.name)} from the side</title>{''.join(parts)}</svg>"
    )


def _symbol(joint: Joint, k: int, x: float, y: float) -> Iterator[str]:
    """Yield the symbol of a force element around its place, and its number."""
    line = f'fill="none" stroke="{_INK}" stroke-width="1.2"'
    if isinstance(joint, Spring):
        yield f'<path d="M{x:.1f} {y - 10:.1f}l4 3l-8 4l8 4l-8 4l8 4l-4 2" {line}/>'
    elif isinstance(joint, Damper):
        yield f'<path d="M{x - 12:.1f} {y:.1f}h10m0 -4v8m8 -5h-10m10 10h-10m10 -10v10m0 -5h8" {line}/>'
    else:
        yield f'<path d="M{x - 5:.1f} {y - 5:.1f}v10m10 -10v10m-7 -5h4" {line}/>'
    yield f'<text x="{x + 7:.1f}" y="{y + 9:.1f}" fill="{_ACCENT}" font-weight="600">{k}</text>'


def bodies(vehicle: VehicleDeclaration) -> Table:
    """Return masses, inertias and places of bodies and wheelsets."""
    placed = [(body, body.height) for body in vehicle.bodies] + [(axle, vehicle.radius) for axle in vehicle.wheelsets]
    rows = [(b.name, *(number(v) for v in (b.mass, *b.inertia, b.at, height))) for b, height in placed]
    heads = [("", ""), ("mass", "kg"), *((f"I{axis}", "kg m²") for axis in _AXES), ("ahead", "m"), ("height", "m")]
    return Table("Bodies", heads, rows)


def elements(vehicle: VehicleDeclaration) -> Table:
    """Return the numbers of springs, dampers and stops."""
    rows = []
    for k, joint in enumerate(joints_of(vehicle), 1):
        count = len(joint.between) * (2 if joint.mirrored else 1)
        rows.append((f"{k}: {type(joint).__name__.lower()}", str(count), _place(joint), _told(joint)))
    return Table("Force elements", [("", ""), ("number", ""), ("x, y, z", "m"), ("along x, y, z", "")], rows)


def _place(joint: Joint) -> str:
    ahead, right, height = (f"{value:g}" for value in joint.at)
    return f"{ahead}, {'±' if joint.mirrored else ''}{right}, {height}"


def _told(joint: Joint) -> str:
    """Return stiffness and damping, or the law of a stop, as text."""
    if isinstance(joint, Stop):
        free = max(u for u, f in zip(joint.deformation, joint.force, strict=True) if f == 0.0)
        return f"free to {1e3 * free:g} mm, {1e-3 * joint.force[-1]:g} kN at {1e3 * joint.deformation[-1]:g} mm"
    said = []
    for name, symbol, unit, factor in (
        ("stiffness", "k", "kN/m", 1e-3), ("damping", "c", "kN s/m", 1e-3), ("turning", "about the axes", "kN m/rad", 1e-3)
    ):  # fmt: skip
        values = getattr(joint, name, (0.0,))
        if any(values):
            said.append(f"{symbol} {', '.join(f'{factor * v:.4g}' for v in values)} {unit}")
    return "; ".join(said)
