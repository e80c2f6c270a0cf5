"""Compiled code of a vehicle."""
