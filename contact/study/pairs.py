"""Pairs of a normal and a tangential method, by name: `analyn+fastrip`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from contact.errors import ContactError
from contact.registry import lookup, methods

#: Strips per patch and elements per strip with which all methods are compared.
RESOLUTION = 30


class Pair(NamedTuple):
    """A normal and a tangential method."""

    normal: str
    tangential: str

    def __str__(self) -> str:
        return "+".join(self)


#: Kalker's complete theory on a grid, the reference of all errors.
REFERENCE = Pair("halfspace", "halfspace")
#: Default pairs, from those of multibody codes to those of this project.
SELECTION = (
    Pair("hertz", "fastsim"),
    Pair("kik_piotrowski", "fastsim"),
    Pair("stripes_ab", "fastsim"),
    Pair("analyn", "fastrip"),
    Pair("strip_halfspace", "fastrip_mapped"),
)


def serves(pair: Pair) -> bool:
    """Return whether `contact.solve` accepts the pair. A normal method on a grid has no strips for other methods."""
    return not lookup("normal", pair.normal).elementwise or pair == REFERENCE


def every_pair() -> tuple[Pair, ...]:
    """Return all pairs of registered methods that `contact.solve` accepts."""
    known = methods()
    both = (Pair(normal, tangential) for normal in known.normal for tangential in known.tangential)
    return tuple(pair for pair in both if serves(pair))


def pairs_of(names: str | Iterable[str | tuple[str, str]]) -> tuple[Pair, ...]:
    """Return the pairs from names like ``"analyn+fastrip"`` or ``("analyn", "fastrip")``, each once.

    ``"all"`` means all pairs.

    Raises
    ------
    ContactError
        For a name that is not a pair, an unknown method, or methods that cannot be combined.
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
            raise ContactError(f"method = {name!r} is not a normal and a tangential method, like 'analyn+fastrip'")
        pair = Pair(*(lookup(kind, part).name for kind, part in zip(("normal", "tangential"), parts, strict=True)))
        if not serves(pair):
            raise ContactError(f"methods: {pair} cannot be combined; normal halfspace needs tangential halfspace")
        found[pair] = None
    return tuple(found)
