"""`Histogram`: wear and fatigue in bins over the arc length of the profile of a wheel or a rail."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, Literal, get_args

import numpy as np

from contact.arrays import Array
from contact.damage import DamageParameters
from contact.damage.assessment import assess
from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile
from contact.geometry.records import Patch
from contact.inputs.material import Material
from contact.inputs.options import RADIUS
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.damage import deposit
from contact.kernels.records import LEDGER
from contact.kernels.rows import Bin
from contact.results import Solution
from contact.view.notebook import Sketch

Per = Literal["metre", "revolution", "pass"]

#: Name → unit and meaning of the quantities that are summed, in the order of `contact.kernels.damage.deposit`. Volume and
#: T-gamma are totals of the bin; the others are means over its width.
SUMS = {
    "contact": ("m", "distance rolled in contact"),
    "wear": ("m", "depth worn off a wheel; of a rail depth times distance [m²]"),
    "volume": ("m3", "volume worn off"),
    "T_gamma": ("N m", "T-gamma times distance, shared over the contact area"),
    "energy_index": ("Pa m", "mean energy index along the strip times distance"),
    "stress_exceedance": ("m", "distance rolled with a positive stress index somewhere along the strip"),
    "fatigue_exceedance": ("m", "distance rolled with a positive surface fatigue index of the patch"),
    "rcf_forward": ("m", "Burstow's index times distance, where the creep force drives the wheel forward"),
    "rcf_backward": ("m", "Burstow's index times distance, where the creep force brakes the wheel"),
}
#: Name → unit and meaning of the maxima so far, 0 where there was no contact.
MAXIMA = {"energy_index_max": ("Pa", "greatest energy index")}

_NAMES = (*SUMS, *MAXIMA)
_OFF = 1e-4  # a contact point further from the profile [m] belongs to another profile


class Histogram(OwnsArrays):
    """Damage accumulated on one profile. `a + b` is the damage of both histograms.

    Bins have equal width along the profile, and the depth is along the profile's normal. Depth times width is therefore the
    area lost. The damage of a strip is shared among the bins that it overlaps. Damage beyond an end of the profile goes to
    the outermost bin, so nothing is lost. Both sides of a wheelset use the right-side convention, like profiles.

    Parameters
    ----------
    profile : Profile
        Profile of a wheel or a rail, with which the patches were found.
    width : float
        Width of a bin [m], 1e-5 ... 1e-2. The edges are multiples of it.
    radius : float
        Nominal radius of the wheel [m]. A revolution is a rolled distance of 2π·radius.
    parameters : DamageParameters, optional
        Constants of the damage models.

    Attributes
    ----------
    edges, centres : ndarray, shape (n + 1,) and (n,)
        Arc length [m] from the profile's point nearest to y = 0, positive to the field side.
    distance : float
        Distance rolled so far [m].
    methods, materials : set of str, set of Material
        Methods and materials of the solutions.

    Raises
    ------
    ContactError
        For arguments outside their range.

    Notes
    -----
    ``histogram[name]`` is a copy of one quantity over the bins. `per` divides the sums. `SUMS` and `MAXIMA` hold units and
    meanings: ``contact`` [m], ``wear`` [m] (of a rail [m²]), ``volume`` [m³], ``T_gamma`` [N m], ``energy_index`` [Pa m],
    ``stress_exceedance`` and ``fatigue_exceedance`` [m], ``rcf_forward`` and ``rcf_backward`` [m], ``energy_index_max`` [Pa].

    The depth of a wheel is spread over its circumference. A cross-section of a rail is passed once by each axle. The depth
    of a rail is therefore that of one pass, and its totals are those of one pass times the distance. Bins much narrower
    than the strips show the strips as steps. Overlapping patches (``multi_hertz``) are all counted.
    """

    def __init__(
        self,
        profile: Profile,
        *,
        width: float = 5e-4,
        radius: float = RADIUS.usual,
        parameters: DamageParameters | None = None,
    ) -> None:
        if not isinstance(profile, Profile):
            raise ContactError(f"profile = {profile!r} is not a contact.geometry.profile.Profile")
        self.profile = profile
        self.width = require_number("width", width, 1e-5, 1e-2)
        self.radius = require_number("radius", radius, 0.05, 2.0)
        self.parameters = parameters or DamageParameters()
        self._rows = np.stack((profile.y, profile.z))
        self.arc = np.empty(profile.y.size)
        deposit.arc_length(self._rows, self.arc)
        self._start, last = np.floor(self.arc[0] / width), np.ceil(self.arc[-1] / width)
        self.edges = self.width * np.arange(self._start, last + 1.0)
        self.distance = 0.0
        self.methods: set[str] = set()
        self.materials: set[Material] = set()
        self._values = np.zeros((len(_NAMES), self.edges.size - 1))

    def _kept(self) -> Any:
        return self._values, self.distance, set(self.methods), set(self.materials)

    def _keep(self, kept: Any) -> None:
        self._values, self.distance, self.methods, self.materials = kept

    def __getitem__(self, name: str) -> Array:
        if name not in _NAMES:
            raise ContactError(f"quantity = {name!r} is none of {', '.join(_NAMES)}")
        return self._values[_NAMES.index(name)].copy()

    @property
    def centres(self) -> Array:
        """Middle of each bin [m]."""
        return 0.5 * (self.edges[:-1] + self.edges[1:])

    @one_thread
    def add(
        self, patches: Patch | Sequence[Patch], solutions: Solution | Sequence[Solution], *, distance: float
    ) -> None:
        """Add the damage of rolling `distance` with these patches.

        Parameters
        ----------
        patches, solutions : Patch and Solution, or sequences of equal length
            All patches of this wheel at one instant and their solutions; empty if the wheel does not touch.
        distance : float
            Rolled distance [m], not negative.

        Raises
        ------
        ContactError
            For a patch that does not lie on the profile, unequal numbers, a distance outside its range, or a solution of a
            method without fields, which has neither wear nor indices. Nothing is added in these cases.
        """
        distance = require_number("distance", distance, 0.0)
        patches = (patches,) if isinstance(patches, Patch) else tuple(patches)
        solutions = (solutions,) if isinstance(solutions, Solution) else tuple(solutions)
        if len(patches) != len(solutions):
            raise ContactError(f"{len(patches)} patches have {len(solutions)} solutions")
        touching = [pair for pair in zip(patches, solutions, strict=True) if pair[1].strips.y.size]
        values = self._values.copy()
        for patch, solution in touching:
            self._deposit(patch, solution, distance, values)
        self._values = values
        self.distance += distance
        self.methods |= {f"{solution.normal} + {solution.tangential}" for _, solution in touching}
        self.materials |= {solution.material for _, solution in touching}

    def _deposit(self, patch: Patch, solution: Solution, distance: float, values: Array) -> None:
        if not solution.has_fields:
            raise ContactError(
                f"tangential = {solution.tangential!r} gives forces only; wear and indices need its fields"
            )
        done = assess(solution, patch.rolling_radius, self.parameters)
        n = solution.strips.y.size
        rates, edges = np.empty((len(Bin), n)), np.empty((2, n))
        y, z = patch.on_wheel if self.profile.kind == "wheel" else patch.on_rail
        mirror = math.copysign(1.0, patch.position[1])  # the right rail lies at positive y
        off = deposit.place(self._rows, self.arc, (y, z), patch.angle, mirror, done.strips, n, edges)
        if off > _OFF:
            raise ContactError(
                f"patch.on_{self.profile.kind} = ({y:g}, {z:g}) does not lie on {self.profile!r}; "
                "was it found with another profile?"
            )
        deposit.strip_rates(
            done.strips, n, done.fields, done.constants, done.damage, done.damage_fields, solution.Fx, rates
        )
        is_wheel = self.profile.kind == "wheel"
        settings = np.array([(self._start, self.width, distance)], LEDGER)[0]
        wear = 1.0 if is_wheel else self.parameters.rail_wear
        deposit.deposit(rates, edges, done.strips, n, settings, patch.share, is_wheel, wear, values)

    def __add__(self, other: Histogram) -> Histogram:
        if not isinstance(other, Histogram):
            return NotImplemented
        self._require_same_bins(other)
        both = Histogram(self.profile, width=self.width, radius=self.radius, parameters=self.parameters)
        n = len(SUMS)
        both._values[:n] = self._values[:n] + other._values[:n]
        both._values[n:] = np.maximum(self._values[n:], other._values[n:])
        both.distance = self.distance + other.distance
        both.methods, both.materials = self.methods | other.methods, self.materials | other.materials
        return both

    def scaled(self, times: float) -> Histogram:
        """Return the histogram after `times` the distance under the same conditions.

        Raises
        ------
        ContactError
            If `times` is negative.
        """
        require_number("times", times, 0.0)
        later = Histogram(self.profile, width=self.width, radius=self.radius, parameters=self.parameters)
        values = dict(zip(_NAMES, self._values, strict=True)) | {n: times * self[n] for n in SUMS}
        later.restore(values, times * self.distance, set(self.methods), set(self.materials))
        return later

    def restore(
        self, values: Mapping[str, Array], distance: float, methods: set[str], materials: set[Material]
    ) -> None:
        """Replace the accumulated damage: all quantities over the bins, the distance [m], methods and materials."""
        self._values = np.array([values[name] for name in _NAMES], dtype=np.float64)
        self.distance, self.methods, self.materials = distance, methods, materials

    def _require_same_bins(self, other: Histogram) -> None:
        a, b = self.profile, other.profile
        if a.kind != b.kind or not (np.array_equal(a.y, b.y) and np.array_equal(a.z, b.z)):
            raise ContactError(f"histograms over different profiles do not add up: {a!r} and {b!r}")
        for name in ("width", "radius", "parameters"):
            mine, others = getattr(self, name), getattr(other, name)
            if mine != others:
                raise ContactError(f"histograms of different {name} do not add up: {mine} and {others}")

    def per(self, unit: Per) -> dict[str, Array]:
        """Return all sums per metre rolled, per revolution of the wheel, or per axle pass of a rail's cross-section.

        Parameters
        ----------
        unit : {"metre", "revolution", "pass"}
            For a rail "metre" and "pass" give the same numbers: the mean damage of one pass over the distance.

        Raises
        ------
        ContactError
            For any other unit, "revolution" of a rail, "pass" of a wheel, or if nothing has rolled yet.
        """
        of_the_other = "pass" if self.profile.kind == "wheel" else "revolution"
        if unit not in get_args(Per) or unit == of_the_other:
            allowed = ", ".join(repr(known) for known in get_args(Per) if known != of_the_other)
            raise ContactError(f"unit = {unit!r} is none of {allowed}, which a {self.profile.kind} has")
        if self.distance <= 0.0:
            raise ContactError("distance = 0: nothing has rolled yet")
        number = self.distance / (2.0 * np.pi * self.radius) if unit == "revolution" else self.distance
        return {name: self._values[k] / number for k, name in enumerate(SUMS)}

    @property
    def depth(self) -> Array:
        """Depth worn off along the profile's normal [m]: the total of a wheel, that of one axle pass for a rail."""
        if self.profile.kind == "wheel" or self.distance <= 0.0:
            return self["wear"]
        return self.per("pass")["wear"]

    @property
    def fatigue(self) -> Array:
        """Burstow's index over the bins of one axle pass, or of one revolution of a wheel, without a floor [-].

        Cracks grow where the creep force on the rolling surface points against the running direction: in a rail under a
        wheel that is driven forward, in a wheel that is braked. Passes in the other direction do not count.
        """
        name = "rcf_backward" if self.profile.kind == "wheel" else "rcf_forward"
        return self[name] / self.distance if self.distance > 0.0 else self[name]

    @property
    def volume(self) -> float:
        """Volume worn off [m³], from the wheel or from the rail along the distance."""
        return float(self["volume"].sum())

    def _repr_html_(self) -> str:
        """Return HTML with a sketch of the depth over the arc length, for a notebook."""
        depth, edges = 1e6 * self.depth, 1e3 * self.edges
        worn = np.flatnonzero(depth)
        first, last = (max(int(worn[0]) - 2, 0), min(int(worn[-1]) + 3, depth.size)) if worn.size else (0, depth.size)
        ends = edges[first : last + 1]
        what = "depth worn off" if self.profile.kind == "wheel" else "depth worn off in one pass"
        drawn = Sketch((ends[0], ends[-1]), (0.0, float(depth.max())), ("arc length [mm]", f"{what} [µm]"), what)
        drawn.area(
            np.r_[ends[0], np.repeat(ends[1:-1], 2), ends[-1], ends[-1], ends[0]],
            np.r_[np.repeat(depth[first:last], 2), 0.0, 0.0],
        )
        return f"{drawn.svg()}<div>{escape(repr(self))}</div>"

    def __repr__(self) -> str:
        return (
            f"Histogram({self.profile!r}, {self.edges.size - 1} bins of {1e3 * self.width:g} mm, "
            f"{self.distance:.6g} m rolled, {1e9 * self.volume:.4g} mm³ worn off)"
        )
