"""`contact run` and `contact wear`: from a file to result and report, over interruptions."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from contact.cli.output import drawing, reported, require_extra, stop
from contact.cli.progress import progress_bar
from models.life import checkpoint, declared_set, scenario
from models.life.run import Run
from models.life.scale import Workers
from models.life.wear import Life

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
    require_extra("xarray")
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


@reported
def wear(
    file: Declared,
    out: Out = None,
    fresh: Fresh = False,
    workers: Annotated[int, typer.Option(help="Processes of this machine; more than one takes dask.")] = 1,
    scheduler: Annotated[str | None, typer.Option(help="Address of a dask scheduler, tcp://host:8786.")] = None,
) -> None:
    """Wear a wheel over a mileage: a set of scenarios is run, the profile changes, the set is run on it again.

    Interrupted, it goes on from the last whole step when it is called again. The result does not depend on the workers.
    """
    drawing()
    require_extra("xarray")
    folder = out or Path("out") / file.stem
    life = Life(declared_set.read(file))
    path, fingerprint = folder / "checkpoint.npz", life.plan.fingerprint
    saved = None if fresh else checkpoint.read(path, fingerprint)
    if saved is not None:
        life.restore(saved)
        typer.echo(f"goes on at {1e-3 * life.mileage:.0f} km from {path}", err=True)
    try:
        with Workers(workers, scheduler) as pool, progress_bar() as bar:
            while not life.ended:
                _wear_on(life, pool, bar)
                checkpoint.write(path, fingerprint, life.save())
    except ImportError as missing:
        stop(str(missing), 1)
    except KeyboardInterrupt:
        stop(f"interrupted at {1e-3 * life.mileage:.0f} km; the same command goes on from {path}", 130)
    from models.life import wear_report

    _write(folder, lambda: wear_report.dataset(life), lambda: wear_report.page_of(life))
    typer.echo(f"{1e-3 * life.mileage:.0f} km in {len(life.wheels) - 1} steps, ended by {life.ended}", err=True)


def _wear_on(life: Life, pool: Workers, bar: Callable[[float, str], None]) -> None:
    """One step; the bar knows the mileage and how many runs of the step are done."""
    done, mileage = life.mileage / life.plan.declared.mileage, 1e-3 * life.mileage
    life.step(pool, lambda k, n: bar(done, f"{mileage:.0f} km, run {k} of {n}"))


def _finish(finished: Run, folder: Path) -> None:
    """Result and report in the folder; the checkpoint is no longer needed."""
    from models.life import report, result

    _write(folder, lambda: result.dataset(finished), lambda: report.page_of(finished))
    (folder / "checkpoint.npz").unlink(missing_ok=True)


def _write(folder: Path, dataset: Callable[[], Any], page: Callable[[], str]) -> None:
    """result.nc and report.html."""
    from models.life.result import write

    folder.mkdir(parents=True, exist_ok=True)
    try:
        write(dataset(), folder / "result.nc")
    except ImportError as missing:
        stop(f"{missing}; pip install 'wheelrail-contact[xarray]'", 1)
    (folder / "report.html").write_text(page(), encoding="utf-8")
    typer.echo(f"wrote {folder / 'result.nc'}, {folder / 'report.html'}", err=True)
