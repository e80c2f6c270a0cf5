"""The exception of the public API, the warnings, and the checks that raise them."""

import contextlib
import math
import operator
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextvars import ContextVar
from difflib import get_close_matches
from importlib import import_module
from types import NoneType, UnionType
from typing import Any, TypeVar

import numpy as np

Class = TypeVar("Class")


class ContactError(ValueError):
    """Invalid input. The message names the argument, its value and the allowed range.

    Examples
    --------
    >>> import contact
    >>> contact.Creepage(float("nan"))
    Traceback (most recent call last):
        ...
    contact.errors.ContactError: creepage.longitudinal = nan is outside the allowed range [-1e+06, 1e+06]
    """


class PlausibilityWarning(UserWarning):
    """Input that is allowed but hardly meant: a wrong unit, a wrong sign, a wheel beside its rail."""


class ModelWarning(UserWarning):
    """An effect that the method neglects matters here. The message names it, its size, and a method that has it."""


class ProfileWarning(PlausibilityWarning):
    """A fault of a measured profile. The message says what was seen and the option that cures it."""


#: What float() would accept: "80e3", which the caller forgot to convert, and what loses a part of itself.
_NO_NUMBERS = (str, bytes, bool, np.bool_, complex, np.complexfloating)


def real(name: str, value: object) -> float:
    """Return a real number as a float. It may be infinite or NaN.

    Raises
    ------
    ContactError
        For anything else, such as text, a truth value, a complex or a masked number.
    """
    if type(value) is float:
        return value
    if isinstance(value, np.ma.MaskedArray) and np.ma.getmaskarray(value).any():
        raise ContactError(f"{name} is masked")
    try:
        if isinstance(value, _NO_NUMBERS) or (isinstance(value, np.ndarray) and value.dtype.kind not in "iufO"):
            raise TypeError
        return float(value)  # type: ignore[arg-type]
    except OverflowError:  # Python may refuse to print it
        raise ContactError(f"{name} is an integer beyond the range of floats") from None
    except (TypeError, ValueError):
        raise ContactError(f"{name} = {value!r} is not a number") from None


def require_number(
    name: str, value: object, minimum: float = -math.inf, maximum: float = math.inf, *, open_minimum: bool = False
) -> float:
    """Return `value` as a finite float within [`minimum`, `maximum`].

    Parameters
    ----------
    name : str
        Name of the argument, for the message.
    value : object
        Value to check. Strings are refused.
    minimum, maximum : float
        Allowed range.
    open_minimum : bool
        Exclude `minimum` itself.

    Raises
    ------
    ContactError
        If the value is not a real number, not finite or outside the range.
    """
    number = value if type(value) is float else real(name, value)
    # a comparison with NaN is a trap where floating-point traps are on
    above = math.isfinite(number) and (number > minimum if open_minimum else number >= minimum)
    if not above or number > maximum:
        if minimum == -math.inf and maximum == math.inf:
            raise ContactError(f"{name} = {number:g} is not finite")
        left = "]" if open_minimum or math.isinf(minimum) else "["
        right = "[" if math.isinf(maximum) else "]"
        raise ContactError(f"{name} = {number:g} is outside the allowed range {left}{minimum:g}, {maximum:g}{right}")
    return number


def require_pair(name: str, value: object) -> tuple[float, float]:
    """Return two positive numbers from `value`, a positive number or a pair of them, or raise a ContactError."""
    both = value if isinstance(value, tuple | list) else (value, value)
    if len(both) != 2:
        raise ContactError(f"{name} = {value!r} is not a number or a pair of numbers")
    first, second = (require_number(name, one, 0.0, open_minimum=True) for one in both)
    return first, second


def doubt(name: str, value: float, limit: float, hint: str, *, least: float = 0.0) -> bool:
    """Warn of a value that is allowed, but larger than `limit` or, other than zero, smaller than `least` in magnitude.

    `hint` says what is usual, or the unit. Return whether it warned.
    """
    doubtful = abs(value) > limit or 0.0 < abs(value) < least
    if doubtful:
        warn(f"{name} = {value:g}: {hint}")
    return doubtful


_SILENT = ContextVar("silent", default=False)


@contextlib.contextmanager
def silent() -> Iterator[None]:
    """Let `warn` do nothing, in this thread."""
    before = _SILENT.set(True)
    try:
        yield
    finally:
        _SILENT.reset(before)


def warn(text: str, kind: type[UserWarning] = PlausibilityWarning) -> None:
    """Warn at the line of the user's code that called this package."""
    if _SILENT.get():
        return
    level, frame = 1, sys._getframe()
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] == "contact":
        level, frame = level + 1, frame.f_back
    warnings.warn(text, kind, stacklevel=level)


def require_integer(name: str, value: object, minimum: float = -math.inf, maximum: float = math.inf) -> int:
    """Return `value` as an int within [`minimum`, `maximum`].

    Parameters
    ----------
    name : str
        Name of the argument, for the message.
    value : object
        Value to check. Floats are refused, also 3.0.
    minimum, maximum : float
        Allowed range.

    Raises
    ------
    ContactError
        If the value is not an integer or is outside the range.
    """
    try:
        number = None if isinstance(value, bool) else operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        number = None
    if number is None or not minimum <= number <= maximum:
        left, right = "]" if math.isinf(minimum) else "[", "[" if math.isinf(maximum) else "]"
        raise ContactError(
            f"{name} = {value!r} is not an integer in the allowed range {left}{minimum:g}, {maximum:g}{right}"
        )
    return number


def require_kind(name: str, value: object, kind: type | UnionType) -> None:
    """Raise a ContactError if `value` is not of a kind: a class, or a class or None."""
    if not isinstance(value, kind):
        named = next((one for one in getattr(kind, "__args__", ()) if one is not NoneType), kind)
        raise ContactError(f"{name} = {value!r} is not a {named.__module__}.{getattr(named, '__name__', '')}")


def require_flag(name: str, value: object) -> bool:
    """Return True or False, also of numpy. A ContactError for any other value: a text like "no" counts as true in Python."""
    if type(value).__name__ not in ("bool", "bool_"):
        raise ContactError(f"{name} = {value!r} is neither True nor False")
    return bool(value)


def ratio(name: str, value: object) -> object:
    """Return the number that a text like "1/40" or "1:40" means; any other value unchanged.

    Raises
    ------
    ContactError
        For other texts.
    """
    if not isinstance(value, str):
        return value
    above, slash, below = value.replace(":", "/").partition("/")
    try:
        return float(above) / float(below) if slash else float(above)
    except (ValueError, ZeroDivisionError):
        raise ContactError(f"{name} = {value!r} is neither a number nor a ratio like 1/40") from None


def suggestion(word: object, known: Iterable[str]) -> str:
    """Return ", did you mean 'analyn'?" if one of the `known` names is close to `word`, else "". Case is ignored."""
    originals = {name.casefold(): name for name in known}
    close = get_close_matches(str(word).casefold(), originals, n=1)
    return f", did you mean {originals[close[0]]!r}?" if close else ""


def optional(module: str, what: str, extra: str) -> Any:
    """Return a module that an extra installs. Without it an ImportError says `what` needs it, and the extra's name."""
    try:
        return import_module(module)
    except ImportError as missing:
        named = module.partition(".")[0]
        raise ImportError(f"{what} {named}: pip install 'wheelrail-contact[{extra}]'") from missing


class _OnlyWithFields:
    """Descriptor of an attribute that can be read only if the record's `has_fields` is true."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __get__(self, record: Any, owner: type | None = None) -> Any:
        if record is None:
            return self
        if not record.has_fields:
            raise ContactError(
                f"there is no {self.name}: tangential = {record.tangential!r} gives forces only; contact.methods() lists "
                "the methods with fields"
            )
        if self.name not in record.__dict__:
            return record.__getattr__(self.name)
        return record.__dict__[self.name]

    def __set__(self, record: Any, value: Any) -> None:
        record.__dict__[self.name] = value


def only_with_fields(*names: str) -> Callable[[type[Class]], type[Class]]:
    """Return a class decorator: these attributes raise a ContactError if the record's `has_fields` is false."""

    def wrap(record: type[Class]) -> type[Class]:
        for name in names:
            setattr(record, name, _OnlyWithFields(name))
        return record

    return wrap
