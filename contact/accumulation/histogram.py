"""`Histogram`: wear and fatigue in bins over the arc length of a wheel's or a rail's own profile."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from contact.damage import DamageParameters
from contact.damage.assessment import assess
from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile
from contact.geometry.records import Patch
from contact.kernels.damage import deposit
from contact.kernels.layout import LEDGER, N_BIN_ROWS
from contact.material import Material
from contact.notebook import Sketch
from contact.solution import Solution

Array = NDArray[np.float64]
Per = Literal["metre", "revolution", "pass"]

#: Name → unit and meaning of what adds up, in the order of `contact.kernels.damage.deposit`. Volume and T-gamma are those of
#: the bin, the rest are means over its width.
SUMS = {
    "contact": ("m", "distance rolled in contact"),
    "wear": ("m", "depth worn off a wheel; of a rail depth times distance [m²]"),
    "volume": ("m3", "volume worn off"),
    "T_gamma": ("N m", "T-gamma times distance, shared over the contact area"),
    "energy_index": ("Pa m", "mean energy index along the strip times distance"),
    "stress_exceedance": ("m", "distance rolled with a positive stress index somewhere along the strip"),
    "fatigue_exceedance": ("m", "distance rolled with a positive surface fatigue index of the patch"),
}
#: Name → unit and meaning of what is the greatest so far, 0 where there was no contact.
MAXIMA = {"energy_index_max": ("Pa", "greatest energy index")}

_NAMES = (*SUMS, *MAXIMA)
_OFF = 1e-4  # [m] from the profile at which a contact point cannot be meant to lie on it


class Histogram:
    """Damage that has accumulated on one profile; `a + b` is that of both.

    Bins are of equal width along the profile, so that depth, taken along the profile's normal, times width is the area
    lost. What a strip does is shared over the bins that it overlaps: nothing is lost, not even beyond the profile's ends,
    which belongs to the outermost bins. Both sides of a wheelset are taken in the right-side convention, as profiles are.

    Parameters
    ----------
    profile : Profile
        Of a wheel or a rail; the patches must have been found with it.
    width : float
        Of a bin [m], 1e-5 ... 1e-2. Edges are multiples of it.
    radius : float
        Nominal radius of the wheel [m]: a revolution is 2π·radius rolled.
    parameters : DamageParameters, optional
        Constants of the damage models.

    Attributes
    ----------
    edges, centres : ndarray, shape (n + 1,) and (n,)
        Arc length [m] from the profile's point nearest to y = 0, positive to the field side.
    distance : float
        Rolled so far [m].
    methods, materials : set of str, set of Material
        What the solutions came from.

    Raises
    ------
    ContactError
        For arguments outside their range.

    Notes
    -----
    ``histogram[name]`` is a copy of one quantity over the bins; `per` divides the sums, `SUMS` and `MAXIMA` hold units and
    meanings: ``contact`` [m], ``wear`` [m] (of a rail [m²]), ``volume`` [m³], ``T_gamma`` [N m], ``energy_index`` [Pa m],
    ``stress_exceedance`` and ``fatigue_exceedance`` [m], ``energy_index_max`` [Pa].

    The depth of a wheel is spread over its circumference; a metre of a rail sees each axle once, so that its depth belongs
    to a pass and its totals are those of one pass times the distance. Bins much narrower than the strips show these as
    steps; patches that overlap (``multi_hertz``) count each.
    """

    def __init__(
        self,
        profile: Profile,
        *,
        width: float = 5e-4,
        radius: float = 0.46,
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

    def __getitem__(self, name: str) -> Array:
        if name not in _NAMES:
            raise ContactError(f"quantity = {name!r} is none of {', '.join(_NAMES)}")
        return self._values[_NAMES.index(name)].copy()

    @property
    def centres(self) -> Array:
        """Middle of each bin [m]."""
        return 0.5 * (self.edges[:-1] + self.edges[1:])

    def add(
        self, patches: Patch | Sequence[Patch], solutions: Solution | Sequence[Solution], *, distance: float
    ) -> None:
        """Let the wheel roll `distance` with these patches.

        Parameters
        ----------
        patches, solutions : Patch and Solution, or as many of each
            All patches of this wheel at one instant and what was solved for them; none when it does not touch.
        distance : float
            [m], not negative.

        Raises
        ------
        ContactError
            A patch that does not lie on the profile, unequal numbers, a distance outside its range, and a solution of a
            creep force law, which has neither wear nor indices. Nothing is added then.
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
                f"tangential = {solution.tangential!r} gives forces alone; wear and indices need its fields"
            )
        done = assess(solution, patch.rolling_radius, self.parameters)
        n = solution.strips.y.size
        rates, edges = np.empty((N_BIN_ROWS, n)), np.empty((2, n))
        y, z = patch.on_wheel if self.profile.kind == "wheel" else patch.on_rail
        mirror = math.copysign(1.0, patch.position[1])  # the right rail lies at positive y
        off = deposit.place(self._rows, self.arc, (y, z), patch.angle, mirror, done.strips, n, edges)
        if off > _OFF:
            raise ContactError(
                f"patch.on_{self.profile.kind} = ({y:g}, {z:g}) does not lie on {self.profile!r}; "
                "was it found with another profile?"
            )
        deposit.strip_rates(done.strips, n, done.fields, done.constants, done.damage, done.damage_fields, rates)
        is_wheel = self.profile.kind == "wheel"
        settings = np.array([(self._start, self.width, distance)], LEDGER)[0]
        deposit.deposit(rates, edges, done.strips, n, settings, patch.share, is_wheel, values)

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
        """The histogram after `times` the distance under the same conditions: a share of a mileage.

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
        """Replace what has accumulated: every quantity over the bins, and the attributes of these names."""
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
        """All sums per metre rolled, per revolution of the wheel, or per axle pass at a cross-section of the rail.

        Parameters
        ----------
        unit : {"metre", "revolution", "pass"}
            For a rail "metre" and "pass" are the same numbers: the mean over the distance of what one pass does.

        Raises
        ------
        ContactError
            For another unit, a revolution of a rail, a pass of a wheel, and before anything has rolled.
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
        """Depth worn off along the profile's normal [m]: of a wheel all of it, of a rail that of one axle pass (0 before)."""
        if self.profile.kind == "wheel" or self.distance <= 0.0:
            return self["wear"]
        return self.per("pass")["wear"]

    @property
    def volume(self) -> float:
        """Volume worn off [m³]: from this wheel, or from the rail along the distance."""
        return float(self["volume"].sum())

    def _repr_html_(self) -> str:
        """Return a sketch of the depth over the arc length, for a notebook."""
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
