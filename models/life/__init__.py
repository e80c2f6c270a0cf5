"""Scenarios, how far a run can be trusted, and wear over a mileage (readme.md)."""
