"""Scenarios, runs of a wheelset with damage on its profiles, and wear over a mileage (readme.md)."""
