"""Helpers for the entries that C calls. Arrays over raw memory come from `contact.kernels.block`."""

from __future__ import annotations

from numba import types
from numba.core.errors import TypingError
from numba.extending import intrinsic

Doubles = types.CPointer(types.float64)
#: Type of an argument or of a result, as tables of entries name it → that of numba.
TYPES = {"i64": types.int64, "f64": types.float64, "ptr": Doubles}


def _start_of(dtype):
    """Return an intrinsic that returns the pointer to the first record of an array as a pointer to `dtype`."""
    pointer = types.CPointer(dtype)

    @intrinsic
    def start(typing_context, records):
        if not (isinstance(records, types.Array) and isinstance(records.dtype, types.Record)):
            raise TypingError("an array of records is needed")

        def generate(context, builder, signature, arguments):
            array = context.make_array(signature.args[0])(context, builder, arguments[0])
            return builder.bitcast(array.data, context.get_value_type(pointer))

        return pointer(records), generate

    return start


#: Pointer to the first record of an array as float64 or int64 values, one for each member.
numbers_of, integers_of = _start_of(types.float64), _start_of(types.int64)
