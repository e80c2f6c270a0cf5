"""From a run to a life: scenarios, runs of a wheelset with damage on its profiles, wear over a mileage (readme.md)."""
