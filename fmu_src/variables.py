"""What one row of an FMU's variable table says, and the table itself.

A table is the single source of an FMU's interface: modelDescription.xml of every packaging, the documentation, the
value references and the checks of its inputs all come from it. A row may be an array; it is declared once and becomes
scalars named after FMI's structured convention, `name[1]` … `name[n]`, `name[1,1]` … row by row. A row `patch[].area` is
an element of an array of structures: `patch[1].area` …
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import product
from typing import TypedDict, Unpack

from contact.errors import require_number


class Causality(StrEnum):
    """Who writes a variable, and when; the values are FMI's words."""

    PARAMETER = "parameter"
    INPUT = "input"
    OUTPUT = "output"


class Kind(StrEnum):
    """FMI's type of a variable; the values are the names of the XML elements in FMI 2.0."""

    REAL = "Real"
    INTEGER = "Integer"
    BOOLEAN = "Boolean"
    ENUMERATION = "Enumeration"


@dataclass(frozen=True)
class Enumeration:
    """A type with named values 1, 2, … in the order of `items` = ((name, description), …)."""

    name: str
    items: tuple[tuple[str, str], ...]

    def number(self, item: str) -> int:
        """Value of the item named `item`."""
        return [name for name, _ in self.items].index(item) + 1

    def item(self, number: int) -> str:
        """Name of the item with value `number`."""
        return self.items[number - 1][0]


class Limits(TypedDict, total=False):
    """What rows of a kind have in common; the meaning of each is at `Variable`."""

    minimum: float
    maximum: float
    open_minimum: bool
    nominal: float | None


class Attributes(Limits, total=False):
    """What a row may say besides its name, description and causality."""

    unit: str | tuple[str, ...]
    start: float | str | tuple[float, ...] | None
    enumeration: Enumeration | None
    integer: bool
    boolean: bool
    shape: tuple[int | str, ...]
    depends: tuple[str, ...] | None
    derivative_of: str | None


@dataclass(frozen=True, kw_only=True)
class Variable:
    """One row of a table.

    Parameters
    ----------
    name, description : str
    causality : Causality
    unit : str or tuple of str
        Key of `units.UNITS`, or one key an element; of a Real only, a Real always has one ("1" without dimension).
    start : number, str, or tuple of numbers
        Required of parameters and inputs. An output with a start is set exactly before initialisation (a state), one
        without is calculated. For an enumeration the name of the item.
    minimum, maximum : float
        The allowed range; with `open_minimum` the minimum itself is not allowed (XML cannot say that, the FMU does).
    nominal : float, optional
        Magnitude of a Real, where it is far from 1.
    enumeration : Enumeration, optional
        Makes the variable an Enumeration.
    integer, boolean : bool
        Makes the variable an Integer or a Boolean.
    shape : tuple of int or str
        Empty for a scalar. In a field names of Integer parameters too: the resolution that the user chooses.
    depends : tuple of str, optional
        Rows (parameters, inputs and continuous states) that an output is a function of; None means all of them.
    derivative_of : str, optional
        Row of which this output is the derivative by time: in model exchange that one is a continuous state.
    """

    name: str
    description: str
    causality: Causality
    unit: str | tuple[str, ...] = "1"
    start: float | str | tuple[float, ...] | None = None
    minimum: float = -math.inf
    maximum: float = math.inf
    open_minimum: bool = False
    nominal: float | None = None
    enumeration: Enumeration | None = None
    integer: bool = False
    boolean: bool = False
    shape: tuple[int | str, ...] = ()
    depends: tuple[str, ...] | None = None
    derivative_of: str | None = None

    @property
    def kind(self) -> Kind:
        """FMI's type."""
        if self.enumeration is not None:
            return Kind.ENUMERATION
        if self.boolean:
            return Kind.BOOLEAN
        return Kind.INTEGER if self.integer else Kind.REAL

    @property
    def variability(self) -> str:
        """FMI's variability: parameters are fixed, reals continuous, the rest discrete."""
        if self.causality is Causality.PARAMETER:
            return "fixed"
        return "continuous" if self.kind is Kind.REAL else "discrete"

    @property
    def initial(self) -> str | None:
        """FMI's `initial`; an input has none."""
        if self.causality is Causality.INPUT:
            return None
        return "calculated" if self.start is None else "exact"

    @property
    def size(self) -> int:
        """Number of scalars; a field has no fixed one."""
        return math.prod(self._counts)

    @property
    def _counts(self) -> tuple[int, ...]:
        """The shape of what has a fixed one."""
        return tuple(int(n) for n in self.shape)

    def element(self, index: str) -> str:
        """Name with an index in brackets, or with none."""
        return self.name.replace("[]", index) if "[]" in self.name else self.name + index

    def scalars(self) -> Iterator[Scalar]:
        """The scalars of the row, first index slowest."""
        for i, index in enumerate(product(*(range(1, n + 1) for n in self._counts))):
            suffix = f"[{','.join(map(str, index))}]" if index else ""
            start = self.start[i] if isinstance(self.start, tuple) else self.start
            if isinstance(start, str):
                assert self.enumeration is not None
                start = self.enumeration.number(start)
            unit = self.unit[i] if isinstance(self.unit, tuple) else self.unit
            yield Scalar(self.element(suffix), self, unit, start)


@dataclass(frozen=True)
class Scalar:
    """One scalar of a row, with its own name, unit and start."""

    name: str
    row: Variable
    unit: str
    start: float | int | None

    @property
    def minimum(self) -> float:
        """Least allowed value; an enumeration starts at 1."""
        return 1 if self.row.enumeration else self.row.minimum

    @property
    def maximum(self) -> float:
        """Greatest allowed value; an enumeration ends with its last item."""
        return len(self.row.enumeration.items) if self.row.enumeration else self.row.maximum

    @property
    def first(self) -> float | int:
        """Value before anything is computed."""
        if self.start is not None:
            return self.start
        return 0.0 if self.row.kind is Kind.REAL else int(self.minimum)

    def check(self, value: float) -> None:
        """Raise ContactError with name, value and range when `value` is not allowed."""
        require_number(self.name, value, self.minimum, self.maximum, open_minimum=self.row.open_minimum)


@dataclass(frozen=True)
class Table:
    """Interface of one FMU. The value reference of a scalar is its position in `scalars`.

    Rows are the interface in FMI 2.0. In FMI 3.0 an array is one variable, with the value reference of its first scalar;
    `fields` are outputs that only arrays can be, all of one shape, which names the parameters that are structural there;
    their value references follow the scalars', and that of time follows theirs.
    """

    name: str
    description: str
    rows: Sequence[Variable]
    step_size: float  # of the default experiment [s]
    fields: Sequence[Variable] = ()
    row: dict[str, Variable] = field(init=False)
    span: dict[str, slice] = field(init=False)  # name of a row → where its scalars are
    scalars: tuple[Scalar, ...] = field(init=False)

    def __post_init__(self) -> None:
        if len({row.shape for row in self.fields}) > 1:
            raise ValueError(f"{self.name}: fields have one shape")
        scalars: list[Scalar] = []
        span: dict[str, slice] = {}
        for row in self.rows:
            span[row.name] = slice(len(scalars), len(scalars) + row.size)
            scalars.extend(row.scalars())
        object.__setattr__(self, "row", {row.name: row for row in self.rows})
        object.__setattr__(self, "scalars", tuple(scalars))
        object.__setattr__(self, "span", span)

    @property
    def derivatives(self) -> list[Variable]:
        """Derivatives of the continuous states, in the states' order."""
        return [row for row in self.rows if row.derivative_of is not None]

    @property
    def states(self) -> list[Variable]:
        """Continuous states, in the order of their derivatives."""
        return [self.row[row.derivative_of] for row in self.derivatives if row.derivative_of is not None]

    @property
    def structural(self) -> frozenset[str]:
        """Parameters that fields have their shape from."""
        return frozenset(n for row in self.fields for n in row.shape if isinstance(n, str))

    def references(self, name: str) -> range:
        """Value references of the row named `name`."""
        where = self.span[name]
        return range(where.start, where.stop)

    def knowns(self, output: Variable) -> list[Variable]:
        """Parameters, inputs and continuous states that `output` is a function of."""
        known = [row for row in self.rows if row.causality is not Causality.OUTPUT or row in self.states]
        return [row for row in known if output.depends is None or row.name in output.depends]


def identifier(name: str) -> str:
    """Name of a row where dots and brackets are not allowed."""
    return name.replace("[]", "").replace(".", "_")


def parameter(name: str, description: str, **attributes: Unpack[Attributes]) -> Variable:
    """A fixed parameter."""
    return Variable(name=name, description=description, causality=Causality.PARAMETER, **attributes)


def signal(name: str, description: str, **attributes: Unpack[Attributes]) -> Variable:
    """An input."""
    return Variable(name=name, description=description, causality=Causality.INPUT, **attributes)


def output(name: str, description: str, **attributes: Unpack[Attributes]) -> Variable:
    """An output."""
    return Variable(name=name, description=description, causality=Causality.OUTPUT, **attributes)
