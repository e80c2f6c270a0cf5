"""The command `inp`: run input files of CONTACT, compare with its printed results, write tables and element files."""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console

from contact import inp as files
from contact.cli.output import NOT_TRUSTED, reported, require_extra
from contact.cli.progress import progress_bar
from contact.cli.tables import show_table
from contact.errors import ContactError
from contact.inp.columns import SIGNS
from contact.inp.compare import TOLERANCE, Difference
from contact.study.files import csv_of, require_writable

#: Exit status where a difference is above the tolerance.
DIFFERS = 1
_SHOWN = 20
#: Status of results that are not to be trusted.
_DOUBTFUL = ("not converged", "unreachable", "out of range", "doubtful gap")
_ENDINGS = (".csv", ".nc", ".mat")

Given = Annotated[Path, typer.Argument(help="input file of CONTACT (.inp)", show_default=False)]
Fast = Annotated[bool, typer.Option("--fast", help="solve steady rolling by the default methods on strips")]
Cases = Annotated[str | None, typer.Option("--cases", help="only these, like 3-7 or 1,4,9-", metavar="RANGE")]
Out = Annotated[list[Path] | None, typer.Option("--out", help="write .csv, .nc or .mat; may be repeated")]
Signs = Annotated[str, typer.Option("--signs", help="ours (SI, on the wheel) or contact (its names, units and signs)")]
Compare = Annotated[Path | None, typer.Option("--compare", help="printed results of CONTACT (.out, .ref_out)")]
Tolerance = Annotated[
    float, typer.Option("--tolerance", help="of forces over the load, of pressure and approach", min=0.0)
]
Elements = Annotated[Path | None, typer.Option("--contact-mat", help="folder for files of elements as CONTACT's .mat")]
Check = Annotated[bool, typer.Option("--check", help="only read the file and tell what could run")]
Cores = Annotated[
    int, typer.Option("--cores", help="processes for cases that do not continue each other; 0: all", min=0)
]
Memory = Annotated[float, typer.Option("--memory", help="most memory of a case in GB", min=0.01)]


@reported
def inp(
    file: Given,
    *,
    fast: Fast = False,
    cases: Cases = None,
    out: Out = None,
    signs: Signs = "ours",
    compare: Compare = None,
    tolerance: Tolerance = TOLERANCE,
    contact_mat: Elements = None,
    check: Check = False,
    cores: Cores = 1,
    memory: Memory = 4.0,
) -> None:
    """Run an input file of CONTACT: a row for each case and patch, patch 0 is the whole case.

    The exit status is 1 if --compare finds a difference above the tolerance, 3 if a case was refused or has no solution.

    Example:  contact inp tractcurv.inp --cases 1-30 --out curve.csv --signs contact
    """
    if signs not in SIGNS:
        raise ContactError(f"--signs {signs!r} is unknown; allowed: {', '.join(SIGNS)}")
    for path in out or []:
        if require_writable(path, _ENDINGS) != ".csv":
            require_extra("xarray")
    if contact_mat is not None and not contact_mat.is_dir():
        raise ContactError(f"--contact-mat {contact_mat} is not a folder")
    given = files.read(file)
    printed = None if compare is None else files.read_printed(compare)
    wanted = _chosen(given, cases)
    if check:
        _tell(file, given)
        return
    start = time.perf_counter()
    with progress_bar() as show:
        results = files.solve(
            _with_those_before(given, wanted),
            fast=fast,
            workers=cores or os.cpu_count() or 1,
            memory=1e9 * memory,
            fields=contact_mat is not None,
            progress=lambda done, total: show(done / total, f"{done} of {total} cases"),
        )
    results = [result for result in results if result.case.number in wanted]
    rows = files.table(results, signs)
    for path in out or []:
        _write(path, rows)
        typer.echo(f"wrote {path}", err=True)
    if contact_mat is not None:
        written = files.write_elements(results, contact_mat)
        typer.echo(f"wrote {len(written)} files to {contact_mat}", err=True)
    console = Console()
    if not out and compare is None:
        _show(rows, signs, console)
    told = [(f"refused ({one.refused})" if one.refused else one.status, one.message) for one in results if one.message]
    for kind, count in Counter(kind for kind, _ in told).items():
        first = next(message for other, message in told if other == kind)
        typer.echo(f"contact: {kind}: {count} of {len(results)} cases, first: {first}", err=True)
    typer.echo(f"{len(results)} cases in {time.perf_counter() - start:.2f} s", err=True)
    if printed is not None:
        differences = files.compare(results, printed)
        _show_differences(differences, tolerance, console)
        if differences and differences[0].error > tolerance:
            raise typer.Exit(DIFFERS)
    if any(result.refused or result.status in _DOUBTFUL for result in results):
        raise typer.Exit(NOT_TRUSTED)


def _chosen(given: Sequence[files.Case], cases: str | None) -> set[int]:
    """Return the numbers of the cases that are asked for."""
    known = {case.number for case in given}
    if cases is None:
        return known
    chosen: set[int] = set()
    for part in cases.split(","):
        first, dash, last = part.strip().partition("-")
        try:
            low = int(first) if first else 1
            high = (int(last) if last else max(known, default=0)) if dash else low
        except ValueError:
            raise ContactError(f"--cases {cases!r} is no range; allowed: like 3-7 or 1,4,9-") from None
        chosen |= {number for number in known if low <= number <= high}
    if not chosen:
        raise ContactError(f"--cases {cases!r} has no case of the file; allowed: 1 to {max(known, default=0)}")
    return chosen


def _with_those_before(given: Sequence[files.Case], wanted: set[int]) -> list[files.Case]:
    """Return the cases that are wanted and those that they continue."""
    chains = files.chains_of(given)
    needed: set[int] = set()
    for chain in chains:
        last = max((k for k, (_, case) in enumerate(chain) if case.number in wanted), default=-1)
        needed |= {place for place, _ in chain[: last + 1]}
    return [case for place, case in enumerate(given) if place in needed]


def _write(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    ending = path.suffix.lower()
    if ending == ".csv":
        path.write_text(csv_of(rows), encoding="utf-8")
        return
    columns: dict[str, Any] = {}
    for title in rows[0] if rows else ():
        name = "".join(c if c.isalnum() else "_" for c in title.split(" [")[0]).strip("_")
        values = [row[title] for row in rows]
        if any(isinstance(value, str) for value in values):
            columns[name] = (title, np.array(values, dtype="U"))
        else:
            columns[name] = (title, np.array([np.nan if value is None else float(value) for value in values]))
    if ending == ".mat":
        from scipy.io import savemat

        savemat(path, {name: values for name, (_, values) in columns.items()})
        return
    import xarray

    data = {name: ("row", values, {"long_name": title}) for name, (title, values) in columns.items()}
    xarray.Dataset(data).to_netcdf(path, engine="scipy")


def _show(rows: Sequence[dict[str, Any]], signs: str, console: Console) -> None:
    """Print the main columns of the first rows."""
    names = ("FN [N]", "FX [N]", "FY [N]", "APPROACH [mm]", "PMAX [MPa]", "NCON")
    if signs == "ours":
        names = ("N [N]", "Fx [N]", "Fy [N]", "approach [m]", "max_pressure [Pa]", "n_contact")
    patches = [row for row in rows if row["patch"] or row["refused"] or row["status"] in ("no contact", "checked")]
    cells = [
        [str(row["case"]), str(row["patch"]), row["refused"] or row["status"]]
        + ["" if row[name] is None else f"{row[name]:.5g}" for name in names]
        for row in patches[:_SHOWN]
    ]
    show_table("", [(name, "") for name in ("case", "patch", "status", *names)], cells, console)
    if len(patches) > _SHOWN:
        console.print(f"… and {len(patches) - _SHOWN} more rows; --out writes all")


def _show_differences(differences: Sequence[Difference], tolerance: float, console: Console) -> None:
    headings = [(name, "") for name in ("case", "patch", "quantity", "here", "CONTACT", "difference")]
    rows = [
        [str(one.case), str(one.patch), one.name, f"{one.ours:.6g}", f"{one.theirs:.6g}", f"{one.error:.2e}"]
        for one in differences[:_SHOWN]
    ]
    show_table("differences, worst first", headings, rows, console)
    worst = files.worst_of(differences)
    agree = sum(error <= tolerance for error in worst.values())
    console.print(f"{agree} of {len(worst)} compared cases agree within {tolerance:g}")


def _tell(file: Path, given: Sequence[files.Case]) -> None:
    """Print how many cases the file has and which of them cannot run."""
    typer.echo(f"{file}: {len(given)} cases are read")
    for case in given:
        for note in case.notes:
            typer.echo(f"{case.place}: {note}")
    for reason, found in files.refusals(given).items():
        typer.echo(f"refused ({reason}): {len(found)} cases, first: {found[0]}")
