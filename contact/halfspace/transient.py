"""Shift and transient rolling, step by step, on the element-wise half space (other_contacts.md).

A step moves the contact by the distance D and the bodies against each other. The shift of the surfaces against each other
in the step is, over D (Kalker 1990),

    s(x) = w(x + D/6) + [C q(x) - C q'(x + D)]/D,

with the traction q' before the step. Coulomb's law holds for s as in steady rolling (`contact.halfspace.newton`). The
operator C is symmetric here. A particle that enters the contact within the step, because D is longer than an element, has
only the share (x_lead - x)/D of the rigid slip, and the displacement at x_lead, one element ahead of the leading one.

In a pure shift the contact does not move: s(x) = W + C q(x) - C q'(x) in metres. `contact.halfspace.step` solves a step.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array
from contact.errors import ContactError, require_number, require_pair
from contact.friction import Friction
from contact.given_force import wanted_force
from contact.halfspace.gap import Division, Gap
from contact.halfspace.lattice import bent_rows
from contact.halfspace.local_law import LocalLaw, of_each_element
from contact.halfspace.norm import Normal, norm
from contact.halfspace.solution import GridSolution, PressedRecord, assemble
from contact.halfspace.solve import grid_of, status_of
from contact.halfspace.state import State
from contact.halfspace.step import Stepper
from contact.halfspace.third_body import ThirdBody
from contact.halfspace.unlike import Coupling
from contact.inputs.creepage import Creepage, as_creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import APPROACH, LOAD
from contact.inputs.plausibility import doubt_rolling
from contact.inputs.separation import Separation
from contact.instance.ownership import OwnsArrays, one_thread, within
from contact.results import Status, doubt_step

Force = float | tuple[float | None, float | None]  # (Fx, Fy) on the wheel [N]; None where the motion is given
_KEPT = ("_amount", "_gap", "_grid", "_state", "_normal", "_pressed", "distance", "speed", "friction", "law", "_local")
#: Turns between pressure and traction of unlike bodies.
_TURNS = 40


class Transient(OwnsArrays):
    """A contact that is shifted and rolled in steps, with its traction.

    It serves one thread. A copy (`copy.copy`, a pickle) continues from the same traction.

    Parameters
    ----------
    separation : Separation or contact.halfspace.Gap
        Undeformed gap.
    load, approach : float
        Normal force [N], positive, or rigid approach [m]; exactly one of them. A step may have another one; on a separation
        a load must not exceed this one.
    friction : float, contact.friction.Friction or contact.halfspace.LocalLaw
        Coefficient mu ≥ 0 [-], a law over the global velocity, or one over the velocity of each element.
    material : Material
    speed : float
        Rolling speed V [m/s] ≥ 0; it only scales velocities and powers, and friction laws.
    spacing : float or (float, float)
        Size (dx, dy) of the elements [m]. Default: 40 × 40 elements over the undeformed overlap of a separation.
    layer : contact.ThirdBody
        Layer between the bodies. Its plastic shear stays with the particles.
    turns : int
        Most turns between pressure and traction of unlike bodies, 1 to 1000. With 1 the traction does not change the pressure.
    normal : callable
        Solves the normal problem, with the arguments of `contact.halfspace.norm`; another one may give a pressure.

    Attributes
    ----------
    distance : float
        Distance rolled since the start [m].

    Raises
    ------
    ContactError
        For arguments outside their range.

    Examples
    --------
    >>> import contact
    >>> contact_patch = contact.Transient(contact.Separation.hertzian(1.1, 0.8), load=80e3, spacing=0.5e-3)
    >>> held = contact_patch.shift(longitudinal=-5e-6)
    >>> rolled = [contact_patch.roll(contact.Creepage(1e-3), distance=0.5e-3) for _ in range(20)]
    >>> held.Fx > 0.0 > rolled[-1].Fx
    True
    """

    def __init__(
        self,
        separation: Separation | Gap,
        *,
        load: float | None = None,
        approach: float | None = None,
        friction: float | Friction | LocalLaw = 0.3,
        material: Material = STEEL,
        speed: float = 20.0,
        spacing: float | tuple[float, float] | None = None,
        layer: ThirdBody | None = None,
        turns: int = _TURNS,
        normal: Callable[..., Normal] = norm,
        progress: Callable[[int, float], None] | None = None,
    ) -> None:
        if not isinstance(separation, Separation | Gap):
            raise ContactError(f"separation = {separation!r} is not a contact.Separation")
        if (load is None) == (approach is None):
            raise ContactError(f"exactly one of load and approach is needed; load = {load}, approach = {approach}")
        if layer is not None and not isinstance(layer, ThirdBody):
            raise ContactError(f"layer = {layer!r} is not a contact.ThirdBody")
        if load is not None:
            self._amount = {"load": require_number("load", load, *LOAD.bounds, open_minimum=True)}
        else:
            self._amount = {"approach": APPROACH.require("approach", approach)}
        self._set_friction(friction)
        self.material = material
        self.speed, self._progress = require_number("speed", speed, 0.0), progress
        self._norm, self.layer, self._turns = normal, layer, int(require_number("turns", turns, 1, 1000))
        division = Division(40, 40, None if spacing is None else require_pair("spacing", spacing))
        grid = separation if isinstance(separation, Gap) else grid_of(separation, load, approach, material, division)
        if grid is None:
            raise ContactError(f"approach = {approach}: the bodies do not touch; a grid needs contact or a Gap")
        self._gap: Separation | Gap = separation
        self._largest = LOAD.most if load is None or isinstance(separation, Gap) else load
        self._grid = grid
        self._stepper = self._prepared()
        self._state = self._stepper.fresh()
        self._normal: Normal | None = None
        self._pressed: Any = None
        self.distance, self.told = 0.0, set[str]()  # for what there was a warning

    def _kept(self) -> Any:
        return {name: self.__dict__[name] for name in _KEPT}

    def _keep(self, kept: Any) -> None:
        self.__dict__.update(kept)
        self._stepper = self._prepared()

    def _set_friction(self, friction: float | Friction | LocalLaw) -> None:
        """Set the law of friction; `law` is that of each element."""
        self.law, self.friction, self._local = of_each_element(friction)

    @one_thread
    def shift(
        self,
        longitudinal: float = 0.0,
        lateral: float = 0.0,
        rotation: float = 0.0,
        *,
        load: float | None = None,
        approach: float | None = None,
        force: Force | None = None,
        gap: Gap | None = None,
    ) -> GridSolution:
        """Shift the wheel against the rail without rolling, and return the solution.

        Parameters
        ----------
        longitudinal, lateral : float
            Rigid shift of the wheel against the rail at the origin [m].
        rotation : float
            About the normal [rad].
        load, approach : float
            Normal force [N] ≥ 0 or approach [m] of this and the following steps.
        force : float or (float, float)
            Tangential force Fx, or (Fx, Fy), on the wheel [N] after the step, instead of the shift in its direction; None in
            a pair where the shift is given. The shift found is the solution's `creepage`.
        gap : Gap
            Undeformed gap of this and the following steps, on elements of the same size. Its grid may be moved by whole
            elements.

        Returns
        -------
        GridSolution
            `sx`, `sy` are the distances slipped [m], `power_per_metre` is the work of friction in this step [J].
        """
        numbers = {"longitudinal": longitudinal, "lateral": lateral, "rotation": rotation}
        moved = Creepage(*(require_number(name, value) for name, value in numbers.items()))
        within(self.take)(load, approach, gap)
        return self._step(moved, 0.0, force)

    @one_thread
    def roll(
        self,
        creepage: Creepage,
        *,
        distance: float,
        load: float | None = None,
        approach: float | None = None,
        force: Force | None = None,
        gap: Gap | None = None,
        sliding: bool = False,
    ) -> GridSolution:
        """Roll by `distance` [m], and return the solution.

        Parameters
        ----------
        creepage : Creepage
            Wheel minus rail over V, constant in the step.
        distance : float
            Rolled in this step [m], positive, not longer than the grid. One element is best: much shorter steps make the
            traction uneven, and a `ModelWarning` tells steps of more than an element and a tenth of the contact's length.
        load, approach, force, gap :
            As for `shift`; with a force, the creepage in its direction is found.
        sliding : bool
            Friction that falls may have several solutions: search from fast sliding, not from rest.

        Returns
        -------
        GridSolution
            `sx`, `sy` are the slip velocities over V, averaged over the step.
        """
        step = require_number("distance", distance, 0.0, self.longest_step, open_minimum=True)
        within(self.take)(load, approach, gap)
        solution = self._step(as_creepage(creepage), step, force, sliding)
        doubt_step(self.told, step, self._stepper.dx, int(np.count_nonzero(self._state.p.any(axis=0))))
        self.distance += step
        return solution

    @one_thread
    def roll_on(
        self,
        creepage: Creepage,
        *,
        load: float | None = None,
        approach: float | None = None,
        force: Force | None = None,
        gap: Gap | None = None,
    ) -> GridSolution:
        """Roll until nothing changes any more, and return the solution of steady rolling. Arguments as for `roll`."""
        within(self.take)(load, approach, gap)
        return self._step(as_creepage(creepage), math.inf, force)

    @one_thread
    def forget(self, *, keep_pressure: bool = False) -> None:
        """Discard traction, plastic shear and the memory of friction: the next step starts from untouched bodies.

        With `keep_pressure` the bodies have been pressed together as they are, without traction.
        """
        p = self._state.p
        self._state = self._stepper.fresh()
        if keep_pressure:
            self._state = replace(self._state, p=p)

    @property
    def state(self) -> State:
        """What the last step has left behind, for `restore`."""
        return self._state

    @one_thread
    def restore(self, state: State) -> None:
        """Go back to what a step before has left behind."""
        self._state = state

    @one_thread
    def change(
        self,
        *,
        friction: float | Friction | LocalLaw | None = None,
        speed: float | None = None,
        slip: ArrayLike | None = None,
    ) -> None:
        """Set another law of friction, rolling speed [m/s] or rigid slip for the steps that follow.

        `slip` is added to the rigid slip of each element, over V, in a shift in metres: shape (2, ny, nx); 0 is none.
        """
        if friction is not None:
            self._set_friction(friction)
        if speed is not None:
            self.speed = require_number("speed", speed, 0.0)
        last, self._stepper = self._stepper.slip, self._prepared()
        self._stepper.slip = last
        if slip is not None:
            wanted, field = (2, *self._grid.h.shape), as_array("slip", slip)
            if field.shape not in ((), wanted) or not np.isfinite(field).all():
                raise ContactError(f"slip has shape {field.shape}; finite numbers of shape {wanted} are needed")
            self._stepper.slip = field

    @property
    def displacement(self) -> tuple[Array, Array]:
        """Elastic displacement of the wheel's surface against the rail's along x and y [m], on the fields of `grid`."""
        ux, uy = self._stepper.displaced(self._state.traction, 0.0)
        if self._stepper.coupling is not None:
            added = self._stepper.coupling.displacement(self._state.p)
            ux, uy = ux + added[0], uy + added[1]
        return ux, uy

    @property
    def grid(self) -> tuple[Array, Array]:
        """Centres x, y of all elements [m]."""
        return self._grid.x, self._grid.y

    @property
    def longest_step(self) -> float:
        """Largest distance of a step [m]: the length of the grid."""
        return float(self._grid.x.size * (self._grid.x[1] - self._grid.x[0]))

    @property
    def traction(self) -> Array:
        """Traction on the wheel of all elements [Pa], shape (2, ny, nx)."""
        return self._state.traction

    @property
    def coupling(self) -> Coupling | None:
        """Coupling of pressure and traction; None for like bodies."""
        return self._stepper.coupling

    @property
    def pressure(self) -> Array:
        """Pressure of all elements [Pa]."""
        return self._state.p

    def _prepared(self) -> Stepper:
        x, y = self._grid.x, self._grid.y
        return Stepper(x, y, self.material, self.layer, self.law, self.speed, self._turns, self._progress)

    @one_thread
    def take(self, load: float | None = None, approach: float | None = None, gap: Gap | None = None) -> None:
        """Take another load [N], approach [m] or gap for the steps that follow, as `shift` and `roll` do."""
        if load is not None and approach is not None:
            raise ContactError(f"of load and approach only one may be given; load = {load}, approach = {approach}")
        if load is not None:
            self._amount = {"load": require_number("load", load, 0.0, self._largest)}
        elif approach is not None:
            self._amount = {"approach": APPROACH.require("approach", approach)}
        if gap is None:
            return
        if not isinstance(gap, Gap):
            raise ContactError(f"gap = {gap!r} is not a contact.halfspace.Gap")
        old = self._grid
        if not (math.isclose(gap.dx, old.dx, rel_tol=1e-6) and math.isclose(gap.dy, old.dy, rel_tol=1e-6)):
            raise ContactError(f"gap has elements of {gap.dx:g} × {gap.dy:g} m; allowed: {old.dx:g} × {old.dy:g} m")
        over = [(new[0] - before[0]) / step for new, before, step in ((gap.x, old.x, old.dx), (gap.y, old.y, old.dy))]
        columns, rows = (round(value) for value in over)
        if abs(over[0] - columns) > 1e-3 or abs(over[1] - rows) > 1e-3:
            raise ContactError(f"gap is moved by {over[0]:g} × {over[1]:g} elements; allowed: whole ones")
        self._gap = self._grid = gap
        self._normal = None
        if (columns, rows) != (0, 0) or gap.h.shape != old.h.shape:
            last, self._stepper = self._state, self._prepared()
            self._state = last.placed(self._stepper.fresh(), rows, columns)

    def _press(self, opening: Array | None, start: Array | None) -> Normal:
        """Return the normal solution for an opening of the gap by traction [m]; without one the last is kept."""
        grid, fixed = self._grid, opening is None
        if fixed and self._normal is not None and self._pressed == self._amount:
            return self._normal
        if self._amount.get("load") == 0.0:
            found = Normal(np.zeros(grid.h.shape), float(grid.h.min()), 0.0, 0, True)
        else:
            h = grid.h if opening is None else grid.h + opening
            more: dict[str, Any] = {} if opening is None else {"tolerance": 1e-7, "start": start}
            found = self._norm(h, grid.dx, grid.dy, self.material, **self._amount, **more)
        if fixed:
            self._normal, self._pressed = found, self._amount
        return found

    def _step(self, motion: Creepage, distance: float, force: Force | None, sliding: bool = False) -> GridSolution:
        """Return the solution of one step; `distance` 0 is a shift, then everything is in metres instead of over V."""
        grid, friction = self._grid, self.friction
        if isinstance(self._gap, Separation):  # a gap on a grid may be of another scale
            doubt_rolling(self._amount, motion, distance, friction.static, self.speed, self.told)
        mu = None if self._local else friction.static
        if mu is not None and distance > 0.0:
            mu = float(friction.coefficient(self.speed * math.hypot(motion.longitudinal, motion.lateral)))
        factor = friction.factor(grid.y)[:, None] if friction.gauge_factor != 1.0 else 1.0
        given = (None, None) if force is None else wanted_force(force)
        self._stepper.progress = self._progress
        if self.law.warmth is not None and not math.isinf(distance):
            raise ContactError("friction.warmth: a step follows no temperature; allowed: roll_on")
        outcome = self._stepper.solve(self._state, motion, distance, self._press, factor, mu, given, sliding)
        self._state = outcome.state
        normal, found = outcome.normal, outcome.tangential
        status = status_of(self._gap, normal.p, grid.y, normal.converged and found.converged and outcome.converged)
        if any(each is not None for each in given) and not found.converged and normal.p.any():
            status = Status.UNREACHABLE
        return assemble(
            grid.x,
            grid.y,
            normal.p,
            found,
            bent_rows(grid, outcome.creepage),
            PressedRecord(normal.approach, normal.stiffness, normal.iterations, status),
            creepage=outcome.creepage,
            friction=friction.static if mu is None else mu,
            material=self.material,
            speed=self.speed,
            layer=outcome.sheared,
        )
