"""`WheelRailPair`: validate, call the kernel, wrap the answer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact import workspace
from contact.case import cases, set_surface
from contact.creepage import Creepage
from contact.damage import DamageParameters
from contact.errors import require_number
from contact.friction import Friction, as_friction
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.wheelset import Pair
from contact.kernels.memory import Bench, Ledger
from contact.kernels.pair import solve_pair
from contact.material import STEEL, Material
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, lookup
from contact.solution import Status
from contact.solver import N_ELEMENTS, N_STRIPS, require_resolution

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Contact:
    """One patch of a pair. Forces act on the wheel; those with x, y, z count in track coordinates, the rest in the
    contact frame, which is the track frame turned by `angle` about x.

    Attributes
    ----------
    N, Fx, Fy : normal force and creep forces [N], with the share of the patch (`contact.geometry.records.Patch`), as the
        moments and the area
    Mx, My : moments of the normal pressure about `position`: it is not centred there [N m]
    Mz : spin moment about `position` [N m]
    position : point of the wheel opposite the reference point, (x, y, z) [m]
    angle : contact angle [rad]
    area, max_pressure : [m²], [Pa]
    creepage : wheel minus rail at `position`
    approach : [m]
    status : Status
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
    status: Status


class PairDamage(NamedTuple):
    """Damage of all patches of a pair together, each with its own rolling radius; names, units as in `contact.damage.Damage`.

    T-gamma, dissipation, Pearce-Sherratt and Archard's volume are sums; the rest are the greatest of the patches.
    `archard_depth` [m per m rolled] and `archard_volume` [m³ per m rolled] are those of `ArchardWear`; `stress_index` and
    `energy_index` [Pa] the maxima of the fields.
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


@dataclass(frozen=True, slots=True, eq=False)
class PairSolution:
    """What one rail does to the wheelset, in track coordinates.

    Attributes
    ----------
    force : (x, y, z) on the wheel [N]
    moment : about the wheelset's centre (0, pose.y, z - nominal radius) [N m]
    z : pose.z, as given or as found for a load or a penetration [m]
    contacts : every patch, from the field side to the flange
    max_pressure, area, slip_area : greatest of all patches [Pa], sums [m²]
    power_per_metre : frictional energy per metre rolled, sum over the patches [N]
    damage : all patches together
    status : Status
    """

    force: Array
    moment: Array
    z: float
    contacts: tuple[Contact, ...]
    max_pressure: float
    area: float
    slip_area: float
    power_per_metre: float
    damage: PairDamage
    status: Status

    @property
    def slip_ratio(self) -> float:
        """Slip area over contact area [-]; 0 without contact."""
        return self.slip_area / self.area if self.area > 0.0 else 0.0


class WheelRailPair:
    """One wheel rolling on one rail: contact search and solution, what a model calls at each time step.

    Parameters
    ----------
    pair : contact.geometry.wheelset.Pair
        Profiles, side, gauge, … and the material of the search under a load. It must not be searched by anybody else
        at the same time.
    material : Material
    normal, tangential : str
        Names from `contact.methods()`.
    n_strips, n_elements : int
        Strips per patch, 4 to 1000, and elements per strip, 4 to 1000.
    conformal : bool
        Let the contact angle vary over each patch (`contact.kernels.conformal`) instead of taking it as a plane; methods that
        give forces alone do not.
    damage : DamageParameters, optional
        Constants of the damage models.
    ledger : contact.kernels.ledger.Ledger, optional
        Bins over both profiles that `solve(…, distance=…)` enters what the patches do in.

    Attributes
    ----------
    bench : contact.kernels.pair.Bench
        All arrays, as the kernel takes them. `bench.memory` is all that one call leaves to the next one.

    Raises
    ------
    ContactError
        For unknown methods and a resolution outside its range.
    """

    def __init__(
        self,
        pair: Pair,
        *,
        material: Material = STEEL,
        normal: str = DEFAULT_NORMAL,
        tangential: str = DEFAULT_TANGENTIAL,
        n_strips: int = N_STRIPS,
        n_elements: int = N_ELEMENTS,
        conformal: bool = False,
        damage: DamageParameters | None = None,
        ledger: Ledger | None = None,
    ) -> None:
        self.pair = pair
        method, rolling = (lookup(*kind, batched=True) for kind in (("normal", normal), ("tangential", tangential)))
        n_strips, n_elements = require_resolution(n_strips, n_elements)
        n_samples = pair.separations.shape[2]
        size = n_strips, n_elements, n_samples
        own = workspace.allocate(method, rolling, material.poisson_ratio, size)
        self.bench: Bench = workspace.bench(size, pair.space, own, ledger or workspace.closed_ledger())
        self.bench.case[:] = cases(1, method, rolling, material, conformal=conformal)
        self.bench.damage_parameters[:] = (damage or DamageParameters()).record(material, 1.0, 1.0)

    def solve(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        load: float | None = None,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
        friction: float | Friction = 0.3,
        distance: float = 0.0,
    ) -> PairSolution:
        """Solve every patch at one instant.

        Parameters
        ----------
        pose, velocity, load, penetration, irregularity :
            As for `contact.geometry.wheelset.contacts`.
        friction : float or contact.friction.Friction
            Coulomb's coefficient mu ≥ 0 [-], or a surface on which it falls with the sliding velocity of each patch.
        distance : float
            That is rolled in this state [m], not negative: what the ledger adds up. Where there is no answer, nothing.

        Returns
        -------
        PairSolution
            A wheel that does not touch is an answer: zero forces, ``Status.NO_CONTACT``. Whether a solution is to be
            trusted, its `status` says.

        Raises
        ------
        ContactError
            For input outside its range, where the profiles do not lie above each other, and for a load that no z carries.
        """
        mode, amount = self.pair.prescribed(load, penetration)
        self.bench.ledger.settings["distance"] = require_number("distance", distance, 0.0)
        set_surface(self.bench.case, as_friction(friction), (velocity or Velocity()).forward)
        code = solve_pair(mode, amount, self.pair.given(pose, velocity, irregularity), self.bench)
        self.pair.require_found(code, pose, load)
        total = self.bench.total[0]
        return PairSolution(
            force=np.array([total.Fx, total.Fy, total.Fz]),
            moment=np.array([total.Mx, total.My, total.Mz]),
            z=float(total.z),
            contacts=tuple(_contact(row) for row in self.bench.contacts[:code]),
            max_pressure=float(total.pmax),
            area=float(total.area),
            slip_area=float(total.slip_area),
            power_per_metre=float(total.power),
            damage=PairDamage(*(float(total[name]) for name in PairDamage._fields)),
            status=Status(total.status),
        )


def _contact(found: np.record) -> Contact:
    return Contact(
        N=float(found.N),
        Fx=float(found.Fx),
        Fy=float(found.Fy),
        Mx=float(found.Mx),
        My=float(found.My),
        Mz=float(found.Mz),
        position=(float(found.x), float(found.y), float(found.z)),
        angle=float(found.angle),
        area=float(found.area),
        max_pressure=float(found.pmax),
        creepage=Creepage(float(found.longitudinal), float(found.lateral), float(found.spin)),
        approach=float(found.approach),
        status=Status(found.status),
    )
