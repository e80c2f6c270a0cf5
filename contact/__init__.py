"""Wheel-rail contact: non-elliptic patch and pressure (ANALYN), traction, stick and slip (FaStrip), forces and damage.

The methods follow M. Sh. Sichani, "On Efficient Modelling of Wheel-Rail Contact in Vehicle Dynamics Simulation", KTH
2016. All quantities are in SI units. Forces act on the wheel. Start with `solve`.
"""

from typing import TYPE_CHECKING, Any

from contact.citation import cite
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


def __getattr__(name: str) -> Any:
    """Import the comparison classes on first access. A simulation does not need them."""
    if name not in ("Case", "Comparison", "compare"):
        raise AttributeError(f"module 'contact' has no attribute {name!r}")
    from contact import study

    return getattr(study, name)
