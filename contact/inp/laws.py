"""Friction laws of files by the digit L, and the friction of strips."""

from __future__ import annotations

from contact.friction import Friction
from contact.inp.case import Case
from contact.inp.reasons import refuse

#: Name of a law here, and what the names of its constants in the file begin with.
LAWS = {2: ("linear", "FLIN"), 3: ("rational", "FRAT"), 4: ("exponential", "FEXP")}


def of_strips(case: Case) -> Friction:
    """Return the friction of strips, which have one set of constants and one term."""
    kind = case["LAW"]
    if case["ROWS"] != 0:
        raise refuse(case, "law on strips", f"V = {case['ROWS']}")
    if kind == 0:
        return Friction(case["FSTAT"])
    if kind == 6:
        raise refuse(case, "temperature", "L = 6")
    name, prefix = LAWS[kind]
    if case[f"{prefix}2"] != 0.0 or case["MEMDST"] > 0.0:
        raise refuse(case, "law on strips", f"L = {kind} of two terms or with memory")
    kinetic = case["FKIN"]
    return Friction(kinetic + case[f"{prefix}1"], kinetic, case["SABSH1"], name, velocity="local")
