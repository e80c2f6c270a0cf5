"""First steps with an FMU: a sketch of its frame, an example with numbers, status values and the time of a step, in HTML."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape

from .description import number
from .variables import Table

STEPS = 10  # steps of an example


@dataclass(frozen=True)
class Example:
    """Inputs that differ from their start values, and outputs after `STEPS` steps of the default size, to four digits."""

    given: Mapping[str, float]
    found: Mapping[str, float]
    about: str


@dataclass(frozen=True)
class First:
    """First steps with one FMU.

    `wire` names the inputs to connect first. `defaults` says what the start values answer. `step` is the median processor time
    of one step in µs, measured with fmpy on one core of an Intel Xeon, with an input that changes at each step.
    """

    wire: tuple[str, ...]
    defaults: str
    examples: tuple[Example, ...]
    step: float
    remarks: tuple[str, ...] = field(default=())


_CREEPAGES = ("creepage.longitudinal", "creepage.lateral", "creepage.spin")
_CONTACT_DEFAULTS = (
    "The start values are a wheel of radius 460 mm under 80 kN that rolls without creepage. So pressure and patch are "
    "those of the load, and the creep forces are 0: an input that is not connected adds no force."
)
_CONTACT_EXAMPLES = (
    Example(
        {}, {"force.x": 0.0, "pressure.max": 9.560e8, "patch.area": 1.255e-4, "approach": 8.336e-5}, "the start values"
    ),
    Example(
        {"creepage.longitudinal": 1e-3},
        {"force.x": -1.151e4, "force.y": 0.0},
        "the wheel brakes: the force points back",
    ),
    Example(
        {"creepage.longitudinal": 1e-3, "creepage.lateral": 5e-4},
        {"force.x": -1.130e4, "force.y": -4955.0, "moment.z": 7.320},
        "and slides to the right: the force points to the left",
    ),
)
_STIFFNESS = "Reading creep_stiffness takes about one step more. Record it only where it is needed."
_PAIR_DEFAULTS = (
    "The start values are a right wheel of a centred wheelset at 20 m/s under 80 kN. The height of the wheelset is found so "
    "that the contact carries this load."
)

#: Name of an FMU → its first steps.
FIRST: dict[str, First] = {
    "WheelRailContact": First(
        (*_CREEPAGES, "load.normal_force", "speed", "geometry.g", "geometry.A"),
        _CONTACT_DEFAULTS,
        _CONTACT_EXAMPLES,
        28.0,
        (_STIFFNESS,),
    ),
    "EllipticContact": First(
        (*_CREEPAGES, "load.normal_force", "speed", "geometry.A0", "geometry.B0"),
        _CONTACT_DEFAULTS,
        _CONTACT_EXAMPLES,
        28.0,
        (_STIFFNESS,),
    ),
    "WheelRailPair": First(
        ("pose.y", "pose.yaw", "velocity.x", "velocity.spin", "load.normal_force"),
        _PAIR_DEFAULTS,
        (
            Example(
                {},
                {"wheel.Q": 8.008e4, "wheel.Y": 493.4, "force.x": -159.0, "wheelset.z": 2.466e-4},
                "the start values",
            ),
            Example(
                {"pose.y": 5e-3},
                {"wheel.Q": 8.085e4, "wheel.Y": 5529.0, "force.x": 2.101e4},
                "5 mm to the right: the wheel rolls on a larger radius and is pushed forward",
            ),
        ),
        133.0,
        ("The numbers are for the profiles S1002 on 60E1 at 1:40.",),
    ),
    "WheelRailSurfaces": First(
        ("pose.y", "pose.yaw", "velocity.x", "velocity.spin", "load.normal_force", "pose.station", "pose.rotation"),
        _PAIR_DEFAULTS,
        (
            Example(
                {},
                {"wheel.Q": 8.008e4, "wheel.Y": 495.4, "force.x": -194.2, "wheelset.z": 2.466e-4},
                "the start values",
            ),
            Example({"pose.y": 5e-3}, {"wheel.Q": 8.085e4, "wheel.Y": 5525.0, "force.x": 2.101e4}, "5 mm to the right"),
        ),
        852.0,
        ("The numbers are for surfaces that do not change along the way, S1002 on 60E1 at 1:40.",),
    ),
    "Wheelset": First(
        ("wheel[1].force.x", "wheel[1].force.y", "wheel[1].force.z", "wheel[1].moment.x", "wheel[2].force.x"),
        "The wheelset starts 3 mm to the right of the centre at 28 m/s. Without the forces of its wheels it falls. Step a "
        "WheelRailPair for each wheel before it.",
        (Example({}, {"distance": 0.056}, "the start values"),),
        4.4,
        ("Names after wheel[1]. (right) and wheel[2]. (left) are those of the pair.",),
    ),
    "Vehicle": First(
        ("speed",),
        "The vehicle starts at distance = -12 m, before the track's first irregularity, with the start value of speed.",
        (Example({"speed": 20.0}, {"distance": -11.80}, "20 m/s for 10 steps of 1 ms"),),
        1826.0,
    ),
    "OpenVehicle": First(
        ("speed", "wheel[1].force.x", "wheel[1].force.y", "wheel[1].force.z", "wheel[1].moment.x"),
        "Without the forces of its wheels the vehicle falls. Step a WheelRailPair for each wheel before the vehicle.",
        (Example({"speed": 20.0}, {"distance": -11.96}, "20 m/s for 10 steps of 0.2 ms"),),
        4.4,
        ("The time of a step is without the contacts.",),
    ),
}

#: From behind: the right wheel on its rail. From above: the wheelset between its rails.
_SKETCH = """<svg viewBox="0 0 640 210" width="640" role="img" aria-label="Frames and signs" font-size="13" fill="none"
 stroke="#1e2837">
<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">
<path d="M0 0 8 4 0 8z" fill="#b4321e" stroke="none"/></marker></defs>
<rect x="49" y="68" width="162" height="12"/><rect x="42" y="20" width="14" height="110"/><rect x="204" y="20" width="14"
 height="110"/><path d="M37 131h24v10h-9v26h14v6H32v-6h14v-26h-9zM199 131h24v10h-9v26h14v6h-34v-6h14v-26h-9z"/>
<g><path d="M450 30V190M590 30V190" stroke="#8a97a5"/><rect x="440" y="104" width="160" height="10"/><rect
 x="443" y="78" width="14" height="62"/><rect x="583" y="78" width="14" height="62"/></g>
<g stroke="#b4321e" stroke-width="2" marker-end="url(#tip)"><path d="M130 100h48"/><path d="M130 100v42"/>
<path d="M520 109V50"/><path d="M520 109h45"/><path d="M495 92A30 30 0 0 1 540 86"/></g>
<circle cx="130" cy="100" r="5" stroke="#b4321e"/><path d="M126.5 96.5l7 7m0-7l-7 7" stroke="#b4321e"/>
<g fill="#1e2837" stroke="none"><text x="184" y="104">y</text><text x="118" y="146">z</text><text x="112" y="97">x</text>
<text x="508" y="52">x</text><text x="569" y="106">y</text><text x="478" y="84">yaw</text>
<text x="80" y="200">from behind, x away from you</text><text x="440" y="206">from above, z away from you</text></g>
</svg>"""
_SIGNS = (
    "x points in the rolling direction, y to the right, z down. Forces act on the wheel. Creepage is the velocity of the wheel "
    "minus that of the rail, over the speed: longitudinal creepage is positive in braking, and force.x is then negative. A "
    "contact's frame is the track's, turned about x by the contact angle, so that its z points from the wheel into the rail. "
    "All values are in SI units."
)


def first_steps(table: Table) -> str:
    """Return the section of an FMU's page in HTML. `table` names an FMU of `FIRST`."""
    first = FIRST[table.name]
    paragraphs = [first.defaults, *first.remarks]
    rows = "".join(
        f"<tr><td>{_values(e.given)}</td><td>{_values(e.found)}</td><td>{escape(e.about)}</td></tr>\n"
        for e in first.examples
    )
    return f"""<h2>Frames and signs</h2>
{_SKETCH}
<p>{_SIGNS}</p>
<h2>First steps</h2>
<p>Connect these inputs first: {", ".join(f"<b>{name}</b>" for name in first.wire)}.</p>
{"".join(f"<p>{escape(text)}</p>" for text in paragraphs)}
<p>Co-simulation, after {STEPS} steps of {number(1e3 * table.step_size)} ms:</p>
<table class="example">
<tr><th>inputs</th><th>outputs</th><th></th></tr>
{rows}</table>
{_status(table)}<h2>Speed</h2>
<p>One step takes {first.step:g} µs with an input that changes at each step: the median with the start values of all parameters,
on one core of an Intel Xeon, called from Python by fmpy.</p>
"""


def _values(values: Mapping[str, float]) -> str:
    return "<br>".join(f"{name} = {value:.4g}" for name, value in values.items()) or "–"


def _status(table: Table) -> str:
    """Return the meanings of the output `status`, or "" if the FMU has none, and of a step that is discarded."""
    lines = ["<h2>Status</h2>\n"]
    for row in table.rows:
        if row.name in ("status", "wheel[].status") and row.enumeration is not None:
            items = "".join(
                f"<li>{k} {name}: {escape(text)}</li>" for k, (name, text) in enumerate(row.enumeration.items, 1)
            )
            lines.append(f"<p><b>{row.name}</b> has these values:</p>\n<ul>{items}</ul>\n")
    lines.append(
        "<p>A step whose inputs are outside their ranges returns Discard with a message that names the input, its value and "
        "the range. In FMI 2.0 the FMU is then terminated.</p>\n"
    )
    return "".join(lines)
