"""Accuracy of the fast methods against CONTACT's half-space solution: the tables of docs/check/accuracy.md.

    python benchmarks/accuracy.py [--write docs/check/accuracy.md]

The reference numbers, and the errors against them, are in `reference`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import contact
import reference
from benchmarks.tables import table, tell
from contact.registry import GAP_LIMIT
from contact.study.errors import mean_p95_max
from reference import accuracy


def triple(values: Any, digits: int = 4) -> str:
    return " / ".join(f"{v:.{digits}f}" for v in mean_p95_max(values))


def report() -> dict[str, str]:
    """Return all tables as Markdown."""
    tangential = list(contact.methods().batched.tangential)
    published = {
        "fastsim_1flx_par": "CONTACT: FASTSIM, 1 flexibility",
        "fastsim_3flx_par": "CONTACT: FASTSIM, 3 flexibilities blended",
        "fastrip_orig": "CONTACT: FaStrip, original",
        "fastrip_fullslid": "CONTACT: FaStrip, full-sliding correction",
        "fastrip_modf": "CONTACT: FaStrip, modified",
    }
    rows = []
    for names, is_published in ((published, True), ({m: f"`{m}`" for m in tangential}, False)):
        for method, title in names.items():
            e = accuracy.errors_on_ellipses(method, is_published)
            rows.append([title, triple(e["force"]), triple(e["moment"]), f"{e['adhesion'].mean():.3f}"])
    a = table(["method", "force, mean / p95 / max", "moment, mean / p95 / max", "adhesion area, mean"], rows)

    rows = []
    for name, title in (("kpec_fastsim", "CONTACT: KPEC"), ("analyn_fastsim", "CONTACT: ANALYN")):
        rows.append([title, *normal_row(accuracy.published_on_patches(name))])
    rows += [
        [f"`{n}`", *normal_row(accuracy.errors_on_patches(n, "fastrip"))] for n in contact.methods().batched.normal
    ]
    d_normal = table(["method", "N", "max pressure", "area", "pressure L2"], rows)

    rows = []
    for name, title in (
        ("contactN_fastsim", "exact pressure + CONTACT's FASTSIM"),
        ("contactN_fastripmod", "exact pressure + CONTACT's FaStrip"),
        ("kpec_fastsim", "CONTACT: KPEC + FASTSIM"),
        ("analyn_fastripmod", "CONTACT: ANALYN + FaStrip"),
    ):
        e = accuracy.published_on_patches(name)
        rows.append([title, triple(e["force"]), triple(e["moment"])])
    calibrated = [name for name, method in contact.methods().tangential.items() if method.calibrated]
    for n in ("analyn", "strip_halfspace"):
        for t in [*tangential, *calibrated]:
            e = accuracy.errors_on_patches(n, t)
            rows.append([f"`{n}` + `{t}`", triple(e["force"]), triple(e["moment"])])
    d_force = table(["method", "force, mean / p95 / max", "moment, mean / p95 / max"], rows)

    own = [
        ("`" + t + "`", list(accuracy.errors_on_fields(t).values()))
        for t in tangential
        if contact.methods().tangential[t].fields
    ]
    theirs = [
        (f"CONTACT: FaStrip, {k}", [case["error_contact_fastrip"][k] for case in reference.fields()])
        for k in ("original", "modified")
    ]
    b = table(
        ["method", "traction field, mean / max"], [[n, f"{np.mean(e):.3f} / {np.max(e):.3f}"] for n, e in theirs + own]
    )
    rows = []
    for n in ("analyn", "strip_halfspace"):
        for t in tangential:
            e = 100 * np.abs(accuracy.errors_of_slopes(n, t))
            figures = [f"{m:.1f} / {w:.1f} %" for m, w in zip(e.mean(axis=0), e.max(axis=0), strict=True)]
            rows.append([f"`{n}` + `{t}`", *figures])
    slopes = table(["method, mean / max", "Fx/ξ", "Fy/η", "Fy/φ", "Mz/φ"], rows)

    rows = []
    for title, options in (("`contact.THESIS`", contact.THESIS), ("default", {})):
        force, pressure, gap = accuracy.errors_of(reference.wheel_rail_patches(), **options)
        wrong = np.abs(pressure) > 0.20
        rows.append(
            [title, triple(force, 3), triple(pressure, 3), f"{wrong.sum()}, {np.sum(gap[wrong] > GAP_LIMIT)} of them",
             f"{np.sum(gap[~wrong] > GAP_LIMIT)} of {np.sum(~wrong)}"]
        )  # fmt: skip
    o = table(
        [
            "methods",
            "force, mean / p95 / max",
            "max pressure",
            f"> 20 % off; `gap_error` > {GAP_LIMIT}",
            "false alarms",
        ],
        rows,
    )
    return {"a": a, "b": b, "d_normal": d_normal, "d_force": d_force, "slopes": slopes, "o": o}


def normal_row(e: dict[str, np.ndarray]) -> list[str]:
    return [*(f"{100 * np.abs(e[k]).mean():.2f} %" for k in ("N", "pmax", "area")), f"{e['L2'].mean():.3f}"]


if __name__ == "__main__":
    tell(report, __doc__)
