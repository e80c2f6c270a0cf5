"""The answer of the kernel of a pair as a `PairSolution`, made when it is read."""

from __future__ import annotations

from operator import itemgetter
from typing import Any

import numpy as np

from contact.inputs.creepage import Creepage
from contact.kernels.arrays import PairArrays
from contact.kernels.records import CONTACT, TOTAL
from contact.pair.solution import Contact, PairDamage, PairSolution
from contact.results import PairJacobian
from contact.results.later import STATES, reader
from contact.results.solution import RENAMED

_NAMES = tuple(RENAMED.get(name, name) for name in TOTAL.names or ())
_PLAIN = [name for name in _NAMES if name in PairSolution.__dataclass_fields__ and name not in ("status", "damage")]
_PICK = itemgetter(*(_NAMES.index(name) for name in _PLAIN))
_STATUS = _NAMES.index("status")
_DAMAGE = itemgetter(*(_NAMES.index(name) for name in PairDamage._fields))


_TOTAL, _CONTACT = reader(TOTAL), reader(CONTACT)
_KEYS = CONTACT.names or ()


class Answer:
    """Reads the records that the kernel fills in `arrays`."""

    def __init__(self, arrays: PairArrays) -> None:
        self._total, self._contacts = (each.view(np.uint8).data for each in (arrays.total, arrays.contacts))
        self._deflection = arrays.rail["dy"], arrays.rail["dz"]

    def solution(self, n: int, spin: float, jacobian: PairJacobian | None) -> PairSolution:
        """Return the solution with `n` patches. Its arrays, patches and damage are made from copies when one is first read."""
        total = _TOTAL.unpack_from(self._total)
        y, z = self._deflection
        numbers = dict(zip(_PLAIN, _PICK(total), strict=True))
        numbers |= {
            "status": STATES[total[_STATUS]],
            "deflection": (float(y[0]), float(z[0])),
            "spin": spin,
            "jacobian": jacobian,
        }
        return PairSolution.later(numbers, _made, total, bytes(self._contacts[: n * CONTACT.itemsize]))


def _made(total: tuple[Any, ...], contacts: bytes) -> dict[str, Any]:
    """Return force, moment, patches and damage."""
    return {
        "force": np.array(total[:3]),
        "moment": np.array(total[3:6]),
        "contacts": tuple(_contact(dict(zip(_KEYS, row, strict=True))) for row in _CONTACT.iter_unpack(contacts)),
        "damage": PairDamage(*_DAMAGE(total)),
    }


def _contact(found: dict[str, Any]) -> Contact:
    return Contact(
        N=found["N"],
        Fx=found["Fx"],
        Fy=found["Fy"],
        Mx=found["Mx"],
        My=found["My"],
        Mz=found["Mz"],
        position=(found["x"], found["y"], found["z"]),
        angle=found["angle"],
        area=found["area"],
        max_pressure=found["pmax"],
        creepage=Creepage(found["longitudinal"], found["lateral"], found["spin"]),
        approach=found["approach"],
        on_rail=(found["rail_y"], found["rail_z"]),
        on_wheel=(found["wheel_y"], found["wheel_z"]),
        used_friction=found["used_friction"],
        status=STATES[found["status"]],
        gap_error=found["gap_error"],
        pitch=found["pitch"],
    )
