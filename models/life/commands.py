"""`contact run`: a scenario from its file to result and report, over interruptions."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer

from contact.cli.output import drawing, reported, stop
from contact.cli.progress import progress_bar
from models.life import checkpoint, scenario
from models.life.run import Run

_STEPS = 100  # between two looks at the clock

Declared = Annotated[Path, typer.Argument(help="TOML file.", show_default=False)]
Out = Annotated[Path | None, typer.Option(help="Folder for the results; default out/ and the file's name.")]
Fresh = Annotated[bool, typer.Option("--fresh", help="Start anew, whatever checkpoint there is.")]


@reported
def run(
    file: Declared,
    out: Out = None,
    fresh: Fresh = False,
    every: Annotated[float, typer.Option(help="Seconds between two checkpoints.")] = 15.0,
) -> None:
    """Run a scenario: a wheelset over a track, its time series, the damage of wheels and rails, a report.

    Interrupted, it goes on from its last checkpoint when it is called again, to the same result bit for bit.
    """
    drawing()
    folder = out or Path("out") / file.stem
    started = Run(scenario.read(file))
    complete(started, folder / "checkpoint.npz", fresh, every)
    _finish(started, folder)


def complete(started: Run, path: Path, fresh: bool, every: float) -> None:
    """Go on from the checkpoint, if there is one, to the end; a progress bar is shown."""
    fingerprint = started.scenario.fingerprint
    saved = None if fresh else checkpoint.read(path, fingerprint)
    if saved is not None:
        started.restore(saved)
        typer.echo(f"goes on at {started.distance:.1f} m from {path}", err=True)
    looked = time.monotonic()
    with progress_bar() as bar:
        try:
            while not started.done:
                started.advance()
                if started.steps % _STEPS:
                    continue
                bar(started.share, f"{started.distance:.0f} m of {started.scenario.name}")
                if time.monotonic() - looked >= every:
                    checkpoint.write(path, fingerprint, started.save())
                    looked = time.monotonic()
        except KeyboardInterrupt:
            # between two steps or within one: the checkpoint on disk is whole either way, and nothing is lost but seconds
            stop(f"interrupted at {started.distance:.1f} m; the same command goes on from {path}", 130)


def _finish(finished: Run, folder: Path) -> None:
    """Result and report in the folder; the checkpoint is no longer needed."""
    from models.life import report, result

    folder.mkdir(parents=True, exist_ok=True)
    try:
        result.write(result.dataset(finished), folder / "result.nc")
    except ImportError as missing:
        stop(f"{missing}; pip install 'wheelrail-contact[xarray]'", 1)
    (folder / "report.html").write_text(report.page_of(finished), encoding="utf-8")
    (folder / "checkpoint.npz").unlink(missing_ok=True)
    typer.echo(f"wrote {folder / 'result.nc'}, {folder / 'report.html'}", err=True)
