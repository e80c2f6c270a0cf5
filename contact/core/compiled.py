"""The C function of an entry, made by numba from its annotations. Only a process that compiles imports this."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from itertools import count
from typing import Annotated, Any, get_args, get_origin

import numpy as np
from numba import carray, cfunc, njit, types
from numba.extending import intrinsic

from contact.core.calls import Entry, members_of

#: Arguments of every C function: addresses of the words of the arguments, and of the words of the results.
SIGNATURE = types.void(types.int64, types.int64)


@intrinsic
def _pointer(typing_context, address):
    """Return an address as a void pointer."""

    def generate(context, builder, signature, arguments):
        return builder.inttoptr(arguments[0], context.get_value_type(types.voidptr))

    return types.voidptr(types.int64), generate


class _Writer:
    """Expressions of a wrapper's source, and the names that they use."""

    def __init__(self) -> None:
        self.names: dict[str, Any] = {"carray": carray, "_pointer": _pointer, "int64": np.int64, "float64": np.float64}
        self._word = count()

    def expression(self, kind: Any) -> str:
        """Return the expression of the next argument, whose annotation is `kind`."""
        if kind is int:
            return f"w[{next(self._word)}]"
        if kind is bool:
            return f"(w[{next(self._word)}] != 0)"
        if kind is float:
            return f"f[{next(self._word)}]"
        if get_origin(kind) is Annotated:
            dtype, ndim = get_args(kind)[1]
            address = f"_pointer(w[{next(self._word)}])"
            shape = ", ".join(f"w[{next(self._word)}]" for _ in range(ndim)) if ndim else "1"
            array = f"carray({address}, ({shape},), {self._named(np.dtype(dtype), 'dtype')})"
            return array if ndim else f"{array}[0]"
        if get_origin(kind) is tuple:
            return f"({', '.join(map(self.expression, get_args(kind)))},)"
        members = [self.expression(of) for _, of in members_of(kind)]
        group = get_origin(kind) or kind
        return f"{self._named(group, group.__name__)}({', '.join(members)})"

    @property
    def n_words(self) -> int:
        """Number of words that the expressions so far take."""
        return next(self._word)

    def _named(self, value: Any, stem: str) -> str:
        for name, known in self.names.items():
            if known is value or (isinstance(value, np.dtype) and isinstance(known, np.dtype) and known == value):
                return name
        name = f"{stem}{len(self.names)}"
        self.names[name] = value
        return name


def wrapper(one: Entry) -> Callable[..., None]:
    """Return a function (words of arguments, words of results) for numba that calls the kernel of an entry."""
    writer = _Writer()
    given = ", ".join(writer.expression(kind) for kind in one.arguments.values())
    n = max(writer.n_words, 1)
    lines = [
        f"def {one.symbol}(a, r):",
        *(f"    {name} = carray(_pointer(a), ({n},), {kind})" for name, kind in (("w", "int64"), ("f", "float64"))),
        f"    found = kernel({given})",
        *(f"    {line}" for line in _stored(one.results)),
    ]
    names = {**writer.names, "kernel": one.dispatcher}
    exec("\n".join(lines), names)  # the names and annotations of the entry, nothing from outside
    made: Callable[..., None] = names[one.symbol]
    return made


def _stored(kinds: tuple[type, ...]) -> Iterator[str]:
    """Yield the statements that store the results."""
    if kinds:
        yield f"i = carray(_pointer(r), ({len(kinds)},), int64)"
        yield f"d = carray(_pointer(r), ({len(kinds)},), float64)"
    for k, kind in enumerate(kinds):
        value = "found" if len(kinds) == 1 else f"found[{k}]"
        yield f"d[{k}] = {value}" if kind is float else f"i[{k}] = int({value})"


def as_c_function(one: Entry) -> Any:
    """Return the C function, which numba compiles."""
    return cfunc(SIGNATURE, error_model="numpy")(wrapper(one))


def called_from_python(one: Entry) -> Callable[[bytes, Any], None]:
    """Return the same for this process, where it can raise what `NUMBA_BOUNDSCHECK` finds."""
    function = njit(SIGNATURE, error_model="numpy", nogil=True)(wrapper(one))

    def call(words: bytes, results: Any) -> None:
        function(ctypes.cast(ctypes.c_char_p(words), ctypes.c_void_p).value, ctypes.addressof(results))

    return call
