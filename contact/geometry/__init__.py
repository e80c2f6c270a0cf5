"""From profiles and a wheelset pose to separations and creepages: `profile` and `wheelset`."""

from contact.geometry import profile, wheelset

__all__ = ["profile", "wheelset"]
