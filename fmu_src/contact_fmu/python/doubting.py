"""What an instance tells of values that no wheel on a rail has (`contact_fmu.doubts`)."""

from __future__ import annotations

from collections.abc import Iterator

from contact.kernels.records import SLOWEST
from .. import doubts
from ..variables import Table
from .values import SlaveValues


class Doubting:
    """The rules of a table that have not been told yet."""

    def __init__(self, table: Table) -> None:
        self._left = [(rule, [table.references(row) for row in rule.rows]) for rule in doubts.rules(table)]

    def messages(self, values: SlaveValues) -> Iterator[str]:
        """Yield a message for each rule that the values break, once."""
        for one in list(self._left):
            rule, places = one
            for place in places[0]:
                if self._is_unusual(rule, place, places[1:], values) and values.uses(values.table.scalars[place].row):
                    self._left.remove(one)
                    yield f"{values.table.scalars[place].name} = {values.numbers[place]:g}: {doubts.text(rule)}"
                    break

    @staticmethod
    def _is_unusual(rule: doubts.Rule, place: int, more: list[range], values: SlaveValues) -> bool:
        x = values.numbers[place]
        if more:
            other, factor = (values.numbers[one.start] for one in more)
            x = 1.0 + x * factor / other if abs(other) > SLOWEST else 0.0
        return abs(x) > rule.usual.largest or 0.0 < abs(x) < rule.usual.least
