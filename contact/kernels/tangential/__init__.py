"""Tangential contact: from strips and creepages to traction, slip and forces. One method per file."""
