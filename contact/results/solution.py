"""`Solution`, the record that every solver returns."""

from __future__ import annotations

import copy
import math
import warnings
from dataclasses import dataclass, field
from functools import cached_property
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array, brief
from contact.damage import Damage, evaluate
from contact.errors import only_with_fields
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material
from contact.kernels.arrays import SolverArrays
from contact.kernels.enumerations import Status
from contact.kernels.friction import of_case
from contact.kernels.records import CASE, RESULT
from contact.kernels.rows import Field, Strip
from contact.registry import methods
from contact.results.jacobian import Jacobian
from contact.results.later import RENAMED, STATES, MadeLater, reader
from contact.results.pressure import pressure_at, sketch
from contact.view.notebook import beside, table
from contact.view.tables import Table

Records = NDArray[np.void]

_UNTOLD = "edges", "limited", "touch", "status"
_MEMBERS = list(RESULT.names or ())
#: Attributes of a solution that are members of the kernel's record, and what picks them from its numbers.
_NAMES = [RENAMED.get(name, name) for name in _MEMBERS if name not in _UNTOLD]
_PICK = itemgetter(*(k for k, name in enumerate(_MEMBERS) if name not in _UNTOLD))
#: Reads the record as numbers. Where some of them are; the edges are the last ones.
READ_RESULT = reader(RESULT).unpack_from
STATUS, N_AT, BEND_AT, BEYOND_AT, GAP_ERROR, _EDGES = (
    _MEMBERS.index(name) for name in ("status", "N", "bend", "beyond", "gap_error", "edges")
)
#: Attribute of a solution → its row in the kernel's fields.
_FIELDS = {"x": Field.X, "p": Field.P, "qx": Field.QX, "qy": Field.QY, "sx": Field.SX, "sy": Field.SY}


@dataclass(frozen=True, slots=True, eq=False)
class Strips:
    """Longitudinal strips of the patch, each with a semi-elliptic pressure. All arrays have shape (n,).

    Attributes
    ----------
    y, dy : lateral position and width [m]
    x_c, a : centre along x and half length [m]
    p0 : peak pressure [Pa]
    aspect : a/b of the local ellipse [-]
    patch : label of the patch, 0, 1, …
    longitudinal, lateral, spin : creepages of each strip [-], [-], [1/m]; None unless `conformal`. The rigid slip of a
        strip is (longitudinal - spin·y, lateral + spin·x)
    tilt : slope of the curved contact surface against the contact plane [-]; None unless `conformal`

    Examples
    --------
    >>> import contact
    >>> strips = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(), load=80e3).strips
    >>> strips.y.size, round(1e3 * float(strips.a.max()), 1)  # half length of the longest one in mm
    (20, 5.9)
    """

    y: Array
    dy: Array
    x_c: Array
    a: Array
    p0: Array
    aspect: Array
    patch: NDArray[np.int64]
    longitudinal: Array | None = None
    lateral: Array | None = None
    spin: Array | None = None
    tilt: Array | None = None

    __repr__ = brief


class Prepared(NamedTuple):
    """Settings of a solver that its solutions record; `speed` in m/s."""

    normal: str
    tangential: str
    material: Material
    speed: float


@only_with_fields("qx", "qy", "sx", "sy", "stick")
@dataclass(frozen=True, eq=False)
class Solution(MadeLater):
    """Solved contact of one wheel-rail pair in the frame of its separation.

    Forces act on the wheel. x points in the rolling direction, y is lateral, z points along the common normal. Fields have
    shape (n_strips, n_elements); element 0 is at the leading edge. Without contact the fields are empty and all numbers
    are zero. If the tangential method gives forces only, `has_fields` is false and reading traction, slip or stick raises
    a ContactError.

    Two solutions compare equal only if they are the same object. All arrays are read-only and own their memory, so keeping
    one array does not keep others alive. Solutions can be copied and pickled, and changed by `dataclasses.replace`. If the
    tangential method gives forces only, `replace` and `dataclasses.asdict` raise the ContactError of the missing fields.

    Attributes
    ----------
    Fx, Fy : tangential force on the wheel [N]
    pressure_y : part of Fy that comes from pressure on a curved surface and not from creepage [N]; see
        `contact.kernels.conformal`
    Mz : spin moment ∫(x q_y - y q_x) dA about the separation's origin [N m]
    N : normal force [N]
    approach : rigid approach of the bodies measured from g = 0 [m]
    max_pressure : largest pressure [Pa]
    area, slip_area : contact area and area of its slip zone [m²]
    power_per_metre : frictional energy per metre rolled, -∬ q·s dA ≥ 0 [N]
    normal_stiffness : dN/d(approach) [N/m]
    gap_error : the largest gap or overlap that the pressure leaves inside the patch, over the approach [-], or the mean
        pressure of waves that are narrower than the strips, over the largest one, if that is more. It estimates the error
        of the normal problem: 0 is exact, above the method's `gap_limit` (`contact.methods()`) the largest pressure is
        doubtful
    bend : change of the contact angle over the patches, which lie in one plane [rad]. The contact is taken as plane unless
        `conformal`; above `BEND` its lateral force is up to a tenth of the load off. The half space in the plane does not
        tell it: 0
    beyond : share of the load on shapes that are more slender or shorter (a/b) than the ellipses of the table of creep forces,
        which then answers with its outermost ones [-]; above `BEYOND` forces are doubtful. It counts for `fastrip_mapped` and
        `table`; for other methods that read Kalker's coefficients it is the share of the load on patches beyond them
    length, width : extent of the patch along x and y [m]
    n_patches, iterations : int
    status : Status
    x, y, p, qx, qy, sx, sy, stick, dA : fields: position [m], pressure and traction on the wheel [Pa], slip velocity
        relative to V [-], stick flag, element area [m²]
    jacobian : derivatives, if they were asked for by ``derivatives=True``; else None

    Examples
    --------
    >>> import contact
    >>> gap = contact.Separation.hertzian(1.1, 0.8)
    >>> solution = contact.solve(gap, contact.Creepage(1e-3), load=80e3, speed=20.0)
    >>> round(solution.slip_ratio, 2), round(solution.damage.T_gamma, 1)
    (0.31, 11.8)
    """

    Fx: float
    Fy: float
    Mz: float
    N: float
    approach: float
    max_pressure: float
    area: float
    slip_area: float
    power_per_metre: float
    normal_stiffness: float
    gap_error: float
    bend: float
    beyond: float
    length: float
    width: float
    n_patches: int
    iterations: int
    status: Status
    strips: Strips
    x: Array
    y: Array
    p: Array
    qx: Array
    qy: Array
    sx: Array
    sy: Array
    stick: NDArray[np.bool_]
    dA: Array
    creepage: Creepage
    friction: float
    material: Material
    speed: float
    normal: str
    tangential: str
    pressure_y: float
    patch_edges: Array = field(repr=False)
    memory: Array = field(repr=False)
    jacobian: Jacobian | None = field(default=None, repr=False, kw_only=True)

    @classmethod
    def of_kernel(
        cls,
        record: tuple[Any, ...],
        n: int,
        arrays: SolverArrays,
        creepage: Creepage,
        prepared: Prepared,
        jacobian: Jacobian | None = None,
    ) -> Solution:
        """Return a solution from the arrays that a kernel has filled for `n` strips; `record` are the numbers of the result.

        The arrays are copied now; friction, strips and fields are made from the copy when one of them is first read, which
        takes longer than the solution.
        """
        numbers = dict(zip(_NAMES, _PICK(record), strict=True))
        numbers["status"] = STATES[record[STATUS]]
        numbers["creepage"], numbers["jacobian"] = creepage, jacobian
        numbers["normal"], numbers["tangential"], numbers["material"], numbers["speed"] = prepared
        space, edges = arrays.workspace, record[_EDGES : _EDGES + 2 * numbers["n_patches"]]
        strips, fields = space.strips[:, :n].copy(), space.fields[:, :n].copy()
        return cls.later(numbers, _arrays, arrays.case[0].tobytes(), edges, strips, fields, space.space.memory.copy())

    def __post_init__(self) -> None:
        """Make every array read-only and the owner of its memory."""
        _own_all(self.__dict__)

    def __getstate__(self) -> dict[str, Any]:
        """Return the attributes for a copy or a pickle. The cached damage is left out and evaluated again."""
        state = super().__getstate__()
        state.pop("damage", None)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(state)
        _own_all(self.__dict__)

    def _table(self) -> Table:
        names = ("p", "qx", "qy", "sx", "sy", "stick", "dA") if self.has_fields else ("p", "dA")
        n_strips, n_elements = self.p.shape
        return Table(
            {"strip": np.arange(n_strips), "element": np.arange(n_elements)},
            {name: getattr(self, name) for name in names},
            {"x": self.x, "y": self.y, "patch": self.strips.patch},
            attributes={"normal": self.normal, "tangential": self.tangential, "status": self.status.name},
        )

    def __repr__(self) -> str:
        return (
            f"Solution({self.status.name}: N = {self.N:.6g} N, Fx = {self.Fx:.6g} N, Fy = {self.Fy:.6g} N, "
            f"Mz = {self.Mz:.6g} N m, "
            f"{self.n_patches} patch(es), {self.area * 1e6:.4g} mm², {self.max_pressure / 1e6:.5g} MPa; "
            f"{self.normal} + {self.tangential})"
        )

    def _repr_html_(self) -> str:
        """Return HTML for a notebook: the main numbers as a table, and a sketch of the patch and its pressure."""
        limit = methods().normal[self.normal].gap_limit
        numbers = (
            ("status", self.status.name),
            ("N", f"{self.N:.6g} N"),
            ("Fx, Fy", f"{self.Fx:.6g} N, {self.Fy:.6g} N"),
            ("Mz", f"{self.Mz:.6g} N m"),
            (
                "creepages",
                f"{self.creepage.longitudinal:g}, {self.creepage.lateral:g}; spin {self.creepage.spin:g} 1/m",
            ),
            ("approach", f"{1e6 * self.approach:.5g} µm"),
            ("patches", f"{self.n_patches}"),
            ("area", f"{1e6 * self.area:.4g} mm²"),
            ("slip area / area", f"{self.slip_ratio:.3g}"),
            ("length × width", f"{1e3 * self.length:.4g} mm × {1e3 * self.width:.4g} mm"),
            ("greatest pressure", f"{1e-6 * self.max_pressure:.5g} MPa"),
            ("gap error", f"{self.gap_error:.2g}{' (the pressure is doubtful)' if self.gap_error > limit else ''}"),
            ("change of contact angle", f"{math.degrees(self.bend):.3g}°"),
            ("friction", f"{self.friction:g}"),
            ("used friction", f"{self.used_friction:.3g}"),
            ("energy per metre", f"{self.power_per_metre:.4g} J/m"),
        )
        shown = table((), numbers, f"{self.normal} + {self.tangential}")
        return beside(shown, sketch(self.strips)) if self.strips.y.size else shown

    @property
    def has_fields(self) -> bool:
        """True if the tangential method gives traction, slip and stick over the patch."""
        return methods().tangential[self.tangential].fields

    @property
    def converged(self) -> bool:
        """True unless the iteration stopped at its limit."""
        return self.status != Status.NOT_CONVERGED

    @property
    def slip_ratio(self) -> float:
        """Slip area over contact area [-]; 0 without contact."""
        return self.slip_area / self.area if self.area > 0.0 else 0.0

    @property
    def used_friction(self) -> float:
        """Creep force over normal force [-]; 0 without contact."""
        return math.hypot(self.Fx, self.Fy - self.pressure_y) / self.N if self.N > 0.0 else 0.0

    @property
    def utilisation(self) -> float:
        """The earlier name of `used_friction`; it goes with 1.0."""
        warnings.warn("Solution.utilisation is now Solution.used_friction", DeprecationWarning, stacklevel=2)
        return self.used_friction

    def with_status(self, status: Status) -> Solution:
        """Return a copy with another status."""
        other = copy.copy(self)
        other.__dict__["status"] = status
        return other

    @cached_property
    def damage(self) -> Damage:
        """Wear and fatigue indices with default parameters; call `contact.damage.evaluate` for other parameters."""
        return evaluate(self)

    def pressure(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the contact pressure [Pa] at points `x`, `y` [m] of the contact plane; 0 outside the patch.

        `x` and `y` broadcast. Along a strip the pressure is semi-elliptic, limited to the material's `pressure_limit`.
        Across the strips, a² and p0·a are interpolated by the parabola through the nearest three strips or edges. Both
        vanish at the edges of a patch. The interpolation is exact for an ellipse.
        """
        return pressure_at(self, x, y)


def _arrays(case: bytes, edges: tuple[float, ...], strips: Array, fields: Array, memory: Array) -> dict[str, Any]:
    """Return friction, strips and fields of a `Solution` from copies of a kernel's records and arrays."""
    record = np.frombuffer(case, CASE)[0]
    y, dA = np.repeat(strips[Strip.Y][:, None], fields.shape[2], axis=1), fields[Field.DX] * strips[Strip.DY][:, None]
    stick, patch = fields[Field.STICK] > 0.5, strips[Strip.PATCH].astype(np.int64)
    bent = record.conformal != 0
    found = {
        "friction": float(of_case(record)),
        "strips": Strips(
            y=strips[Strip.Y],
            dy=strips[Strip.DY],
            x_c=strips[Strip.XC],
            a=strips[Strip.A],
            p0=strips[Strip.P0],
            aspect=strips[Strip.ASPECT],
            patch=patch,
            longitudinal=strips[Strip.VX] if bent else None,
            lateral=strips[Strip.VY] if bent else None,
            spin=strips[Strip.PHI] if bent else None,
            tilt=strips[Strip.TILT] if bent else None,
        ),
        **{name: fields[row] for name, row in _FIELDS.items()},
        "y": y,
        "stick": stick,
        "dA": dA,
        "patch_edges": np.array(edges).reshape(-1, 2),
        "memory": memory,
    }
    _own_all(found)
    return found


def _own_all(values: dict[str, Any]) -> None:
    """Replace all arrays, also those in strips and tuples, by read-only arrays that own their memory."""
    for name, value in values.items():
        if isinstance(value, np.ndarray):
            values[name] = _own(value)
        elif isinstance(value, Strips):
            values[name] = Strips(**{k: _own(getattr(value, k)) for k in Strips.__slots__})
        elif isinstance(value, tuple) and value and all(isinstance(part, np.ndarray) for part in value):
            values[name] = tuple(map(_own, value))


def _own(array: Any) -> Any:
    """Return a read-only array that owns its memory: `array` itself if it is one already, else a copy."""
    if not isinstance(array, np.ndarray) or (array.base is None and not array.flags.writeable):
        return array
    copied = array.copy()
    copied.setflags(write=False)
    return copied
