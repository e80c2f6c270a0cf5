"""Pairs of a normal and a tangential method, by name: `analyn+fastrip`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from contact.errors import ContactError
from contact.registry import lookup, methods


class Pair(NamedTuple):
    """A normal and a tangential method."""

    normal: str
    tangential: str

    def __str__(self) -> str:
        return "+".join(self)


#: Kalker's complete theory on a grid: what all others are measured against.
REFERENCE = Pair("halfspace", "halfspace")
#: From what multibody codes do to what this project offers.
SELECTION = (
    Pair("hertz", "fastsim"),
    Pair("kik_piotrowski", "fastsim"),
    Pair("stripes_ab", "fastsim"),
    Pair("analyn", "fastrip"),
    Pair("strip_halfspace", "fastrip_mapped"),
)


def serves(pair: Pair) -> bool:
    """Whether `contact.solve` takes the pair: a normal method on a grid leaves no strips to the others."""
    return not lookup("normal", pair.normal).elementwise or pair == REFERENCE


def every_pair() -> tuple[Pair, ...]:
    """Every registered normal with every registered tangential method that serves it."""
    known = methods()
    both = (Pair(normal, tangential) for normal in known.normal for tangential in known.tangential)
    return tuple(pair for pair in both if serves(pair))


def pairs_of(names: str | Iterable[str | tuple[str, str]]) -> tuple[Pair, ...]:
    """Pairs from ``"analyn+fastrip"`` or ``("analyn", "fastrip")``, each once; ``"all"`` stands for all of them.

    Raises
    ------
    ContactError
        For what is no pair, an unknown method, or methods that do not go together.
    """
    if isinstance(names, str):
        names = [names]
    found: dict[Pair, None] = {}
    for name in names:
        if name == "all":
            found |= dict.fromkeys(every_pair())
            continue
        parts = tuple(name.split("+")) if isinstance(name, str) else tuple(name)
        if len(parts) != 2:
            raise ContactError(f"methods: {name!r} is not a normal and a tangential method, like 'analyn+fastrip'")
        pair = Pair(*(lookup(kind, part).name for kind, part in zip(("normal", "tangential"), parts, strict=True)))
        if not serves(pair):
            raise ContactError(f"methods: {pair} does not go together; with normal halfspace tangential is halfspace")
        found[pair] = None
    return tuple(found)
