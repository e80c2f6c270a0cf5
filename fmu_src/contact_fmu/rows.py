"""Constructors of the rows of a table: parameters, inputs and outputs, with what the library says of an option or a record."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TypedDict, Unpack

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


class Placed(Taken, total=False):
    """The same, and where it goes."""

    member: str


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


def of(record: str, member: str) -> Placed:
    """Return start value and range of a number of a record, and the place where it goes."""
    return {**taken(MEMBERS[record][member]), "member": f"{record}.{member}"}


def parameter(name: str, description: str = "", **attributes: Unpack[Attributes]) -> Variable:
    """Return a parameter, fixed unless it is `tunable`."""
    return Variable(name=name, description=description, causality=Causality.PARAMETER, **attributes)


def signal(name: str, description: str = "", **attributes: Unpack[Attributes]) -> Variable:
    """Return an input."""
    return Variable(name=name, description=description, causality=Causality.INPUT, **attributes)


def output(name: str, description: str = "", **attributes: Unpack[Attributes]) -> Variable:
    """Return an output."""
    return Variable(name=name, description=description, causality=Causality.OUTPUT, **attributes)
