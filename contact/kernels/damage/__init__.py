"""Damage models, one per file, and the accumulation of damage on a profile."""
