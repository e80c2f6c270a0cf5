"""Damage models, and the accumulation of damage on a profile."""
