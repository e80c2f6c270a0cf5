"""Stresses below the surface, and the load on a grid from which they follow."""
