"""Markers whose type chooses the kernels of a workspace. A process compiles only the methods that it uses.

A workspace holds one marker for the normal and one for the tangential problem. numba compiles a kernel once for each
pair of markers that it is called with. `AnyNormal` and `AnyTangential` compile every method and choose by `case` at run
time, as FMUs do.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from contact.kernels.enumerations import NormalFamily, TangentialFamily


class Analyn(NamedTuple):
    """Marker of the kernel `normal.analyn`."""


class Hertzian(NamedTuple):
    """Marker of the kernel `normal.hertzian`."""


class StripHalfspace(NamedTuple):
    """Marker of the kernel `normal.strip_halfspace`."""


class ByApproach(NamedTuple):
    """Marker of the kernel `normal.by_approach`."""


class AnyNormal(NamedTuple):
    """Marker of all normal kernels. `case.normal_family` chooses one of them."""


class FaStrip(NamedTuple):
    """Marker of the kernel `tangential.fastrip`."""


class FaStripMapped(NamedTuple):
    """Marker of the kernel `tangential.fastrip_mapped`."""


class Fastsim(NamedTuple):
    """Marker of the kernel `tangential.fastsim`."""


class CreepForce(NamedTuple):
    """Marker of the kernel `tangential.creep_force`."""


class AnyTangential(NamedTuple):
    """Marker of all tangential kernels. `case.tangential_family` chooses one of them."""


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
