"""The kinds of models of FMUs, and the functions of each that C calls.

The module of a kind has a function `entries()`. It returns Python functions by the names in `SIGNATURES`, which numba compiles.
The first argument is the array of all values, indexed by value reference. Most functions also take the working memory, which
begins with the warm start. The last argument is `component.Given`.

* ``model_memory(values, given)`` returns the size of the warm start in numbers, ``model_size(values, given)`` that of all
  working memory. Both depend only on the parameters in `values`.
* ``model_prepare(values, work, given)`` fills what depends only on the parameters.
* ``model_outputs(values, work, h, given)`` advances by h [s] from the warm start, then computes the outputs. With h = 0 it
  computes them only from the inputs in `values`.
* ``model_lazy(values, work, given)`` computes the rows `lazy` from the solution that ``model_outputs`` has left in `work`. A
  model without such rows does not need it.
* ``model_jacobian(values, work, given)`` derives the rows `derived` by the rows `derived_by` at the solution that
  ``model_outputs`` has left in `work`, which it uses up. It returns where in `work` the matrix begins, one row of it after the
  other. A column of NaN is not known here. A model without such rows does not need it.
* ``model_difference(values, reference, given)`` returns a suitable step of one variable for difference quotients.
* ``model_field(values, work, k, given)`` writes field number `k` of the last ``model_outputs`` into `work` and returns where
  it begins. A model without fields does not need it.

The functions that return neither a size, a step nor a position return 0 or the number of a message (`Component.warnings`,
`failures`). At a cold start the warm start is all zeros. In the library the names begin with the kind instead of ``model``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .component import SIGNATURES, Given

if TYPE_CHECKING:
    from contact.compile.library import Added

#: Kinds of models.
KINDS = ("contact", "pair", "surfaces", "vehicle", "open_vehicle")
#: Those that FMUs for hosts with Python have too.
OF_PYTHON = ("contact", "pair", "open_vehicle")


def names(kind: str) -> list[str]:
    """Return the names of a kind's functions in the library."""
    return [f"{kind}_{name}" for name in SIGNATURES]


def added() -> list[Added]:
    """Return what native FMUs add to the libraries of all systems (`contact.compile.library`)."""
    from . import open_vehicle, vehicle, wheel_rail_contact, wheel_rail_pair, wheel_rail_surfaces

    modules = (wheel_rail_contact, wheel_rail_pair, wheel_rail_surfaces, vehicle, open_vehicle)
    return [
        one for kind, module in zip(KINDS, modules, strict=True) for one in of_kind(kind, module.entries(), f"{kind}.c")
    ]


def of_kind(kind: str, entries: dict[str, Callable[..., Any]], file: str) -> list[Added]:
    """Return the functions of a kind, given those by the names in `SIGNATURES` that it needs."""
    from contact.compile.library import Added  # an installation packs FMUs and compiles nothing

    made: dict[str, Callable[..., Any]] = {name: entries.get(f"model_{name}") or _UNNEEDED[name] for name in SIGNATURES}
    return [
        Added(f"{kind}_{name}", made[name], result, arguments, _given, file, kind in OF_PYTHON)
        for name, (result, arguments) in SIGNATURES.items()
    ]


def _given(tables: Any) -> Any:
    """Return numba's type of `Given`."""
    from numba import types

    from contact.compile.pointers import Doubles

    return types.NamedTuple((Doubles, Doubles, tables), Given)


def _nothing(values: Any, work: Any, given: Any) -> int:
    return 0


def _no_field(values: Any, work: Any, k: Any, given: Any) -> int:
    return 0


#: What stands for functions that a kind does not need.
_UNNEEDED: dict[str, Callable[..., Any]] = {"lazy": _nothing, "jacobian": _nothing, "field": _no_field}
