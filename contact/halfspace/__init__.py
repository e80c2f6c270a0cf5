"""Kalker's complete theory element by element on a grid: the project's own reference (theory.md 6)."""

from contact.halfspace.gap import Gap
from contact.halfspace.norm import Normal, norm
from contact.halfspace.solution import GridSolution
from contact.halfspace.tang import Tangential, tang

__all__ = ["Gap", "GridSolution", "Normal", "Tangential", "norm", "tang"]
