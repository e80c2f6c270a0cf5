"""Values that are allowed but that no wheel on a rail has, and answers that leave something out.

Both packagings say so, once for each instance and rule. The rules are those of Python (`contact.inputs.plausibility`), under
the names of the variables.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from contact.inputs.plausibility import USUAL, Usual
from contact.results import ANSWERS
from .variables import Table

#: Row → rule. A wheel carries another load than a patch.
_CONTACT = {"load.normal_force": "load"}
_PAIR = {"load.normal_force": "wheel load"}
_ROWS = {
    "load.approach": "approach",
    **{f"creepage.{name}": f"creepage.{name}" for name in ("longitudinal", "lateral", "spin")},
    "friction.coefficient": "friction",
    "speed": "speed",
    "velocity.x": "speed",
    "geometry.A": "A",
    "geometry.A0": "A",
    "wheel.radius": "wheel radius",
    "material.shear_modulus": "shear_modulus",
    "material.pressure_limit": "pressure_limit",
    **{f"pose.{name}": f"pose.{name}" for name in ("y", "roll", "yaw")},
    **{f"velocity.{name}": f"velocity.{name}" for name in ("y", "z", "roll", "yaw")},
}
#: Row of an answer → rule.
_ANSWERS = {"force.n": "N", "wheel.Q": "N", "bend": "bend", "beyond": "beyond"}
#: Rows of the slip of a wheel: 1 + first * third / second, of a wheel that moves.
_SLIP = ("velocity.spin", "velocity.x", "wheel.radius")


class Rule(NamedTuple):
    """Rows of which a number is made, the first of which may be an array, and what is usual of it.

    With one row the number is its value, with three it is the longitudinal slip.
    """

    rows: tuple[str, ...]
    usual: Usual


def rules(table: Table) -> Iterator[Rule]:
    """Yield the rules for the rows that a host gives, and those of the answer."""
    pair = "velocity.spin" in table.row
    for row, name in {**_ROWS, **(_PAIR if pair else _CONTACT)}.items():
        if row in table.row and table.row[row].is_given:
            yield Rule((row,), USUAL[name])
    if pair and table.row[_SLIP[0]].is_given:
        yield Rule(_SLIP, USUAL["slip"])
    for row, name in _ANSWERS.items():
        if row in table.row:
            yield Rule((row,), ANSWERS[name])


def text(rule: Rule) -> str:
    """Return what is said after the value."""
    return rule.usual.hint if len(rule.rows) == 1 else f"the longitudinal creepage is too large: {rule.usual.hint}"
