"""Wheel-rail contact: non-elliptic patch and pressure (ANALYN), traction, stick and slip (FaStrip), forces and damage.

The methods follow M. Sh. Sichani, "On Efficient Modelling of Wheel-Rail Contact in Vehicle Dynamics Simulation", KTH
2016. All quantities are in SI units. Forces act on the wheel. Start with `solve`.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from contact.core.library import get_include, get_library
from contact.errors import ContactError
from contact.forces import forces
from contact.halfspace.third_body import ThirdBody
from contact.halfspace.transient import Transient
from contact.inputs.creepage import Creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.separation import Separation
from contact.registry import Method, Methods, methods
from contact.results import Forces, Solution, Status, Strips
from contact.solve import solve
from contact.solver import THESIS, Solver
from contact.theory.hertz import HertzContact, hertz
from contact.version import __version__ as __version__
from contact.version import cite
from contact.view.notebook import draw_with

if TYPE_CHECKING:
    from contact.study.case import Case
    from contact.study.compare import compare
    from contact.study.comparison import Comparison

__all__ = [
    "STEEL",
    "THESIS",
    "Case",
    "Comparison",
    "ContactError",
    "Creepage",
    "Forces",
    "HertzContact",
    "Material",
    "Method",
    "Methods",
    "Separation",
    "Solution",
    "Solver",
    "Status",
    "Strips",
    "ThirdBody",
    "Transient",
    "cite",
    "compare",
    "forces",
    "get_include",
    "get_library",
    "hertz",
    "methods",
    "solve",
]


def _figures() -> Any:
    from contact import plot

    return plot


draw_with(_figures)


#: Packages that load when they are first used, and those whose classes are looked for here.
_PACKAGES = ("accumulation", "geometry", "inp", "pair", "plot", "stress", "study")
_WITH_CLASSES = ("pair", "geometry.profile", "geometry.wheelset", "geometry.surfaces", "damage", "friction")


def __getattr__(name: str) -> Any:
    """Import packages and the comparison classes on first access. A simulation does not need them."""
    if name in _PACKAGES:
        return import_module(f"contact.{name}")
    if name in ("Case", "Comparison", "compare"):
        return getattr(import_module("contact.study"), name)
    hint = ""
    if name[:1].isupper():
        places = (f"contact.{package}" for package in _WITH_CLASSES)
        hint = next((f"; it is {place}.{name}" for place in places if hasattr(import_module(place), name)), "")
    raise AttributeError(f"module 'contact' has no attribute {name!r}{hint}")
