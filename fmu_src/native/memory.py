"""Arrays over raw memory, for entries that C calls; numba compiles it, nothing here runs as Python."""

from llvmlite import ir
from numba import carray, njit, types
from numba.core.errors import TypingError
from numba.extending import intrinsic

Doubles = types.CPointer(types.float64)

#: The policy of `contact._jit` without its cache: these functions are compiled once, by the builder.
compiled = njit(error_model="numpy")


@intrinsic
def ahead(typing_context, pointer, count):
    """Pointer to the number that lies `count` numbers behind that of `pointer`."""
    if pointer != Doubles:
        raise TypingError("ahead() takes a pointer to float64")

    def generate(context, builder, signature, arguments):
        base, offset = arguments
        return builder.gep(base, [offset], source_etype=ir.DoubleType())

    return Doubles(Doubles, types.int64), generate


@compiled
def vector(memory, at, n):
    """Vector of n numbers from `at` on, and where the next one starts."""
    return carray(ahead(memory, at), (n,)), at + n


@compiled
def matrix(memory, at, rows, columns):
    """Matrix likewise."""
    return carray(ahead(memory, at), (rows, columns)), at + rows * columns


@compiled
def cube(memory, at, layers, rows, columns):
    """Three-dimensional array likewise."""
    return carray(ahead(memory, at), (layers, rows, columns)), at + layers * rows * columns


@compiled
def next_line(at):
    """First place from `at` on at which a cache line begins, as the memory itself does."""
    return (at + 7) // 8 * 8
