"""Results as tables of pandas and xarray, with named axes and units (`contact.view.units`)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from contact.errors import optional
from contact.view.units import UNITS

Values = NDArray[Any]


class Table(NamedTuple):
    """What a table is made of.

    Attributes
    ----------
    axes : name of each axis → the values along it
    columns : name → values over all axes, or over the first ones
    beside : the same, of what is no result but tells where it belongs
    units : units of names that have another one here than in `contact.view.units`
    attributes : what holds for the whole table
    """

    axes: Mapping[str, Values]
    columns: Mapping[str, Values]
    beside: Mapping[str, Values] = {}
    units: Mapping[str, str] = {}
    attributes: Mapping[str, str] = {}

    def unit(self, name: str) -> str | None:
        """Return the unit of a column or an axis, None if it has none."""
        return self.units.get(name, UNITS.get(name))


class Tabular:
    """Base of results that are tables."""

    __slots__ = ()

    def _table(self) -> Table:
        raise NotImplementedError

    def to_dataframe(self) -> Any:
        """Return the results as a `pandas.DataFrame`, a row for each point of the axes, which are its index.

        `DataFrame.attrs["units"]` has the unit of each column and axis.

        Raises
        ------
        ImportError
            If pandas is missing; the message names the extra.
        """
        pandas, table = optional("pandas", "tables need", "tables"), self._table()
        shape = tuple(values.size for values in table.axes.values())
        columns = {
            name: np.broadcast_to(_over(values, len(shape)), shape).ravel()
            for name, values in (table.beside | table.columns).items()  # type: ignore[operator]
        }
        levels = np.meshgrid(*table.axes.values(), indexing="ij")
        if len(levels) == 1:
            index = pandas.Index(levels[0], name=next(iter(table.axes)))
        else:
            index = pandas.MultiIndex.from_arrays([level.ravel() for level in levels], names=list(table.axes))
        made = pandas.DataFrame(columns, index=index)
        units = {name: table.unit(name) for name in (*table.axes, *columns)}
        made.attrs = {"units": {name: unit for name, unit in units.items() if unit}, **table.attributes}
        return made

    def to_xarray(self) -> Any:
        """Return the results as an `xarray.Dataset` over named axes. Variables have the attribute `units`.

        Raises
        ------
        ImportError
            If xarray is missing; the message names the extra.
        """
        xarray, table = optional("xarray", "tables need", "tables"), self._table()
        names = tuple(table.axes)

        def variable(name: str, values: Values, over: tuple[str, ...]) -> tuple[Any, ...]:
            unit = table.unit(name)
            return over, values, {"units": unit} if unit else {}

        columns = {name: variable(name, values, names[: values.ndim]) for name, values in table.columns.items()}
        axes = {name: variable(name, values, (name,)) for name, values in table.axes.items()}
        beside = {name: variable(name, values, names[: values.ndim]) for name, values in table.beside.items()}
        return xarray.Dataset(columns, axes | beside, dict(table.attributes))


class ArrayOfResults(Tabular):
    """Base of records whose members are arrays of one shape. The inputs of the array, kept in `_given`, name its axes."""

    __slots__ = ("_given",)

    def _with_inputs(self, given: Mapping[str, Values]) -> Self:
        object.__setattr__(self, "_given", dict(given))
        return self

    def _table(self) -> Table:
        names = [each.name for each in fields(self) if each.name != "jacobian"]  # type: ignore[arg-type]
        shape = np.shape(getattr(self, names[0])) or (1,)
        axes, beside = axes_of(shape, getattr(self, "_given", {}))
        columns = {name: np.reshape(getattr(self, name), shape) for name in names if name not in axes | beside}
        return Table(axes, columns, beside)

    def __getstate__(self) -> Any:
        members = {each.name: getattr(self, each.name) for each in fields(self)}  # type: ignore[arg-type]
        return members, getattr(self, "_given", {})

    def __setstate__(self, state: Any) -> None:
        for name, value in state[0].items():
            object.__setattr__(self, name, value)
        self._with_inputs(state[1])


def _over(values: Values, n: int) -> Values:
    """Return values over the first axes with axes of length 1 for the other ones."""
    return values.reshape(*values.shape, *(1,) * (n - values.ndim))


def axes_of(shape: Sequence[int], given: Mapping[str, Values]) -> tuple[dict[str, Values], dict[str, Values]]:
    """Return axes for results of this shape, and what is beside them, from the inputs that broadcast to it.

    An axis along which one input varies, and which varies along no other axis, has the name and the values of that input.
    Another axis is called case, or axis_0, axis_1, … if there are more; inputs that vary along it are beside.
    """
    shape = tuple(shape) or (1,)
    along: dict[str, tuple[int, ...]] = {}
    for name, values in given.items():
        first = len(shape) - values.ndim
        along[name] = tuple(first + k for k, n in enumerate(values.shape) if n > 1)
    axes, beside = {}, {}
    for k, n in enumerate(shape):
        varied = [name for name, over in along.items() if k in over]
        if len(varied) == 1 and along[varied[0]] == (k,):
            axes[varied[0]] = np.ravel(given[varied[0]])
        else:
            axes["case" if len(shape) == 1 else f"axis_{k}"] = np.arange(n)
    for name, values in given.items():
        if name not in axes and along[name]:
            beside[name] = np.broadcast_to(values, shape)
    return axes, beside
