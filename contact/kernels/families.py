"""Markers that choose the kernels of a workspace by their type: a process compiles only the methods that it uses.

A workspace holds one marker for the normal and one for the tangential problem. numba compiles a kernel once for each pair of
them that it meets. `AnyNormal` and `AnyTangential` compile every method and choose by `case` at run time, as an FMU does.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from contact.kernels.layout import NormalFamily, TangentialFamily


class Analyn(NamedTuple):
    """`normal.analyn`."""


class Hertzian(NamedTuple):
    """`normal.hertzian`."""


class StripHalfspace(NamedTuple):
    """`normal.strip_halfspace`."""


class ByApproach(NamedTuple):
    """`normal.by_approach`."""


class AnyNormal(NamedTuple):
    """All of these, by `case.normal_family`."""


class FaStrip(NamedTuple):
    """`tangential.fastrip`."""


class FaStripMapped(NamedTuple):
    """`tangential.fastrip_mapped`."""


class Fastsim(NamedTuple):
    """`tangential.fastsim`."""


class CreepForce(NamedTuple):
    """`tangential.creep_force`."""


class AnyTangential(NamedTuple):
    """All of these, by `case.tangential_family`."""


class Families(NamedTuple):
    """The markers of a workspace."""

    normal: Any
    tangential: Any


NORMAL = {
    NormalFamily.ANALYN: Analyn(),
    NormalFamily.HERTZ: Hertzian(),
    NormalFamily.STRIP_HALFSPACE: StripHalfspace(),
    NormalFamily.BY_APPROACH: ByApproach(),
}
TANGENTIAL = {
    TangentialFamily.FASTRIP: FaStrip(),
    TangentialFamily.FASTRIP_MAPPED: FaStripMapped(),
    TangentialFamily.FASTSIM: Fastsim(),
    TangentialFamily.CREEP_FORCE: CreepForce(),
}
ANY = Families(AnyNormal(), AnyTangential())
