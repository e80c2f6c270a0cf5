"""`contact.Solver`: a solver whose methods, resolution and memory are prepared once, for use at every time step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import UnionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.core import pack
from contact.errors import ContactError, ModelWarning, require_flag, require_integer, require_number, warn
from contact.friction import Friction, as_friction
from contact.given_force import as_numbers, wanted_force
from contact.inputs.creepage import Creepage, as_creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import APPROACH, ITERATIONS, LOAD, N_ELEMENTS, N_STRIPS
from contact.inputs.plausibility import doubt_alike, doubt_case
from contact.inputs.separation import Separation
from contact.instance import workspace
from contact.instance.case import cases, set_surface
from contact.instance.ownership import OwnsArrays, one_thread, within
from contact.kernels.arrays import SolverArrays
from contact.kernels.enumerations import LoadKind
from contact.kernels.normal.start import MEM_IMAGE
from contact.kernels.solver import derive_contact, solve_contact, solve_contact_under_force
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, GAP_LIMIT_INTERACTING, Method, ReadOnly, lookup
from contact.results import ANSWERS, BEND, BEYOND, CaseForces, Jacobian, Prepared, Solution, Status, doubt_answer
from contact.results.later import STATES
from contact.results.solution import BEND_AT, BEYOND_AT, GAP_ERROR, N_AT, READ_RESULT, STATUS
from contact.view import trace

#: The methods of the thesis and a resolution for them, as arguments of `solve`, `forces`, `Solver` and `WheelRailPair`.
THESIS: Mapping[str, Any] = ReadOnly({"normal": "analyn", "tangential": "fastrip", "n_strips": 30, "n_elements": 30})
#: Default number of separation samples for which a solver allocates memory.
N_SAMPLES = 101


def require_resolution(n_strips: object, n_elements: object) -> tuple[int, int]:
    """Return both as integers in their ranges, or raise a ContactError."""
    return N_STRIPS.require("n_strips", n_strips), N_ELEMENTS.require("n_elements", n_elements)


def require_conformal(tangential: Method) -> None:
    """Raise a ContactError if the tangential method gives forces only, because it then needs a plane contact."""
    if not tangential.fields:
        raise ContactError(f"conformal: tangential = {tangential.name!r} is only for a plane contact")


def require_separation(separation: object, kind: type | UnionType) -> None:
    """Raise a ContactError unless `separation` is one of this kind."""
    if not isinstance(separation, kind):
        if isinstance(getattr(separation, "separation", None), kind):
            raise ContactError(f"separation is a {type(separation).__name__}; use patch.separation")
        raise ContactError(f"separation = {separation!r} is not a contact.Separation")


def require_amount(load: object, approach: object) -> float:
    """Return the load [N] or the approach [m], one of which is given, or raise a ContactError."""
    if (load is None) == (approach is None):
        raise ContactError(f"exactly one of load and approach is needed; load = {load}, approach = {approach}")
    return LOAD.require("load", load) if load is not None else APPROACH.require("approach", approach)


class Solver(OwnsArrays):
    """A prepared solver that owns its memory and can be called many times.

    A call costs the compiled kernel and a few microseconds. A solver serves one thread. A copy, by `copy.copy` or a pickle, has
    memory of its own and starts from the same last solution. The results equal those of `contact.solve`.

    Parameters
    ----------
    normal, tangential : str
        Names from ``contact.methods().batched``. The element-wise half space is only in `contact.solve`.
    n_strips, n_elements : int
        Strips per patch and elements per strip, each 4 to 1000.
    friction : float or contact.friction.Friction
        Coulomb's coefficient mu ≥ 0 [-], or a friction law. A call may give another one.
    material : Material
    speed : float
        Rolling speed [m/s] ≥ 0. A call may give another one.
    conformal : bool
        Let the contact angle vary over the patch, as in `contact.solve`.
    n_samples : int
        Number of separation samples to allocate memory for. A larger separation causes one reallocation.
    max_iterations : int
        Most iterations of the strip half space, 1 to 1000. They cap the time of a call. What is not at rest then is iterated
        as often once more if they are 60 or more. After that the status is NOT_CONVERGED.

    Attributes
    ----------
    arrays : contact.kernels.arrays.SolverArrays
        All arrays, as the kernel uses them.

    Raises
    ------
    ContactError
        For unknown methods or values outside their range.

    Examples
    --------
    >>> import contact
    >>> solver = contact.Solver(tangential="fastrip_mapped", friction=0.35)
    >>> separation = contact.Separation.hertzian(1.1, 0.8)
    >>> solver.solve(separation, contact.Creepage(1e-3), load=80e3).status
    <Status.OK: 1>
    """

    def __init__(
        self,
        *,
        normal: str = DEFAULT_NORMAL,
        tangential: str = DEFAULT_TANGENTIAL,
        n_strips: int = N_STRIPS.usual,
        n_elements: int = N_ELEMENTS.usual,
        friction: float | Friction = 0.3,
        material: Material = STEEL,
        speed: float = 20.0,
        conformal: bool = False,
        n_samples: int = N_SAMPLES,
        max_iterations: int = ITERATIONS.usual,
    ) -> None:
        self.normal = lookup("normal", normal, batched=True)
        self.tangential = lookup("tangential", tangential, batched=True)
        self.n_strips, self.n_elements = require_resolution(n_strips, n_elements)
        self.material, self.conformal = material, require_flag("conformal", conformal)
        if conformal:
            require_conformal(self.tangential)
        self.max_iterations = ITERATIONS.require("max_iterations", max_iterations)
        self.doubted: set[str] | None = set()  # arguments that were told to be unusual; None: they are not judged here
        self.told: set[str] = set()  # for what there was a ModelWarning
        self._coefficients: NDArray[np.float64] | None = None
        problem = cases(
            1, self.normal, self.tangential, material, conformal=conformal, max_iterations=self.max_iterations
        )
        self._allocate(require_integer("n_samples", n_samples, 3), problem)
        within(self.set_surface)(friction, speed)

    def _kept(self) -> Any:
        return (self._friction, self._speed), self._coefficients, self._memory.copy()

    def _keep(self, kept: Any) -> None:
        surface, coefficients, memory = kept
        self.set_surface(*surface)
        if coefficients is not None:
            self.calibrate(coefficients)
        self._memory[:] = memory

    def __repr__(self) -> str:
        return (
            f"Solver({self.normal.name} + {self.tangential.name}, {self.n_strips} strips x {self.n_elements} elements, "
            f"friction {self._friction.static:g})"
        )

    @one_thread
    def set_surface(self, friction: float | Friction, speed: float) -> None:
        """Set the friction [-] and the rolling speed [m/s] for the following calls that do not give their own."""
        surface, velocity = as_friction(friction), require_number("speed", speed, 0.0)
        self._given, self._friction, self._speed = friction, surface, velocity
        set_surface(self._case, self._friction, self._speed)

    def _is_given(self, friction: float | Friction) -> bool:
        """Return whether this is the friction of the last call."""
        return type(friction) is type(self._given) and (friction is self._given or friction == self._given)

    @one_thread
    def forget(self) -> None:
        """Discard the last solution, so that the next call is a cold start even with `warm`."""
        self._memory[:] = 0.0

    @one_thread
    def start_from(self, solution: Solution) -> None:
        """Start the next warm call from `solution`. A solution of another resolution is ignored."""
        if solution.memory.size == self._memory.size:
            self._memory[:] = solution.memory

    @one_thread
    def calibrate(self, table: NDArray[np.float64]) -> None:
        """Use `table` of creepage coefficients (`contact.theory.kalker.constant_table`) instead of that of linear theory."""
        self._coefficients = table
        self._allocate(self._n_samples, self._case)

    def _allocate(self, n_samples: int, problem: NDArray[np.void]) -> None:
        """Allocate the arrays for separations of `n_samples` samples, with what is known of the `problem`."""
        size = self.n_strips, self.n_elements, n_samples
        made = workspace.solver_arrays(self.normal, self.tangential, self.material.poisson_ratio, size)
        if self._coefficients is not None:
            tables = made.workspace.tables._replace(kalker=self._coefficients)
            made = made._replace(workspace=made.workspace._replace(tables=tables))
        self.arrays: SolverArrays = made
        self._packed, self._n_samples = pack(SolverArrays, made), n_samples
        self._case, self._memory = made.case[:1], made.workspace.space.memory
        self._case[:] = problem
        self._member = {name: self._case[name] for name in self._case.dtype.names or ()}
        self._answer = made.result.view(np.uint8).data

    @one_thread
    def solve(
        self,
        separation: Separation,
        creepage: Creepage,
        *,
        load: float | None = None,
        approach: float | None = None,
        force: float | tuple[float | None, float | None] | None = None,
        friction: float | Friction | None = None,
        speed: float | None = None,
        warm: bool = False,
        derivatives: bool = False,
        throw: bool = True,
    ) -> Solution:
        """Solve one contact.

        Parameters
        ----------
        separation : Separation
        creepage : Creepage
        load, approach : float
            Normal force [N] ≥ 0, or rigid approach [m]. Give exactly one of them.
        force : float or (float or None, float or None)
            Tangential force Fx, or (Fx, Fy), on the wheel [N], instead of the creepages in its direction, as in
            `contact.solve`.
        friction, speed : optional
            For this and the following calls. Default: unchanged.
        warm : bool
            Start from the last solution. For interacting strips this changes the computing time, and the result within
            the method's tolerance.
        derivatives : bool
            Also find `Solution.jacobian`. Where its strips have no tangent (docs/check/derivatives.md) the solution is iterated
            further, and differs within the method's tolerance.
        throw : bool
            As in `contact.solve`.

        Returns
        -------
        Solution
            A copy; later calls do not change it.

        Raises
        ------
        ContactError
            As `contact.solve`.
        """
        if force is not None and derivatives:
            raise ContactError("derivatives = True does not work with force; solve again with the creepage found")
        creepage = as_creepage(creepage)
        n, found = self._run(True, separation, creepage, load, approach, (friction, speed), warm, derivatives, force)
        if force is not None:
            vx, vy = (float(self._member[name][0]) for name in ("vx", "vy"))
            creepage = replace(creepage, longitudinal=vx, lateral=vy)
        if throw:
            require_trustworthy(STATES[found[STATUS]], separation.y, load, approach)
        self._doubt(found, separation.fit_error)
        prepared = Prepared(self.normal.name, self.tangential.name, self.material, self._speed)
        jacobian = self._jacobian(load) if derivatives else None
        return Solution.of_kernel(found, n, self.arrays, creepage, prepared, jacobian)

    @one_thread
    def trace(self) -> str:
        """Return a table of the iterations of the last solution, for who must understand a status.

        A row has the mean relative change of the strips' lengths that would close the gap at their ends, weighted with their
        loads [-]; the largest move of an end over the width [-]; the approach above first touch; the ends of the panels of
        strips; and what happened, such as a new panel on a lobe. After 64 iterations the last row stands for the last one.
        """
        space, result = self.arrays.workspace.space, self.arrays.result[0]
        made = int(result.iterations)
        of_normal = f"normal = {self.normal.name!r}: {made} iterations"
        if self.normal.interacting:
            of_normal += "\n" + trace.of_strips(space.iterates, made, bool(space.memory[MEM_IMAGE] > 0.0))
        status = STATES[int(result.status)].name
        return f"{of_normal}\ntangential = {self.tangential.name!r}: no iterations; status {status}"

    @one_thread
    def forces(
        self,
        separation: Separation,
        creepage: Creepage,
        *,
        load: float | None = None,
        approach: float | None = None,
        friction: float | Friction | None = None,
        speed: float | None = None,
        warm: bool = False,
        derivatives: bool = False,
    ) -> CaseForces:
        """Return the forces of one contact. Parameters as in `solve`; `status` tells whether they can be trusted."""
        _, found = self._run(False, separation, creepage, load, approach, (friction, speed), warm, derivatives)
        self._doubt(found, separation.fit_error)
        Fx, Fy, Mz, N, approach, pmax, area, slip_area, power, *_ = found
        slip_ratio = slip_area / area if area > 0.0 else 0.0
        jacobian = self._jacobian(load) if derivatives else None
        status, gap_error = STATES[found[STATUS]], found[GAP_ERROR]
        return CaseForces(Fx, Fy, Mz, N, approach, pmax, area, slip_ratio, power, status, gap_error, jacobian)

    def _run(
        self,
        with_fields: bool,
        separation: Separation,
        creepage: Creepage,
        load: float | None,
        approach: float | None,
        surface: tuple[float | Friction | None, float | None],
        warm: bool,
        derivatives: bool,
        force: object = None,
    ) -> tuple[int, tuple[Any, ...]]:
        """Check the arguments, fill the case and call the kernel. Return the number of strips and the numbers of the result."""
        require_separation(separation, Separation)
        creepage, amount = as_creepage(creepage), require_amount(load, approach)
        wanted = None if force is None else as_numbers(wanted_force(force))
        friction, speed = surface
        if speed is not None and type(speed) is not float:
            speed = require_number("speed", speed, 0.0)
        friction = self._given if friction is None or self._is_given(friction) else friction
        if friction is not self._given or (speed is not None and speed != self._speed):
            within(self.set_surface)(friction, self._speed if speed is None else speed)
        if self.doubted is not None:  # a run in time is told once of each
            vector = creepage.longitudinal, creepage.lateral, creepage.spin
            doubt_case(load, approach, vector, self._friction.static, self._speed, self.doubted)
            if "coupling" not in self.doubted:
                self.doubted.add("coupling")
                doubt_alike(self.material.coupling)
        if separation.y.size > self._n_samples:
            self._allocate(separation.y.size, self._case)
        member = self._member
        member["load_kind"][0] = LoadKind.APPROACH if load is None else LoadKind.LOAD
        member["amount"][0] = amount
        member["vx"][0], member["vy"][0], member["phi"][0] = creepage.longitudinal, creepage.lateral, creepage.spin
        member["rolling"][0] = separation.rolling
        if not warm:
            self._memory[0] = 0.0
        if derivatives:
            n = derive_contact(separation.packed, with_fields, self._packed)
        elif wanted is not None:
            n = solve_contact_under_force(separation.packed, self._packed, *wanted)
        else:
            n = solve_contact(separation.packed, with_fields, self._packed)
        return n, READ_RESULT(self._answer)

    def _doubt(self, found: tuple[Any, ...], fit_error: float) -> None:
        """Warn of an answer that no wheel has, or that leaves something out, once of each."""
        if (  # this is asked at every call, so all at once
            found[GAP_ERROR] <= self.normal.gap_limit
            and found[BEND_AT] <= BEND
            and found[BEYOND_AT] <= BEYOND
            and found[N_AT] <= ANSWERS["N"].largest
            and fit_error <= GAP_LIMIT_INTERACTING
        ):
            return
        doubt_answer(
            self.told, self.normal.gap_limit, self.conformal, N=found[N_AT], bend=found[BEND_AT], gap_error=found[GAP_ERROR],
            beyond=found[BEYOND_AT], fit_error=fit_error,
        )  # fmt: skip

    def _jacobian(self, load: float | None) -> Jacobian:
        """Return a copy of the derivatives of the last solution."""
        values = self.arrays.slopes.copy()
        values.setflags(write=False)
        return Jacobian(values, "approach" if load is None else "load")


def require_trustworthy(status: Status, y: NDArray[np.float64], load: float | None, approach: float | None) -> None:
    """Raise a ContactError if `status` is OUT_OF_RANGE or NOT_CONVERGED. Warn of a load without contact."""
    if load and status is Status.NO_CONTACT:
        warn(
            f"load = {load:g}: its approach is within the round-off of the gap over y = [{y[0]:g}, {y[-1]:g}] m, so "
            f"{status.message}",
            ModelWarning,
        )
    if status in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED):
        what, amount = ("load", load) if load is not None else ("approach", approach)
        raise ContactError(
            f"{what} = {amount:g}: {status.message}; y = [{y[0]:g}, {y[-1]:g}] m "
            f"(throw=False returns the solution with this status)"
        )
