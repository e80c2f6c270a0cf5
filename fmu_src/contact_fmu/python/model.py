"""What the slaves of all models share: a model for the parameters, and outputs that follow from the table."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..variables import Causality, Table
from .slave import TableSlave
from .values import Rows, SlaveValues


class ModelSlave(TableSlave):
    """Slave with a model that is made for the parameters. Arguments as for `TableSlave`."""

    def __init__(self, table: Table, guid: str, **kwargs: Any) -> None:
        super().__init__(table, guid, **kwargs)
        self.model: Any = None
        self._made_of: list[float] = []
        self._parameters = [row.name for row in table.rows if row.causality is Causality.PARAMETER]
        records = {row.member.partition(".")[0] for row in table.rows}
        self._members = {record: table.members(record, given=False) for record in records}
        self._integrals = [(row.name, *row.integral_of) for row in table.rows if row.integral_of]

    def made(self, values: SlaveValues, make: Callable[[SlaveValues, Any], Any]) -> Any:
        """Return the model with these parameters. `make` makes it from them and the old one, or None, if they have changed."""
        wanted = [values[name] for name in self._parameters]
        if self.model is None or wanted != self._made_of:
            self.model, self._made_of = make(values, self.model), wanted
        return self.model

    def copied(self, record: str, member: Callable[[str], float | list[float]]) -> Rows:
        """Return the outputs that are members of a record. `member` returns one by its name, of an array of patches a list."""
        return {row: member(name) for row, name in self._members[record].items()}

    def integrals(self, values: SlaveValues, new: Rows, step_size: float) -> Rows:
        """Return the outputs that are integrated over time, after a step [s] with the outputs `new`."""
        found: dict[str, float] = {}
        for total, rate, speed in self._integrals:
            per_second = 1.0 if speed is None else abs(values[speed])
            per_second *= 1.0 if rate is None else new[rate]  # type: ignore[operator]
            found[total] = values[total] + per_second * step_size
        return found
