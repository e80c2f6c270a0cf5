"""Arrays laid in one block of memory: a numpy array in Python, a pointer to float64 in compiled code.

Every function lays an array from the float64 with index `end` on and returns it with the new end. In compiled code nothing
is read or written. So one list of arrays (`contact.kernels.memory`) allocates a Python workspace and places the arrays in
the memory of an FMU instance.
"""

from __future__ import annotations

from typing import Any

from contact.core import COMPILING, shared
from contact.kernels.arrays import Array

#: Number of float64 in a cache line. Vectors that extend over two lines cost a sixth of the time of the march.
_LINE = 8


def ahead(block: Array, count: int) -> Array:
    """Return the block without its first `count` float64; in compiled code the pointer advanced by as many."""
    return block[count:]


def vector(block: Array, end: int, n: int) -> tuple[Array, int]:
    """Return a vector of `n` float64, laid in `block`, and the new end."""
    return block[end : end + n], end + n


def matrix(block: Array, end: int, rows: int, columns: int) -> tuple[Array, int]:
    """Return a matrix of float64, laid in `block`, and the new end."""
    return block[end : end + rows * columns].reshape(rows, columns), end + rows * columns


def cube(block: Array, end: int, layers: int, rows: int, columns: int) -> tuple[Array, int]:
    """Return a three-dimensional array of float64, laid in `block`, and the new end."""
    size = layers * rows * columns
    return block[end : end + size].reshape(layers, rows, columns), end + size


def part(pool: Array, at: int, layers: int, rows: int, columns: int) -> Array:
    """Return a three-dimensional view of the float64 of `pool` from the index `at` on."""
    return pool[at : at + layers * rows * columns].reshape(layers, rows, columns)


def records(block: Array, end: int, n: int, dtype: Any) -> tuple[Array, int]:
    """Return `n` records, laid in `block`, and the new end."""
    size = n * (dtype.itemsize // 8)
    return block[end : end + size].view(dtype), end + size


@shared
def next_line(end: int) -> int:
    """Return the first index from `end` on at which a cache line begins. The block itself begins at one."""
    return (end + _LINE - 1) // _LINE * _LINE


if COMPILING:
    from llvmlite import ir
    from numba import TypingError, carray, types
    from numba.extending import intrinsic, overload

    @intrinsic
    def _advanced(typing_context, pointer, count):
        """Return the pointer advanced by `count` float64 values."""
        if pointer != types.CPointer(types.float64):
            raise TypingError("a block in compiled code is a pointer to float64")

        def generate(context, builder, signature, arguments):
            base, offset = arguments
            return builder.gep(base, [offset], source_etype=ir.DoubleType())

        return pointer(pointer, types.int64), generate

    @overload(ahead)
    def _ahead(block, count):
        return lambda block, count: _advanced(block, count)

    @intrinsic
    def _untyped(typing_context, pointer):
        """Return the pointer as a void pointer, which `carray` requires for records."""

        def generate(context, builder, signature, arguments):
            return builder.bitcast(arguments[0], context.get_value_type(types.voidptr))

        return types.voidptr(pointer), generate

    @intrinsic
    def _pointer_to(typing_context, array):
        """Return the pointer to the first float64 of an array."""
        pointer = types.CPointer(types.float64)

        def generate(context, builder, signature, arguments):
            return context.make_array(signature.args[0])(context, builder, arguments[0]).data

        return pointer(array), generate

    @overload(part)
    def _part(pool, at, layers, rows, columns):
        return lambda pool, at, layers, rows, columns: carray(ahead(_pointer_to(pool), at), (layers, rows, columns))

    @overload(vector)
    def _vector(block, end, n):
        return lambda block, end, n: (carray(ahead(block, end), (n,)), end + n)

    @overload(matrix)
    def _matrix(block, end, rows, columns):
        return lambda block, end, rows, columns: (carray(ahead(block, end), (rows, columns)), end + rows * columns)

    @overload(cube)
    def _cube(block, end, layers, rows, columns):
        def lay(block, end, layers, rows, columns):
            return carray(ahead(block, end), (layers, rows, columns)), end + layers * rows * columns

        return lay

    @overload(records)
    def _records(block, end, n, dtype):
        words = dtype.dtype.size // 8
        return lambda block, end, n, dtype: (carray(_untyped(ahead(block, end)), (n,), dtype), end + n * words)
