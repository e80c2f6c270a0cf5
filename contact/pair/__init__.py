"""One wheel on one rail, from the wheelset's motion to forces in track coordinates and damage."""

from contact.pair.solve import Contact, PairSolution, WheelRailPair

__all__ = ["Contact", "PairSolution", "WheelRailPair"]
