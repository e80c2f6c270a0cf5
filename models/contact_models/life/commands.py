"""`contact wear`: wear over a mileage from the file of a set. An interrupted command can continue."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact.cli import options as opt
from contact.cli.document import document
from contact.cli.output import INTERRUPTED, MISSING, NOT_TRUSTED, drawing, reported, require_extra, stop
from contact.cli.progress import progress_bar
from contact.errors import ContactError
from contact.study.files import require_folder
from ..runs import checkpoint
from ..runs.commands import Declared, Fresh, require_reliable, results_of, resumable, warn, write_both, wrote
from ..runs.trust import NotTrusted
from . import declared_set
from .scale import Workers
from .wear import Life
from .wear_log import WearLog

Out = Annotated[Path | None, typer.Option(help="Folder for the results; default out/ and the file's name.")]


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
    require_folder(folder)
    life = Life(declared_set.read(file))
    path, fingerprint = folder / "checkpoint.npz", life.plan.fingerprint
    saved = checkpoint.read(path, fingerprint, fresh)
    if saved is not None:
        life.restore(saved)
        typer.echo(f"continues at {1e-3 * life.mileage:.0f} km from {path}", err=True)
    try:
        with Workers(workers, scheduler) as pool, progress_bar() as bar:
            log = WearLog(life, folder)
            while not life.ended:
                life.step(pool, lambda k, n: log.ran(bar, k, n), go_on=go_on)
                checkpoint.write(path, fingerprint, life.save())
                log.stepped()
                if not life.ended and log.may_write:
                    log.wrote(lambda: _save(life, folder))
    except ImportError as missing:
        stop(str(missing), MISSING)
    except KeyboardInterrupt:
        stop(f"interrupted at {1e-3 * life.mileage:.0f} km; {resumable(path)}", INTERRUPTED)
    except ContactError as error:
        if life.mileage > 0.0:  # what has been found so far may show why
            _tell(life, folder, as_json)
        if isinstance(error, NotTrusted):
            stop(str(error), NOT_TRUSTED)
        raise
    _tell(life, folder, as_json)
    require_reliable(life.trust)


def _tell(life: Life, folder: Path, as_json: bool) -> None:
    """Write result and report of a study, and say how it ended."""
    _save(life, folder)
    typer.echo(wrote(folder), err=True)
    ended = f"ended by {life.ended}" if life.ended else "not ended"
    typer.echo(f"{1e-3 * life.mileage:.0f} km in {len(life.rows) - 1} steps, {ended}", err=True)
    warn(life.trust)
    if as_json:
        found = {"mileage": life.mileage, "steps": len(life.rows) - 1, "ended_by": life.ended}
        typer.echo(document({"set": life.plan.name, **found, **results_of(folder, life.trust)}))


def _save(life: Life, folder: Path) -> None:
    """Write result and report of a study, which may go on."""
    from . import wear_report, wear_result

    write_both(folder, lambda: wear_result.dataset(life), lambda: wear_report.page_of(life))
