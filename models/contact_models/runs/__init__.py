"""A run: a scenario of a vehicle on a track, its result and its report."""
