"""Kalker's complete theory on a grid of elements: the reference solution of this project (theory.md 6)."""

from contact.halfspace.gap import Gap
from contact.halfspace.local_law import LocalLaw
from contact.halfspace.norm import Normal, norm
from contact.halfspace.solution import GridSolution
from contact.halfspace.tang import Tangential, tang
from contact.halfspace.transient import Transient

__all__ = ["Gap", "GridSolution", "LocalLaw", "Normal", "Tangential", "Transient", "norm", "tang"]
