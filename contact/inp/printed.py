"""Read the results that CONTACT prints (`.out`, `.ref_out`), in its own names, units and signs."""

from __future__ import annotations

import math
import os
import re
from dataclasses import dataclass, field

from contact.errors import ContactError
from contact.inp.words import LARGEST_FILE
from contact.reading.text import lines_of

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+|[+-]\d{2,3})?|\*{3,}|NaN|[+-]?Infinity")
_CASE = re.compile(
    r"^ Case\s+(\d+)(?: for (?:w/r contact|contact problem\s+(\d+)) on result element\s+(\d+))?(?:, result element\s+(\d+))?"
)
_STRESS = re.compile(r"^\s*(?:ABSMAX|MAX|MIN)\s+(SIG\w+)\s*=\s*(\S+)\s+AT \(X,Y,Z\) = \((.*)\)")
#: Names under which CONTACT prints the same quantity.
_SAME = {
    "FS": "FY",
    "MN": "MZ",
    "BAR_FN": "FN",
    "BAR_FX": "FX",
    "BAR_FS": "FY",
    "FRIC.WORK": "FRIC.POWER",
    "CREEP X": "CKSI",
    "CREEP Y": "CETA",
    "SHIFT X": "CKSI",
    "SHIFT Y": "CETA",
    "MAX(T1)": "MAX(T1,T2)",
}


@dataclass
class PrintedPatch:
    """Numbers of one patch by CONTACT's names: FN, FX, FY, MZ [N, N mm], APPROACH [mm], PMAX [MPa], …"""

    number: int
    values: dict[str, float] = field(default_factory=dict)
    stresses: list[dict[str, tuple[float, ...]]] = field(default_factory=list)


@dataclass
class Printed:
    """What CONTACT printed of one case: the numbers of the whole, and the patches.

    `printed` is False if the case has no result in the file (O = 0).
    """

    number: int
    element: int
    line: int
    values: dict[str, float] = field(default_factory=dict)
    patches: list[PrintedPatch] = field(default_factory=list)
    no_contact: bool = False

    @property
    def printed(self) -> bool:
        """Whether there are results."""
        return bool(self.patches or self.values or self.no_contact)


def _number(word: str) -> float:
    if word.startswith("*") or word in ("NaN", "Infinity", "+Infinity", "-Infinity"):
        return math.nan
    match = re.fullmatch(r"([+-]?[\d.]+)([+-]\d{2,3})", word)
    return float(f"{match[1]}e{match[2]}" if match else word.replace("D", "E").replace("d", "e"))


def _numbers(line: str) -> list[float]:
    return [_number(word) for word in _NUMBER.findall(line)]


def read_printed(path: str | os.PathLike[str]) -> list[Printed]:
    """Read a file of results that CONTACT printed.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    list of Printed
        One for each case, in the order of the file; in CONTACT's units and signs.

    Raises
    ------
    ContactError
        If the file cannot be read or has no case.
    """
    lines = lines_of(path, "path", LARGEST_FILE)
    cases: list[Printed] = []
    for k, line in enumerate(lines):
        match = _CASE.match(line)
        if match:
            cases.append(Printed(int(match[1]), int(match[3] or match[4] or 0), k + 1))
        elif cases:
            _take(cases[-1], line, [each.rstrip("\r") for each in lines[k + 1 : k + 7]])
    if not cases:
        raise ContactError(f"{path} has no line with a case; allowed: what CONTACT prints (.out)")
    return cases


def _take(case: Printed, line: str, ahead: list[str]) -> None:
    """Take the numbers that follow a heading."""
    ahead = ahead + [""] * 6
    if "WHEEL-SET POSITION AND VELOCITY" in line:
        names = ("S_WS", "Y_WS", "Z_WS", "ROLL", "YAW", "PITCH")
        case.values.update(zip(names, _numbers(ahead[1]), strict=False))
        case.values.update(zip(("VS", "VY", "VZ", "VROLL", "VYAW", "VPITCH"), _numbers(ahead[4]), strict=False))
    elif "MASSLESS RAIL DEFLECTION" in line or re.match(r"^\s+(FX|MX@R|MX)\(TR\)", line):
        head, numbers = (ahead[0], ahead[1]) if "MASSLESS" in line else (line, ahead[0])
        case.values.update(zip(head.split(), _numbers(numbers), strict=False))
    elif "NO CONTACT FOUND" in line:
        case.no_contact = True
    elif "DATA FOR CONTACT PATCH" in line:
        case.patches.append(PrintedPatch(int(_numbers(line)[0])))
    elif "KINEMATIC CONSTANTS" in line or "ELAST.EN." in line:
        if not case.patches:
            case.patches.append(PrintedPatch(1))
        _kinematic(case.patches[-1], line, ahead)
    elif case.patches:
        _patch(case.patches[-1], line, ahead)


def _kinematic(patch: PrintedPatch, line: str, ahead: list[str]) -> None:
    values = patch.values
    if "KINEMATIC" in line:
        head = re.sub(r"(F[XYS])(?:/FSTAT)?/FN", r"\1REL", ahead[0]).split()
        values.update(zip(head, _numbers(ahead[1]), strict=False))
        return
    for name, value in zip(line.split(), _numbers(ahead[0]), strict=False):
        values[_SAME.get(name, name)] = value
    head = re.findall(r"(?:CREEP|SHIFT) [XY]|\S+", ahead[1])
    for name, value in zip(head, _numbers(ahead[2]), strict=False):
        values[_SAME.get(name, re.sub(r"(F[XYS])(?:/FSTAT)?/FN", r"\1REL", name))] = value


def _patch(patch: PrintedPatch, line: str, ahead: list[str]) -> None:
    if "CONTACT REFERENCE LOCATION" in line:
        for k in (0, 3):
            patch.values.update(zip(ahead[k].split(), _numbers(ahead[k + 1]), strict=False))
    elif line.split()[:3] == ["NPOT", "NCON", "NADH"]:
        patch.values.update(zip(line.split(), _numbers(ahead[0]), strict=False))
    elif "SUBSURFACE STRESSES BLOCK" in line:
        patch.stresses.append({})
    elif (match := _STRESS.match(line)) is not None:
        if not patch.stresses:
            patch.stresses.append({})
        patch.stresses[-1][match[1]] = (_number(match[2]), *_numbers(match[3]))
