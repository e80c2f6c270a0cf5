"""The compiled core: find the library, and call its entries.

An entry is a kernel that Python calls. Its annotations are its interface: int, float, bool, an array, a record, or a group of
these. The library has one C function for each entry,

    int64_t entry(const int64_t *arguments, int64_t *results);

Numbers take one word of 8 bytes. A record is its address, a group the words of its members. The words of an array are what
numba calls an array: two that only Python needs, number of elements, bytes of an element, address, shape and strides.
`CONTACT_JIT=1` compiles the same C function with numba when it is first called.
"""

from __future__ import annotations

import ctypes
import inspect
import struct
from collections.abc import Callable
from functools import cache, cached_property, update_wrapper
from typing import Annotated, Any, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np

from contact.core.marks import COMPILING

_Pack = Callable[[Any], bytes]
#: Bytes of a word, and number of words of an array besides shape and strides.
WORD, ARRAY_WORDS = 8, 5
_INTEGER, _REAL = struct.Struct("q").pack, struct.Struct("d").pack


class Shape(NamedTuple):
    """What an annotation says of an array: type of its elements and number of dimensions; 0 for a single record."""

    dtype: Any
    ndim: int


class Packed:
    """Words of an argument that is passed many times. A copy has the words of its own copy of the arrays."""

    __slots__ = ("kind", "value", "words")

    def __init__(self, kind: Any, value: Any) -> None:
        self.kind, self.value = kind, value
        self.words = _packer(kind)(value)

    def __reduce__(self) -> tuple[Any, ...]:
        return Packed, (self.kind, self.value)


def pack(kind: Any, value: Any) -> Any:
    """Return an argument with the annotation `kind` as its words. Entries take them in place of the argument itself."""
    return Packed(kind, value)


@cache
def _packer(kind: Any) -> _Pack:
    """Return a function that packs arguments with this annotation."""
    if kind is float:
        return _REAL
    if kind in (int, bool):
        return _INTEGER
    if get_origin(kind) is Annotated:
        shape = get_args(kind)[1]
        return (
            _record_packer(np.dtype(shape.dtype))
            if shape.ndim == 0
            else _array_packer(np.dtype(shape.dtype), shape.ndim)
        )
    if get_origin(kind) is tuple:
        packers = [_packer(of) for of in get_args(kind)]
        return lambda value: b"".join([pack_one(one) for pack_one, one in zip(packers, value, strict=True)])
    members = [(name, _packer(of)) for name, of in members_of(kind)]
    return lambda value: b"".join([pack_member(getattr(value, name)) for name, pack_member in members])


def members_of(kind: Any) -> list[tuple[str, Any]]:
    """Return (name, annotation) of the members of a group. `PairArrays[Search]` is a group with a parameter."""
    group = get_origin(kind) or kind
    given = dict(zip(getattr(group, "__parameters__", ()), get_args(kind), strict=True))

    def resolved(of: Any) -> Any:
        if get_origin(of) is Annotated and not isinstance(get_args(of)[1], Shape):
            of = get_args(of)[0]  # a group, with how it is laid
        if of in given:
            return given[of]
        inner = () if get_origin(of) is Annotated else getattr(of, "__parameters__", ())
        return of[tuple(given[parameter] for parameter in inner)] if inner else of

    return [(name, resolved(of)) for name, of in get_type_hints(group, include_extras=True).items()]


def _array_packer(dtype: np.dtype, ndim: int) -> _Pack:
    to_bytes = struct.Struct(f"{ARRAY_WORDS + 2 * ndim}q").pack

    def pack_array(value: Any) -> bytes:
        if (
            not isinstance(value, np.ndarray)
            or value.ndim != ndim
            or not value.flags.c_contiguous
            or (value.dtype is not dtype and value.dtype != dtype)
        ):
            raise TypeError(
                f"a C-contiguous array of {dtype} with {ndim} dimensions is needed, not {_described(value)}"
            )
        return to_bytes(0, 0, value.size, value.itemsize, value.ctypes.data, *value.shape, *value.strides)

    return pack_array


def _record_packer(dtype: np.dtype) -> _Pack:
    def pack_record(value: Any) -> bytes:
        if not isinstance(value, np.void) or value.dtype != dtype:
            raise TypeError(f"a record {dtype} is needed, not {_described(value)}")
        return _INTEGER(np.frombuffer(value, np.uint8).ctypes.data)

    return pack_record


def _described(value: Any) -> str:
    if isinstance(value, np.ndarray):
        order = "" if value.flags.c_contiguous else ", not contiguous"
        return f"an array of {value.dtype} with shape {value.shape}{order}"
    return f"{type(value).__name__} {value!r}"


class Entry:
    """A kernel that Python calls, in the library."""

    def __init__(self, function: Callable[..., Any]) -> None:
        update_wrapper(self, function)
        self.function = function
        if COMPILING:
            from contact.core.marks import kernel

            self.dispatcher = kernel(function)

    @property
    def _numba_type_(self) -> Any:
        """To numba, which compiles kernels that call this one, an entry is the compiled function itself."""
        return self.dispatcher._numba_type_

    def __reduce__(self) -> str:
        return self.function.__qualname__

    def __repr__(self) -> str:
        return f"<kernel {self.function.__module__}.{self.function.__qualname__}>"

    @property
    def symbol(self) -> str:
        """Name of the entry in the library."""
        return f"{self.function.__module__}.{self.function.__qualname__}".replace(".", "_")

    @property
    def arguments(self) -> dict[str, Any]:
        """Name and annotation of each argument."""
        hints = get_type_hints(self.function, include_extras=True)
        return {name: hints[name] for name in inspect.signature(self.function).parameters}

    @property
    def results(self) -> tuple[type, ...]:
        """Types of what is returned: none, one, or those of a tuple."""
        kind = get_type_hints(self.function).get("return", type(None))
        if get_origin(kind) is tuple:
            return get_args(kind)
        return () if kind is type(None) else (kind,)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        if named:
            arguments = inspect.signature(self.function).bind(*arguments, **named).args
        return self.call(*arguments)

    @cached_property
    def call(self) -> Callable[..., Any]:
        """The function that packs arguments, calls the library and unpacks results, for who calls it many times."""
        packers = [_packer(kind) for kind in self.arguments.values()]
        function, kinds = _function(self), self.results
        n, name = len(packers), self.function.__qualname__
        results_type = ctypes.c_int64 * max(len(kinds), 1)
        unpack = struct.Struct("".join("d" if kind is float else "q" for kind in kinds)).unpack_from

        def call(*arguments: Any) -> Any:
            if len(arguments) != n:
                raise TypeError(f"{name} takes {n} arguments, not {len(arguments)}")
            results = results_type()
            both = zip(packers, arguments, strict=True)
            words = [one.words if type(one) is Packed else pack_one(one) for pack_one, one in both]
            function(b"".join(words), results)
            if not kinds:
                return None
            values = unpack(results)
            return values if len(kinds) > 1 else values[0]

        if bool not in kinds:
            return call

        def call_with_bool(*arguments: Any) -> Any:
            found = call(*arguments)
            if len(kinds) == 1:
                return bool(found)
            return tuple(bool(value) if kind is bool else value for kind, value in zip(kinds, found, strict=True))

        return call_with_bool


def entry(function: Callable[..., Any]) -> Entry:
    """Mark a kernel that Python calls. All its arguments and its result are annotated."""
    return Entry(function)


#: Type of the C function of an entry. Calls release Python's global lock.
_C_FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.c_void_p)


def _function(one: Entry) -> Any:
    """Return the C function of an entry."""
    if COMPILING:
        from contact.core.compiled import called_from_python

        return called_from_python(one)
    from contact.core.library import address

    return _C_FUNCTION(address(one.symbol, one.function.__module__))
