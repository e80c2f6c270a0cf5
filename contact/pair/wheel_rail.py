"""`WheelRailPair`: validate, call the kernel, wrap the result."""

from __future__ import annotations

import struct
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from contact.core import pack
from contact.damage import DamageParameters
from contact.errors import ContactError, require_kind, require_number
from contact.friction import Friction, as_friction
from contact.geometry.flexible import WheelOffset
from contact.geometry.posed import Posed, require_motion
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.surfaces import SurfacePair
from contact.geometry.wheelset import Pair
from contact.inputs.material import STEEL, Material
from contact.inputs.options import ITERATIONS, LOAD, N_ELEMENTS, N_STRIPS
from contact.inputs.plausibility import doubt_alike
from contact.instance import workspace
from contact.instance.case import SURFACE, cases, surface_bytes
from contact.instance.ownership import one_thread, turn_of, within
from contact.kernels.arrays import DerivativeArrays, Ledger, PairArrays, Search, SurfaceSearch
from contact.kernels.enumerations import Height, NoAnswer
from contact.kernels.flexible import solve_on_profiles, solve_on_surfaces
from contact.kernels.pair_conditions import derive_on_profiles, derive_on_surfaces
from contact.kernels.records import GIVEN, LARGEST_ANGLE
from contact.kernels.rows import Moved
from contact.pair.driven import drive
from contact.pair.elastic_rail import ElasticRail
from contact.pair.motion import AnyPair
from contact.pair.solution import PairSolution
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, lookup
from contact.results import PairJacobian, doubt_answer
from contact.results.jacobian import columns_of_pair
from contact.solve import solve
from contact.solver import require_resolution
from contact.view.notebook import figures

#: Records of the arrays that are written where they change, as they are at the beginning.
_NOTHING: dict[str, Any] = {"rail": ElasticRail(), "offset": WheelOffset()}
#: Columns of the derivatives, with and without the amount that prescribes the height.
_ALL = np.arange(len(Moved))
_PACK_GIVEN = struct.Struct(f"{GIVEN.itemsize // 8}d").pack_into
_FORWARD, _SPIN = (list(GIVEN.names or ()).index(name) for name in ("vx", "spin"))
_WITHOUT_AMOUNT = np.delete(_ALL, Moved.AMOUNT)


class WheelRailPair(AnyPair):
    """One wheel rolling on one rail: contact search and solution, for use at every time step of a model.

    Parameters
    ----------
    pair : contact.geometry.wheelset.Pair or contact.geometry.surfaces.SurfacePair
        Profiles, or surfaces that change along the way, side, gauge, …, and the material of the search under a load.
    material : Material
        Material of the contact solution.
    normal, tangential : str
        Names from `contact.methods()`.
    n_strips, n_elements : int
        Strips per patch, 4 to 1000, and elements per strip, 4 to 1000.
    conformal : bool
        Let the contact angle vary over each patch (`contact.kernels.conformal`). Methods that give forces only ignore it
        and use a plane.
    max_iterations : int
        Most iterations of the strip half space for each solution, 1 to 1000. They cap the time of a call.
    damage : DamageParameters, optional
        Constants of the damage models.
    ledger : contact.kernels.arrays.Ledger, optional
        Bins over both profiles in which `solve(…, distance=…)` adds up wear and damage. Not for surfaces. Pairs with the same
        ledger serve one thread together.

    Attributes
    ----------
    arrays : contact.kernels.arrays.PairArrays
        All arrays, as the kernel uses them. Only `arrays.memory` carries over from one call to the next.

    Raises
    ------
    ContactError
        For arguments of a wrong type, unknown methods or a resolution outside its range.
    """

    def __init__(
        self,
        pair: Pair | SurfacePair,
        *,
        material: Material = STEEL,
        normal: str = DEFAULT_NORMAL,
        tangential: str = DEFAULT_TANGENTIAL,
        n_strips: int = N_STRIPS.usual,
        n_elements: int = N_ELEMENTS.usual,
        conformal: bool = False,
        max_iterations: int = ITERATIONS.usual,
        damage: DamageParameters | None = None,
        ledger: Ledger | None = None,
    ) -> None:
        if not isinstance(pair, Posed):
            raise ContactError(
                f"pair = {pair!r} is no contact.geometry.wheelset.Pair; make one from a wheel and a rail"
            )
        if ledger is not None and not isinstance(pair, Pair):
            raise ContactError(f"ledger = {ledger!r}: {pair!r} has no profiles over which damage could be added up")
        require_kind("material", material, Material)
        require_kind("damage", damage, DamageParameters | None)
        self.pair = pair.again()  # so that two of these can have one pair
        if ledger is not None:
            self.pair.take_turns_with(turn_of(ledger.bins))
        self.take_turns_with(self.pair)
        self._methods: dict[str, Any] = {
            "normal": normal,
            "tangential": tangential,
            "n_strips": n_strips,
            "n_elements": n_elements,
        }
        self._methods |= {"conformal": conformal, "material": material}
        method, rolling = (lookup(*kind, batched=True) for kind in (("normal", normal), ("tangential", tangential)))
        n_strips, n_elements = require_resolution(n_strips, n_elements)
        n_samples = pair.separations.shape[2]
        size = self._size = n_strips, n_elements, n_samples
        self._derivatives: DerivativeArrays | None = None  # laid out with the first derivatives
        self._packed_derivatives: Any = None
        doubt_alike(material.coupling)
        scratch = workspace.allocate(method, rolling, material.poisson_ratio, size)
        self.arrays: PairArrays = workspace.pair_arrays(
            size, self.pair.space, scratch, ledger or workspace.closed_ledger()
        )
        self.arrays.case[:] = cases(
            1,
            method,
            rolling,
            material,
            conformal=conformal,
            max_iterations=ITERATIONS.require("max_iterations", max_iterations),
        )
        constant = isinstance(pair, Pair)
        self._solve = (solve_on_profiles if constant else solve_on_surfaces).call
        self._packed = pack(PairArrays[Search] if constant else PairArrays[SurfaceSearch], self.arrays)
        self._gap_limit = method.gap_limit
        self._written = dict(_NOTHING)
        self._found = self.arrays.total.view(np.uint8).data, self.arrays.contacts.view(np.uint8).data
        self._deflection = self.arrays.rail["dy"], self.arrays.rail["dz"]
        self._bytes = self.arrays.given.view(np.uint8).data, self.arrays.case.view(np.uint8).data
        self._speed, self._distance = self.arrays.case["speed"], self.arrays.ledger.settings["distance"]
        self._surface: tuple[object, bytes] = (None, b"")
        self._static = 0.0
        self.arrays.damage_parameters[:] = (damage or DamageParameters()).record(material, 1.0, 1.0)

    def _kept(self) -> Any:
        return self.arrays.memory.copy()

    def _keep(self, kept: Any) -> None:
        self.arrays.memory[:] = kept

    @one_thread
    def forget(self) -> None:
        """Discard the last solution, so that the next call is a cold start.

        Interacting strips start from the last call. This changes their results within their tolerance, 1e-4.
        """
        self.arrays.memory[:] = 0.0

    @one_thread
    def solve(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        station: float = 0.0,
        rotation: float = 0.0,
        load: float | None = None,
        penetration: float | None = None,
        vertical: float | None = None,
        force: float | None = None,
        torque: float | None = None,
        irregularity: Irregularity | None = None,
        friction: float | Friction = 0.3,
        distance: float = 0.0,
        rail: ElasticRail | None = None,
        offset: WheelOffset | None = None,
        derivatives: bool = False,
    ) -> PairSolution:
        """Find and solve all patches at one instant.

        Parameters
        ----------
        pose, velocity, load, penetration, irregularity :
            As for `contact.geometry.wheelset.contacts`. A wheelset with `velocity.forward` < 0 rolls backwards: forces and
            creepages stay in the track's axes, creepages refer to |forward|. Not on surfaces that change along the
            way. The normal forces alone carry `load`, by the normal method of
            this pair; friction adds to the vertical force or relieves it.
        station, rotation : float
            Position of the axle along the slices of the rail [m], and angle by which the wheel has turned about the y axis
            [rad], for surfaces. It decreases when rolling forward: the angle -rotation of the wheel is at the bottom.
        vertical : float
            Vertical force on the wheel [N] ≥ 0 that normal and friction forces carry together, by the methods of this
            pair; instead of `load` and `penetration`. Like `load` it takes about three times as long as a given height.
        force, torque : float
            Longitudinal force on the wheelset [N], or drive torque about the axle [N m], the contact's moment about y; both
            positive when driving. The rotation that gives it is found, from `velocity.spin` on; it is `PairSolution.spin`.
            `velocity.forward` must be positive. If no rotation gives it, the status is UNREACHABLE, and the solution has the
            largest slip that was tried, half of free rolling.
        friction : float or contact.friction.Friction
            Coulomb's coefficient mu ≥ 0 [-], or a friction law, evaluated with the sliding velocity of each patch.
        distance : float
            Distance rolled in this state [m], not negative, for the ledger. If the solution fails, nothing is added.
        rail : contact.pair.ElasticRail
            Springs under the rail. Its deflection is found, from that of the last call; `forget` resets it. If the force
            jumps and no deflection is in balance, the status is NOT_CONVERGED. It takes three to thirty times as long.
        offset : contact.geometry.flexible.WheelOffset
            Displacement and rotation of this wheel against its wheelset, with their rates.
        derivatives : bool
            Also find `PairSolution.jacobian`, not with a force or a torque. The solution stays as it is.

        Returns
        -------
        PairSolution
            If the wheel does not touch, all forces are zero and the status is ``Status.NO_CONTACT``. The `status` tells
            whether the solution can be trusted.

        Raises
        ------
        ContactError
            For input outside its range, if wheel and rail do not overlap laterally, if no z gives the load, or if both
            `force` and `torque` are given, or one of them and a `distance`.

        Warns
        -----
        PlausibilityWarning
            Once, for a pose, a spin of the axle or a load that no wheelset has, as from a wrong unit or sign.
        """
        if force is not None or torque is not None:
            if derivatives:
                raise ContactError(
                    "derivatives = True does not work with force and torque; solve again with the rotation found"
                )
            if distance != 0.0:
                raise ContactError(
                    f"distance = {distance}: solve again with the rotation that was found to book damage"
                )

            turning = partial(
                within(self.solve),
                pose,
                station=station,
                rotation=rotation,
                load=load,
                penetration=penetration,
                vertical=vertical,
                irregularity=irregularity,
                friction=friction,
                rail=rail,
                offset=offset,
            )
            shear_modulus = float(self.arrays.case[0]["G"])
            velocity = Velocity() if velocity is None else velocity
            require_motion(pose, velocity)
            return drive(turning, velocity, self.pair.nominal_radius, shear_modulus, force, torque)
        if vertical is None:
            mode, amount = self.pair.prescribed(load, penetration)
        elif load is None and penetration is None:
            mode, amount = Height.VERTICAL, LOAD.require("vertical", vertical)
        else:
            raise ContactError(f"vertical = {vertical} excludes load = {load} and penetration = {penetration}")
        self._distance[0] = require_number("distance", distance, 0.0)
        self._write("rail", rail)
        offset = self._write("offset", offset)
        given = self.pair.motion_of(pose, velocity, irregularity)
        self.pair.set_way(
            station, rotation if offset.pitch == 0.0 else require_number("rotation", rotation) + offset.pitch
        )
        if friction is not self._surface[0]:
            law = as_friction(friction)
            self._surface = law if law is friction or type(friction) is not float else friction, surface_bytes(law)
            self._static = law.static
        of_given, of_case = self._bytes
        _PACK_GIVEN(of_given, 0, *given)
        of_case[SURFACE], self._speed[0] = self._surface[1], abs(given[_FORWARD])
        code = self._solve(mode, amount, self._packed)
        if code == NoAnswer.TURNED:
            raise ContactError(
                f"offset.roll = {offset.roll:g} and offset.yaw = {offset.yaw:g}: with the wheelset's roll and "
                f"yaw the wheel is turned by more than {LARGEST_ANGLE:g} rad"
            )
        if vertical is not None and code == NoAnswer.NOT_SETTLED:
            raise ContactError(
                f"vertical = {vertical:g}: no z was found at which normal and friction forces carry it together"
            )
        self.pair.require_found(code, pose, load)
        carried, name = (load, "load") if vertical is None else (vertical, "vertical")
        self.pair.doubt(pose, velocity, carried, name, self._static)
        jacobian = self._derive(mode) if derivatives else None
        y, z = self._deflection
        found = PairSolution.of_kernel(*self._found, code, (float(y[0]), float(z[0])), given[_SPIN], jacobian)
        doubt_answer(
            self.pair.told, self._gap_limit, self._methods["conformal"], Q=found.Q, gap_error=found.gap_error,
            bend=found.bend, beyond=found.beyond,
        )  # fmt: skip
        return found

    def _derive(self, mode: int) -> PairJacobian:
        """Return the derivatives of the last solution, labelled."""
        derivatives = within(self.derive_given)(mode)
        name = None if mode == Height.GIVEN else Height(mode).name.lower()
        shown = _ALL if name else _WITHOUT_AMOUNT
        values = derivatives.jacobian[: len(PairJacobian.rows), shown]
        values.setflags(write=False)
        sided = np.flatnonzero(derivatives.sides[shown])
        one_sided = tuple(columns_of_pair(name)[k] for k in sided) if sided.size else ()
        return PairJacobian(values, name, one_sided)

    def plot(self, pose: Pose, velocity: Velocity | None = None, **given: Any) -> Any:
        """Return a figure of wheel, rail and all patches with pressure and traction (matplotlib's Figure).

        Parameters are those of `solve`. Each patch is solved once more with its fields, at the height that `solve` finds.

        Raises
        ------
        ContactError
            As `solve`, if the wheel does not touch, and for surfaces, which change along the way.
        """
        if not isinstance(self.pair, Pair):
            raise ContactError(f"{self.pair!r} changes along the way; contact.plot.passage draws what `run` returns")
        velocity = Velocity() if velocity is None else velocity
        require_motion(pose, velocity)
        require_number("velocity.forward", velocity.forward, 0.0)
        found = self.solve(pose, velocity, **given)
        velocity = replace(velocity, spin=found.spin)
        rail = given.get("irregularity")
        patches = self.pair.contacts(replace(pose, z=found.z), velocity, irregularity=rail)
        surface = as_friction(given.get("friction", 0.3))
        mirror = -1.0 if self.pair.side == "left" else 1.0
        solutions = [
            solve(
                patch.separation,
                patch.creepage,
                approach=patch.approach,
                friction=surface.placed(patch.on_rail[0], patch.angle, mirror),
                speed=velocity.forward,
                throw=False,
                **self._methods,
            )
            for patch in patches
        ]
        draw = figures()
        return draw.position([draw.Wheel(self.pair.side, *self.pair.profiles, patches, solutions)], pose.roll)

    @one_thread
    def solve_given(self, mode: int, amount: float, given: np.record) -> int:
        """Call the kernel for the record GIVEN of a motion and return its code. The result is in `arrays`."""
        self.arrays.given[0] = given
        return int(self._solve(mode, amount, self._packed))

    @one_thread
    def derive_given(self, mode: int) -> DerivativeArrays:
        """Call the kernel of the derivatives of the last solution, with the `mode` of it. They are in what is returned."""
        constant = isinstance(self.pair, Pair)
        if self._derivatives is None:
            self._derivatives = workspace.derivative_arrays(self._size, self.arrays)
            self._packed_derivatives = pack(
                DerivativeArrays[Search] if constant else DerivativeArrays[SurfaceSearch], self._derivatives
            )
        (derive_on_profiles if constant else derive_on_surfaces)(mode, self._packed, self._packed_derivatives)
        return self._derivatives

    def _write(self, name: str, given: Any) -> Any:
        """Write an elastic rail or an offset into its record, unless it stands there. Return it, none for None."""
        nothing = _NOTHING[name]
        given = nothing if given is None else given
        if given is not self._written[name]:
            require_kind(name, given, type(nothing))
            getattr(self.arrays, name)[0] = given.record()
            self._written[name] = given
        return given
