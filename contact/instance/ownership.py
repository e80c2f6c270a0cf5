"""Objects that own arrays which compiled kernels write: one call at a time, and copies by what they were made of.

A call of the library releases Python's global lock. A second thread would then write the same arrays, and both results would
be wrong. So every public method that uses the arrays asks for a lock first. It does not wait: a second thread, or a callback or
signal handler inside the first call, gets a ContactError. Nothing can therefore wait for ever.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from threading import Lock
from types import MethodType
from typing import Any, Concatenate, ParamSpec, Self, TypeVar
from weakref import WeakValueDictionary

from contact.arrays import Array
from contact.errors import ContactError, silent

_Given = ParamSpec("_Given")
_Answer = TypeVar("_Answer")
#: Longest time for which a copy waits for another thread, which may be copying the same object [s].
_PATIENCE = 0.2
_Owner = TypeVar("_Owner", bound="OwnsArrays")


class OwnsArrays:
    """Base of objects with arrays that kernels write. Copies and pickles hold what an object was made of, and `_kept`."""

    _made_of: tuple[tuple[Any, ...], dict[str, Any]]
    _turn: Lock

    def __new__(cls, *given: Any, **options: Any) -> Self:
        made = super().__new__(cls)
        made._made_of, made._turn = (given, options), Lock()
        return made

    def take_turns_with(self, other: OwnsArrays | Lock) -> None:
        """Let one thread at a time use this object or the `other`, which writes the same arrays."""
        self._turn = other._turn if isinstance(other, OwnsArrays) else other

    def again(self) -> Self:
        """Return another object that is made of the same, without what this one has computed."""
        return _made(type(self), *self._made_of)

    def _kept(self) -> Any:
        """Return what a copy has from this object besides what it is made of, for its method `_keep`."""
        return None

    def _keep(self, kept: Any) -> None:
        """Take over what `_kept` of another object has returned, unless that is None."""

    def __reduce__(self) -> tuple[Any, ...]:
        if not self._turn.acquire(timeout=_PATIENCE):
            raise _in_use(self)
        try:
            return _made, (type(self), *self._made_of), self._kept()
        finally:
            self._turn.release()

    def __setstate__(self, kept: Any) -> None:
        self._keep(kept)


def _made(kind: type[_Owner], given: tuple[Any, ...], options: dict[str, Any]) -> _Owner:
    with silent():  # what is doubtful was said when the first one was made
        return kind(*given, **options)


def one_thread(
    method: Callable[Concatenate[_Owner, _Given], _Answer],
) -> Callable[Concatenate[_Owner, _Given], _Answer]:
    """Mark a method that uses the arrays of its object. Its calls raise a ContactError while another one has the arrays."""

    @wraps(method)
    def call(self: _Owner, *given: _Given.args, **options: _Given.kwargs) -> _Answer:
        # A signal between `acquire` and `try` would keep the lock for ever; `with` has no such gap. A thread that comes between
        # the question and `with` waits for this one call.
        turn = self._turn
        if turn.locked():
            raise _in_use(self)
        with turn:
            return method(self, *given, **options)

    return call


def within(method: Callable[_Given, _Answer]) -> Callable[_Given, _Answer]:
    """Return a method marked by `one_thread` for a call that has the arrays already."""
    unmarked = getattr(method, "__wrapped__", None)
    return method if unmarked is None else MethodType(unmarked, method.__self__)  # type: ignore[attr-defined]


def _in_use(one: OwnsArrays) -> ContactError:
    return ContactError(
        f"this {type(one).__name__} is in use by another thread, or by a call that has not ended: its arrays serve one call "
        "at a time. Make one for each thread, for example by copy.copy"
    )


#: Address of an array → the lock of all objects that write it.
_TURNS: WeakValueDictionary[int, Lock] = WeakValueDictionary()


def turn_of(array: Array) -> Lock:
    """Return the lock for objects that write the same array. They keep the array."""
    return _TURNS.setdefault(array.ctypes.data, Lock())
