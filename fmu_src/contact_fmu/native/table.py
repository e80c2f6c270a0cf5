"""Write resources/model.bin of a native FMU: its variables, totals, messages and numbers, which c/table.c reads.

The file is little-endian: 8 magic bytes, a checksum of what follows (FNV-1a, 64 bits), then the structs of c/instance.h, whose
members all have 8 bytes. A text is its place among the texts, which come last.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator

from .. import doubts
from ..resources import checksum
from ..variables import Causality, Scalar, Table, Variable
from .component import Component

MAGIC = b"WRMODEL1"
NAME = "model.bin"
_KINDS = {"Real": 1, "Integer": 2, "Enumeration": 4, "Boolean": 8, "Count": 16}
_PARAMETER, _INPUT, _OUTPUT, _TOTAL, _FIELD, _TIME, _ACCUMULATED, _TUNABLE = 1, 2, 4, 16, 32, 64, 128, 256
_WARNING, _DISCARD = 1, 2
_NONE = -1
_MOST_USES = 2


def content(component: Component, guid: str) -> bytes:
    """Return the file."""
    return _Writer(component).content(guid)


class _Writer:
    def __init__(self, component: Component) -> None:
        self.component, self.table = component, component.table
        self.texts: dict[str, int] = {"": 0}
        self.end = 1

    def text(self, text: str) -> int:
        """Return the place of a text."""
        if text not in self.texts:
            self.texts[text] = self.end
            self.end += len(text.encode()) + 1
        return self.texts[text]

    def content(self, guid: str) -> bytes:
        table, component = self.table, self.component
        parameters = _leading_parameters(table)
        accumulated = _accumulated(component)
        given = [row for row in table.twins if row.is_given]
        shown = [row for row in table.twins if not row.is_given]
        messages = [(_WARNING, i, text) for i, text in component.warnings.items()]
        messages += [(_DISCARD, i, text) for i, text in component.failures.items()]
        by_number = {int(i): (category, *self.message(text)) for category, i, text in messages}
        last = max([0, *by_number])
        doubted = [self.doubt(rule) for rule in doubts.rules(table)]
        parts = [
            *self.variables(),
            *(struct.pack("<qqq", *by_number.get(i, (0, 0, _NONE))) for i in range(last + 1)),
            *(
                struct.pack("<qqq", self.at(total), *(_NONE if row is None else self.at(row) for row in rates))
                for total, rates in component.totals.items()
            ),
            *(struct.pack("<qq", self.at(row.name), self.at(row.twin_of)) for row in (*given, *shown)),
            *(struct.pack("<q8sqq", self.text(r.name), r.magic, r.rows, r.most) for r in component.resources),
            *(struct.pack("<q", self.at(row)) for row in (*component.derived, *component.derived_by)),
            *doubted,
            component.own.astype("<i8").tobytes(),
        ]
        names = (self.text(guid), self.text(table.name), self.text(component.kind))
        texts = b"".join(text.encode() + b"\0" for text in self.texts)
        texts += bytes(-len(texts) % 8)
        counts = (
            len(table.scalars) - accumulated, accumulated, len(table.fields), parameters, last,
            len(component.totals), len(given), len(shown), len(component.resources),
            len(component.derived), len(component.derived_by), len(doubted),
        )  # fmt: skip
        accumulates = self.at(component.accumulates) if accumulated else _NONE
        head = (*names, *counts, accumulates, *self.field(), component.own.size, len(texts))
        body = struct.pack(f"<{len(head)}q", *head) + b"".join(parts) + texts
        body = struct.pack("<Q", len(body) + 8) + body
        return MAGIC + struct.pack("<Q", checksum(body)) + body

    def message(self, text: str) -> tuple[int, int]:
        """Return the text of a message, and the value with whose name it begins."""
        name, _, rest = text.partition(": ")
        return (self.text(rest), self.at(name)) if name in self.table.row else (self.text(text), _NONE)

    def doubt(self, rule: doubts.Rule) -> bytes:
        first, *rest = (self.at(row) for row in rule.rows)
        other, factor = rest or (_NONE, _NONE)
        usual, n = rule.usual, self.table.row[rule.rows[0]].size
        return struct.pack("<4q2dq", first, n, other, factor, usual.least, usual.largest, self.text(doubts.text(rule)))

    def at(self, row: str) -> int:
        return self.table.span[row].start

    def variables(self) -> Iterator[bytes]:
        for row in self.table.rows:
            for i, scalar in enumerate(row.scalars()):
                yield self.variable(scalar, row.size if i == 0 else 0)
        fields = ((row.name, _KINDS[row.kind], _FIELD, 0) for row in self.table.fields)
        for name, *numbers in (*fields, ("time", _KINDS["Real"], _TIME, 1)):
            yield struct.pack("<6q3d4q", self.text(name), *numbers, 0, 0, *(0.0,) * 3, *(0,) * 4)

    def variable(self, scalar: Scalar, size: int) -> bytes:
        row = scalar.row
        kind = "Count" if row.name in self.table.structural else row.kind
        uses = [0] * (2 * _MOST_USES)
        for k, (name, items) in enumerate(row.used.items()):
            enumeration = self.table.row[name].enumeration
            assert enumeration is not None
            uses[2 * k : 2 * k + 2] = self.at(name), sum(1 << enumeration.number(item) for item in items)
        flags = (row.name in self.component.lazy, row.open_minimum)
        numbers = (float(scalar.first), float(scalar.minimum), float(scalar.maximum))
        return struct.pack(
            "<6q3d4q", self.text(scalar.name), _KINDS[kind], self.role(row), size, *flags, *numbers, *uses
        )

    def role(self, row: Variable) -> int:
        if row.name in self.component.accumulated:
            return _ACCUMULATED
        if row.name in self.component.totals:
            return _TOTAL
        roles = {Causality.PARAMETER: _PARAMETER, Causality.INPUT: _INPUT}
        return roles.get(row.causality, _OUTPUT) | (_TUNABLE if row.tunable else 0)

    def field(self) -> tuple[int, int, int]:
        """Return the size of a field: a number, and value references of two parameters by which it is multiplied."""
        factor, by = 1 if self.table.fields else 0, []
        for n in self.table.fields[0].shape if self.table.fields else ():
            if isinstance(n, int):
                factor *= n
            else:
                by.append(self.at(n))
        first, second = [*by, _NONE, _NONE][:2]
        return factor, first, second


def _leading_parameters(table: Table) -> int:
    """Return the number of parameters."""
    n = sum(s.row.causality is Causality.PARAMETER for s in table.scalars)
    if any(s.row.causality is not Causality.PARAMETER for s in table.scalars[:n]):
        raise ValueError(
            f"{table.name}: the parameters must come first, because the wrapper compares them as one block"
        )
    return n


def _accumulated(component: Component) -> int:
    """Return how many numbers accumulate."""
    rows, names = component.table.rows, component.accumulated
    if tuple(row.name for row in rows)[len(rows) - len(names) :] != names:
        raise ValueError(
            f"{component.table.name}: the rows that accumulate must come last, because they are not part of the values"
        )
    return sum(component.table.row[name].size for name in names)
