"""The blocks of points below the surface in CONTACT's input files, declared once."""

from __future__ import annotations

from collections.abc import Callable

from contact.inp.fields import Array, Group, Now, d, i
from contact.inp.table import MM


def _kinds(*kinds: int) -> Callable[[Now], bool]:
    return lambda n: n["ISUBS"] in kinds


def _listed(name: str, count: str, factor: float, when: Callable[[Now], bool]) -> Array:
    return Array(name, lambda n: int(n[count]), lambda n: (factor,), when=when)


_MOST_POINTS = 100_000
#: A block of points below the surface after its ISUBS.
SUBSURFACE: tuple[Group | Array, ...] = (
    Group((i("IXL"), i("IXINC"), i("IXH")), _kinds(2, 6)),
    Group((i("IYL"), i("IYINC"), i("IYH")), _kinds(2, 6)),
    Group((i("NX", 1, _MOST_POINTS), i("NY", 1, _MOST_POINTS)), _kinds(3, 7)),
    _listed("IX", "NX", 1.0, _kinds(3, 7)),
    _listed("IY", "NY", 1.0, _kinds(3, 7)),
    Group((i("NZ", 1, _MOST_POINTS), d("ZL", MM), d("DZ", MM)), _kinds(1, 2, 3)),
    Group((i("NZ", 1, _MOST_POINTS),), _kinds(5, 6, 7)),
    Group(tuple(i(name, 1, _MOST_POINTS) for name in ("NX", "NY", "NZ")), _kinds(9)),
    _listed("X", "NX", MM, _kinds(9)),
    _listed("Y", "NY", MM, _kinds(9)),
    _listed("Z", "NZ", MM, _kinds(5, 6, 7, 9)),
)
SUBSURFACE_TYPES = (1, 2, 3, 5, 6, 7, 9)
