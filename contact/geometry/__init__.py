"""From profiles and a wheelset pose to separations and creepages: `profile` and `wheelset`; rigid contact points, conicity."""

from contact.geometry import profile, wheelset
from contact.geometry.en15302 import conicity, equivalent_conicity
from contact.geometry.rigid import contact_points

__all__ = ["conicity", "contact_points", "equivalent_conicity", "profile", "wheelset"]
