"""`contact.compare`: methods side by side on the same problems."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from time import perf_counter
from typing import Any

from contact.creepage import Creepage
from contact.errors import ContactError
from contact.halfspace.gap import least
from contact.separation import Separation
from contact.solution import Solution
from contact.solve import solve
from contact.solver import N_ELEMENTS, N_STRIPS
from contact.study.case import Case
from contact.study.comparison import Comparison
from contact.study.errors import errors_against
from contact.study.pairs import REFERENCE, SELECTION, Pair, pairs_of
from contact.study.row import Row

#: Rows and columns of the reference: creep forces within 0.002 mu N of those on a much finer grid, at 0.1 s a case.
REFERENCE_ELEMENTS = 80
#: A solve is repeated until it has taken this long in all, and this often at most.
_TIMED, _REPEATS = 0.03, 50
#: Share of the area below which there is no stick: slip is summed over the elements.
_ROUND_OFF = 1e-12

Progress = Callable[[float, str], None]


def compare(
    cases: Case | Sequence[Case],
    methods: str | Iterable[str | tuple[str, str]] = SELECTION,
    *,
    reference: bool = True,
    n_strips: int = N_STRIPS,
    n_elements: int = N_ELEMENTS,
    reference_elements: int = REFERENCE_ELEMENTS,
    progress: Progress | None = None,
) -> Comparison:
    """Solve the same problems with several methods, and measure each against the element-wise half space.

    Parameters
    ----------
    cases : Case or sequence of Case
    methods : str, or iterable of str or (str, str)
        Pairs of a normal and a tangential method: ``"analyn+fastrip"`` or ``("analyn", "fastrip")``; ``"all"`` for every
        pair. Default: `contact.study.SELECTION`.
    reference : bool
        Solve with ``halfspace+halfspace`` too and give the errors against it.
    n_strips, n_elements : int
        Resolution of the methods, as in `contact.solve`.
    reference_elements : int
        Rows and columns of the half space over the undeformed overlap, 4 to 1000, of which contact takes about 0.7 each way;
        also of its tangential part on the pressure of another method.
    progress : callable
        Given the share that is done, 0 to 1, and what is being solved.

    Returns
    -------
    Comparison
        One row a case and pair, the reference first, with every solution; exports and pictures.

    Raises
    ------
    ContactError
        No case or no pair, two cases of one name, input that `contact.solve` refuses. A case that a method cannot solve is
        an answer: the row's status says so.
    """
    listed = _named([cases] if isinstance(cases, Case) else list(cases))
    pairs = pairs_of(methods)
    if reference:
        pairs = (REFERENCE, *(pair for pair in pairs if pair != REFERENCE))
    if not pairs:
        raise ContactError("methods is empty; at least one pair is needed")
    if not isinstance(reference_elements, int) or not 4 <= reference_elements <= 1000:
        raise ContactError(
            f"reference_elements = {reference_elements!r} is not an integer in the allowed range [4, 1000]"
        )
    rows, solutions = [], []
    total, done = len(listed) * len(pairs), 0
    for case in listed:
        true = None
        for pair in pairs:
            what = f"{case.name}: {pair}"
            on_grid = pair.tangential == REFERENCE.tangential
            division = (reference_elements,) * 2 if on_grid else (n_strips, n_elements)
            solution, seconds = timed(case, pair, division, _inner(progress, done / total, what))
            if pair == REFERENCE and reference:
                true = solution
            rows.append(_row(case, pair, solution, seconds, true))
            solutions.append(solution)
            done += 1
    if progress is not None:
        progress(1.0, "done")
    return Comparison(listed, pairs, tuple(rows), tuple(solutions))


def timed(
    case: Case, pair: Pair, division: tuple[int, int], progress: Callable[[int, float], None] | None = None
) -> tuple[Solution, float]:
    """Solution and the least time [s] of a warm `contact.solve`, fields included."""
    options: dict[str, Any] = {"normal": pair.normal, "tangential": pair.tangential, "throw": False}
    # kernels are compiled or loaded
    solve(Separation.hertzian(1.0, 1.0), Creepage(1e-3), load=1e4, **options, n_strips=8, n_elements=8)
    options |= dict(zip(("n_strips", "n_elements"), division, strict=True))
    least, spent, repeats = math.inf, 0.0, 0
    while spent < _TIMED and repeats < _REPEATS:
        start = perf_counter()
        solution = solve(**case.arguments, **options, progress=progress)
        seconds = perf_counter() - start
        least, spent, repeats = min(least, seconds), spent + seconds, repeats + 1
    return solution, least


def _row(case: Case, pair: Pair, s: Solution, seconds: float, true: Solution | None) -> Row:
    stick = s.area - s.slip_area if s.slip_area < (1.0 - _ROUND_OFF) * s.area else 0.0
    return Row(
        case=case.name,
        normal=pair.normal,
        tangential=pair.tangential,
        status=s.status.name,
        N=s.N,
        approach=s.approach,
        Fx=s.Fx,
        Fy=s.Fy,
        Mz=s.Mz,
        max_pressure=s.max_pressure,
        area=s.area,
        adhesion_area=stick if s.has_fields else None,
        time=seconds,
        errors=None if true is None or true is s else errors_against(true, s, least(case.separation)),
    )


def _named(cases: list[Case]) -> tuple[Case, ...]:
    """The cases, those without a name numbered."""
    if not cases or not all(isinstance(case, Case) for case in cases):
        raise ContactError("cases holds something else than contact.Case, or nothing")
    named = tuple(case if case.name else replace(case, name=f"case {k}") for k, case in enumerate(cases, 1))
    for k, case in enumerate(named):
        if case.name in [other.name for other in named[:k]]:
            raise ContactError(f"cases: two are called {case.name!r}")
    return named


def _inner(progress: Progress | None, share: float, what: str) -> Callable[[int, float], None] | None:
    """Tell `progress` of the start of a solve, and return what the half space tells of its steps."""
    if progress is None:
        return None
    progress(share, what)

    def tell(step: int, residual: float) -> None:
        progress(share, f"{what}, step {step}, residual {residual:.0e}")

    return tell
