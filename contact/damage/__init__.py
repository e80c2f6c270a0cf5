"""Wear and rolling-contact fatigue of one solution (thesis chapter 6). `evaluate` computes all models.

Marks of the constants' evidence: [T] thesis, [2+] two sources agree, [1] one source seen, [R] recalled only, [X] sources
disagree.
"""

from contact.damage.archard import ArchardMap, wear_coefficient
from contact.damage.assessment import WEAR_LAWS, ArchardWear, Damage, DamageParameters, IndexField, evaluate
from contact.damage.burstow import Burstow, burstow
from contact.damage.indices import energy_index, fatigue_index, stress_index, t_gamma
from contact.damage.pearce_sherratt import PearceSherratt, pearce_sherratt
from contact.damage.shakedown import shakedown_limit
from contact.damage.usfd import Usfd, usfd

__all__ = [
    "WEAR_LAWS",
    "ArchardMap",
    "ArchardWear",
    "Burstow",
    "Damage",
    "DamageParameters",
    "IndexField",
    "PearceSherratt",
    "Usfd",
    "burstow",
    "energy_index",
    "evaluate",
    "fatigue_index",
    "pearce_sherratt",
    "shakedown_limit",
    "stress_index",
    "t_gamma",
    "usfd",
    "wear_coefficient",
]
