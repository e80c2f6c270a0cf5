"""Kalker's complete theory element by element on a grid: the project's own reference (theory.md 6)."""

from contact.halfspace.norm import Normal, norm

__all__ = ["Normal", "norm"]
