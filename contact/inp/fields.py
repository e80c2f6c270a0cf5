"""What blocks of CONTACT's input files are made of: fields, groups and lists of numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

#: What is known while a case is read: its digits by letter and the values in force by name.
Now = Mapping[str, Any]


def always(now: Now) -> bool:
    """Return True."""
    return True


@dataclass(frozen=True)
class Field:
    """One number or name of a group.

    Attributes
    ----------
    kind : "i" integer, "d" real, "a" angle, "s" name of a file
    factor : to SI units; a function of what is known where it depends on digits
    low, high : allowed range of the number in the file; `above` makes the lower end open
    when : whether the field is there
    optional : only read from the line that has the last mandatory value
    default : of an optional field that is not there
    """

    name: str
    kind: str = "d"
    factor: float | Callable[[Now], float] = 1.0
    low: float = -math.inf
    high: float = math.inf
    above: bool = False
    when: Callable[[Now], bool] = always
    optional: bool = False
    default: Any = None

    def scale(self, now: Now) -> float:
        """Return the factor to SI units."""
        return self.factor(now) if callable(self.factor) else self.factor

    @property
    def allowed(self) -> str:
        """The allowed range, in words."""
        if self.kind == "s":
            return "a name in single quotes"
        kind = {"i": "an integer", "d": "a number", "a": "an angle like 90d or 1.5708"}[self.kind]
        if math.isinf(self.low) and math.isinf(self.high):
            return kind
        left, right = ("]" if self.above or math.isinf(self.low) else "["), ("[" if math.isinf(self.high) else "]")
        return f"{kind} in {left}{self.low:.12g}, {self.high:.12g}{right}"


@dataclass(frozen=True)
class Group:
    """Values in a fixed order. With `repeat` it is there that many times, and each name holds a tuple.

    `kept` are values that say afterwards which block was read: name and function of what is known.
    """

    fields: tuple[Field, ...]
    when: Callable[[Now], bool] = always
    repeat: Callable[[Now], int] | None = None
    kept: tuple[tuple[str, Callable[[Now], Any]], ...] = ()


@dataclass(frozen=True)
class Array:
    """A list of `count` numbers; `factors` returns the factor of each of the `columns` or of each number."""

    name: str
    count: Callable[[Now], int]
    factors: Callable[[Now], tuple[float, ...]]
    kind: str = "d"
    when: Callable[[Now], bool] = always


@dataclass(frozen=True)
class Subsurface:
    """Blocks of points below the surface, until one with ISUBS ≤ 0."""

    when: Callable[[Now], bool] = always


Block = Group | Array | Subsurface


def i(name: str, low: float = -math.inf, high: float = math.inf, **others: Any) -> Field:
    """Return a field with an integer."""
    return Field(name, "i", low=low, high=high, **others)


def d(name: str, factor: float | Callable[[Now], float] = 1.0, low: float = -math.inf, **others: Any) -> Field:
    """Return a field with a real number."""
    return Field(name, "d", factor, low, **others)


def a(name: str, **others: Any) -> Field:
    """Return a field with an angle [rad]."""
    return Field(name, "a", **others)


def maybe(field: Field, default: Any) -> Field:
    """Return the field as an optional one."""
    return Field(**{**field.__dict__, "optional": True, "default": default})
