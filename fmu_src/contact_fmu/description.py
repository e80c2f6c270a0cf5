"""modelDescription.xml of FMI 2.0, made from a table of variables.

The order is that of the table, and numbers are written so that they read back exactly. Nothing depends on the time or place
of the build, so the same table gives the same bytes. The guid is their hash.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from uuid import UUID
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from contact import __version__
from .units import BASE_UNITS, DISPLAY_UNITS, UNITS, display_unit
from .variables import Causality, Enumeration, Kind, Scalar, Table, Variable

LOG_CATEGORIES = {
    "logStatusWarning": "A result that should be used with care",
    "logStatusDiscard": "A step that was not done because a value is outside its range",
    "logStatusError": "A call that is not allowed, or a defect of the FMU",
}
#: Origin of the FMU. The build date is left out so that a second build gives the same file.
ORIGIN = {
    "author": "the wheelrail-contact authors",
    "version": __version__,
    "copyright": "Copyright (c) 2026 the wheelrail-contact authors",
    "license": "MIT, see documentation/licenses",
    "generationTool": f"wheelrail-contact {__version__}",
}
STOP_TIME = 1.0  # of the default experiment [s]

#: FMI interface ("CoSimulation", "ModelExchange") → attributes of its element besides modelIdentifier
Interfaces = Mapping[str, Mapping[str, str]]


def model_description(
    table: Table, interfaces: Interfaces, code: bytes = b"", sources: Sequence[str] = ()
) -> tuple[str, str]:
    """Return (guid, XML) of an FMU with this table, these interfaces and these C files in sources/.

    The guid also depends on `code`.
    """
    root = _root(table, interfaces)
    for interface in interfaces if sources else ():
        listed = SubElement(next(root.iter(interface)), "SourceFiles")
        for name in sources:
            SubElement(listed, "File", name=name)
    guid = f"{{{UUID(bytes=hashlib.sha256(tostring(root) + code).digest()[:16])}}}"
    root.set("guid", guid)
    return guid, text_of(root)


def text_of(root: Element) -> str:
    """Return an indented file of XML."""
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def number(value: float) -> str:
    """Return a number as text that reads back exactly."""
    return repr(value)


def root_of(table: Table, interfaces: Interfaces, version: str, **identity: str) -> Element:
    """Return the root of a description with its interfaces; `identity` is what the version calls guid or token."""
    about = {"description": table.description, **ORIGIN, "variableNamingConvention": "structured"}
    root = Element("fmiModelDescription", {"fmiVersion": version, "modelName": table.name, **identity, **about})
    for interface, attributes in interfaces.items():
        SubElement(root, interface, {"modelIdentifier": table.name, **attributes})
    return root


def _root(table: Table, interfaces: Interfaces) -> Element:
    root = root_of(table, interfaces, "2.0", guid="")
    shown = [(r, table.scalars[r]) for row in table.shown for r in table.references(row.name)]
    units(root, {scalar.unit for _, scalar in shown if scalar.row.kind is Kind.REAL})
    for enumeration, definitions in enumerations(root, table):
        simple = SubElement(definitions, "SimpleType", name=enumeration.name)
        items(SubElement(simple, "Enumeration"), enumeration)
    experiment(root, table)
    variables = SubElement(root, "ModelVariables")
    for reference, scalar in shown:
        variables.append(_variable(reference, scalar))
    index = {reference: i for i, (reference, _) in enumerate(shown, start=1)}  # FMI counts variables from 1
    _structure(root, table, index)
    return root


def units(root: Element, used: Collection[str | tuple[str, ...]]) -> None:
    """Add the definitions of these units, which are the same in FMI 2.0 and 3.0."""
    definitions = SubElement(root, "UnitDefinitions")
    for name, exponents in UNITS.items():
        if name in used:
            unit = SubElement(definitions, "Unit", name=name)
            SubElement(
                unit, "BaseUnit", {base: str(e) for base, e in zip(BASE_UNITS, exponents, strict=True) if e != 0}
            )
            if name in DISPLAY_UNITS:
                shown, factor = DISPLAY_UNITS[name]
                SubElement(unit, "DisplayUnit", name=shown, factor=number(factor))


def experiment(root: Element, table: Table) -> None:
    """Add the log categories and the default experiment, which are the same in FMI 2.0 and 3.0."""
    categories = SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=description)
    SubElement(root, "DefaultExperiment", startTime="0.0", stopTime=number(STOP_TIME), stepSize=number(table.step_size))


def enumerations(root: Element, table: Table) -> Iterator[tuple[Enumeration, Element]]:
    """Yield each enumeration that is used, and the element, added with the first, that takes its definition."""
    found = {row.enumeration.name: row.enumeration for row in table.shown if row.enumeration}
    if found:
        definitions = SubElement(root, "TypeDefinitions")
        for enumeration in found.values():
            yield enumeration, definitions


def items(element: Element, enumeration: Enumeration) -> None:
    """Add the items of an enumeration, which are the same in FMI 2.0 and 3.0."""
    for value, (name, description) in enumerate(enumeration.items, start=1):
        SubElement(element, "Item", name=name, value=str(value), description=description)


def _variable(reference: int, scalar: Scalar) -> Element:
    row = scalar.row
    element = Element(
        "ScalarVariable",
        name=scalar.name,
        valueReference=str(reference),
        description=row.description,
        causality=row.causality,
        variability=row.variability,
    )
    if row.initial is not None:
        element.set("initial", row.initial)
    SubElement(element, row.kind, dict(_type_attributes(scalar)))
    return element


def _type_attributes(scalar: Scalar) -> Iterator[tuple[str, str]]:
    row = scalar.row
    if row.enumeration is not None:
        yield "declaredType", row.enumeration.name
    if row.kind is Kind.REAL:
        yield "unit", scalar.unit
        if shown := display_unit(scalar.unit, row.nominal):
            yield "displayUnit", shown
    for name, bound in (("min", scalar.minimum), ("max", scalar.maximum)):
        if math.isfinite(bound):
            yield name, number(bound)
    if row.nominal is not None:
        yield "nominal", number(row.nominal)
    if scalar.start is not None:
        yield "start", number(scalar.start)


def _structure(root: Element, table: Table, index: Mapping[int, int]) -> None:
    """Add ModelStructure. Outputs depend on inputs, their initial values on parameters and inputs.

    `index` is that of each value reference.
    """
    structure = SubElement(root, "ModelStructure")
    for name, rows, knowns in unknowns(table.shown):
        if rows:
            element = SubElement(structure, f"{name}s")
            for row in rows:
                known = [r for of in table.knowns(row) if of in knowns for r in table.references(of.name)]
                dependencies = " ".join(str(index[reference]) for reference in known)
                for reference in table.references(row.name):
                    SubElement(element, "Unknown", index=str(index[reference]), dependencies=dependencies)


def unknowns(rows: Sequence[Variable]) -> Iterator[tuple[str, list[Variable], list[Variable]]]:
    """Yield what is unknown by its name in ModelStructure, its rows, and those on which they may depend."""
    outputs, inputs, parameters = (
        [row for row in rows if row.causality is of] for of in (Causality.OUTPUT, Causality.INPUT, Causality.PARAMETER)
    )
    yield "Output", outputs, inputs
    yield "InitialUnknown", [row for row in outputs if row.initial == "calculated"], [*parameters, *inputs]
