"""Lines of `contact wear`: what each step has done, and the time left."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import typer

from ..runs.progress import Progress, time_left
from .wear import Life

_WRITING = 0.1  # largest share of the time for interim reports
_RECENT = 3  # steps from which the time left is estimated


class WearLog:
    """Lines and bar of a study of wear, with the time left, and when an interim report may be written.

    Parameters
    ----------
    life : Life
    folder : Path
        Of the log file, which has a line for each step and one a minute.
    """

    def __init__(self, life: Life, folder: Path) -> None:
        self._life = life
        self._times = [time.monotonic()]  # at the end of each step
        self._mileages = [life.mileage]
        self._written, self._writing = self._times[0], 0.0
        self._progress = Progress(folder)
        typer.echo(
            f"{life.plan.name}: {len(life.plan.scenarios)} runs a step, {life.plan.declared.mileage * 1e-3:g} km in all",
            err=True,
        )

    def ran(self, bar: Callable[[float, str], None], k: int, n: int) -> None:
        """Show that `k` of `n` runs of a step are done."""
        life = self._life
        total = life.plan.declared.mileage
        ahead = min(self._mileages[-1] - self._mileages[max(len(self._mileages) - 2, 0)], total - life.mileage)
        said = f"{1e-3 * life.mileage:.0f} km, run {k} of {n}"
        bar((life.mileage + ahead * k / n) / total, said)
        if k < n:
            self._progress.tell(lambda: said)

    def stepped(self) -> None:
        """Print what a step has done, and the time left by the last steps."""
        life = self._life
        self._times.append(time.monotonic())
        self._mileages.append(life.mileage)
        since = max(len(self._times) - 1 - _RECENT, 0)
        pace = (self._times[-1] - self._times[since]) / (life.mileage - self._mileages[since])
        deepest = max(life.parts, key=lambda part: float(part["deepest"][-1]))
        tape = max(float(wheel["tread_depth"][-1]) for wheel in life.wheels.values())
        line = (
            f"step {len(life.rows) - 1}, {self._times[-1] - self._times[-2]:.0f} s: {1e-3 * life.mileage:.0f} of "
            f"{1e-3 * life.plan.declared.mileage:g} km, {1e6 * deepest['deepest'][-1]:.0f} µm off {deepest.name}, "
            f"{1e3 * tape:.2f} mm off the tape circle since new{time_left(pace * (life.plan.declared.mileage - life.mileage))}"
        )
        typer.echo(line, err=True)
        self._progress.log(line)

    @property
    def may_write(self) -> bool:
        """Whether a report would take no more than a tenth of the time, by the last one."""
        return self._writing <= _WRITING * (time.monotonic() - self._written)

    def wrote(self, write: Callable[[], None]) -> None:
        """Write a report and note how long that takes."""
        begun = time.monotonic()
        write()
        self._written = time.monotonic()
        self._writing = self._written - begun
