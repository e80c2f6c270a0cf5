"""Forces of the 3220 cases by the half space, computed on all cores. A file lets an interrupted run continue."""

from __future__ import annotations

import math
import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.forces import cores
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation
from contact.solve import solve
from contact.study.design import ELLIPSES, FRICTION, LOAD, MATERIAL, Design
from contact.study.ellipse import ellipse

Forces = tuple[float, float, float]
_CHUNK = 20
Job = TypeVar("Job")
Answer = TypeVar("Answer")


def reference_forces(
    d: Design,
    elements: int,
    *,
    stored: Path | None = None,
    processes: int | None = None,
    progress: Callable[[float, str], None] | None = None,
) -> Array:
    """Return Fx/(mu N), Fy/(mu N) and Mz/(mu N c), shape (n, 3), by TANG on Hertz's pressure.

    Parameters
    ----------
    d : Design
    elements : int
        Rows and columns of elements on the patch.
    stored : Path, optional
        File of results. Cases in it are not computed again; new results are added to it at once.
    processes : int, optional
        Number of processes; default all cores. More than one start new interpreters, so the calling script needs
        ``if __name__ == "__main__"``.
    progress : callable, optional
        Called with the share done, 0 to 1, and a description.

    Raises
    ------
    ContactError
        If the file has another resolution or is no such file.
    """
    heading = f"# number,Fx/muN,Fy/muN,Mz/muNc by the half space with {elements} x {elements} elements on the ellipse"
    known = {} if stored is None else _read(stored, heading)
    todo = [k for k in range(d.number.size) if int(d.number[k]) not in known]
    chunks = [todo[i : i + _CHUNK] for i in range(0, len(todo), _CHUNK)]
    jobs = [
        [(int(d.ellipse[k]), d.longitudinal[k], d.lateral[k], d.spin[k], elements) for k in chunk] for chunk in chunks
    ]
    for n, (chunk, found) in enumerate(zip(chunks, in_processes(_solve, jobs, processes), strict=True), 1):
        rows = dict(zip((int(d.number[k]) for k in chunk), found, strict=True))
        known |= rows
        if stored is not None:
            _add(stored, heading, rows)
        if progress is not None:
            progress(n / len(chunks), f"half space, {min(n * _CHUNK, len(todo))} of {len(todo)} cases")
    return np.array([known[int(number)] for number in d.number])


def in_processes(solve: Callable[[Job], Answer], jobs: Sequence[Job], processes: int | None) -> Iterator[Answer]:
    """Yield the answers of the jobs in their order, from as many processes, by default from all cores."""
    count = min(processes or cores(), len(jobs))
    if count <= 1:
        yield from map(solve, jobs)
        return
    with ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn")) as pool:
        yield from pool.map(solve, jobs)


def _solve(cases: list[tuple[Any, ...]]) -> list[Forces]:
    """Return the forces of some cases. Runs in a separate process."""
    found = []
    for k, longitudinal, lateral, spin, elements in cases:
        s = solve(
            separation_of(k),
            Creepage(float(longitudinal), float(lateral), float(spin)),
            load=LOAD,
            friction=FRICTION,
            material=MATERIAL,
            normal="hertz",
            tangential="halfspace",
            n_strips=elements,
            n_elements=elements,
        )
        a, b, _ = ELLIPSES[k]
        scale = FRICTION * LOAD
        found.append((s.Fx / scale, s.Fy / scale, s.Mz / (scale * math.sqrt(a * b))))
    return found


@cache
def separation_of(k: int) -> Separation:
    """Return the separation whose patch under the load is ellipse `k`."""
    a, b, _ = ELLIPSES[k]
    return ellipse(a / b, math.sqrt(a * b), LOAD, MATERIAL)


def _read(path: Path, heading: str) -> dict[int, Forces]:
    """Return the results of an earlier run, by number. An incomplete last line is ignored."""
    try:
        lines = path.read_text(encoding="utf-8").split("\n")
    except FileNotFoundError:
        return {}
    except (OSError, ValueError) as error:
        raise ContactError(f"{path} cannot be read: {error}") from None
    if lines[0] != heading:
        raise ContactError(f"{path} holds other results: its first line is not {heading!r}")
    found = {}
    for line in lines[1:-1]:
        try:
            number, Fx, Fy, Mz = line.split(",")
            found[int(number)] = float(Fx), float(Fy), float(Mz)
        except ValueError:
            raise ContactError(f"{path} is damaged: {line!r} is not a number and three forces") from None
    return found


def _add(path: Path, heading: str, rows: dict[int, Forces]) -> None:
    text = "".join(f"{number},{Fx:.9g},{Fy:.9g},{Mz:.9g}\n" for number, (Fx, Fy, Mz) in rows.items())
    try:
        if path.exists() and not path.read_bytes().endswith(b"\n"):  # an earlier run was interrupted within a line
            path.write_text(path.read_text(encoding="utf-8").rpartition("\n")[0] + "\n", encoding="utf-8")
        with path.open("a", encoding="utf-8") as file:
            file.write(text if file.tell() else f"{heading}\n{text}")
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error.strerror}") from None
