"""`contact run` and `contact wear`: compute result and report from a file. Interrupted commands can continue."""

from __future__ import annotations

import math
import signal
import sys
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
from contact.cli.output import INTERRUPTED, MISSING, NOT_TRUSTED, drawing, reported, require_extra, stop
from contact.cli.progress import progress_bar
from contact.errors import ContactError
from ..vehicle.run import VehicleRun
from . import checkpoint, declared_set, scenario
from .result import ENDINGS, write_series
from .scale import Workers
from .trust import NotTrusted, Trust
from .wear import Life
from .wear_log import WearLog, time_left

_SHOWN = 0.2  # between two changes of the progress bar [s]
_TOLD = 10.0  # between two lines on the terminal, where there is no bar [s]
_LOGGED = 60.0  # between two lines of progress.log [s]

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
    as_json: opt.Json = False,
) -> None:
    """Run a scenario: a vehicle over a track, with time series, damage of wheels and rails, and a report.

    If the command is interrupted, call it again: it continues from the last checkpoint, with the same result bit for bit. The
    result does not depend on the number of threads.
    """
    drawing()
    require_extra("xarray")
    folder, table = _places(out or Path("out") / file.stem)
    started = VehicleRun(scenario.read(file), threads)
    complete(started, folder / "checkpoint.npz", fresh, every)
    _finish(started, folder)
    if table is not None:
        write_series(started, table)
        typer.echo(f"wrote {table}", err=True)
    if as_json:
        found = {"scenario": started.scenario.name, "step_error": asdict(started.step_error)}
        typer.echo(document({**found, **_results(folder, started.trust)}))
    _require_reliable(started.trust)


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
    written = shown = told = logged = begun
    with progress_bar() as bar, interrupts() as asked:
        try:
            while not (started.done or asked()):
                started.advance()
                now = time.monotonic()
                if now - shown >= _SHOWN:
                    bar(started.share, f"{started.distance:.0f} m of {started.scenario.name}")
                    shown = now
                tells = now - told >= _TOLD and not sys.stderr.isatty()
                if tells or now - logged >= _LOGGED:
                    done = started.share - at_first
                    left = (now - begun) * (1.0 - started.share) / done if done > 0.0 else math.inf
                    line = f"{started.distance:.0f} m of {started.scenario.declared.length:g} m{time_left(left)}"
                    if tells:
                        typer.echo(line, err=True)
                        told = now
                    if now - logged >= _LOGGED:
                        log(path.parent, line)
                        logged = now
                if now - written >= every:
                    checkpoint.write(path, fingerprint, started.save())
                    written = time.monotonic()
        except KeyboardInterrupt:  # within a sample, so that only what is on disk is complete
            stop(f"interrupted at {started.distance:.1f} m; {_resumable(path)}", INTERRUPTED)
        if not started.done:
            checkpoint.write(path, fingerprint, started.save())
            stop(f"interrupted at {started.distance:.1f} m; the same command continues from {path}", INTERRUPTED)


def log(folder: Path, line: str) -> None:
    """Add a line with the time to progress.log in a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "progress.log").open("a", encoding="utf-8") as file:
        file.write(f"{time.strftime('%Y-%m-%d %H:%M:%S')}  {line}\n")


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


@reported
def wear(
    file: Declared,
    out: Out = None,
    fresh: Fresh = False,
    workers: Annotated[int, typer.Option(help="Processes of this machine; more than one need dask.")] = 1,
    scheduler: Annotated[str | None, typer.Option(help="Address of a dask scheduler, tcp://host:8786.")] = None,
    go_on: Annotated[bool, typer.Option("--go-on", help="Go on if the energy of a run does not close.")] = False,
    as_json: opt.Json = False,
) -> None:
    """Compute the wear of wheels and rails over a mileage: run a set of scenarios, change the profiles, and repeat.

    If the command is interrupted, call it again: it continues from the last complete step. Each step prints a line, and result
    and report are written anew. The result does not depend on the number of workers. It stops with exit status 3 if the
    energy of a run does not close to 2 % of its dissipation.
    """
    drawing()
    require_extra("xarray")
    folder = out or Path("out") / file.stem
    life = Life(declared_set.read(file))
    path, fingerprint = folder / "checkpoint.npz", life.plan.fingerprint
    saved = checkpoint.read(path, fingerprint, fresh)
    if saved is not None:
        life.restore(saved)
        typer.echo(f"continues at {1e-3 * life.mileage:.0f} km from {path}", err=True)
    try:
        with Workers(workers, scheduler) as pool, progress_bar() as bar:
            log = WearLog(life)
            while not life.ended:
                life.step(pool, lambda k, n: log.ran(bar, k, n), go_on=go_on)
                checkpoint.write(path, fingerprint, life.save())
                log.stepped()
                if not life.ended and log.may_write:
                    log.wrote(lambda: _save(life, folder))
    except ImportError as missing:
        stop(str(missing), MISSING)
    except KeyboardInterrupt:
        stop(f"interrupted at {1e-3 * life.mileage:.0f} km; {_resumable(path)}", INTERRUPTED)
    except ContactError as error:
        if life.mileage > 0.0:  # what has been found so far may show why
            _tell(life, folder, as_json)
        if isinstance(error, NotTrusted):
            stop(str(error), NOT_TRUSTED)
        raise
    _tell(life, folder, as_json)
    _require_reliable(life.trust)


def _tell(life: Life, folder: Path, as_json: bool) -> None:
    """Write result and report of a study, and say how it ended."""
    _save(life, folder)
    typer.echo(_wrote(folder), err=True)
    ended = f"ended by {life.ended}" if life.ended else "not ended"
    typer.echo(f"{1e-3 * life.mileage:.0f} km in {len(life.rows) - 1} steps, {ended}", err=True)
    _warn(life.trust)
    if as_json:
        found = {"mileage": life.mileage, "steps": len(life.rows) - 1, "ended_by": life.ended}
        typer.echo(document({"set": life.plan.name, **found, **_results(folder, life.trust)}))


def _save(life: Life, folder: Path) -> None:
    """Write result and report of a study, which may go on."""
    from . import wear_report, wear_result

    _write(folder, lambda: wear_result.dataset(life), lambda: wear_report.page_of(life))


def _results(folder: Path, trust: Trust) -> dict[str, Any]:
    """Return what both commands say in JSON: the files, and how far they can be trusted."""
    files = [str(folder / name) for name in ("result.nc", "report.html")]
    return {"files": files, "trust": trust.as_dict(), "warnings": list(trust.warnings)}


def _resumable(path: Path) -> str:
    """Return what the same command will do."""
    return f"the same command continues from {path}" if path.exists() else "there is no checkpoint yet"


def _finish(finished: VehicleRun, folder: Path) -> None:
    """Write result and report to the folder, and delete the checkpoint."""
    from ..vehicle import report
    from . import result

    _write(folder, lambda: result.dataset(finished), lambda: report.page_of(finished))
    typer.echo(_wrote(folder), err=True)
    (folder / "checkpoint.npz").unlink(missing_ok=True)
    _warn(finished.trust)
    typer.echo(finished.step_error.sentence, err=True)


def _warn(trust: Trust) -> None:
    """Print the warnings, each on a line of its own."""
    for sentence in trust.warnings:
        typer.echo(f"warning: {sentence}", err=True)


def _require_reliable(trust: Trust) -> None:
    """End the command with its own exit status if what it has written is not to be trusted. The warnings say why."""
    if not trust.reliable:
        raise typer.Exit(NOT_TRUSTED)


def _write(folder: Path, dataset: Callable[[], Any], page: Callable[[], str]) -> None:
    """Write result.nc and report.html to the folder. A command that is interrupted leaves no broken file."""
    from .result import write

    folder.mkdir(parents=True, exist_ok=True)
    part = folder / "written.part"
    write(dataset(), part)
    part.replace(folder / "result.nc")
    part.write_text(page(), encoding="utf-8")
    part.replace(folder / "report.html")


def _wrote(folder: Path) -> str:
    return f"wrote {folder / 'result.nc'}, {folder / 'report.html'}"
