"""Kernels as plain Python, on numbers that carry their derivative: exact tangents of the same source.

A `Dual` is x + x' e with e² = 0. Comparisons look at x alone, so a kernel takes the branches that it takes on floats. A dual
has no `__float__`: where it would lose its derivative, in an array of floats or a function of `math`, it raises a TypeError.
"""

from __future__ import annotations

import ast
import inspect
import math
import sys
from functools import cache
from types import FunctionType, ModuleType, SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from contact.core.calls import Entry


class Dual:
    """A number and its derivative."""

    __slots__ = ("d", "x")
    __array_priority__ = 1.0

    def __init__(self, x: float, d: float = 0.0) -> None:
        self.x, self.d = float(x), float(d)

    def __repr__(self) -> str:
        return f"{self.x:g} + {self.d:g}e"

    def __add__(self, o):
        return Dual(self.x + o.x, self.d + o.d) if type(o) is Dual else Dual(self.x + o, self.d)

    def __sub__(self, o):
        return Dual(self.x - o.x, self.d - o.d) if type(o) is Dual else Dual(self.x - o, self.d)

    def __rsub__(self, o):
        return Dual(o - self.x, -self.d)

    def __mul__(self, o):
        return Dual(self.x * o.x, self.x * o.d + self.d * o.x) if type(o) is Dual else Dual(self.x * o, self.d * o)

    def __truediv__(self, o):
        if type(o) is not Dual:
            return Dual(self.x / o, self.d / o)
        return Dual(self.x / o.x, (self.d - self.x / o.x * o.d) / o.x)

    def __rtruediv__(self, o):
        return Dual(o / self.x, -o / self.x / self.x * self.d if self.d != 0.0 else 0.0)

    def __pow__(self, o):
        if type(o) is Dual:
            return _exp(o * _log(self))
        return Dual(self.x**o, o * self.x ** (o - 1) * self.d if self.d != 0.0 else 0.0)

    def __rpow__(self, o):
        return _exp(self * math.log(o))

    def __abs__(self):
        return self if self.x >= 0.0 else -self

    def __neg__(self):
        return Dual(-self.x, -self.d)

    def __pos__(self):
        return self

    def __int__(self):
        return int(self.x)

    def __floor__(self):
        return math.floor(self.x)

    def __bool__(self):
        return self.x != 0.0

    def __eq__(self, o):
        return self.x == value(o)

    def __ne__(self, o):
        return self.x != value(o)

    def __lt__(self, o):
        return self.x < value(o)

    def __le__(self, o):
        return self.x <= value(o)

    def __gt__(self, o):
        return self.x > value(o)

    def __ge__(self, o):
        return self.x >= value(o)

    __radd__, __rmul__, __hash__ = __add__, __mul__, None


def value(number: Any) -> float:
    """Return the number without its derivative."""
    return number.x if type(number) is Dual else number


def slope(number: Any) -> float:
    """Return the derivative."""
    return number.d if type(number) is Dual else 0.0


def _lifted(function, derivative):
    def of(z):
        return Dual(function(z.x), derivative(z.x) * z.d if z.d != 0.0 else 0.0) if type(z) is Dual else function(z)

    return of


def _atan2(y, x):
    square = value(x) ** 2 + value(y) ** 2
    return Dual(math.atan2(value(y), value(x)), (value(x) * slope(y) - value(y) * slope(x)) / square)


def _copysign(size, sign):
    return abs(size) if math.copysign(1.0, value(sign)) > 0.0 else -abs(size)


_exp = _lifted(math.exp, math.exp)
_log = _lifted(math.log, lambda x: 1.0 / x)
MATH = SimpleNamespace(
    pi=math.pi,
    inf=math.inf,
    nan=math.nan,
    floor=math.floor,
    exp=_exp,
    log=_log,
    sqrt=_lifted(lambda x: math.sqrt(x), lambda x: 0.5 / math.sqrt(x)),
    sin=_lifted(math.sin, math.cos),
    cos=_lifted(math.cos, lambda x: -math.sin(x)),
    tan=_lifted(math.tan, lambda x: 1.0 + math.tan(x) ** 2),
    asin=_lifted(math.asin, lambda x: 1.0 / math.sqrt(1.0 - x * x)),
    acos=_lifted(math.acos, lambda x: -1.0 / math.sqrt(1.0 - x * x)),
    atan=_lifted(math.atan, lambda x: 1.0 / (1.0 + x * x)),
    asinh=_lifted(math.asinh, lambda x: 1.0 / math.sqrt(1.0 + x * x)),
    atan2=_atan2,
    copysign=_copysign,
    isfinite=lambda z: math.isfinite(value(z)),
)


class _Members:
    """Stands for a module."""


def _choices(spaces: dict[str, dict[str, Any]]) -> dict[tuple[str, str], Any]:
    """Return what stands for the stubs of `contact.core.chosen_by`: the kernel for the type of the first argument.

    The statements with that call are run again, for the plain kernels.
    """
    kernels: dict[tuple[str, str], dict[type, Any]] = {}

    def choose(stub, chosen):
        kernels.setdefault((stub.__module__, stub.__name__), {}).update(chosen)

    for name, space in spaces.items():
        lines = ast.parse(inspect.getsource(sys.modules[name])).body
        calls = [line for line in lines if isinstance(line, ast.Expr | ast.For) and "chosen_by(" in ast.unparse(line)]
        exec(compile(ast.Module(calls, []), name, "exec"), {**space, "chosen_by": choose})
    return {stub: lambda first, *rest, of=chosen: of[type(first)](first, *rest) for stub, chosen in kernels.items()}


@cache
def _plain_modules() -> dict[str, dict[str, Any]]:
    """Return the globals of all loaded modules of kernels, with functions that are not compiled and this module's `math`."""
    spaces = {name: dict(vars(module)) for name, module in sys.modules.items() if name.startswith("contact.kernels")}
    for space in spaces.values():
        for name, member in space.items():
            source = member.function if isinstance(member, Entry) else getattr(member, "__wrapped__", member)
            source = getattr(source, "py_func", source)
            if isinstance(source, FunctionType) and source.__module__ in spaces:
                space[name] = FunctionType(source.__code__, spaces[source.__module__], name, source.__defaults__)
            elif member is math:
                space[name] = MATH
            elif isinstance(member, ModuleType) and member.__name__ in spaces:
                space[name] = _Members()
                space[name].__dict__ = spaces[member.__name__]
    choices = _choices(spaces)
    for space in spaces.values():
        for member, source in space.items():
            if isinstance(source, FunctionType) and (source.__module__, source.__name__) in choices:
                space[member] = choices[source.__module__, source.__name__]
    return spaces


def plain(module: str, name: str) -> Any:
    """Return a kernel of ``contact.kernels.<module>`` as plain Python for dual numbers."""
    return _plain_modules()[f"contact.kernels.{module}"][name]


class Records(list):
    """Records that are copied into their places, as numpy does."""

    def __getitem__(self, at):
        found = super().__getitem__(at)
        return Records(found) if isinstance(at, slice) else found

    def __setitem__(self, at, record):
        vars(self[at]).update(vars(record))

    @property
    def size(self) -> int:
        return len(self)


def record(of: Any) -> SimpleNamespace:
    """Return a copy of a numpy record whose members may be dual."""
    members = of.dtype.names
    return SimpleNamespace(**{name: of[name].astype(object) if of[name].ndim else of[name].item() for name in members})


def copied(of: Any) -> Any:
    """Return a copy of an array or a group of arrays that may hold dual numbers. Tables of integers stay."""
    if isinstance(of, tuple) and hasattr(of, "_fields"):
        return type(of)(*(copied(member) for member in of))
    if not isinstance(of, np.ndarray):
        return of
    if of.dtype.names:
        return Records(record(each) for each in of)
    return of.astype(object) if of.dtype == np.float64 else of.copy()


class Forces(NamedTuple):
    """Derivatives of what a patch answers."""

    Fx: float
    Fy: float
    Mz: float
    power: float


def slopes(result: Any) -> Forces:
    """Return the derivatives in a record of results."""
    return Forces(*(slope(getattr(result, name)) for name in Forces._fields))
