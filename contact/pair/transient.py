"""`TransientPair`: one wheel on one rail that are shifted and rolled in steps, by the element-wise half space.

Elements keep their places on the rail: rows at multiples of their width along the rail's profile, columns in a shift likewise
along the track, while a rolling contact takes its columns with it. So a patch finds what the step before has left on its
elements, whether it has grown, moved, split or joined another one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from contact.arrays import Array, connected
from contact.errors import ContactError, require_number
from contact.geometry.records import Pose, Velocity
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.halfspace import Normal, Transient, norm
from contact.halfspace.lattice import Lattice
from contact.halfspace.state import State
from contact.halfspace.third_body import ThirdBody
from contact.inputs.creepage import Creepage
from contact.instance.ownership import one_thread
from contact.pair import backwards
from contact.pair.curved import Elements, elements
from contact.pair.halfspace import Given, HalfspacePair, Instant
from contact.pair.solution import PairSolution, Solved

#: Most turns between pressure and traction of unlike bodies.
_TURNS = 40


class Left(NamedTuple):
    """What a step has left on a patch. If it is only `pressed`, no more than the pressure counts.

    Attributes
    ----------
    x, u, s : place of the first element against the contact, along the rail and along its profile [m]
    state : of the elements
    """

    x: float
    u: float
    s: float
    state: State
    pressed: bool = False

    def touched(self) -> tuple[int, int, int, int] | None:
        """Return the first and last column and row that were in contact; None without contact."""
        rows, columns = np.nonzero(self.state.p > 0.0)
        if rows.size == 0:
            return None
        return int(columns.min()), int(columns.max()), int(rows.min()), int(rows.max())


@dataclass(frozen=True)
class _Step:
    """A step: its distance [m], 0 for a shift, infinite for steady rolling."""

    distance: float
    sliding: bool = False


def _parted(pose: Pose, velocity: Velocity | None, given: dict[str, Any]) -> tuple[Instant, Given]:
    """Return the arguments of a step as those of its instant and what is given of height, forces and springs."""
    prescribed = {name: given.pop(name) for name in Given._fields if name in given}
    return Instant.of(pose, velocity, **given), Given(**prescribed)


class TransientPair(HalfspacePair):
    """One wheel on one rail that are shifted and rolled in steps.

    `shift` and `roll` continue from the step before, `roll_on` rolls until nothing changes; `solve` is the same. A call that
    raises leaves the state as it was. Given forces and loads are found as by `HalfspacePair`, each trial from the last state.

    Parameters
    ----------
    pair : SurfacePair
        With the `spacing` of its elements.
    layer : contact.ThirdBody
        Layer between wheel and rail. Its plastic shear stays on the elements.
    conformal : bool
        Take elements on the curved surface between both bodies, with a contact angle for each row, and how they slide on
        each other at each element. The influence of elements on each other stays that of a plane half space.
    true_slip : bool
        Take the latter only: elements in the plane, which slide as the surfaces above and below them do.

    Examples
    --------
    >>> from contact.geometry import profile
    >>> from contact.geometry.surfaces import SurfacePair
    >>> from contact.geometry.wheelset import Pose, Velocity
    >>> from contact.pair import TransientPair
    >>> pair = TransientPair(SurfacePair(profile.s1002(), profile.rail_60e1(), spacing=1e-3))
    >>> held = pair.shift(Pose(), Velocity(0.0, spin=1e-5), load=80e3)
    >>> rolled = [pair.roll(Pose(), Velocity(20.0), distance=1e-3, load=80e3) for _ in range(3)]
    >>> bool(held.force[0] < rolled[-1].force[0] < 0.0)
    True
    """

    def __init__(
        self, pair: SurfacePair, *, layer: ThirdBody | None = None, conformal: bool = False, true_slip: bool = False
    ) -> None:
        super().__init__(pair, layer=layer)
        self.conformal, self.true_slip = bool(conformal), bool(true_slip)
        spacing = self.pair.division.spacing
        if spacing is None:
            raise ContactError("pair.spacing = None: the elements of steps need a size; give the SurfacePair a spacing")
        self._spacing, self.turns = spacing, _TURNS
        self._left: tuple[Left, ...] = ()
        self._now: list[Left] = []
        self._step = _Step(math.inf)

    def _kept(self) -> Any:
        return self._left, self._depth, self._share

    def _keep(self, kept: Any) -> None:
        self._left, self._depth, self._share = kept

    def _begin(self) -> None:
        """Search on from where the last step has ended."""

    @property
    def state(self) -> tuple[Left, ...]:
        """What the last step has left behind, for `restore`."""
        return self._left

    @one_thread
    def restore(self, state: tuple[Left, ...]) -> None:
        """Go back to what a step before has left behind."""
        self._left = state

    @one_thread
    def forget(self, *, keep_pressure: bool = False) -> None:
        """Discard traction, plastic shear and the memory of friction; with `keep_pressure` not the pressure."""
        self._left = tuple(one._replace(pressed=True) for one in self._left) if keep_pressure else ()

    @one_thread
    def shift(self, pose: Pose, moved: Velocity, **given: Any) -> PairSolution:
        """Shift the wheel against the rail without rolling, and return the solution after it.

        Parameters
        ----------
        pose : after the shift
        moved : contact.pair.Velocity
            Displacement of the wheelset in this step in place of its velocity [m], [rad]; so are the rates of `irregularity`
            and `offset`. Without `spin` it rolls.
        **given
            As for `HalfspacePair.solve`, but neither force nor torque; station and rotation are those after the shift, and
            friction may also be a `contact.halfspace.LocalLaw`.

        Returns
        -------
        PairSolution
            Creepages are shifts [m], [rad], `power_per_metre` is the work of friction [J].
        """
        for name in ("force", "torque"):
            if name in given:
                raise ContactError(f"{name} = {given[name]!r}: a shift takes no {name}; it is given by `moved`")
        return self._stepped(_Step(0.0), *_parted(pose, moved, given))

    @one_thread
    def roll(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        distance: float,
        sliding: bool = False,
        **given: Any,
    ) -> PairSolution:
        """Roll by `distance` [m], positive, and return the solution after it.

        `sliding` is as for `contact.Transient.roll`, the other parameters as for `HalfspacePair.solve`; friction may also be a
        `contact.halfspace.LocalLaw`.
        """
        step = _Step(require_number("distance", distance, 0.0, open_minimum=True), sliding)
        return self._stepped(step, *_parted(pose, velocity, given))

    def roll_on(self, pose: Pose, velocity: Velocity | None = None, **given: Any) -> PairSolution:
        """Roll until nothing changes any more: `solve`, after which steps continue."""
        return self.solve(pose, velocity, **given)

    def _given(self, at: Instant, given: Given) -> PairSolution:
        return self._stepped(_Step(math.inf), at, given)

    def _stepped(self, step: _Step, at: Instant, given: Given) -> PairSolution:
        """Return the solution of a step, and keep what it leaves."""
        self._step = step
        found = super()._given(at, given)
        self._left = tuple(self._now)
        return found

    def _place(self, at: Instant) -> None:
        shift = self._step.distance == 0.0
        self.pair.division = self._lattice(at)
        super()._place(at._replace(velocity=Velocity()) if shift else at)

    def _lattice(self, at: Instant) -> Lattice:
        """Return the elements of a step, aligned with those of the largest patch of the last one."""
        (dx, dy), shift = self._spacing, self._step.distance == 0.0
        y, arc = self._profile(at.station)
        if not self._left:
            return Lattice(self._spacing, y, arc, shift)
        m = 1.0 if self.pair.side == "right" else -1.0
        largest = max(self._left, key=lambda one: float(one.state.p.sum()))
        zero = largest.u, m * largest.s
        cover = []
        for one in self._left if self._step.distance < math.inf else ():
            ranges = one.touched()
            if ranges is not None:
                left, right = (k * dx + (one.u - zero[0] if shift else one.x) for k in ranges[:2])
                low, high = sorted(m * (k * dy + one.s) - zero[1] for k in ranges[2:])
                cover.append((left, right, low, high))
        return Lattice(self._spacing, y, arc, shift, zero, tuple(cover))

    def _doubt(self, at: Instant, load: float | None, name: str) -> None:
        if self._step.distance > 0.0:
            super()._doubt(at, load, name)

    def _profile(self, station: float) -> tuple[Array, Array]:
        """Return y and arc length of the rail's profile [m], from y = 0 on; y increases."""
        y, z = self.pair.rail.curves(np.array([station]))[:, 0]
        known = np.isfinite(y)
        y, z = y[known], z[known]
        rising = connected(np.diff(y) > 0.0, int(np.argmin(z)))
        y, z = y[rising], z[rising]
        arc = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))))
        return y, arc - float(np.interp(0.0, y, arc))

    def _solution(self, patches: Any, at: Instant) -> PairSolution:
        self._now = []
        return super()._solution(patches, at)

    def _normal(self, patch: SurfacePatch) -> Callable[..., Normal]:
        """Return what solves the normal problem of a patch."""
        return norm

    def _law(self, patch: SurfacePatch, at: Instant, rows: Elements | None) -> Any:
        """Return the friction of a patch, and of its rows if they lie on the true surfaces."""
        return at.friction

    def _solved(self, patch: SurfacePatch, at: Instant) -> Solved:
        """Return the patch with its solution, and note what it leaves."""
        step = self._step
        creepage, speed = reference, _ = self._rolling(patch, at)
        slip: Any = 0.0
        rows = self._true(patch) if self.conformal or self.true_slip else None
        if rows is not None:
            patch = replace(patch, gap=rows.gap, approach=rows.approach)
            slip, creepage = self._slip(rows, at) / speed, Creepage()
        gap, back = patch.gap, self._backwards(patch, at)
        if back:
            creepage, slip = backwards.of_creepage(creepage), 0.0 if rows is None else backwards.of_vectors(slip)
        contact = Transient(
            backwards.of_gap(gap) if back else gap,
            approach=patch.approach,
            friction=self._law(patch, at, rows),
            material=self.pair.material,
            speed=speed,
            layer=self.layer,
            turns=self.turns,
            normal=self._normal(patch),
        )
        u = at.station + float(patch.frame.origin[0]) + float(self._moved[0])
        s = float(np.interp(patch.on_rail[0], *self._profile(at.station)))
        s = s if self.pair.side == "right" else -s
        here = Left(float(gap.x[0]), float(gap.x[0]) + u, float(gap.y[0]) + s, contact.state)
        contact.told = self.pair.told
        contact.change(slip=slip)
        if math.isinf(step.distance):
            found = contact.roll_on(creepage)
        else:
            before = self._continued(here)
            contact.restore(backwards.of_state(before) if back else before)
            if step.distance == 0.0:
                found = contact.shift(creepage.longitudinal, creepage.lateral, creepage.spin)
            else:
                found = contact.roll(creepage, distance=step.distance, sliding=step.sliding)
        left = contact.state
        if back:
            found, left = backwards.of_solution(found), backwards.of_state(left)
        self._now.append(here._replace(state=left))
        return Solved(patch, found if rows is None else replace(found, creepage=reference), patch.frame.axes)

    def _backwards(self, patch: SurfacePatch, at: Instant) -> bool:
        """Return whether a patch rolls towards -x."""
        return False

    def _true(self, patch: SurfacePatch) -> Elements:
        """Return the elements of a patch on the true surfaces."""
        return elements(self.pair, patch, self.conformal)

    def _slip(self, rows: Elements, at: Instant) -> Array:
        """Return the velocity of the wheel against the rail at each element, in the axes of its row [m/s]."""
        ahead = np.array([self._moved[0], 0.0, 0.0])
        bodies = self._moving(at)
        v = bodies.wheel.at(rows.on_wheel + ahead) - bodies.rail.at(rows.on_rail + ahead)
        return np.einsum("rai,rci->arc", rows.axes[:, :2], v)

    def _continued(self, here: Left) -> State:
        """Return what all patches of the last step have left on a grid, each where it was in contact."""
        state = fresh = here.state
        dx, dy = self._spacing
        for last in self._left:
            ahead = here.u - last.u if self._step.distance == 0.0 else here.x - last.x
            there = last.state.placed(fresh, round((here.s - last.s) / dy), round(ahead / dx))
            touched = there.p > 0.0
            names = ("p",) if last.pressed else ("traction", "p", "mu", "tau", "shear")
            state = replace(state, **{n: np.where(touched, getattr(there, n), getattr(state, n)) for n in names})
        return state

    def _rolling(self, patch: SurfacePatch, at: Instant) -> tuple[Creepage, float]:
        if self._step.distance > 0.0:
            return super()._rolling(patch, at)
        one = self._slide(patch, at)
        return Creepage(one.x, one.y, one.spin), 1.0
