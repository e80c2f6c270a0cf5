"""`contact.compare`: several methods on the same problems."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from time import perf_counter
from typing import Any

from contact.errors import ContactError, require_integer
from contact.halfspace.gap import least
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation
from contact.results import Solution
from contact.solve import solve
from contact.study.case import Case
from contact.study.comparison import Comparison
from contact.study.errors import errors_against
from contact.study.pairs import REFERENCE, RESOLUTION, SELECTION, Pair, pairs_of
from contact.study.row import Row

#: Rows and columns of the reference. Creep forces are within 0.002 mu N of those on a much finer grid; a case takes 0.1 s.
REFERENCE_ELEMENTS = 80
#: For its timing, a solution is repeated until the total is this long [s], at most this often.
_TIMED, _REPEATS = 0.03, 50
#: A stick area below this share of the area is round-off of the sum of the slip area.
_ROUND_OFF = 1e-12

Progress = Callable[[float, str], None]


def compare(
    cases: Case | Sequence[Case],
    methods: str | Iterable[str | tuple[str, str]] = SELECTION,
    *,
    reference: bool = True,
    n_strips: int = RESOLUTION,
    n_elements: int = RESOLUTION,
    reference_elements: int = REFERENCE_ELEMENTS,
    progress: Progress | None = None,
) -> Comparison:
    """Solve the same problems with several methods and return their errors against the element-wise half space.

    Parameters
    ----------
    cases : Case or sequence of Case
    methods : str, or iterable of str or (str, str)
        Pairs of a normal and a tangential method, like ``"analyn+fastrip"`` or ``("analyn", "fastrip")``. ``"all"`` means
        every pair. Default: `contact.study.SELECTION`.
    reference : bool
        Also solve with ``halfspace+halfspace``, and compute the errors against it.
    n_strips, n_elements : int
        Resolution of the methods, as in `contact.solve`.
    reference_elements : int
        Rows and columns of the half space over the undeformed overlap, 4 to 1000; the contact takes about 0.7 of it in each
        direction. They are also used for its tangential part on the pressure of another method.
    progress : callable
        Called with the share done, 0 to 1, and the name of the present case and pair.

    Returns
    -------
    Comparison
        One row per case and pair, the reference first, with all solutions.

    Raises
    ------
    ContactError
        If there is no case or no pair, two cases have the same name, or `contact.solve` refuses the input. If a method
        cannot solve a case, only the status of its row tells.

    Examples
    --------
    >>> import contact
    >>> case = contact.Case(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3), load=80e3)
    >>> found = contact.compare(case, ["analyn+fastrip", "hertz+fastsim"], reference=False)
    >>> [row.tangential for row in found.rows]
    ['fastrip', 'fastsim']
    """
    listed = _named([cases] if isinstance(cases, Case) else list(cases))
    pairs = pairs_of(methods)
    if reference:
        pairs = (REFERENCE, *(pair for pair in pairs if pair != REFERENCE))
    if not pairs:
        raise ContactError("methods is empty; at least one pair is needed")
    require_integer("reference_elements", reference_elements, 4, 1000)
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
    """Return the solution and the least time [s] of `contact.solve`, fields included, without compilation."""
    options: dict[str, Any] = {"normal": pair.normal, "tangential": pair.tangential, "throw": False}
    # compile or load the kernels first
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
    """Return the cases. Those without a name are numbered."""
    if not cases or not all(isinstance(case, Case) for case in cases):
        raise ContactError("cases is empty or holds an object that is not a contact.Case")
    named = tuple(case if case.name else replace(case, name=f"case {k}") for k, case in enumerate(cases, 1))
    for k, case in enumerate(named):
        if case.name in [other.name for other in named[:k]]:
            raise ContactError(f"cases: two have the name {case.name!r}")
    return named


def _inner(progress: Progress | None, share: float, what: str) -> Callable[[int, float], None] | None:
    """Report the start of a solution to `progress`. Return the callback for the steps of the half space."""
    if progress is None:
        return None
    progress(share, what)

    def tell(step: int, residual: float) -> None:
        progress(share, f"{what}, step {step}, residual {residual:.0e}")

    return tell
