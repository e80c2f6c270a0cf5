"""The command `check`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.document import GIVEN
from contact.cli.output import BAD_INPUT, drawing, in_options, reported, stop
from contact.errors import ContactError
from contact.geometry import profile
from contact.study.files import PICTURES

Given = Annotated[list[Path], typer.Argument(help="profile files or folders", show_default=False)]
Kind = Annotated[
    str | None, opt.in_profiles("--profile-kind", "--kind", help="wheel or rail, for files that do not say it")
]


@reported
def check(
    files: Given,
    *,
    kind: Kind = None,
    reading: arguments.ProfileFile,
    output: arguments.Output,
) -> None:
    """Check profile files: spikes, gaps, repeated scans, noise, offsets; each with the option that cures it.

    Example:  contact check measured/*.whl --out check.png
    """
    found, unread = [], []
    for path in _files(files):
        try:
            found.append(profile.check(path, kind=kind, **reading.given))
        except ContactError as error:
            unread.append(str(error))
    if len(found) != 1 and any(path.suffix.lower() in PICTURES for path in output.out or []):
        raise ContactError(f"out: a picture shows one file; {len(found)} could be read")
    rows: list[dict[str, str | None]] = [
        {"file": one.name, "fault": finding.fault.value, "seen": finding.seen, "cure": finding.cure}
        for one in found
        for finding in one.findings
    ]

    def show(console: Console) -> None:
        for one in found:
            console.print(in_options(str(one), GIVEN.get()), markup=False, highlight=False, soft_wrap=True)

    output.deliver(
        {"files": [_plain(one) for one in found], "unread": unread},
        show=show,
        rows=lambda: rows or [dict.fromkeys(("file", "fault", "seen", "cure"))],
        figure=lambda: drawing().profile_check(found[0]),
    )
    if unread:
        stop("\n".join(in_options(text, GIVEN.get()) for text in dict.fromkeys(unread)), BAD_INPUT)


def _files(given: list[Path]) -> Iterator[Path]:
    for path in given:
        if not path.is_dir():
            yield path
        elif inside := sorted(each for each in path.iterdir() if each.is_file() and not each.name.startswith(".")):
            yield from inside
        else:
            raise ContactError(f"folder = {str(path)!r} holds no file")


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
