"""Damage models, one a file, and what they do to a profile."""
