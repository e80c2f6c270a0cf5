"""Rules for the variables of a description, their units and types."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import product
from xml.etree.ElementTree import Element

from . import reading

_INDEX = r"\[\d+(?:,\d+)*\]"
_BASE_UNITS = {"kg", "m", "s", "A", "K", "mol", "cd", "rad"}


def arrays_are_whole(root: Element) -> Iterator[str]:
    """Array indices start at one and are complete, row by row:"""
    arrays: dict[str, list[tuple[int, ...]]] = {}
    for variable in reading.variables(root):
        name = variable.get("name", "")
        indices = tuple(int(i) for part in re.findall(_INDEX, name) for i in part[1:-1].split(","))
        if indices:
            arrays.setdefault(re.sub(_INDEX, "[]", name), []).append(indices)
    for name, found in arrays.items():
        if len({len(indices) for indices in found}) > 1:
            yield f"{name} has elements of several dimensions"
        elif found != list(product(*(range(1, max(i) + 1) for i in zip(*found, strict=True)))):
            yield name


def dimensions_fit(root: Element) -> Iterator[str]:
    """Dimensions of arrays are structural parameters or numbers, and there is one start for each element or one for all:"""
    structural = {n: v for n, v in reading.numbered(root).items() if reading.causality(v) == "structuralParameter"}
    for variable in reading.variables(root):
        sizes = []
        for dimension in variable.findall("Dimension"):
            by = int(dimension.get("valueReference", -1))
            if dimension.get("start") is None and by not in structural:
                yield f"{variable.get('name')} has the dimension of variable {by}"
            sizes.append(
                int(dimension.get("start") or (structural[by].get("start") if by in structural else None) or 0)
            )
        starts = (variable.get("start") or "").split()
        if sizes and starts and len(starts) not in (1, math.prod(sizes)):
            yield f"{variable.get('name')} has {len(starts)} starts for {math.prod(sizes)} elements"


def references_are_unique(root: Element) -> Iterator[str]:
    """Value references are unique:"""
    seen: dict[str | None, str | None] = {}
    for variable in reading.variables(root):
        reference = variable.get("valueReference")
        if reference in seen:
            yield f"{seen[reference]} and {variable.get('name')} share {reference}"
        seen[reference] = variable.get("name")


def starts_are_given(root: Element) -> Iterator[str]:
    """A start value is given where a variable is set before the start, and nowhere else:"""
    for variable in reading.variables(root):
        if reading.causality(variable) in ("input", "independent") and variable.get("initial"):
            yield f"{variable.get('name')} is an {reading.causality(variable)} and has an initial"
        wanted = reading.causality(variable) == "input" or reading.initial(variable) in ("exact", "approx")
        if wanted != (reading.type_of(variable).get("start") is not None):
            yield f"{variable.get('name')} has {'none' if wanted else 'one'}"


def numbers_are_within_range(root: Element) -> Iterator[str]:
    """min, start and max are finite and in this order, a nominal is not zero:"""
    for variable in reading.variables(root):
        kind, name = reading.type_of(variable), variable.get("name")
        if kind.tag in ("Boolean", "String", "Binary", "Clock"):
            continue
        minimum, maximum, starts = (reading.of_type(root, variable, key) for key in ("min", "max", "start"))
        for start in [None] if starts is None else starts.split():
            numbers = [float(number) for number in (minimum, start, maximum) if number is not None]
            if numbers != sorted(numbers) or not all(map(math.isfinite, numbers)):
                yield f"{name}: min {minimum}, start {start}, max {maximum}"
        nominal = float(reading.of_type(root, variable, "nominal") or 1.0)
        if nominal == 0.0 or not math.isfinite(nominal):
            yield f"{name}: nominal {nominal:g}"


def units_are_defined(root: Element) -> Iterator[str]:
    """Every Real has a unit, defined by integer exponents of SI base units (an array in FMI 3.0 may have several units):"""
    defined = {unit.get("name"): unit.find("BaseUnit") for unit in root.findall("UnitDefinitions/Unit")}
    for name, base in defined.items():
        exponents = {
            k: v for k, v in (base.attrib if base is not None else {"": ""}).items() if k not in ("factor", "offset")
        }
        if not set(exponents) <= _BASE_UNITS or not all(re.fullmatch(r"-?\d+", e) for e in exponents.values()):
            yield f"{name} is not defined so"
    for variable in reading.variables(root):
        unit = reading.of_type(root, variable, "unit")
        mixed = unit is None and variable.find("Dimension") is not None
        if reading.type_of(variable).tag in reading.CONTINUOUS and unit not in defined and not mixed:
            yield f"{variable.get('name')} has {unit}"


def types_are_declared(root: Element) -> Iterator[str]:
    """Declared types exist and fit the kind of the variable, and the start of an enumeration is one of its items:"""
    types = {d.get("name"): d if reading.is_3(root) else d[0] for d in root.findall("TypeDefinitions/*")}
    for variable in reading.variables(root):
        kind, name = reading.type_of(variable), variable.get("name")
        declared = types.get(kind.get("declaredType"))
        if declared is None:
            if kind.tag == "Enumeration" or kind.get("declaredType"):
                yield f"{name}: {kind.get('declaredType')}"
        elif declared.tag.removesuffix("Type") != kind.tag:
            yield f"{name} is a {kind.tag}, its type {kind.get('declaredType')} is a {declared.tag}"
        elif kind.get("start") and declared.findall("Item"):
            values = [item.get("value") for item in declared.findall("Item")]
            if kind.get("start") not in values or len(set(values)) < len(values):
                yield f"{name}: start {kind.get('start')}, items {', '.join(map(str, values))}"


RULES = (
    *(arrays_are_whole, dimensions_fit, references_are_unique),
    *(starts_are_given, numbers_are_within_range, units_are_defined, types_are_declared),
)
