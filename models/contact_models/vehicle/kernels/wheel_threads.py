"""Kernels that share the contacts of all wheels between threads (vehicle.md, 6).

One thread, the leader, advances the vehicle as in `motion`. Before the contacts it opens the list of wheels. All threads
take the next wheel of the list until none is left. Each has scratch memory of its own, and what a wheel remembers goes with
the wheel, so no bit of a result depends on who solves it or on the number of threads.

Helpers call `serve` once and wait without a lock, because a step lasts a few tenths of a millisecond. A thread that waits for
long gives way to other processes.
"""

from __future__ import annotations

import sys
from enum import IntEnum

from contact.core import COMPILING, entry, kernel
from contact.kernels.arrays import Integers, Search
from .frames import speed_at
from .layout import Book, Model, Scratch, State
from .motion import move, prepare_contacts
from .wheel_arrays import WheelArrays
from .wheels import follow_wheel


class Counter(IntEnum):
    """Counters of the threads, each in a cache line of its own."""

    NEXT = 0  # wheel of the list; the list is closed from the number of wheels on
    SOLVED = 8
    ENDED = 16  # 1 when helpers shall return


N_LINE = 24
#: Looks at a counter before a thread gives way: about 50 µs, the time of one contact.
_PATIENCE = 5000

if COMPILING:
    from llvmlite import ir
    from numba import TypingError, types
    from numba.extending import intrinsic

    #: Symbol of the system's function by which a thread gives way to others.
    _GIVE_WAY = types.ExternalFunction("SwitchToThread" if sys.platform == "win32" else "sched_yield", types.int32())

    def _pointer(context, builder, counters, arguments):
        array = context.make_array(counters)(context, builder, arguments[0])
        return builder.gep(array.data, [arguments[1]])

    @intrinsic
    def _add(typing_context, counters, at, value):
        """Add to a counter; return what it was. Memory is ordered: what others wrote before theirs is seen after this."""
        if counters != types.Array(types.int64, 1, "C"):
            raise TypingError("counters are an array of int64")

        def generate(context, builder, signature, arguments):
            pointer = _pointer(context, builder, counters, arguments)
            return builder.atomic_rmw("add", pointer, arguments[2], "seq_cst")

        return types.int64(counters, types.int64, types.int64), generate

    @intrinsic
    def _set(typing_context, counters, at, value):
        """Set a counter; return what it was. Memory is ordered as for `_add`."""

        def generate(context, builder, signature, arguments):
            pointer = _pointer(context, builder, counters, arguments)
            return builder.atomic_rmw("xchg", pointer, arguments[2], "seq_cst")

        return types.int64(counters, types.int64, types.int64), generate

    @intrinsic
    def _look(typing_context, counters, at):
        """Return a counter as other threads have left it."""

        def generate(context, builder, signature, arguments):
            pointer = _pointer(context, builder, counters, arguments)
            return builder.load_atomic(pointer, "seq_cst", 8, typ=ir.IntType(64))

        return types.int64(counters, types.int64), generate


@kernel
def _work(wheel_arrays, scratch, counters, codes):
    """Solve wheels of the list until none is left."""
    n = scratch.wheels.size
    w = _add(counters, Counter.NEXT.value, 1)
    while w < n:
        codes[w] = follow_wheel(wheel_arrays, scratch, w)
        _add(counters, Counter.SOLVED.value, 1)
        w = _add(counters, Counter.NEXT.value, 1)


@entry
def serve(wheel_arrays: WheelArrays[Search], scratch: Scratch, counters: Integers, codes: Integers) -> None:
    """Solve wheels whenever a list is open, until the leader has ended."""
    n, looks = scratch.wheels.size, 0
    while _look(counters, Counter.ENDED.value) == 0:
        if _look(counters, Counter.NEXT.value) < n:
            _work(wheel_arrays, scratch, counters, codes)
            looks = 0
        looks += 1
        if looks > _PATIENCE:
            _GIVE_WAY()


@kernel
def _press_together(wheel_arrays, scratch, counters, codes):
    """As `solve_contacts`, with the helpers: open the list, work, and wait for the last wheel."""
    n, looks = scratch.wheels.size, 0
    _set(counters, Counter.SOLVED.value, 0)
    _set(counters, Counter.NEXT.value, 0)  # opens the list
    _work(wheel_arrays, scratch, counters, codes)
    while _look(counters, Counter.SOLVED.value) < n:
        looks += 1
        if looks > _PATIENCE:
            _GIVE_WAY()
    for w in range(n):
        if codes[w] < 0:
            return -1 - w
    return 0


@entry
def lead(
    model: Model,
    state: State,
    wheel_arrays: WheelArrays[Search],
    scratch: Scratch,
    counters: Integers,
    codes: Integers,
    h: float,
    steps: int,
) -> int:
    """As `motion.advance`, with the helpers that `serve`. They are told to return at the end."""
    failed = 0
    for _ in range(steps):
        speed = speed_at(model.track, state.books[Book.DISTANCE])
        prepare_contacts(model, state, wheel_arrays.motions, scratch, speed)
        failed = _press_together(wheel_arrays, scratch, counters, codes)
        if failed < 0:
            break
        move(model, state, wheel_arrays.motions, scratch, h, speed)
    _set(counters, Counter.ENDED.value, 1)
    return failed
