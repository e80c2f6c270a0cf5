"""Scenarios, runs and wear over a mileage."""
