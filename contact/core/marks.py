"""Decorators of compiled functions.

All kernels are compiled ahead of time into one library, which `contact.core` finds and calls; numba is then not imported.
With the environment variable ``CONTACT_JIT=1`` numba compiles each kernel when it is called: set it to try a changed kernel
without building the library. The library's builder sets it to ``build``.

* ``error_model="numpy"``: no exception branches. A kernel prevents a division by zero, it does not catch it.
* No ``fastmath``: results must not depend on the instruction set. FMUs are compared bit for bit.

Kernels allocate no memory, raise no exception and take no function as argument. One source therefore serves Python, C, FMUs
and browsers.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, TypeVar

_Group = TypeVar("_Group")

#: Whether numba compiles in this process: for Python ("1"), or for the library ("build").
COMPILING = os.environ.get("CONTACT_JIT") in ("1", "build")
_OPTIONS = {"error_model": "numpy", "nogil": True}
if os.environ.get("CONTACT_JIT") == "build":
    # Arrays belong to the caller. Without the code that counts references to them, a fifth less is compiled. A kernel then may
    # return arrays in a tuple, but not an array of its own making.
    _OPTIONS["_nrt"] = False


def arranging(function: Callable[..., Any]) -> Any:
    """Mark a kernel that lays arrays over memory that it is given, and returns them."""
    if not COMPILING:
        return kernel(function)
    from numba import njit

    return njit(**{**_OPTIONS, "_nrt": True})(function)


def kernel(function: Callable[..., Any]) -> Any:
    """Mark a function that other kernels call. Python calls only functions marked by `contact.core.entry`."""
    if COMPILING:
        from numba import njit

        return njit(**_OPTIONS)(function)

    @wraps(function)
    def refuse(*arguments: Any, **named: Any) -> Any:
        raise TypeError(f"{function.__module__}.{function.__qualname__} is compiled for other kernels only")

    return refuse


def group(named_tuple: type[_Group]) -> type[_Group]:
    """Mark a class of named tuples with arrays. Kernels pass its instances by address (`contact.core.groups`)."""
    if not COMPILING:
        return named_tuple
    from contact.core.groups import passed_by_address

    return passed_by_address(named_tuple)


def inlined(function: Callable[..., Any]) -> Any:
    """Mark a thin function that numba writes into each kernel that calls it."""
    if not COMPILING:
        return kernel(function)
    from numba import njit

    return njit(**_OPTIONS, inline="always")(function)


def shared(function: Callable[..., Any]) -> Any:
    """Mark a function that kernels call and that Python calls as it is."""
    if not COMPILING:
        return function
    from numba.extending import register_jitable

    return register_jitable(function)


def chosen_by(stub: Callable[..., Any], kernels: Mapping[type, Callable[..., Any]]) -> None:
    """Make compiled calls of `stub` run the kernel for the type of its first argument.

    Several calls of this function for one stub add their kernels.
    """
    if not COMPILING:
        return
    from numba.extending import overload

    functions = {kind: getattr(chosen, "py_func", chosen) for kind, chosen in kernels.items()}

    @overload(stub, jit_options=_OPTIONS, strict=False, inline="always")
    def _choose(first, *arguments):
        return functions.get(first.instance_class)
