"""Tangential contact: strips and creepages in, traction, slip and forces out. One method a file."""
