"""What an instance tells of values that no wheel on a rail has (`contact_fmu.doubts`)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from contact.arrays import Array
from contact.kernels.records import SLOWEST
from .. import doubts
from ..variables import Table


class Doubting:
    """The rules of a table that have not been told yet."""

    def __init__(self, table: Table) -> None:
        self._table = table
        self._left = list(doubts.rules(table))
        self._order()

    def _order(self) -> None:
        """Make arrays of the rules that are left: references of the numbers, what is usual of them, the rule of each."""
        each = [(rule, at) for rule in self._left for at in self._table.references(rule.rows[0])]
        self._rules = [rule for rule, _ in each]
        self._references = np.array([at for _, at in each], np.int64)
        self._least, self._largest = (
            np.array([getattr(rule.usual, name) for rule in self._rules]) for name in ("least", "largest")
        )
        #: Numbers that are slips: their places among the others, and the references of what they are made of.
        self._slips = [
            (k, *(self._table.span[name].start for name in rule.rows[1:]))
            for k, rule in enumerate(self._rules)
            if len(rule.rows) > 1
        ]

    def messages(self, values: Array) -> Iterator[str]:
        """Yield a message for each rule that the values break, once."""
        numbers = values[self._references]
        for k, other, factor in self._slips:
            moves = abs(values[other]) > SLOWEST
            numbers[k] = 1.0 + numbers[k] * values[factor] / values[other] if moves else 0.0
        size = np.abs(numbers)
        unusual = (size > self._largest) | ((size > 0.0) & (size < self._least))
        if not unusual.any():
            return
        for k in np.flatnonzero(unusual):
            scalar, rule = self._table.scalars[self._references[k]], self._rules[k]
            if rule in self._left and self._table.uses(scalar.row, values):
                self._left.remove(rule)
                yield f"{scalar.name} = {values[self._references[k]]:g}: {doubts.text(rule)}"
        self._order()
