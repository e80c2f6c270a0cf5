"""Arrays laid in one block of memory: a numpy array in Python, a pointer to float64 in compiled code.

Every function lays an array from the float64 with index `end` on and returns it with the new end. In compiled code nothing
is read or written. So one list of arrays (`contact.kernels.memory`) allocates a Python workspace and places the arrays in
the memory of an FMU instance.
"""

from __future__ import annotations

from typing import Any, get_args, get_type_hints

import numpy as np

from contact.core import COMPILING, shared
from contact.kernels import records as of_records
from contact.kernels import rows
from contact.kernels.arrays import ON_LINE, Array

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


#: What the shapes of arrays may name, and what lays them by their number of dimensions.
_NAMES = {**vars(rows), **vars(of_records)}
_ARRAYS = {1: vector, 2: matrix, 3: cube}
_LAYOUTS: dict[Any, Any] = {}


def layout(
    kind: Any, parameters: str, names: dict[str, Any], *, of: str = "", new: tuple[str, ...] = (), **shapes: str
) -> Any:
    """Return the function ``lay(block, end, …)``, which lays a group of arrays as the annotations of its members say.

    Parameters
    ----------
    kind : type
        A named tuple as those of `contact.kernels.arrays`.
    parameters : str
        Names of what the shapes depend on. A member with such a name is what the caller gives.
    names : dict
        What other names in the shapes mean, besides those of `rows` and `records`.
    of, new : str, tuple of str
        Parameter with a group of the same kind, which has all members but the `new` ones and the parameters.
    **shapes : str
        Member → shape in place of that in its annotation.
    """
    known, given = {**_NAMES, **names, "next_line": next_line, "made": kind}, parameters.split(", ")
    lines, values = [], []
    for name, hint in get_type_hints(kind, include_extras=True).items():
        values.append(f"{of}.{name}" if of and name not in (*new, *given) else name)
        if name in given or values[-1] != name:
            continue
        its, *about = get_args(hint)
        begin = "next_line(end)" if ON_LINE in about else "end"
        if its in _LAYOUTS:
            known[f"lay_{name}"], size = _LAYOUTS[its], about[0]
        else:
            array = about[0]
            known[f"lay_{name}"], size = _ARRAYS[array.ndim], shapes.get(name) or about[1]
            if array.dtype is not np.float64:
                known[f"lay_{name}"], known[f"of_{name}"], size = records, array.dtype, f"{size}, of_{name}"
        lines.append(f"    {name}, end = lay_{name}(block, {begin}, {size})\n")
    source = f"def lay(block, end, {parameters}):\n{''.join(lines)}    return made({', '.join(values)}), end\n"
    exec(compile(source, f"<layout of {kind.__name__}>", "exec"), known)
    if not of:
        _LAYOUTS[kind] = known["lay"]
    return shared(known["lay"])


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
