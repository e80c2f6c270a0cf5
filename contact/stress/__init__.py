"""Stresses below the surface of a solved contact: tensor, von Mises, Tresca, principal stresses, Dang Van (subsurface.md).

The bodies are elastic half spaces under the pressure and the traction of a solution. Tension is positive.
"""

from contact.stress.fatigue import DangVan, Endurance, dang_van
from contact.stress.field import Peak, StressField
from contact.stress.half_space import at, below, largest
from contact.stress.load import SurfaceLoad

__all__ = ["DangVan", "Endurance", "Peak", "StressField", "SurfaceLoad", "at", "below", "dang_van", "largest"]
