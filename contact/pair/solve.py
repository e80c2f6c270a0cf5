"""`WheelRailPair`: validate, call the kernel, wrap the answer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact import workspace
from contact._layout import (
    CASE_CONFORMAL,
    CASE_G,
    CASE_NORMAL,
    CASE_NU,
    CASE_PRESSURE_LIMIT,
    CASE_TANGENTIAL,
    MAX_PATCHES,
    N_CASE,
)
from contact.creepage import Creepage
from contact.damage import DamageParameters
from contact.damage._kernel import N_DAMAGE, N_DAMAGE_FIELDS
from contact.errors import require_number
from contact.friction import Friction, as_friction, fill
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.wheelset import Pair
from contact.material import STEEL, Material
from contact.pair import layout
from contact.pair.kernel import N_TOTAL, Bench, solve_pair
from contact.pair.ledger import DISTANCE, Ledger, closed
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, lookup
from contact.solution import Status
from contact.solve import N_ELEMENTS, N_STRIPS, require_resolution

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Contact:
    """One patch of a pair. Forces act on the wheel; those with x, y, z count in track coordinates, the rest in the
    contact frame, which is the track frame turned by `angle` about x.

    Attributes
    ----------
    N, Fx, Fy : normal force and creep forces [N]
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


@dataclass(frozen=True, slots=True)
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
    damage : numbers of all patches together, in the order of `contact.damage._kernel`: T-gamma, dissipation,
        Pearce-Sherratt and Archard's volume are sums, the rest are the greatest of the patches. Each patch counts with its
        own rolling radius.
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
    damage: Array
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
        Let the contact angle vary over each patch (`contact.conformal`) instead of taking it as a plane; methods that give
        forces alone do not.
    damage : DamageParameters, optional
        Constants of the damage models.
    ledger : contact.pair.ledger.Ledger, optional
        Bins over both profiles that `solve(…, distance=…)` enters what the patches do in.

    Attributes
    ----------
    bench : contact.pair.kernel.Bench
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
        own = workspace.allocate(method, rolling, material.poisson_ratio, n_strips, n_elements, n_samples)
        case = np.zeros(N_CASE)
        case[CASE_G], case[CASE_NU] = material.shear_modulus, material.poisson_ratio
        case[CASE_PRESSURE_LIMIT] = material.pressure_limit
        case[CASE_NORMAL], case[CASE_TANGENTIAL] = method.id, rolling.id
        case[CASE_CONFORMAL] = float(conformal)
        self.bench = Bench(
            search=pair.space,
            own=own,
            case=case,
            memory=np.zeros(1 + MAX_PATCHES * own.space.memory.size),
            damage_parameters=(damage or DamageParameters()).array(material, 1.0, 1.0),
            damage_fields=np.empty((N_DAMAGE_FIELDS, *own.fields.shape[1:])),
            damage=np.empty(N_DAMAGE),
            contacts=np.zeros((MAX_PATCHES, layout.N_CONTACT)),
            total=np.zeros(N_TOTAL),
            ledger=ledger or closed(),
        )

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
        self.bench.ledger.settings[DISTANCE] = require_number("distance", distance, 0.0)
        fill(self.bench.case, as_friction(friction), (velocity or Velocity()).forward)
        code = solve_pair(mode, amount, self.pair.given(pose, velocity, irregularity), self.bench)
        self.pair.require_found(code, pose, load)
        total = self.bench.total.tolist()
        return PairSolution(
            force=self.bench.total[layout.TOTAL_FX : layout.TOTAL_MX].copy(),
            moment=self.bench.total[layout.TOTAL_MX : layout.TOTAL_Z].copy(),
            z=total[layout.TOTAL_Z],
            contacts=tuple(_contact(row) for row in self.bench.contacts[:code].tolist()),
            max_pressure=total[layout.TOTAL_PMAX],
            area=total[layout.TOTAL_AREA],
            slip_area=total[layout.TOTAL_SLIP_AREA],
            power_per_metre=total[layout.TOTAL_POWER],
            damage=self.bench.total[layout.TOTAL_DAMAGE :].copy(),
            status=Status(int(total[layout.TOTAL_STATUS])),
        )


def _contact(row: list[float]) -> Contact:
    return Contact(
        N=row[layout.CONTACT_N],
        Fx=row[layout.CONTACT_FX],
        Fy=row[layout.CONTACT_FY],
        Mx=row[layout.CONTACT_MX],
        My=row[layout.CONTACT_MY],
        Mz=row[layout.CONTACT_MZ],
        position=(row[layout.CONTACT_X], row[layout.CONTACT_Y], row[layout.CONTACT_Z]),
        angle=row[layout.CONTACT_ANGLE],
        area=row[layout.CONTACT_AREA],
        max_pressure=row[layout.CONTACT_PMAX],
        creepage=Creepage(*row[layout.CONTACT_LONGITUDINAL : layout.CONTACT_SPIN + 1]),
        approach=row[layout.CONTACT_APPROACH],
        status=Status(int(row[layout.CONTACT_STATUS])),
    )
