"""`contact run`: compute result and report of a scenario. An interrupted command can continue."""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer

from contact.cli import options as opt
from contact.cli.document import document
from contact.cli.output import INTERRUPTED, NOT_TRUSTED, drawing, reported, require_extra, stop
from contact.cli.progress import progress_bar
from contact.errors import ContactError
from contact.study.files import require_folder
from . import checkpoint, scenario
from .progress import Progress, time_left
from .result import ENDINGS, write_series
from .run import VehicleRun
from .trust import Trust

_SHOWN = 0.2  # between two changes of the progress bar [s]

Declared = Annotated[Path, typer.Argument(help="TOML file.", show_default=False)]
Out = Annotated[Path | None, typer.Option(help="Folder for the results; default out/ and the file's name.")]
Fresh = Annotated[bool, typer.Option("--fresh", help="Start from the beginning and ignore a checkpoint.")]


@reported
def run(
    file: Declared,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for the results, or a file of the time series, .csv, .mat or .nc, beside the folder of its name; "
            "default out/ and the file's name."
        ),
    ] = None,
    fresh: Fresh = False,
    every: Annotated[float, typer.Option(help="Seconds between two checkpoints.")] = 15.0,
    threads: Annotated[int, typer.Option(help="Threads that share the contacts, at most one for each wheel.")] = 1,
    critical_speed: Annotated[
        bool,
        typer.Option(
            "--critical-speed",
            help="Find the nonlinear critical speed for the report: half a minute, once for a vehicle and its profiles.",
        ),
    ] = False,
    as_json: opt.Json = False,
) -> None:
    """Run a scenario: a vehicle over a track, with time series, damage of wheels and rails, and a report.

    If the command is interrupted, call it again: it continues from the last checkpoint, with the same result bit for bit. The
    result does not depend on the number of threads.
    """
    drawing()
    require_extra("xarray")
    folder, table = _places(out or Path("out") / file.stem)
    require_folder(folder)
    if table is not None and table.is_dir():
        raise ContactError(f"{table} cannot be written: it is a folder")
    started = VehicleRun(scenario.read(file), threads)
    complete(started, folder / "checkpoint.npz", fresh, every)
    _finish(started, folder, critical_speed)
    if table is not None:
        write_series(started, table)
        typer.echo(f"wrote {table}", err=True)
    if as_json:
        found = {"scenario": started.scenario.name, "step_error": asdict(started.step_error)}
        typer.echo(document({**found, **results_of(folder, started.trust)}))
    require_reliable(started.trust)


def _places(out: Path) -> tuple[Path, Path | None]:
    """Return the folder of the results, and the file of the time series if `out` is one. It then lies beside the folder."""
    is_file = out.suffix.lower() in ENDINGS
    return (out.with_suffix(""), out) if is_file else (out, None)


def complete(started: VehicleRun, path: Path, fresh: bool, every: float) -> None:
    """Complete a run, from its checkpoint if there is one, with a progress bar, and a line a minute in progress.log beside it.

    Checkpoints are written to `path` every `every` seconds. `fresh` ignores an existing checkpoint.
    """
    fingerprint = started.scenario.fingerprint
    saved = checkpoint.read(path, fingerprint, fresh)
    if saved is not None:
        started.restore(saved)
        typer.echo(f"continues at {started.distance:.1f} m from {path}", err=True)
    begun, at_first = time.monotonic(), started.share
    written = shown = begun
    progress = Progress(path.parent)

    def line() -> str:
        done = started.share - at_first
        left = (time.monotonic() - begun) * (1.0 - started.share) / done if done > 0.0 else math.inf
        return f"{started.distance:.0f} m of {started.scenario.declared.length:g} m{time_left(left)}"

    with progress_bar() as bar, interrupts() as asked:
        try:
            while not (started.done or asked()):
                started.advance()
                now = time.monotonic()
                if now - shown >= _SHOWN:
                    bar(started.share, f"{started.distance:.0f} m of {started.scenario.name}")
                    shown = now
                progress.tell(line)
                if now - written >= every:
                    checkpoint.write(path, fingerprint, started.save())
                    written = time.monotonic()
        except KeyboardInterrupt:  # within a sample, so that only what is on disk is complete
            stop(f"interrupted at {started.distance:.1f} m; {resumable(path)}", INTERRUPTED)
        if not started.done:
            checkpoint.write(path, fingerprint, started.save())
            stop(f"interrupted at {started.distance:.1f} m; the same command continues from {path}", INTERRUPTED)


@contextmanager
def interrupts() -> Iterator[Callable[[], bool]]:
    """Yield a function that tells whether Ctrl-C was pressed. So a sample is completed first. A second one stops at once."""
    pressed: list[int] = []

    def note(number: int, frame: object) -> None:
        if pressed:
            raise KeyboardInterrupt
        pressed.append(number)

    if threading.current_thread() is not threading.main_thread():  # only this one may set what a signal does
        yield lambda: False
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield lambda: bool(pressed)
    finally:
        signal.signal(signal.SIGINT, before)


def results_of(folder: Path, trust: Trust) -> dict[str, Any]:
    """Return what both commands say in JSON: the files, and how far they can be trusted."""
    files = [str(folder / name) for name in ("result.nc", "report.html")]
    return {"files": files, "trust": trust.as_dict(), "warnings": list(trust.warnings)}


def resumable(path: Path) -> str:
    """Return what the same command will do."""
    return f"the same command continues from {path}" if path.exists() else "there is no checkpoint yet"


def _finish(finished: VehicleRun, folder: Path, nonlinear: bool) -> None:
    """Write result and report to the folder, and delete the checkpoint. See `report.page_of` for `nonlinear`."""
    from . import report, result

    write_both(folder, lambda: result.dataset(finished), lambda: report.page_of(finished, nonlinear))
    typer.echo(wrote(folder), err=True)
    (folder / "checkpoint.npz").unlink(missing_ok=True)
    warn(finished.trust)
    typer.echo(finished.step_error.sentence, err=True)


def warn(trust: Trust) -> None:
    """Print the warnings, each on a line of its own."""
    for sentence in trust.warnings:
        typer.echo(f"warning: {sentence}", err=True)


def require_reliable(trust: Trust) -> None:
    """End the command with its own exit status if what it has written is not to be trusted. The warnings say why."""
    if not trust.reliable:
        raise typer.Exit(NOT_TRUSTED)


def write_both(folder: Path, dataset: Callable[[], Any], page: Callable[[], str]) -> None:
    """Write result.nc and report.html to the folder. A command that is interrupted leaves no broken file."""
    from .result import write

    folder.mkdir(parents=True, exist_ok=True)
    part = folder / "written.part"
    write(dataset(), part)
    part.replace(folder / "result.nc")
    part.write_text(page(), encoding="utf-8")
    part.replace(folder / "report.html")


def wrote(folder: Path) -> str:
    return f"wrote {folder / 'result.nc'}, {folder / 'report.html'}"
