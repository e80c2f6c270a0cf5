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
from .variables import Causality, Kind, Scalar, Table

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
    indent(root)
    return guid, '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def number(value: float) -> str:
    """Return a number as text that reads back exactly."""
    return repr(value)


def _root(table: Table, interfaces: Interfaces) -> Element:
    root = Element(
        "fmiModelDescription",
        {
            "fmiVersion": "2.0",
            "modelName": table.name,
            "guid": "",
            "description": table.description,
            **ORIGIN,
            "variableNamingConvention": "structured",
        },
    )
    for interface, attributes in interfaces.items():
        SubElement(root, interface, {"modelIdentifier": table.name, **attributes})
    shown = [(r, table.scalars[r]) for row in table.shown for r in table.references(row.name)]
    units(root, {scalar.unit for _, scalar in shown if scalar.row.kind is Kind.REAL})
    _types(root, table)
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


def _types(root: Element, table: Table) -> None:
    enumerations = {row.enumeration.name: row.enumeration for row in table.shown if row.enumeration}
    if not enumerations:
        return
    definitions = SubElement(root, "TypeDefinitions")
    for enumeration in enumerations.values():
        simple = SubElement(definitions, "SimpleType", name=enumeration.name)
        items = SubElement(simple, "Enumeration")
        for value, (name, description) in enumerate(enumeration.items, start=1):
            SubElement(items, "Item", name=name, value=str(value), description=description)


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
    outputs = [row for row in table.shown if row.causality is Causality.OUTPUT]
    inputs = [row for row in table.shown if row.causality is Causality.INPUT]
    parameters = [row for row in table.shown if row.causality is Causality.PARAMETER]
    for section, rows, knowns in (
        ("Outputs", outputs, inputs),
        ("InitialUnknowns", [row for row in outputs if row.initial == "calculated"], [*parameters, *inputs]),
    ):
        if rows:
            element = SubElement(structure, section)
            names = {known.name for known in knowns}
            for row in rows:
                known = [r for of in table.knowns(row) if of.name in names for r in table.references(of.name)]
                dependencies = " ".join(str(index[reference]) for reference in known)
                for reference in table.references(row.name):
                    SubElement(element, "Unknown", index=str(index[reference]), dependencies=dependencies)
