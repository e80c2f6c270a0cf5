"""Profiles (`profile`), contact search with separations and creepages (`wheelset`), rigid contact points and conicity."""

from contact.geometry import profile, wheelset
from contact.geometry.en15302 import Conicity, conicity, equivalent_conicity
from contact.geometry.rigid import ContactPoints, Touches, contact_points
from contact.geometry.steering import Steering, nonlinearity, steering

__all__ = [
    "Conicity",
    "ContactPoints",
    "Steering",
    "Touches",
    "conicity",
    "contact_points",
    "equivalent_conicity",
    "nonlinearity",
    "profile",
    "steering",
    "wheelset",
]
