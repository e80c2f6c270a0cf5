"""Variable table of an FMU and its rows.

The table is the single source of an FMU's interface: modelDescription.xml of every packaging, the documentation, the value
references and the checks of its inputs are all made from it. A row may be an array. It is declared once and becomes scalars
with names of FMI's structured convention: `name[1]` … `name[n]`, or `name[1,1]` … row by row. A row `patch[].area` is a
member of an array of structures: `patch[1].area` …
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from itertools import product

from contact.errors import require_number
from contact.kernels.records import MEANING, unit_of


class Causality(StrEnum):
    """Causality of a variable: who writes it, and when. The values are FMI's words."""

    PARAMETER = "parameter"
    INPUT = "input"
    OUTPUT = "output"
    LOCAL = "local"  # computed like an output, but no connector of a host


class Kind(StrEnum):
    """Type of a variable. The values are the names of the XML elements in FMI 2.0."""

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
        """Return the value of the item named `item`."""
        return [name for name, _ in self.items].index(item) + 1

    def item(self, number: int) -> str:
        """Return the name of the item with value `number`."""
        return self.items[number - 1][0]


@dataclass(frozen=True, kw_only=True)
class Variable:
    """One row of a table.

    Parameters
    ----------
    name, description : str
        If the description is not given, it is that of the `member`.
    causality : Causality
    unit : str or tuple of str
        Key of `units.UNITS`, or one key for each element. Every Real has a unit ("1" if dimensionless), other types have none.
        If it is not given, it is that of the `member`.
    start : number, str, or tuple of numbers
        Start value, for an enumeration the name of the item. Parameters and inputs need one. An output with a start is exact
        before initialisation; an output without a start is calculated.
    minimum, maximum : float
        Allowed range. With `open_minimum` the minimum itself is not allowed. The XML cannot express this, so the FMU checks it.
    nominal : float, optional
        Typical magnitude of a Real, if it is far from 1.
    enumeration : Enumeration, optional
        Makes the variable an Enumeration.
    integer, boolean : bool
        Makes the variable an Integer or a Boolean.
    shape : tuple of int or str
        Empty for a scalar. For a field it may contain names of Integer parameters, the resolution that the user chooses.
    depends : tuple of str, optional
        Rows (parameters and inputs) on which an output depends. None means all of them.
    tunable : bool
        Whether a host may change the parameter after initialisation: in event mode or between steps.
    used : mapping
        Enumeration → its items with which this input or parameter is used; with all of them if it is not named. A value that
        is not used may be any, even NaN.
    twin_of : str
        Row that this one stands for in hosts that do not know its type (`with_twins`).
    member : str
        "record.member" of the kernels (`contact.kernels.records`). A parameter or an input is copied to it, an output is copied
        from it, an array of patches from as many records. An item of an enumeration counts from 0 there, a status from 1.
    integral_of : (str or None, str or None), optional
        A rate per metre and a speed of either sign, or one of the two. The output is the integral of their product over time.
    """

    name: str
    description: str = ""
    causality: Causality
    unit: str | tuple[str, ...] = ""
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
    tunable: bool = False
    used: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    twin_of: str = ""
    member: str = ""
    integral_of: tuple[str | None, str | None] | None = None

    def __post_init__(self) -> None:
        if not self.unit:
            object.__setattr__(self, "unit", _unit_of(self.member))
        if not self.description:
            object.__setattr__(self, "description", _meaning_of(self.member))

    @property
    def is_given(self) -> bool:
        """Whether the host gives the value: a parameter or an input."""
        return self.causality in (Causality.PARAMETER, Causality.INPUT)

    @property
    def kind(self) -> Kind:
        """Type of the variable in FMI."""
        if self.enumeration is not None:
            return Kind.ENUMERATION
        if self.boolean:
            return Kind.BOOLEAN
        return Kind.INTEGER if self.integer else Kind.REAL

    @property
    def variability(self) -> str:
        """Variability in FMI: parameters are fixed or tunable, reals continuous, the rest discrete."""
        if self.causality is Causality.PARAMETER:
            return "tunable" if self.tunable else "fixed"
        return "continuous" if self.kind is Kind.REAL else "discrete"

    @property
    def initial(self) -> str | None:
        """Attribute `initial` in FMI. An input has none."""
        if self.causality is Causality.INPUT:
            return None
        return "calculated" if self.start is None else "exact"

    @property
    def size(self) -> int:
        """Number of scalars. A field has no fixed number."""
        return math.prod(self._counts)

    @property
    def _counts(self) -> tuple[int, ...]:
        """Shape of a row that is not a field."""
        return tuple(int(n) for n in self.shape)

    def element(self, index: str) -> str:
        """Return the name with `index` in brackets, or without brackets if it is empty."""
        return self.name.replace("[]", index) if "[]" in self.name else self.name + index

    def scalars(self) -> Iterator[Scalar]:
        """Yield the scalars of the row, with the first index slowest."""
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
        """Value before the first computation."""
        if self.start is not None:
            return self.start
        return 0.0 if self.row.kind is Kind.REAL else int(self.minimum)

    def check(self, value: float) -> None:
        """Raise ContactError with name, value and range if `value` is not allowed."""
        require_number(self.name, value, self.minimum, self.maximum, open_minimum=self.row.open_minimum)


@dataclass(frozen=True)
class Table:
    """Interface of one FMU. The value reference of a scalar is its position in `scalars`. Rows that need one get a twin.

    The rows are the interface in FMI 2.0. In FMI 3.0 an array is one variable, with the value reference of its first scalar.
    `hidden` names rows that hosts do not see: they keep their start values, and the code is that of the whole table.
    `fields` are outputs only in FMI 3.0. All fields have the same shape, and the parameters that it names are structural
    parameters in FMI 3.0. The value references of the fields follow those of the scalars, and that of time comes last.
    """

    name: str
    description: str
    rows: Sequence[Variable]
    step_size: float  # step size of the default experiment [s]
    fields: Sequence[Variable] = ()
    hidden: frozenset[str] = frozenset()
    row: dict[str, Variable] = field(init=False)
    span: dict[str, slice] = field(init=False)  # name of a row → positions of its scalars
    scalars: tuple[Scalar, ...] = field(init=False)

    def __post_init__(self) -> None:
        if len({row.shape for row in self.fields}) > 1:
            raise ValueError(f"{self.name}: all fields must have the same shape")
        object.__setattr__(self, "rows", with_twins(self.rows))
        object.__setattr__(self, "fields", with_twins(self.fields))
        scalars: list[Scalar] = []
        span: dict[str, slice] = {}
        for row in self.rows:
            span[row.name] = slice(len(scalars), len(scalars) + row.size)
            scalars.extend(row.scalars())
        object.__setattr__(self, "row", {row.name: row for row in self.rows})
        object.__setattr__(self, "scalars", tuple(scalars))
        object.__setattr__(self, "span", span)

    @property
    def shown(self) -> list[Variable]:
        """Rows that hosts see."""
        return [row for row in self.rows if not {row.name, row.twin_of} & self.hidden]

    @property
    def twins(self) -> list[Variable]:
        """Rows that stand for another one."""
        return [row for row in self.rows if row.twin_of]

    def members(self, record: str, *, given: bool) -> dict[str, str]:
        """Return name → member of `record` of the rows that a host gives, or of those that it reads."""
        split = ((row, *row.member.partition(".")) for row in self.rows if row.is_given is given)
        return {row.name: member for row, of, _, member in split if of == record}

    @property
    def structural(self) -> frozenset[str]:
        """Names of the parameters that determine the shape of the fields."""
        return frozenset(n for row in self.fields for n in row.shape if isinstance(n, str))

    def references(self, name: str) -> range:
        """Return the value references of the row named `name`."""
        where = self.span[name]
        return range(where.start, where.stop)

    def knowns(self, output: Variable) -> list[Variable]:
        """Return the parameters and inputs on which `output` depends."""
        known = [row for row in self.shown if row.is_given]
        return [row for row in known if output.depends is None or {row.name, row.twin_of} & {*output.depends}]


def with_twins(rows: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return the rows with a twin after each row whose type some hosts do not know.

    Some hosts read every output as a Real (CasADi, CoFMUPy). So an output of another type becomes a local variable, and its
    twin `…_real` is the output. Others have no Enumerations (libcosim). So each Enumeration that a host sets has a twin
    `…_integer` of type Integer. If that is not 0, it is the value of the Enumeration.
    """
    every: list[Variable] = []
    for row in rows:
        if row.causality is Causality.OUTPUT and row.kind is not Kind.REAL:
            every.append(replace(row, causality=Causality.LOCAL))
            numbers = row.enumeration and ", ".join(
                f"{i} {name}" for i, (name, _) in enumerate(row.enumeration.items, 1)
            )
            every.append(
                Variable(
                    name=f"{row.name}_real",
                    description=f"{row.name} as a Real" + (f": {numbers}" if numbers else ""),
                    causality=Causality.OUTPUT,
                    minimum=1 if row.enumeration else row.minimum,
                    maximum=len(row.enumeration.items) if row.enumeration else row.maximum,
                    shape=row.shape,
                    depends=row.depends,
                    twin_of=row.name,
                )
            )
        elif row.is_given and row.enumeration is not None:
            every += [
                row,
                Variable(
                    name=f"{row.name}_integer",
                    description=f"Number of the item of {row.name}, for hosts without Enumerations; 0: {row.name} counts",
                    causality=row.causality,
                    integer=True,
                    start=0,
                    minimum=0,
                    maximum=len(row.enumeration.items),
                    tunable=row.tunable,
                    twin_of=row.name,
                ),
            ]
        else:
            every.append(row)
    return tuple(every)


#: Rotations per metre. FMI tells their unit from that of a curvature.
_TURNING = ("case.phi", "case.rolling", "contact.spin")


def _unit_of(member: str) -> str:
    """Return the unit that the kernels state for a member of a record, as FMI writes it; "1" for none."""
    if not member or member in _TURNING:
        return "rad/m" if member else "1"
    return unit_of(member).replace(" ", ".")


def _meaning_of(member: str) -> str:
    """Return what the kernels say of a member of a record, without its unit."""
    record, name = member.split(".")
    text = re.sub(r" *\[.+?\]", "", MEANING[record][name])
    return text[:1].upper() + text[1:]
