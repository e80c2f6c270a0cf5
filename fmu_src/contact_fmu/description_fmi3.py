"""modelDescription.xml of FMI 3.0, made from a table of variables. Each array is one variable, and fields are included."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from xml.etree.ElementTree import Element, SubElement

from .description import Interfaces, enumerations, experiment, items, number, root_of, text_of, units, unknowns
from .units import display_unit
from .variables import Kind, Scalar, Table, Variable

_TYPES = {Kind.REAL: "Float64", Kind.INTEGER: "Int64", Kind.BOOLEAN: "Boolean", Kind.ENUMERATION: "Enumeration"}


def model_description(table: Table, interfaces: Interfaces, token: str) -> str:
    """Return the XML of an FMU with this table and these interfaces. `token` is the instantiation token of its binary."""
    root = root_of(table, interfaces, "3.0", instantiationToken=token)
    units(root, {row.unit for row in (*table.shown, *table.fields) if row.kind is Kind.REAL} | {"s"})
    for enumeration, definitions in enumerations(root, table):
        items(SubElement(definitions, "EnumerationType", name=enumeration.name), enumeration)
    experiment(root, table)
    _variables(root, table)
    _structure(root, table)
    return text_of(root)


def build_description(name: str, sources: Sequence[str]) -> str:
    """Return sources/buildDescription.xml for these C files."""
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=name)
    files = SubElement(
        configuration, "SourceFileSet", language="C11", compiler="gcc", compilerOptions="-ffp-contract=off"
    )
    for source in sources:
        SubElement(files, "SourceFile", name=source)
    # A host that makes a shared library cancels the prefix by FMI3_OVERRIDE_FUNCTION_PREFIX.
    prefix = {
        "name": "FMI3_FUNCTION_PREFIX",
        "value": f"{name}_",
        "description": "Before the names of all FMI functions",
    }
    SubElement(files, "PreprocessorDefinition", prefix)
    SubElement(
        configuration, "Library", name="m", external="true", description="Mathematical functions of the C library"
    )
    return text_of(root)


def value_references(table: Table) -> dict[str, int]:
    """Return the value reference of every variable by name.

    An array has the value reference that its first scalar has in FMI 2.0. Fields and time come last.
    """
    references = {row.name: table.span[row.name].start for row in table.rows}
    for name in (*(field.name for field in table.fields), "time"):
        references[name] = len(table.scalars) + len(references) - len(table.rows)
    return references


def _variables(root: Element, table: Table) -> None:
    references = value_references(table)
    variables = SubElement(root, "ModelVariables")
    for row in (*table.shown, *table.fields):
        element = SubElement(
            variables,
            "UInt64" if row.name in table.structural else _TYPES[row.kind],
            name=row.element(""),
            valueReference=str(references[row.name]),
            description=row.description,
            causality="structuralParameter" if row.name in table.structural else row.causality,
            variability=row.variability,
        )
        if row.initial is not None:
            element.set("initial", row.initial)
        scalars = [] if row in table.fields else list(row.scalars())
        element.attrib.update(_attributes(row, scalars))
        for size in row.shape:
            known = {"start": str(size)} if isinstance(size, int) else {"valueReference": str(references[size])}
            SubElement(element, "Dimension", known)
    SubElement(
        variables,
        "Float64",
        name="time",
        valueReference=str(references["time"]),
        description="Simulation time",
        causality="independent",
        variability="continuous",
        unit="s",
    )


def _attributes(row: Variable, scalars: list[Scalar]) -> Iterator[tuple[str, str]]:
    """Yield the attributes that depend on the type. `scalars` are those of the row, empty for a field."""
    if row.enumeration is not None:
        yield "declaredType", row.enumeration.name
    if row.kind is Kind.REAL and isinstance(row.unit, str):  # the elements of an array have one unit or none
        yield "unit", row.unit
        if shown := display_unit(row.unit, row.nominal):
            yield "displayUnit", shown
    if row.kind is not Kind.BOOLEAN:
        write = number if row.kind is Kind.REAL else lambda bound: str(int(bound))
        limits = scalars[0] if scalars else row
        for name, bound in (("min", limits.minimum), ("max", limits.maximum)):
            if math.isfinite(bound):
                yield name, write(bound)
    if row.nominal is not None:
        yield "nominal", number(row.nominal)
    starts = [scalar.start for scalar in scalars if scalar.start is not None]
    if starts:
        yield "start", " ".join(map(number, starts))


def _structure(root: Element, table: Table) -> None:
    """Add ModelStructure. Outputs depend on inputs, their initial values on parameters and inputs."""
    structure = SubElement(root, "ModelStructure")
    references = value_references(table)
    for element, rows, knowns in unknowns((*table.shown, *table.fields)):
        for row in rows:
            dependencies = " ".join(str(references[known.name]) for known in table.knowns(row) if known in knowns)
            SubElement(structure, element, valueReference=str(references[row.name]), dependencies=dependencies)
