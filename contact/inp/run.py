"""Run cases: those that continue each other in order, others at once."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from typing import Any

from contact.errors import ContactError, ModelWarning, PlausibilityWarning
from contact.inp.case import Case
from contact.inp.reasons import REASONS, RefusedError
from contact.inp.results import Result
from contact.inp.single import MEMORY, Single, require_supported

Progress = Callable[[int, int], None]


def solve(
    cases: Sequence[Case],
    *,
    fast: bool = False,
    workers: int = 1,
    memory: float = MEMORY,
    fields: bool = False,
    progress: Progress | None = None,
) -> list[Result]:
    """Solve cases, by default as the file asks for: by the half space, on the grid and in the order of the file.

    Parameters
    ----------
    cases : sequence of Case
        As `contact.inp.read` returns them.
    fast : bool
        Solve steady rolling by the default methods on strips instead, without a grid.
    workers : int
        Number of processes, for cases that do not continue each other.
    memory : float
        Most memory of a case [bytes].
    fields : bool
        Keep the fields of the elements, for `write_elements`; of single contacts by the half space.
    progress : callable
        Called with the numbers of cases that are done and of all.

    Returns
    -------
    list of Result
        In the order of the cases. A case that cannot run has the status "refused", a named reason and a message.
    """
    if not isinstance(cases, Sequence) or not all(isinstance(case, Case) for case in cases):
        raise ContactError(f"cases = {cases!r} are no cases; contact.inp.read(path) returns those of a file")
    chains, results, done = chains_of(cases), {}, 0
    if workers > 1 and len(chains) > 1:
        parts = _parts(chains, 4 * workers)
        with ProcessPoolExecutor(workers) as pool:
            for part, found in zip(
                parts, pool.map(partial(_run, fast=fast, memory=memory, fields=fields), parts), strict=True
            ):
                for (k, _), result in zip(part, found, strict=True):
                    results[k] = result
                done += len(part)
                if progress is not None:
                    progress(done, len(cases))
    else:
        # the cases of the file, those of a chain one after the other
        order = [one for chain in chains for one in chain]
        for k, result in zip((k for k, _ in order), _each(order, fast, memory, fields), strict=True):
            results[k] = result
            done += 1
            if progress is not None:
                progress(done, len(cases))
    return [results[k] for k in range(len(cases))]


Chain = list[tuple[int, Case]]


def chains_of(cases: Sequence[Case]) -> list[Chain]:
    """Return the cases with their places, in chains: a case that continues another one follows it in its chain."""
    chains: list[Chain] = []
    last: dict[tuple[int, int, int], int] = {}
    for k, case in enumerate(cases):
        if case.continues and case.memory in last:
            chains[last[case.memory]].append((k, case))
        else:
            last[case.memory] = len(chains)
            chains.append([(k, case)])
    return chains


def refusals(cases: Sequence[Case], fast: bool = False) -> dict[str, list[str]]:
    """Return the messages of the cases that cannot run, by reason, as far as their digits and numbers tell."""
    found: dict[str, list[str]] = {}
    for case in cases:
        try:
            if case.module == 1:
                from contact.inp.pair import require_supported as require_pair

                require_pair(case, fast)
            else:
                require_supported(case, fast)
        except RefusedError as error:
            found.setdefault(error.reason, []).append(str(error))
    return found


def _parts(chains: Iterable[Chain], count: int) -> list[Chain]:
    """Return the chains joined to about `count` parts."""
    parts: list[Chain] = [[] for _ in range(count)]
    for chain in chains:
        min(parts, key=len).extend(chain)
    return [part for part in parts if part]


def _run(chain: Chain, fast: bool, memory: float, fields: bool) -> list[Result]:
    """Return the results of a chain, or of several."""
    return list(_each(chain, fast, memory, fields))


def _each(chain: Chain, fast: bool, memory: float, fields: bool) -> Iterator[Result]:
    """Yield the results of a chain, or of several. What does not depend on the case before is kept, as profiles are."""
    runners: dict[tuple[int, int, int], Any] = {}
    broken: set[tuple[int, int, int]] = set()
    for _, case in chain:
        start = time.perf_counter()
        if case.memory not in runners or (case.module == 3 and not case.continues):
            runners[case.memory] = _runner(case, fast, memory, fields)
        if not case.continues:
            broken.discard(case.memory)
        result = _one(case, runners[case.memory], case.memory in broken)
        if result.refused:
            broken.add(case.memory)
        yield replace(result, seconds=time.perf_counter() - start)


def _runner(case: Case, fast: bool, memory: float, fields: bool) -> Any:
    if case.module == 1:
        from contact.inp.pair import PairRunner

        return PairRunner(fast, memory)
    if fast:
        from contact.inp.fast import FastSingle

        return FastSingle()
    return Single(memory, fields)


def _one(case: Case, runner: Any, broken: bool) -> Result:
    if case.digits["R"] in (2, 3):
        return Result(case, status="checked")
    if broken:
        reason = "follows a refused case"
        return Result(case, status="refused", refused=reason, message=f"{case.place}: {REASONS[reason]}")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PlausibilityWarning)
            warnings.simplefilter("ignore", ModelWarning)
            return runner.solve(case)
    except RefusedError as error:
        return Result(case, status="refused", refused=error.reason, message=str(error))
    except ContactError as error:
        return Result(case, status="refused", refused="input", message=f"{case.place}: {error}")
