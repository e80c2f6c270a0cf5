"""What a pair answers: `PairSolution`, the action of one rail on the wheelset, and `Contact`, one patch of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from contact.arrays import Array, brief
from contact.damage.assessment import assess
from contact.geometry.records import Patch, Pose, contact_angle
from contact.geometry.surfaces import SurfacePatch
from contact.inputs.creepage import Creepage
from contact.kernels.records import CONTACT, MOTION, TOTAL
from contact.kernels.resultants import add_patch, compare_forces
from contact.results import PairJacobian, Solution, Status
from contact.results.later import RENAMED, STATES, MadeLater, reader
from contact.view.notebook import beside, table
from contact.view.tables import Table


@dataclass(frozen=True, slots=True)
class Contact:
    """One patch of a pair.

    Forces act on the wheel. `position` is in track coordinates; everything else is in the contact frame, which is the
    track frame turned by `angle` about x, then by `pitch`. Forces, moments and area are multiplied by the patch's share
    (`contact.geometry.records.Patch`).

    Attributes
    ----------
    N, Fx, Fy : normal force and creep forces [N]
    Mx, My : moments of the normal pressure about `position`, which is not the centre of pressure [N m]
    Mz : spin moment about `position` [N m]
    position : point of the wheel opposite the reference point, (x, y, z) [m]
    angle : contact angle [rad]
    area, max_pressure : [m²], [Pa]
    creepage : wheel minus rail at `position`
    approach : [m]
    on_rail, on_wheel : position on the profiles, (y, z), as in `contact.geometry.records.Patch` [m]
    used_friction : creep force over normal force [-]
    status : Status
    gap_error : as `contact.Solution.gap_error` [-]. On surfaces it is not less than the error of the parabolas along x that
        stand for the gap of the strips, root mean square over the approach; 0 for a wheel of revolution on a straight rail
    pitch : inclination of the frame's normal along the track [rad]; 0 except for surfaces with ``tilted=True``
    patch, solution : geometry of the patch, and its solution with all fields, by `RollerRig` and `HalfspacePair`; None by
        `WheelRailPair`, which keeps no fields
    """

    N: float
    Fx: float
    Fy: float
    Mx: float
    My: float
    Mz: float
    position: tuple[float, float, float]
    angle: float
    area: float
    max_pressure: float
    creepage: Creepage
    approach: float
    on_rail: tuple[float, float]
    on_wheel: tuple[float, float]
    used_friction: float
    status: Status
    gap_error: float
    pitch: float = 0.0
    patch: Patch | SurfacePatch | None = field(default=None, repr=False)
    solution: Solution | None = field(default=None, repr=False)

    @property
    def contact_angle(self) -> float:
        """Contact angle [rad], positive if the rail pushes the wheel to the track's centre, on either side."""
        return contact_angle(self.angle, self.position[1])

    @property
    def T_gamma(self) -> float:
        """|Fx vx| + |Fy vy| of this patch [N = J/m]. The patches add up to `PairDamage.T_gamma`."""
        return abs(self.Fx * self.creepage.longitudinal) + abs(self.Fy * self.creepage.lateral)


class PairArchard(NamedTuple):
    """Archard's wear of a pair, under the names of `contact.damage.ArchardWear`: [m per m rolled], [m³ per m rolled]."""

    depth_max: float
    volume: float


class PairDamage(NamedTuple):
    """Damage of all patches of a pair. Names and units are those of `contact.damage.Damage`.

    Each patch has its own rolling radius. T-gamma, dissipation, Pearce-Sherratt and Archard's volume are sums over the
    patches; all others are maxima. `archard_depth` [m per m rolled] and `archard_volume` [m³ per m rolled] are those of
    `ArchardWear`. `stress_index` and `energy_index` [Pa] are the maxima of the fields.
    """

    T_gamma: float
    T_gamma_spin: float
    dissipation: float
    pearce_sherratt: float
    burstow: float
    usfd: float
    archard_depth: float
    archard_volume: float
    fatigue_index: float
    stress_index: float
    energy_index: float

    @property
    def archard(self) -> PairArchard:
        """Archard's wear, as in `Solution.damage`: ``damage.archard.volume``."""
        return PairArchard(self.archard_depth, self.archard_volume)


@dataclass(frozen=True, eq=False)
class PairSolution(MadeLater):
    """Action of one rail on the wheelset, in track coordinates. Its tables have a row for each patch.

    Attributes
    ----------
    force : (x, y, z) on the wheel [N]
    moment : about the wheelset's centre (0, pose.y, z - nominal radius) [N m]
    Q : vertical force of the wheel on the rail, positive down [N]
    Y : lateral force of the wheel on the rail, positive outwards, as with the flange in contact [N]
    Y_over_Q : their ratio [-]; 0 without vertical force
    used_friction : sum of the creep forces of all patches over that of the normal forces [-]
    z : pose.z, as given or as found for a load or a penetration [m]
    contacts : all patches, from the field side to the flange
    max_pressure : largest pressure of all patches [Pa]
    area, slip_area : sums over the patches [m²]
    power_per_metre : frictional energy per metre rolled, sum over the patches [N]
    damage : damage of all patches
    status : Status
    gap_error : the greatest of the patches [-]
    bend : largest change of the contact angle over the patches of one plane [rad]; `contact.Solution.bend` says what it means.
        It is 0 where no strips are solved
    beyond : the greatest `contact.Solution.beyond` of the patches [-]
    deflection : lateral and vertical deflection of an elastic rail [m], added to its irregularity; 0 for a rigid rail
    spin : rotation about the axle [rad/s], as given or as found for a force or a torque; negative when rolling forward
    jacobian : derivatives of force, moment and z; None unless they were asked for
    """

    force: Array
    moment: Array
    Q: float
    Y: float
    Y_over_Q: float
    used_friction: float
    z: float
    contacts: tuple[Contact, ...]
    max_pressure: float
    area: float
    slip_area: float
    power_per_metre: float
    damage: PairDamage
    status: Status
    gap_error: float
    deflection: tuple[float, float] = (0.0, 0.0)
    spin: float = 0.0
    bend: float = 0.0
    beyond: float = 0.0
    jacobian: PairJacobian | None = field(default=None, repr=False)

    __repr__ = brief

    @classmethod
    def of_kernel(
        cls,
        total: memoryview,
        contacts: memoryview,
        n: int,
        deflection: tuple[float, float],
        spin: float,
        jacobian: PairJacobian | None,
    ) -> PairSolution:
        """Return the solution with `n` patches from the bytes of the records that the kernel has filled.

        Patches and damage are made from copies when one of them is first read.
        """
        record = _TOTAL.unpack_from(total)
        numbers = dict(zip(_PLAIN, _PICK(record), strict=True))
        numbers["status"], numbers["deflection"] = STATES[record[_STATUS]], deflection
        numbers["spin"], numbers["jacobian"] = spin, jacobian
        numbers["force"], numbers["moment"] = np.array(record[:3]), np.array(record[3:6])
        return cls.later(numbers, _made, record, bytes(contacts[: n * CONTACT.itemsize]))

    def _table(self) -> Table:
        names = "N", "Fx", "Fy", "Mx", "My", "Mz", "angle", "area", "max_pressure", "approach", "used_friction"
        columns = {name: np.array([getattr(c, name) for c in self.contacts]) for name in (*names, "gap_error", "pitch")}
        for name in ("longitudinal", "lateral", "spin"):
            columns[name] = np.array([getattr(c.creepage, name) for c in self.contacts])
        columns["status"] = np.array([int(c.status) for c in self.contacts], dtype=np.int64)
        beside = {name: np.array([c.position[k] for c in self.contacts]) for k, name in enumerate("xyz")}
        for name in ("on_rail", "on_wheel"):
            beside |= {
                f"{name}_{axis}": np.array([getattr(c, name)[k] for c in self.contacts]) for k, axis in enumerate("yz")
            }
        return Table({"patch": np.arange(len(self.contacts))}, columns, beside)

    def _repr_html_(self) -> str:
        """Return HTML for a notebook: a table of the whole wheel and one of its patches."""
        whole = (
            ("status", self.status.name),
            ("Q, Y", f"{self.Q:.6g} N, {self.Y:.6g} N"),
            ("force x, y, z", ", ".join(f"{f:.6g}" for f in self.force) + " N"),
            ("Y/Q", f"{self.Y_over_Q:.3g}"),
            ("used friction", f"{self.used_friction:.3g}"),
            ("wheelset z", f"{1e3 * self.z:.5g} mm"),
            ("rotation", f"{self.spin:.6g} rad/s"),
            ("greatest pressure", f"{1e-6 * self.max_pressure:.5g} MPa"),
            ("energy per metre", f"{self.power_per_metre:.4g} J/m"),
        )
        heads = "patch", "angle [°]", "y [mm]", "N [N]", "Fx [N]", "Fy [N]", "area [mm²]", "pressure [MPa]", "status"
        rows = [
            (
                str(k),
                f"{math.degrees(c.contact_angle):.3g}",
                f"{1e3 * c.position[1]:.5g}",
                *(f"{force:.5g}" for force in (c.N, c.Fx, c.Fy)),
                f"{1e6 * c.area:.4g}",
                f"{1e-6 * c.max_pressure:.5g}",
                c.status.name,
            )
            for k, c in enumerate(self.contacts, 1)
        ]
        return beside(table((), whole, "wheel on rail"), table(heads, rows) if rows else "")

    @property
    def slip_ratio(self) -> float:
        """Slip area over contact area [-]; 0 without contact."""
        return self.slip_area / self.area if self.area > 0.0 else 0.0


_TOTAL, _CONTACT = reader(TOTAL), reader(CONTACT)
_NAMES = tuple(RENAMED.get(name, name) for name in TOTAL.names or ())
#: Attributes of a solution that are numbers of its record.
_PLAIN = [name for name in _NAMES if name in PairSolution.__dataclass_fields__ and name not in ("status", "damage")]
_PICK = itemgetter(*(_NAMES.index(name) for name in _PLAIN))
_STATUS = _NAMES.index("status")
_DAMAGE = itemgetter(*(_NAMES.index(name) for name in PairDamage._fields))


def _made(total: tuple[Any, ...], contacts: bytes) -> dict[str, Any]:
    """Return patches and damage."""
    return {
        "contacts": tuple(
            _read(dict(zip(CONTACT.names or (), row, strict=True))) for row in _CONTACT.iter_unpack(contacts)
        ),
        "damage": PairDamage(*_DAMAGE(total)),
    }


def _read(found: dict[str, Any]) -> Contact:
    """Return the contact with the members of a record."""
    return Contact(
        N=found["N"],
        Fx=found["Fx"],
        Fy=found["Fy"],
        Mx=found["Mx"],
        My=found["My"],
        Mz=found["Mz"],
        position=(found["x"], found["y"], found["z"]),
        angle=found["angle"],
        area=found["area"],
        max_pressure=found["pmax"],
        creepage=Creepage(found["longitudinal"], found["lateral"], found["spin"]),
        approach=found["approach"],
        on_rail=(found["rail_y"], found["rail_z"]),
        on_wheel=(found["wheel_y"], found["wheel_z"]),
        used_friction=found["used_friction"],
        status=STATES[found["status"]],
        gap_error=found["gap_error"],
        pitch=found["pitch"],
    )


class Solved(NamedTuple):
    """A patch, its solution, and the axes of its frame as rows in track coordinates, shape (3, 3)."""

    patch: Patch | SurfacePatch
    solution: Solution
    axes: Array


def of_patches(
    found: Sequence[Solved], pose: Pose, z: float, side: str, nominal_radius: float, spin: float, ahead: float = 0.0
) -> PairSolution:
    """Return the action of all patches on the wheelset at the height `z` [m]; `spin` is the rotation of the wheel [rad/s].

    The patches' x counts from a point `ahead` of the wheelset's centre [m].
    The kernel of `WheelRailPair` adds them up.
    """
    total, contacts, motion = np.zeros(1, TOTAL), np.zeros(len(found), CONTACT), np.zeros(1, MOTION)[0]
    motion.y, motion.z, motion.radius, motion.changing = pose.y, z, nominal_radius, 1
    whole = total[0]
    whole.status, whole.z = Status.NO_CONTACT, z
    for one, contact in zip(found, contacts, strict=True):
        _report(one, contact)
        if one.solution.status is not Status.NO_CONTACT:
            assessed = assess(one.solution, one.patch.rolling_radius)
            add_patch(contact, assessed.result, assessed.damage, one.patch.share, motion, whole)
    whole.My -= ahead * whole.Fz
    whole.Mz += ahead * whole.Fy
    compare_forces(1.0 if side == "right" else -1.0, whole)
    made = PairSolution.of_kernel(
        total.view(np.uint8).data, contacts.view(np.uint8).data, len(found), (0.0, 0.0), spin, None
    )
    patches = zip(made.contacts, found, strict=True)
    return replace(made, contacts=tuple(replace(c, patch=one.patch, solution=one.solution) for c, one in patches))


def _report(one: Solved, contact: np.record) -> None:
    """Fill the contact of a solved patch. The pressure's moments are those about the origin of its frame."""
    patch, s, share = one.patch, one.solution, one.patch.share
    pressing = s.p * s.dA
    contact.N, contact.Fx, contact.Fy, contact.Mz = share * s.N, share * s.Fx, share * s.Fy, share * s.Mz
    contact.Mx = -share * float((s.y * pressing).sum())
    contact.My = share * float((s.x * pressing).sum())
    contact.x, contact.y, contact.z = patch.wheel_position
    contact.angle, contact.pitch = patch.angle, math.asin(min(max(float(one.axes[2, 0]), -1.0), 1.0))
    contact.area, contact.pmax, contact.approach = share * s.area, s.max_pressure, s.approach
    creepage = s.creepage
    contact.longitudinal, contact.lateral, contact.spin = creepage.longitudinal, creepage.lateral, creepage.spin
    (contact.rail_y, contact.rail_z), (contact.wheel_y, contact.wheel_z) = patch.on_rail, patch.on_wheel
    contact.used_friction, contact.status, contact.gap_error = s.used_friction, s.status, s.gap_error
