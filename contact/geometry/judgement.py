"""What is wrong with the points of a file, and the profile that they give: findings, repair, smoothing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from contact.errors import ContactError
from contact.geometry import inspection, repair
from contact.geometry.formats import Content
from contact.geometry.inspection import REPAIRED, Fault, Finding, Points
from contact.geometry.placing import placed, require_plausible
from contact.geometry.roughness import turns
from contact.geometry.shape import Kind, Profile
from contact.geometry.smoothing import filtered, smoothed


@dataclass(frozen=True, eq=False, repr=False)
class Inspection:
    """What `check` found. Printed, it lists the findings; `contact.plot.profile_check` draws it.

    Attributes
    ----------
    name : str
    kind : {"wheel", "rail"}
    points : ndarray, shape (n, 2)
        y, z as measured, in the right-side convention, in the order of the rows [m].
    findings : tuple of contact.geometry.inspection.Finding
    profile : Profile or None
        The profile that `read` gives; None if the points are no curve.
    repaired : tuple of contact.geometry.inspection.Finding
        What `repair` has cured.
    dropped : int
        Number of points of the file that `repair` has left out.
    """

    name: str
    kind: Kind
    points: Points
    findings: tuple[Finding, ...]
    profile: Profile | None
    repaired: tuple[Finding, ...] = ()
    dropped: int = 0

    @property
    def told(self) -> list[str]:
        """What was found, and what was repaired, a line each."""
        return [*map(str, self.findings), *([self.profile.note] if self.profile and self.profile.note else [])]

    def __str__(self) -> str:
        head = f"{self.name}: {self.kind}, {len(self.points)} points"
        return "\n".join([head, *(f"  {line}" for line in self.told)] if self.told else [f"{head}, nothing found"])

    __repr__ = __str__


def inspect_profile(given: Profile) -> Inspection:
    """Return what is wrong with the points of a profile."""
    points = np.column_stack((given.y, given.z))
    findings = inspection.order(points) or [*inspection.shape(points), *inspection.place(points, given.kind)]
    return Inspection(given.name or given.kind, given.kind, points, tuple(findings), given)


def judged(
    measured: Points,
    content: Content,
    kind: Kind,
    path: Path,
    unit: float,
    zero: str | float | None,
    scale: float,
    mended: bool,
    smoothing: float | None,
    wavelength: float | None,
) -> Inspection:
    """Return what is wrong with the points of a file [m], and their profile."""
    measured, outline = repair.head_of(measured, kind, content.downwards, scale)
    if not outline and (fault := inspection.tall(measured / scale, kind)):
        raise ContactError(f"path = {str(path)!r}: {fault[0]}; {fault[1]}")
    disorder = inspection.order(measured) if not outline or len(measured) < len(content.points) else []
    if mended and not outline and any(finding.fault is Fault.UNSORTED for finding in disorder):  # of a whole rail?
        measured, outline = repair.head_of(repair.joined(measured), kind, content.downwards, scale)
    uncut = bool(outline) and len(measured) == len(content.points)
    findings = [*content.told, *outline, *disorder]
    if uncut or (disorder and not mended):
        return Inspection(path.name, kind, placed(measured, content, kind, path, zero, scale), tuple(findings), None)
    ordered = repair.repaired(measured) if disorder else measured
    points = placed(ordered, content, kind, path, zero, scale)
    curve = repair.repaired(points) if mended else points
    findings += repair.narrowed(measured, ordered) or repair.narrowed(points, curve)
    found = inspection.shape(points, content.resolution * unit, scale)
    try:
        require_plausible(curve / scale, kind, path, unit)
    except ContactError as error:
        causes = [str(finding) for finding in findings if finding.fault is Fault.NARROWED]
        raise ContactError("; ".join((str(error), *causes))) from None
    slim = inspection.narrow(curve, unit) if scale == 1.0 else []
    if slim and content.unit is not None:
        raise ContactError(f"path = {str(path)!r}: {slim[0].seen}; {slim[0].cure}")
    findings += [*found, *inspection.place(curve, kind, scale), *slim]
    named = any(finding.fault is Fault.FLANGE for finding in findings)
    if kind == "wheel" and not content.downwards and not named and not inspection.has_flange(curve / scale):
        seen = (
            "no flange shows where z points; it was taken so that the wheel rises to its field side, or to both sides"
        )
        findings.append(Finding(Fault.FLANGE, seen, "if it does not, give Profile('wheel', y, z)", curve[:0]))
    cured = REPAIRED if mended else frozenset()
    dropped = len(measured) - len(curve) if mended else 0
    repaired = tuple(finding for finding in findings if finding.fault in cured)
    if mended and disorder:  # spikes were dropped before the points were placed
        hidden = inspection.shape(repair.in_order(measured), scale=scale)
        repaired += tuple(replace(finding, at=points[:0]) for finding in hidden if finding.fault in cured)
    findings = [finding for finding in findings if finding.fault not in cured]
    notes = [_note(repaired, dropped, len(measured))]
    result = _profile(curve, kind, path.stem, smoothing, wavelength, "")
    if smoothing is not None or wavelength is not None:
        findings, rounded = _after_smoothing(findings, result, scale)
        notes.append(rounded)
    note = "; ".join(filter(None, notes))
    result = replace(result, note=note) if note else result
    return Inspection(path.name, kind, points, tuple(findings), result, repaired, dropped)


def _after_smoothing(findings: list[Finding], profile: Profile, scale: float) -> tuple[list[Finding], str]:
    """Return the findings that are left in a smoothed profile, and what became of the kinks."""
    points = np.column_stack((profile.y, profile.z))
    raw = [finding for finding in findings if finding.fault is Fault.KINK]
    left = [finding for finding in inspection.shape(points, scale=scale) if finding.fault is Fault.KINK]
    kept = [finding for finding in findings if finding.fault not in (Fault.NOISE, Fault.KINK)]
    kept += [
        replace(finding, seen=f"{finding.seen}, left after smoothing", cure="a longer one rounds more")
        for finding in left
    ]
    if not raw or left:
        return kept, ""
    largest = np.degrees(np.abs(turns(points)).max())
    return kept, f"smoothing rounded {len(raw[0].at)} kinks; the largest corner left is {largest:.1f}°"


def _note(repaired: tuple[Finding, ...], dropped: int, rows: int) -> str:
    """Return what a repair has done, for messages and captions; empty if nothing."""
    if not repaired:
        return ""
    faults = ", ".join(finding.fault.value for finding in repaired)
    return (
        f"repair dropped {dropped} of {rows} points ({faults})"
        if dropped
        else f"repair put the rows in order ({faults})"
    )


def _profile(
    points: Points, kind: Kind, name: str, smoothing: float | None, wavelength: float | None, note: str
) -> Profile:
    y, z = points.T
    angle = None
    if smoothing is not None:
        y, z, angle = smoothed(y, z, smoothing)
    elif wavelength is not None:
        y, z, angle = filtered(y, z, wavelength)
    return Profile(kind, y, z, angle, name, note)  # type: ignore[arg-type]
