"""Write the files of elements that CONTACT's plotting reads (`.mat`, text), after the format of CONTACT 25.1."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from contact.errors import ContactError
from contact.inp.case import Case
from contact.inp.results import PatchResult, Result

#: Version of the format.
_VERSION = 2410.0
_COLUMNS = 11


def write_elements(results: Sequence[Result], folder: str | os.PathLike[str]) -> list[Path]:
    """Write a file for each patch whose elements are known: `NAME.0001.mat`, for wheels on rails `NAME.0001a.mat`.

    Units and signs are CONTACT's: mm, N/mm², tractions on the rail.

    Parameters
    ----------
    results : sequence of Result
        Of `contact.inp.solve(…, fields=True)`.
    folder : path-like

    Raises
    ------
    ContactError
        If the folder is missing.
    """
    place = Path(folder)
    if not place.is_dir():
        raise ContactError(f"{place} is not a folder")
    written = []
    for result in results:
        case = result.case
        for k, patch in enumerate(result.patches):
            if not patch.fields:
                continue
            element = f"_re{case.element:03d}" if case.element else ""
            letter = "abcdefghij"[k] if case.module == 1 else ""
            path = place / f"{case.file.stem}{element}.{case.number:04d}{letter}.mat"
            path.write_text("\n".join(_lines(result, patch, k)) + "\n")
            written.append(path)
    return written


def _lines(result: Result, patch: PatchResult, k: int) -> list[str]:
    case, f, v = result.case, patch.fields, patch.values
    width = _COLUMNS + (3 if case.digits["M"] == 4 else 0)
    x, y = 1e3 * f["x"], 1e3 * f["y"]
    dx, dy = _step(x), _step(y)
    at = {name: 1e3 * v.get(name, 0.0) for name in ("XCP(TR)", "YCP(TR)", "ZCP(TR)", "YCP(W)")}
    station, pitch = 1e3 * case.get("S_WS", 0.0), case.get("PITCH", 0.0)
    rows: list[tuple[str, list[float]]] = [
        ("TIM, S_WS, TH_WS, Y_R, Z_R, ROLL_R, RNOM_ROL, FMT", [0.0, station, pitch, 0, 0, 0, 0]),
        ("X_W, Y_W, Z_W, ROLL_W, YAW_W, RNOM_WHL", [0, 0, 0, 0, 0, 1e3 * case.get("NOMRADW", 0.0)]),
        (
            "X_CP(R), Y_CP(R), Z_CP(R), DELT_CP(R), X_CP(W), Y_CP(W), Z_CP(W), NPATCH, IPATCH, SPINXO, SPINYO",
            [
                *(at[name] for name in ("XCP(TR)", "YCP(TR)", "ZCP(TR)")),
                v.get("DELTCP(TR)", 0.0),
                at["XCP(TR)"],
                at["YCP(TR)"],
                at["ZCP(TR)"],
                len(result.patches),
                k + 1,
                1e3 * case.get("SPINXO", 0.0),
                1e3 * case.get("SPINYO", 0.0),
            ],
        ),
        (
            "MX, MY, XL, YL, DX, DY, CHI, DQ, C1, D",
            [
                *(x.size, y.size, x[0] - 0.5 * dx, y[0] - 0.5 * dy, dx, dy, case.get("CHI", 0.0)),
                *(1e3 * case.get("DQ", 1e-3 * dx), case.digits.get("C1", 0), case.digits["D"]),
            ],
        ),
        ("T, M, GG1, GG2, POISS1, POISS2", _bodies(case)),
        (
            "L, H, VELOC, law",
            [case["LAW"], case.digits["H"], 1e3 * case.get("VELOC", case.get("VS", 1e-3)), *_law(case)],
        ),
    ]
    lines = []
    for number, (names, values) in enumerate(rows):
        padded = [*values, *[0.0] * (width - len(values))]
        if number == 0:
            padded[-1] = _VERSION
        lines += [f"% {names}", " ".join(f"{float(value):.8g}" for value in padded)]
    more = ", TAUCRT, UPLSX, UPLSY" if width > _COLUMNS else ""
    slip = "SHFT" if case.digits["T"] == 1 else "SREL"
    lines.append(f"% I, IGS, H, MU, PN, PX, PY, UN, UX, UY, {slip}{more}")
    columns = [1e3 * f["h"], f["mu"], 1e-6 * f["p"], 1e-6 * f["px"], 1e-6 * f["py"]]
    columns += [1e3 * f["un"], 1e3 * f["ux"], 1e3 * f["uy"], f["slip"] * (1e3 if case.digits["T"] == 1 else 1.0)]
    if more:
        columns += [1e-6 * f["tau"], 1e3 * f["shear_x"], 1e3 * f["shear_y"]]
    state = f["state"].ravel()
    flat = np.stack([column.ravel() for column in columns], axis=1)
    every = case.digits["A"] == 2
    for i, row in enumerate(flat):
        if every or state[i] > 0:
            lines.append(f"{i + 1} {int(state[i])} " + " ".join(f"{value:.8g}" for value in row))
    return lines


def _step(centres: Any) -> float:
    return float(centres[1] - centres[0]) if centres.size > 1 else 1.0


def _bodies(case: Case) -> list[float]:
    T, M = case.digits["T"], case.digits["M"]
    values = [T, M, 1e-6 * case["GG1"], 1e-6 * case["GG2"], case["POISS1"], case["POISS2"]]
    if M == 4:
        values += [1e-6 * case["GG3"], 1e3 * case["LAYTHK"], 1e-6 * case["TAU_C0"], 1e-9 * case["K_TAU"]]
    return values


def _law(case: Case) -> list[float]:
    names = {0: ("FSTAT", "FKIN"), 2: ("FKIN", "FLIN1", "SABSH1", "FLIN2", "SABSH2")}
    names |= {law: ("FKIN", f"{term}1", "SABSH1", f"{term}2", "SABSH2") for law, term in ((3, "FRAT"), (4, "FEXP"))}
    names[6] = ("FREF", "TREF", "DFHEAT", "DTHEAT")
    found = []
    for name in names[case["LAW"]]:
        value = case[name]
        first = value[0] if isinstance(value, tuple) else value
        found.append(1e3 * first if name.startswith("SABSH") else first)
    return found
