"""The command `check`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from contact.cli import options as opt
from contact.cli.output import deliver, drawing, in_options, prepare, reported
from contact.errors import ContactError
from contact.geometry import profile

Given = Annotated[list[Path], typer.Argument(help="profile files or folders", show_default=False)]
Kind = Annotated[
    str | None, opt.in_profiles("--profile-kind", "--kind", help="wheel or rail, for files that do not say it")
]


@reported
def check(
    files: Given,
    *,
    kind: Kind = None,
    profile_unit: opt.Unit = None,
    profile_side: opt.Drawn = None,
    profile_zero: opt.Zero = None,
    profile_scale: opt.Scale = 1.0,
    profile_columns: opt.Columns = None,
    profile_rows: opt.Rows = None,
    profile_section: opt.Section = None,
    profile_repair: opt.Repair = False,
    profile_smoothing: opt.Smoothing = None,
    profile_wavelength: opt.Wavelength = None,
    as_json: opt.Json = False,
    out: opt.Files = None,
) -> None:
    """Check profile files: spikes, gaps, repeated scans, noise, offsets; each with the option that cures it.

    Example:  contact check measured/*.whl --out check.png
    """
    prepare(out)
    options = {
        **{"kind": kind, "unit": profile_unit, "side": profile_side, "zero": profile_zero},
        **{"scale": profile_scale, "columns": profile_columns, "rows": profile_rows, "section": profile_section},
        **{"repair": profile_repair, "smoothing": profile_smoothing, "wavelength": profile_wavelength},
    }
    found, unread = [], []
    for path in _files(files):
        try:
            found.append(profile.check(path, **options))
        except ContactError as error:
            unread.append(str(error))
    if out and len(found) != 1 and any(path.suffix.lower() in (".png", ".pdf", ".svg") for path in out):
        raise ContactError(f"out: a picture shows one file; {len(found)} could be read")
    rows = [
        {"file": one.name, "fault": finding.fault.value, "seen": finding.seen, "cure": finding.cure}
        for one in found
        for finding in one.findings
    ]

    def show(console: Console) -> None:
        for text in (*map(str, found), *unread):
            console.print(in_options(text, {}), markup=False, highlight=False, soft_wrap=True)

    deliver(
        {"files": [_plain(one) for one in found], "unread": unread},
        show=show,
        as_json=as_json,
        out=out,
        rows=lambda: rows or [dict.fromkeys(("file", "fault", "seen", "cure"))],
        figure=lambda: drawing().profile_check(found[0]),
    )
    if unread:
        raise typer.Exit(2)


def _files(given: list[Path]) -> Iterator[Path]:
    for path in given:
        inside = (each for each in path.iterdir() if each.is_file() and not each.name.startswith("."))
        yield from sorted(inside) if path.is_dir() else [path]


def _plain(found: Any) -> dict[str, Any]:
    findings = [
        {"fault": finding.fault.value, "seen": finding.seen, "cure": finding.cure, "at": finding.at}
        for finding in found.findings
    ]
    repaired = found.profile.note if found.profile else ""
    return {
        **{"file": found.name, "kind": found.kind, "points": len(found.points), "findings": findings},
        **{"repaired": repaired, "dropped": found.dropped},
    }
