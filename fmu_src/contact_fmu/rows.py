"""Constructors of the rows of a table: parameters, inputs and outputs, with what the library says of an option or a record."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, TypedDict, Unpack

from contact.inputs.options import MEMBERS, Real, Whole
from .variables import Causality, Enumeration, Variable


class Limits(TypedDict, total=False):
    """Range and nominal of a row, explained at `Variable`. Rows of one kind may share them."""

    minimum: float
    maximum: float
    open_minimum: bool
    nominal: float | None


class Taken(TypedDict, total=False):
    """What a row has of an option of the library."""

    start: float
    minimum: float
    maximum: float
    open_minimum: bool
    integer: bool


class Attributes(Limits, total=False):
    """Optional attributes of a row, explained at `Variable`."""

    unit: str | tuple[str, ...]
    start: float | str | tuple[float, ...] | None
    enumeration: Enumeration | None
    integer: bool
    boolean: bool
    shape: tuple[int | str, ...]
    depends: tuple[str, ...] | None
    tunable: bool
    used: Mapping[str, tuple[str, ...]]
    twin_of: str
    member: str
    integral_of: tuple[str | None, str | None] | None


def identifier(name: str) -> str:
    """Return the name of a row as an identifier, without dots and brackets."""
    return name.replace("[]", "").replace(".", "_")


def taken(option: Whole | Real) -> Taken:
    """Return start value and range of an option of the library."""
    found: Taken = {"start": option.usual, "minimum": option.least}
    if isinstance(option, Whole):
        return {**found, "integer": True, "maximum": option.most}
    if option.above:
        found["open_minimum"] = True
    return found if math.isinf(option.most) else {**found, "maximum": option.most}


def parameter(name: str, description: str = "", **attributes: Unpack[Attributes]) -> Variable:
    """Return a parameter, fixed unless it is `tunable`."""
    return _given(Causality.PARAMETER, name, description, attributes)


def signal(name: str, description: str = "", **attributes: Unpack[Attributes]) -> Variable:
    """Return an input."""
    return _given(Causality.INPUT, name, description, attributes)


def _given(causality: Causality, name: str, description: str, attributes: Attributes) -> Variable:
    """Return what a host gives. Start value and range are those of its `member`, unless others are stated."""
    record, _, member = attributes.get("member", "").partition(".")
    limits = None if attributes.get("enumeration") else MEMBERS.get(record, {}).get(member)
    known: Any = {**(taken(limits) if limits else {}), **attributes}
    return Variable(name=name, description=description, causality=causality, **known)


def output(name: str, description: str = "", **attributes: Unpack[Attributes]) -> Variable:
    """Return an output."""
    return Variable(name=name, description=description, causality=Causality.OUTPUT, **attributes)
