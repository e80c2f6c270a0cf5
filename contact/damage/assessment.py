"""`evaluate`: all damage indices of one solution."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Literal, NamedTuple, get_args

import numpy as np

from contact.arrays import Array, brief
from contact.damage.archard import ArchardMap
from contact.damage.burstow import Burstow
from contact.damage.pearce_sherratt import PearceSherratt
from contact.damage.usfd import Usfd
from contact.errors import ContactError, only_with_fields, require_number
from contact.inputs.material import Material
from contact.inputs.options import MEMBERS, RADIUS
from contact.inputs.plausibility import doubt_value
from contact.kernels.damage.assess import damage_kernel
from contact.kernels.records import CASE, DAMAGE, DAMAGE_PARAMETERS, RESULT
from contact.kernels.rows import DamageField, Field, Strip
from contact.registry import methods

if TYPE_CHECKING:
    from contact.results import Solution

WearLaw = Literal["archard", "usfd", "usfd_local", "pearce_sherratt"]
WEAR_LAWS: tuple[WearLaw, ...] = get_args(WearLaw)


@dataclass(frozen=True, slots=True)
class DamageParameters:
    """Constants of all damage models. Hardness and shear yield stress are in `Material`.

    Parameters
    ----------
    pearce_sherratt : PearceSherratt
    burstow : Burstow
    usfd : Usfd
    archard : ArchardMap
        Constants of the models, with their sources.
    with_spin : bool
        Use T-gamma with |Mz phi| in Pearce-Sherratt, Burstow and USFD. Default False, thesis Eq. 6.1.
    wear_law : {"archard", "usfd", "usfd_local", "pearce_sherratt"}
        Law for the wear of profiles in `contact.accumulation`. "usfd" takes the rate from T-gamma/A of the whole patch and
        spreads it evenly over the area. "usfd_local" takes the rate from -q·s of each element. "pearce_sherratt" spreads
        the area loss over the patch.
    rail_wear : float
        Wear of the rail over that of the wheel [-], 0 to 1000, for `contact.accumulation`: by Archard's law the hardness of
        the wheel over that of the rail, if both have one wear coefficient. Default 1: both lose the same volume.
    """

    pearce_sherratt: PearceSherratt = field(default_factory=PearceSherratt)
    burstow: Burstow = field(default_factory=Burstow)
    usfd: Usfd = field(default_factory=Usfd)
    archard: ArchardMap = field(default_factory=ArchardMap)
    with_spin: bool = False
    wear_law: WearLaw = "archard"
    rail_wear: float = 1.0

    def __post_init__(self) -> None:
        if self.wear_law not in WEAR_LAWS:
            raise ContactError(f"wear_law = {self.wear_law!r} is unknown; allowed: {', '.join(WEAR_LAWS)}")
        MEMBERS["damage_parameters"]["rail_wear"].require("rail_wear", self.rail_wear)

    def record(self, material: Material, wheel_radius: float, speed: float) -> np.record:
        """Return the constants as the record DAMAGE_PARAMETERS of `contact.kernels.records`.

        `wheel_radius` is in m, `speed` in m/s.

        Raises
        ------
        ContactError
            If the wheel radius is not positive or the speed is negative.
        """
        made = np.zeros(1, DAMAGE_PARAMETERS)[0]
        made.speed = require_number("speed", speed, 0.0)
        made.wheel_radius = require_number("wheel_radius", wheel_radius, 0.0, open_minimum=True)
        made.hardness, made.shear_yield = material.hardness, material.shear_yield
        made.rail_wear = self.rail_wear
        made.with_spin, made.wear_law = self.with_spin, WEAR_LAWS.index(self.wear_law)
        for name in ("pearce_sherratt", "burstow", "usfd", "archard"):
            made[name] = getattr(self, name).constants()
        return made


@dataclass(frozen=True, slots=True, eq=False)
class IndexField:
    """An index over the patch, shape (n_strips, n_elements) [Pa], and its maximum [Pa]."""

    field: Array
    max: float

    __repr__ = brief


@dataclass(frozen=True, slots=True, eq=False)
class ArchardWear:
    """Archard's sliding wear, spread over the circumference of the wheel.

    Attributes
    ----------
    depth : depth worn off by each element [m per m rolled], shape (n_strips, n_elements)
    depth_per_strip : sum of `depth` along the rolling direction [m per m rolled], the wear profile over the strips' y
    depth_max : largest depth of a strip [m per m rolled]
    volume : ∬ k p |s|/H dA = 2πr ∫ depth dy [m³ per m rolled]; on a curved surface dy is along the surface
    wheel_radius : r [m]
    """

    depth: Array
    depth_per_strip: Array
    depth_max: float
    volume: float
    wheel_radius: float

    __repr__ = brief

    @property
    def depth_per_revolution(self) -> Array:
        """Depth worn off the wheel per revolution [m], shape (n_strips,). The rail loses the same depth per passage."""
        return 2.0 * np.pi * self.wheel_radius * self.depth_per_strip


@only_with_fields("archard", "stress_index", "energy_index")
@dataclass(frozen=True)
class Damage:
    """Damage indices of one solution. All are zero without contact.

    Rates are per metre that the wheel rolls; multiplied by 2πr they are per revolution. If the tangential method gives
    forces only, `has_fields` is false, and reading archard, stress_index or energy_index raises a ContactError. The
    dissipation is then -(F·v + Mz phi).

    Attributes
    ----------
    T_gamma, T_gamma_spin : |Fx vx| + |Fy vy|, and the same + |Mz phi| [N = J/m]
    dissipation : frictional energy -∬ q·s dA [N = J/m]; multiplied by the speed it is a power
    pearce_sherratt : tread cross-section lost [m² per m rolled]; the published unit 1 mm²/km is 1e-9 m²/m
    burstow : fraction of RCF life used by one axle pass [-]; may be negative (see `Burstow.clip_negative`)
    usfd : volume lost per contact area and metre rolled [m³/(m² m)]
    archard : ArchardWear
    fatigue_index : FI_surf [-]; a positive value predicts surface fatigue
    stress_index : SI = |q| - k [Pa]; a positive value predicts fatigue
    energy_index : EI [Pa], positive for dissipation
    """

    T_gamma: float
    T_gamma_spin: float
    dissipation: float
    pearce_sherratt: float
    burstow: float
    usfd: float
    archard: ArchardWear = field(repr=False)
    fatigue_index: float
    stress_index: IndexField = field(repr=False)
    energy_index: IndexField = field(repr=False)
    tangential: str

    @property
    def has_fields(self) -> bool:
        """True if the tangential method gives traction and slip over the patch."""
        return methods().tangential[self.tangential].fields


def evaluate(
    solution: Solution, wheel_radius: float = RADIUS.usual, parameters: DamageParameters | None = None
) -> Damage:
    """Return all damage indices of a solution.

    Parameters
    ----------
    solution : Solution
        Hardness and yield stress are those of its material. Sliding velocities scale with its speed.
    wheel_radius : float
        Rolling radius r [m] > 0. It gives Pearce-Sherratt's diameter, and the circumference over which Archard's wear is
        spread.
    parameters : DamageParameters
        Constants of the models.

    Returns
    -------
    Damage

    Raises
    ------
    ContactError
        If the wheel radius is not positive.
    """
    doubt_value("wheel radius", wheel_radius, "wheel_radius")
    assessed = assess(solution, wheel_radius, parameters)
    number, damage_fields = assessed.damage, assessed.damage_fields
    return Damage(
        **{one.name: float(number[one.name]) for one in fields(Damage) if one.type == "float"},
        archard=ArchardWear(
            depth=damage_fields[DamageField.DEPTH],
            depth_per_strip=damage_fields[DamageField.DEPTH].sum(axis=1),
            depth_max=float(number.archard_depth),
            volume=float(number.archard_volume),
            wheel_radius=wheel_radius,
        ),
        stress_index=IndexField(damage_fields[DamageField.STRESS_INDEX], float(number.stress_index)),
        energy_index=IndexField(damage_fields[DamageField.ENERGY_INDEX], float(number.energy_index)),
        tangential=solution.tangential,
    )


class Assessed(NamedTuple):
    """Input and output arrays of `damage_kernel` for one solution."""

    strips: Array
    fields: Array
    constants: np.record
    damage: np.record
    damage_fields: Array
    result: np.record


def assess(
    solution: Solution, wheel_radius: float = RADIUS.usual, parameters: DamageParameters | None = None
) -> Assessed:
    """Return the results of `evaluate` as the kernel's arrays. Parameters as in `evaluate`."""
    strips, fields, case, result = _arrays(solution)
    damage, damage_fields = np.zeros(1, DAMAGE)[0], np.zeros((len(DamageField), *solution.p.shape))
    constants = (parameters or DamageParameters()).record(solution.material, wheel_radius, solution.speed)
    damage_kernel(strips, strips.shape[1], fields, case, result, constants, damage_fields, damage)
    return Assessed(strips, fields, constants, damage, damage_fields, result)


def _arrays(solution: Solution) -> tuple[Array, Array, np.record, np.record]:
    """Return strips, fields, case and result of a solution as the kernel's arrays. Rows that it does not read are zero."""
    shape = solution.p.shape
    strips = np.zeros((len(Strip), shape[0]))
    strips[Strip.Y], strips[Strip.DY], strips[Strip.A] = solution.strips.y, solution.strips.dy, solution.strips.a
    creepage, given = solution.creepage, solution.strips
    strips[Strip.VX] = creepage.longitudinal if given.longitudinal is None else given.longitudinal
    strips[Strip.VY] = creepage.lateral if given.lateral is None else given.lateral
    strips[Strip.PHI] = creepage.spin if given.spin is None else given.spin
    strips[Strip.TILT] = 0.0 if given.tilt is None else given.tilt
    fields = np.zeros((len(Field), *shape))
    fields[Field.X], fields[Field.P] = solution.x, solution.p
    fields[Field.DX] = solution.dA / strips[Strip.DY][:, None]
    if solution.has_fields:
        fields[Field.QX], fields[Field.QY] = solution.qx, solution.qy
        fields[Field.SX], fields[Field.SY] = solution.sx, solution.sy
    case, result = np.zeros(1, CASE)[0], np.zeros(1, RESULT)[0]
    method = methods().tangential[solution.tangential]
    case.tangential, case.tangential_family = method.id, method.family
    case.vx, case.vy, case.phi = creepage.longitudinal, creepage.lateral, creepage.spin
    result.Fx, result.Fy, result.Mz, result.N = solution.Fx, solution.Fy, solution.Mz, solution.N
    result.pmax, result.area, result.slip_area = solution.max_pressure, solution.area, solution.slip_area
    result.status, result.bend = solution.status, solution.bend
    result.power, result.pressure_y = solution.power_per_metre, solution.pressure_y
    return strips, fields, case, result
