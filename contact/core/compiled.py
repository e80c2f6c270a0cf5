"""The C function of an entry, made by numba from its annotations. Only a process that compiles imports this.

The words of arrays and groups lie in memory as compiled functions have them (`contact.core.calls`), so an entry reads nothing
but numbers and passes addresses on.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from typing import Annotated, Any, get_args, get_origin

import numpy as np
from numba import carray, cfunc, njit, types
from numba.extending import intrinsic
from numba.np import numpy_support

from contact.core.calls import ARRAY_WORDS, WORD, Entry, members_of
from contact.core.groups import Group

#: Arguments of every C function: addresses of the words of the arguments, and of the words of the results.
SIGNATURE = types.void(types.int64, types.int64)


def numba_type(kind: Any) -> types.Type:
    """Return numba's type of an annotation."""
    if get_origin(kind) is Annotated:
        shape = get_args(kind)[1]
        element = numpy_support.from_dtype(np.dtype(shape.dtype))
        return types.Array(element, shape.ndim, "C") if shape.ndim else element
    if get_origin(kind) is tuple:
        return types.BaseTuple.from_types([numba_type(of) for of in get_args(kind)])
    if kind in (int, float, bool):
        return {int: types.int64, float: types.float64, bool: types.boolean}[kind]
    return Group(get_origin(kind) or kind, tuple(numba_type(of) for _, of in members_of(kind)))


def n_words(kind: Any) -> int:
    """Return the number of words of an argument with this annotation."""
    if get_origin(kind) is Annotated:
        ndim = get_args(kind)[1].ndim
        return ARRAY_WORDS + 2 * ndim if ndim else 1
    if get_origin(kind) is tuple:
        return sum(map(n_words, get_args(kind)))
    return 1 if kind in (int, float, bool) else sum(n_words(of) for _, of in members_of(kind))


def _reader(kind: Any, word: int) -> Callable[..., Any]:
    """Return a function for numba that takes the address of all words and returns the argument that begins at `word`."""
    numba_kind = numba_type(kind)

    @intrinsic
    def read(typing_context, address):
        def generate(context, builder, signature, arguments):
            at = builder.add(arguments[0], context.get_constant(types.int64, WORD * word))
            value = context.get_value_type(numba_kind)
            if isinstance(numba_kind, Group):
                return builder.inttoptr(at, value)
            return builder.load(builder.inttoptr(at, value.as_pointer()))

        return numba_kind(types.int64), generate

    return read


@intrinsic
def _pointer(typing_context, address):
    """Return an address as a void pointer."""

    def generate(context, builder, signature, arguments):
        return builder.inttoptr(arguments[0], context.get_value_type(types.voidptr))

    return types.voidptr(types.int64), generate


class _Writer:
    """Expressions of a wrapper's source, and the functions that they call."""

    def __init__(self) -> None:
        self.names: dict[str, Any] = {"carray": carray, "_pointer": _pointer, "int64": np.int64, "float64": np.float64}
        self._word = 0

    def expression(self, kind: Any) -> str:
        """Return the expression of the next argument, whose annotation is `kind`."""
        if get_origin(kind) is tuple:
            return f"({', '.join(map(self.expression, get_args(kind)))},)"
        name = f"read{self._word}"
        self.names[name] = _reader(int if kind is bool else kind, self._word)
        self._word += n_words(kind)
        return f"({name}(a) != 0)" if kind is bool else f"{name}(a)"


def wrapper(one: Entry) -> Callable[..., None]:
    """Return a function (words of arguments, words of results) for numba that calls the kernel of an entry."""
    writer = _Writer()
    given = ", ".join(writer.expression(kind) for kind in one.arguments.values())
    lines = [
        f"def {one.symbol}(a, r):",
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
