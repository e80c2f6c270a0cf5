"""Terminals of the FMUs for FMI 3.0: groups of variables that belong together, so that a tool connects them at once.

A contact has one terminal for whoever poses its problem. A pair has one for its wheelset, one for its rail, one for the
displacement of a flexible wheel and one that shows its patches. A vehicle without contacts has one for its
wheels: its members are arrays of what a pair takes and gives.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement

from .description import text_of
from .tables.wheel_rail_contact import PROBLEM, REACTION
from .variables import Causality, Table


@dataclass(frozen=True)
class Terminal:
    """A terminal: its kind (terminals of one kind can be connected), what it is for, and member → variable."""

    name: str
    kind: str
    about: str
    members: Mapping[str, str]


#: Terminal of a pair → what it is for, and the groups whose inputs and outputs are its members: their names begin so.
_OF_PAIR = {
    "wheelset": (
        "Motion and load of the wheelset to this wheel, force and moment on the wheel back",
        ("pose", "velocity", "load", "wheelset", "force", "moment"),
    ),
    "rail": ("Motion of the rail under this wheel, and its deflection", ("irregularity", "rail")),
    "offset": ("Displacement of this wheel against its wheelset, and its rate; may stay open", ("offset",)),
    "patches": ("All patches in track coordinates", ("patches", "patch", "pressure", "used_friction")),
}


def of_table(table: Table) -> Iterator[Terminal]:
    """Yield the terminals of an FMU."""
    connectors = [row.element("") for row in table.shown if row.causality in (Causality.INPUT, Causality.OUTPUT)]
    if set(REACTION) <= set(connectors):
        members = {member: member for member in (*PROBLEM, *REACTION) if member in connectors}
        yield Terminal("contact", "contact", "The contact problem to the contact, its forces back", members)
    of_wheels = {row.name.removeprefix("wheel[]."): row.element("") for row in table.rows if "wheel[]." in row.name}
    if "pose.y" in of_wheels:
        about = "Motion to the pair of each wheel, its force and moment back: arrays over the wheels"
        yield Terminal("wheels", "wheels", about, of_wheels)
    groups = {variable: variable.split(".")[0] for variable in connectors}
    for name, (about, wanted) in _OF_PAIR.items() if "pose" in groups.values() else ():
        yield Terminal(name, name, about, {v: v for v, group in groups.items() if group in wanted})


def terminals(table: Table) -> str | None:
    """Return terminalsAndIcons.xml of an FMU, None if it has no terminals."""
    found = list(of_table(table))
    if not found:
        return None
    root = Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    every = SubElement(root, "Terminals")
    for terminal in found:
        kind = f"wheelrail-contact.{terminal.kind}"
        about = {"name": terminal.name, "matchingRule": "bus", "terminalKind": kind, "description": terminal.about}
        element = SubElement(every, "Terminal", about)
        for member, variable in terminal.members.items():
            members = {"variableName": variable, "memberName": member, "variableKind": "signal"}
            SubElement(element, "TerminalMemberVariable", members)
    return text_of(root)
