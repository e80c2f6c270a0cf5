"""Wear over a mileage (readme.md)."""
