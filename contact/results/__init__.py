"""What the solvers return: `Solution` with the fields of one patch, `Forces` of arrays of cases, `Jacobian`."""

from contact.results.doubts import ANSWERS, BEND, BEYOND, doubt_answer, doubt_step
from contact.results.jacobian import Jacobian, PairJacobian
from contact.results.resultants import CaseForces, Forces
from contact.results.solution import Prepared, Solution, Status, Strips

__all__ = [
    "ANSWERS",
    "BEND",
    "BEYOND",
    "CaseForces",
    "Forces",
    "Jacobian",
    "PairJacobian",
    "Prepared",
    "Solution",
    "Status",
    "Strips",
    "doubt_answer",
    "doubt_step",
]
