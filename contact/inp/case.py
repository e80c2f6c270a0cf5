"""`Case`, one case of an input file with everything that is in force, by CONTACT's names and in SI units."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from contact.errors import ContactError


@dataclass(frozen=True)
class Case:
    """One case.

    Attributes
    ----------
    number : int
        Number of the case, as CONTACT counts it.
    module : int
        1 wheel on rail, 3 a single contact.
    element, problem : int
        Result element and contact problem, 0 and 1 if none is given. Each has its own memory.
    digits : dict
        Control digits by letter: C1, P, B, T, N, F, S, V, L, D, C3, M, Z, E, M2, WEIGHTING, X, H, G, I, A, O, W, R.
    values : dict
        Numbers in force by name, in SI units: those of this case and those that it keeps. Names of files are paths.
    lines : dict
        Line of the file from which each value comes.
    fresh : frozenset
        Names of the values that this case itself gives.
    file : Path
    line : int
        Line of the first control word.
    notes : tuple of str
        What the program changes or warns of.
    """

    number: int
    module: int
    element: int
    problem: int
    digits: dict[str, int]
    values: dict[str, Any] = field(repr=False)
    lines: dict[str, int] = field(repr=False, compare=False)
    fresh: frozenset[str] = field(repr=False)
    file: Path = field(compare=False)
    line: int = field(compare=False)
    notes: tuple[str, ...] = field(default=(), compare=False)

    def __getitem__(self, name: str) -> Any:
        """Return a value in force [SI]. A ContactError names the case and what is missing."""
        try:
            return self.values[name]
        except KeyError:
            raise ContactError(f"{self.place}: {name} is not given, in this case or before it") from None

    def get(self, name: str, default: Any = None) -> Any:
        """Return a value in force [SI], or `default`."""
        return self.values.get(name, default)

    @property
    def place(self) -> str:
        """File, line and number of the case, for messages."""
        return f"{self.file}, line {self.line}, case {self.number}"

    @property
    def memory(self) -> tuple[int, int, int]:
        """Module, element and problem: cases of equal memory follow each other."""
        return self.module, self.element, self.problem

    @property
    def continues(self) -> bool:
        """Whether the state of the last case of the same memory is where this one starts."""
        first_state = self.digits["P"] in (0, 1, 3)
        return first_state and self.digits["T"] in (1, 2)

    def changed(self, digits: dict[str, int] | None = None, **values: Any) -> Case:
        """Return the case with other digits and values [SI]."""
        return replace(
            self,
            digits={**self.digits, **(digits or {})},
            values={**self.values, **values},
            fresh=self.fresh | set(values),
        )

    def solve(self, **options: Any) -> Any:
        """Solve this case alone; see `contact.inp.solve` for the options. The result is a `contact.inp.Result`."""
        from contact.inp.run import solve

        return solve([self], **options)[0]
