"""Values of an instance's variables by the names of the table's rows."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from contact.errors import ContactError
from ..variables import Table, Variable

#: Values of some rows by name: a number, or a list for an array.
Rows = Mapping[str, float | list[float]]


class SlaveValues:
    """Values of all scalars. A row is read by name: a number, or a list for an array."""

    def __init__(self, table: Table, numbers: list[float]) -> None:
        self.table = table
        self.numbers = numbers

    def __getitem__(self, name: str) -> Any:
        span = self.table.span[name]
        return self.numbers[span] if self.table.row[name].shape else self.numbers[span.start]

    def item(self, name: str) -> str:
        """Return the name of the current item of an enumeration."""
        enumeration = self.table.row[name].enumeration
        assert enumeration is not None
        return enumeration.item(self.numbers[self.table.span[name].start])

    def uses(self, row: Variable) -> bool:
        """Return whether the value of a parameter or input has any effect."""
        return all(self.item(name) in items for name, items in row.used.items())

    def copy(self) -> SlaveValues:
        """Return a copy that later calls do not change."""
        return SlaveValues(self.table, self.numbers.copy())

    def updated(self, new: Rows) -> SlaveValues:
        """Return a copy with some rows replaced. Raise ContactError if one of these is not finite."""
        result = self.copy()
        for name, value in new.items():
            column = value if isinstance(value, list) else [value]
            if not all(map(math.isfinite, column)):
                raise ContactError(f"{name} has no finite value for these inputs")
            result.numbers[self.table.span[name]] = column
        return result
