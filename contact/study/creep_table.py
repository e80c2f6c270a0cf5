"""Build the table of `contact.kernels.tangential.table` with the half space, on all cores. Interrupted runs continue."""

from __future__ import annotations

import math
import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TypeVar

from contact.errors import ContactError
from contact.forces import cores
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material
from contact.inputs.separation import Separation
from contact.kernels.enumerations import Status
from contact.results.solution import Solution
from contact.solve import solve
from contact.study.ellipse import ellipse
from contact.theory import force_table as table
from contact.theory import kalker

Job = TypeVar("Job")
Answer = TypeVar("Answer")

#: Conditions of the computation: material, load [N], friction [-] and √(ab) [m]. The results are divided by mu N or mu N c.
MATERIAL, LOAD, FRICTION, C = Material(82e9, table.NU), 82e3, 0.3, 6e-3
#: Value of r that replaces infinity, far into full slip.
_FAR = 1e3
#: ln(a/b) from which on there are twice as many elements along x: with 60 forces are .0025 of mu N off in the mean, .012 most.
_SLENDER = math.log(10.0) - 1e-9


def build(
    path: Path,
    elements: int = 60,
    *,
    processes: int | None = None,
    progress: Callable[[float, str], None] | None = None,
) -> None:
    """Compute the rows of the table that are missing in `path`, and add them to it.

    Each node is one solution of TANG on Hertz's pressure, with `elements` rows and columns on the ellipse, and twice as many
    columns on slender ones.

    Raises
    ------
    ContactError
        If the file contains something else or cannot be written.
    """
    todo = table.rows()
    heading = _heading(elements)
    try:
        known = path.read_text(encoding="utf-8") if path.exists() else ""
        if known and not known.startswith(heading):
            raise ContactError(f"{path} does not contain the beginning of this table")
        lines = known[len(heading) :].split("\n")[:-1] if known else []
        path.write_text(heading + "".join(line + "\n" for line in lines), encoding="utf-8")
        jobs = [(*row, elements) for row in todo[len(lines) :]]
        with path.open("a", encoding="utf-8") as file:
            for n, line in enumerate(in_processes(_row, jobs, processes), len(lines) + 1):
                file.write(line + "\n")
                file.flush()
                if progress is not None:
                    progress(n / len(todo), f"row {n} of {len(todo)}")
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error.strerror}") from None


def in_processes(solve: Callable[[Job], Answer], jobs: Sequence[Job], processes: int | None) -> Iterator[Answer]:
    """Yield the answers of the jobs in their order, from as many processes, by default from all cores."""
    count = min(processes or cores(), len(jobs))
    if count <= 1:
        yield from map(solve, jobs)
        return
    with ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn")) as pool:
        yield from pool.map(solve, jobs)


def _heading(elements: int) -> str:
    names = ", ".join(f"{what} at rho = {k}/{table.N_RHO - 1}" for k in (1, 2) for what in ("Fx", "Fy", "Mz", "slip"))
    return (
        "# Creep forces over mu N, moment over mu N c, share of slip, on ellipses of Hertz at Poisson's ratio "
        f"{table.NU}: contact/kernels/tangential/table.py\n"
        f"# Computed by `contact table build` (TANG of contact.halfspace, {elements} x {elements} elements on the ellipse, "
        "from a/b = 10 on twice as many along x)\n"
        f"# A row for each a/b, spin and direction, in the order of table.rows(); {names}, ...\n"
    )


def creepage(log_aspect: float, alpha: float, beta: float, rho: float) -> Creepage:
    """Return the creepages of a node on the ellipse of the computation."""
    direction = math.cos(beta) * math.cos(alpha), math.cos(beta) * math.sin(alpha), math.sin(beta)
    return Creepage(*(size * share for size, share in zip(sizes(log_aspect, rho), direction, strict=True)))


def sizes(log_aspect: float, rho: float) -> tuple[float, float, float]:
    """Return the sizes of longitudinal [-], lateral [-] and spin [1/m] creepage at `rho`.

    Each of them by itself has the dimensionless size of all creepages of a node together.
    """
    c11, c22, c23, _ = kalker.coefficients(kalker.table(table.NU), log_aspect)
    r = table.R0 * rho / (1.0 - rho) if rho < 1.0 else _FAR
    unit = r * FRICTION * LOAD / (MATERIAL.shear_modulus * C**2)
    return unit / c11, unit / c22, unit / (table.spin_weight(log_aspect, c11, c22, c23) * c23 * C)


def _solved(separation: Separation, slip: Creepage, elements: int, columns: int) -> Solution:
    """Return the solution of a node with `elements` rows, and `columns` times as many columns.

    Pure spin on the most slender ellipses may not converge. Then the next smaller multiple of four that does is taken.
    """
    for n in range(elements, elements // 2, -4):
        found = solve(
            separation,
            slip,
            load=LOAD,
            friction=FRICTION,
            material=MATERIAL,
            normal="hertz",
            tangential="halfspace",
            n_strips=n,
            n_elements=columns * n,
            throw=False,
        )
        if found.status <= Status.SATURATED:
            return found
    raise ContactError(f"a node of the table does not converge with {elements} to {n} elements")


def _row(job: tuple[int, int, int, int]) -> str:
    """Return one line of the file. Runs in a separate process.

    Pure spin is solved one way round; the other is its mirror image.
    """
    i, j, k, elements = job
    mirrored = -1.0 if k == 0 else 1.0
    log_aspect, alpha, beta, rho = table.nodes()
    separation = ellipse(math.exp(log_aspect[i]), C, LOAD, MATERIAL)
    numbers = []
    for share in rho[1:]:
        slip = creepage(float(log_aspect[i]), float(alpha[j]), mirrored * float(beta[k]), float(share))
        s = _solved(separation, slip, elements, 2 if log_aspect[i] >= _SLENDER else 1)
        scale = FRICTION * LOAD
        numbers += [s.Fx / scale, mirrored * s.Fy / scale, mirrored * s.Mz / (scale * C), s.slip_ratio]
    return ",".join(short(number) for number in numbers)


def short(number: float) -> str:
    """Return a number with four decimals, without the zero before the point."""
    text = f"{round(number, 4) + 0.0:.4f}"
    return text.replace("0.", ".", 1) if abs(number) < 0.99995 else text
