"""Terminals of the FMUs for FMI 3.0: groups of variables that belong together, so that a tool connects them at once.

A wheelset has one terminal for each side, a contact has one. Members that are connected have the same names.
"""

from __future__ import annotations

from xml.etree.ElementTree import Element, SubElement, indent, tostring

from fmu_src.variables import Table
from models.wheelset.ports import PROBLEM, REACTION, SIDES

_KIND = "wheelrail-contact.contact"  # connected terminals are of one kind
_MEMBERS = tuple(dict.fromkeys(name.split("[")[0] for name in (*PROBLEM, *REACTION)))  # rows, without their indices
_PREFIXES: dict[str, str] = {"contact": "", **{str(side): f"{side}." for side in SIDES}}


def terminals(table: Table) -> str | None:
    """Return terminalsAndIcons.xml of an FMU, None if it has no terminals."""
    shown = {row.name for row in table.shown}
    found = {name: prefix for name, prefix in _PREFIXES.items() if {prefix + member for member in REACTION} <= shown}
    if not found:
        return None
    root = Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    every = SubElement(root, "Terminals")
    for name, prefix in found.items():
        about = "The contact problem to the contact, its forces back"
        terminal = SubElement(every, "Terminal", name=name, matchingRule="bus", terminalKind=_KIND, description=about)
        for member in _MEMBERS:
            if (variable := prefix + member) in shown:
                members = {"variableName": variable, "memberName": member, "variableKind": "signal"}
                SubElement(terminal, "TerminalMemberVariable", members)
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"
