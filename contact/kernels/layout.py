"""Memory layout shared by the kernels, the Python library and the FMU's C code.

A record is a numpy structured type, aligned like a C struct: ``case.mu``, ``result.Fx``. All members are 8 bytes wide
(int64 or float64), so a record fills a whole number of float64 and can lie anywhere in a block of them. An `IntEnum` names
the rows of an array (``strips[Strip.Y, i]``) or the values of an integer member (``case.normal == Normal.HERTZ``).
All quantities are in SI units; lengths in m, forces in N, angles in rad.
"""

from __future__ import annotations

from enum import IntEnum

import numpy as np

#: Largest number of separate patches of one separation.
MAX_PATCHES = 4
#: Largest number of runs of interpenetration that a contact search keeps apart.
MAX_LOBES = 16

#: Range of creepages [-] and spin [1/m]: slip beyond any use, and far from where squares overflow.
LARGEST_CREEPAGE = 1e6

_INT, _FLOAT = np.int64, np.float64


def _record(members: str) -> np.dtype:
    """Return the aligned record of the words of `members`: ``name`` is a float64, ``name:int`` an int64, ``name:8`` an array."""
    fields: list[tuple] = []
    for word in members.split():
        name, _, kind = word.partition(":")
        if kind.isdigit():
            fields.append((name, _FLOAT, (int(kind),)))
        else:
            fields.append((name, _INT if kind == "int" else _FLOAT))
    return np.dtype((np.record, np.dtype(fields, align=True)))


class LoadKind(IntEnum):
    """What `case.amount` is: a normal force [N] or a rigid approach [m]."""

    LOAD = 0
    APPROACH = 1


class Normal(IntEnum):
    """Normal methods, in the order of `contact.methods()`."""

    ANALYN = 0
    HERTZ = 1
    STRIP_HALFSPACE = 2
    KIK_PIOTROWSKI = 3
    KIK_PIOTROWSKI_2008 = 4
    LINDER = 5
    STRIPES_A = 6
    STRIPES_AB = 7
    WINKLER = 8
    SRST = 9
    KPEC = 10
    SEMI_WINKLER = 11
    MULTI_HERTZ = 12
    PASCAL_SAUVAGE = 13
    HALFSPACE = 14  # element by element: no kernel of this package


class NormalFamily(IntEnum):
    """The kernel that solves a normal method."""

    ANALYN = 0
    HERTZ = 1
    STRIP_HALFSPACE = 2
    BY_APPROACH = 3  # strips follow from the approach in one go
    NONE = 4


class Tangential(IntEnum):
    """Tangential methods."""

    FASTRIP = 0
    FASTSIM = 1
    FASTRIP_MAPPED = 2
    FASTSIM_ONE = 3
    FASTSIM_ELLIPTIC = 4
    FASTSIM_LINDER = 5
    FASTSIM_STRIPES = 6
    STRIP_THEORY = 7
    CARTER = 8
    JOHNSON = 9
    VERMEULEN_JOHNSON = 10
    LINEAR = 11
    LINEAR_SATURATED = 12
    SHEN_HEDRICK_ELKINS = 13
    POLACH = 14
    TABLE = 15
    HALFSPACE = 16  # element by element: no kernel of this package


class TangentialFamily(IntEnum):
    """The kernel that solves a tangential method."""

    FASTRIP = 0
    FASTRIP_MAPPED = 1
    FASTSIM = 2
    CREEP_FORCE = 3  # forces only, no fields
    NONE = 4


class FrictionLaw(IntEnum):
    """How the coefficient of friction falls with the sliding velocity."""

    COULOMB = 0
    LINEAR = 1
    RATIONAL = 2
    RATIONAL_SQUARE = 3
    EXPONENTIAL = 4


class SlipVelocity(IntEnum):
    """The sliding velocity that a friction law takes."""

    GLOBAL = 0
    LOCAL = 1
    GREATEST = 2


class Status(IntEnum):
    """How a solution came about; the numbers are those of the FMU's `status`."""

    OK = 1
    NO_CONTACT = 2
    SATURATED = 3  # full slip: |F| = mu N up to the effect of spin
    OUT_OF_RANGE = 4  # the patch reaches the end of the separation: data are missing
    NOT_CONVERGED = 5

    @property
    def message(self) -> str:
        """One sentence for a log."""
        return _MESSAGES[self]


_MESSAGES = {
    Status.OK: "solved",
    Status.NO_CONTACT: "the bodies do not touch: all forces are zero",
    Status.SATURATED: "solved; the whole patch slips",
    Status.OUT_OF_RANGE: "the contact patch reaches the end of the given separation; extend y",
    Status.NOT_CONVERGED: "the iteration stopped at its cap; the last iterate is returned",
}


class Height(IntEnum):
    """What the height of a wheel on its rail follows from: pose.z, a penetration [m] or a vertical load [N]."""

    GIVEN = 0
    PENETRATION = 1
    LOAD = 2


class NoAnswer(IntEnum):
    """Why a contact search has no answer."""

    NO_OVERLAP = -1  # the profiles do not lie above each other
    NOT_SETTLED = -2  # no height was found at which the wheel carries the load
    TOO_DEEP = -3  # the wheel lies far inside the rail


class WearLaw(IntEnum):
    """The law by which profiles wear."""

    ARCHARD = 0
    USFD = 1
    USFD_LOCAL = 2
    PEARCE_SHERRATT = 3


#: One contact problem besides its separation. `amount` is the load [N] or the approach [m], see `LoadKind`; `mu` the coefficient of
#: friction at rest; `pressure_limit` [Pa], 0 or infinite for none; `velocity` a `SlipVelocity`; `slope`, `slope_far`, `slope_rate` the
#: factor on the creep stiffness at small creepage, its limit at large, its rate; `gauge_factor` the factor on the coefficient on one
#: side of `border` [m], over `border_width` [m], whose sign says on which side; `conformal` is 1 where the surface of contact is not
#: taken as a plane, and `rolling` [1/m] is then the turn of the wheel about the plane's y axis per metre; `k_A`, `k_S` Polach's
#: reduction factors; `drop` what heat takes off the coefficient over that of the cold surface, from the rise `warm` [K] on, over
#: `warm_range` [K]; `heating` the heat share over 2 √(π λ ρ c) [m² K/(W √s)].
CASE = _record(
    """
    load_kind:int amount
    normal:int normal_family:int tangential:int tangential_family:int
    vx vy phi speed
    G nu pressure_limit
    mu law:int kinetic half_speed velocity:int
    slope slope_far slope_rate
    gauge_factor border border_width
    k_A k_S
    drop warm warm_range heating
    conformal:int rolling
    """
)

#: What a solver says besides fields. `slip_area` [m²]; `power` is the dissipated energy per metre rolled [N], -∬ q·s dA; `stiffness`
#: dN/d(approach) [N/m]; `pressure_y` what of `Fy` is the pressure on a bent surface; `touch` the approach at which the bodies first
#: touch [m]; `limited` is 1 where the pressure was cut at its limit; `edges` holds the lateral edges of the patches, two each.
RESULT = _record(
    f"""
    Fx Fy Mz N
    approach pmax area slip_area power stiffness length width
    n_patches:int iterations:int status:int limited:int
    pressure_y touch
    edges:{2 * MAX_PATCHES}
    """
)

#: Pose, velocity and irregularity as a caller gives them, of either side. The wheelset's centre is at (0, y, z - radius).
GIVEN = _record(
    """
    y z roll yaw
    vx vy vz roll_rate yaw_rate spin
    rail_y rail_z rail_roll rail_vy rail_vz rail_roll_rate
    """
)

#: The same on the right side, with the rail's origin added to `rail_y` and `rail_z`, and what a search needs besides: the nominal
#: rolling `radius`, the distance of the `tape` circle from the wheelset's centre, when lobes share a plane, `mirror` 1 for the right
#: and -1 for the left side, and the `origin` of the rail's profile without irregularity.
MOTION = _record(
    """
    y z roll yaw
    vx vy vz roll_rate yaw_rate spin
    rail_y rail_z rail_roll rail_vy rail_vz rail_roll_rate
    radius tape combine_distance combine_angle most_patches:int mirror origin_y origin_z
    """
)

#: Runs of interpenetration, later whole patches; moments are weighted with the interpenetration; `low`, `low_z` and `high`,
#: `high_z` are its edges, `tie` the share by which a patch still forms one with the patch before it.
LOBE = _record("low high low_z high_z weight moment cosine sine tie")

#: One patch of a search, on the right side. (x, y, z) is the reference point in track coordinates, `rail_…` and `wheel_…` the same
#: point in profile coordinates, `point_…` the wheel's point opposite; `low` and `high` are the edges of the interpenetration along
#: the plane; `load` is filled by a search for a load; `share`, with which the patch counts, is below 1 only while lobes pass
#: from one plane to planes of their own.
PATCH = _record(
    """
    angle x y z rail_y rail_z wheel_y wheel_z radius approach
    vx vy phi
    low high load point_y point_z share
    """
)

#: One patch of a pair. Forces act on the wheel in the contact frame; `Mx`, `My` are moments of the pressure about the reference point;
#: (x, y, z) is the wheel's point opposite it in track coordinates; creepages are those there.
CONTACT = _record(
    "N Fx Fy Mx My Mz x y z angle area pmax longitudinal lateral spin approach status:int",
)

#: Damage numbers of `contact.damage.Damage`; indices are maxima [Pa], Archard's per metre rolled.
DAMAGE = _record(
    """
    T_gamma T_gamma_spin dissipation pearce_sherratt burstow usfd archard_depth archard_volume
    fatigue_index stress_index energy_index
    """
)

#: All patches of a pair together. Forces on the wheel in track coordinates, moments about the wheelset's centre; `z` is pose.z as
#: given or as found; `power` is the dissipated energy per metre rolled [N]. Then damage, added up or the greatest.
TOTAL = _record(
    "Fx Fy Fz Mx My Mz z n_patches:int status:int pmax area slip_area power " + " ".join(DAMAGE.names or ()),
)

#: Constants of the damage models; the arrays are those of `contact.damage`'s dataclasses.
DAMAGE_PARAMETERS = _record(
    """
    speed wheel_radius hardness shear_yield with_spin:int wear_law:int
    pearce_sherratt:7 burstow:5 usfd:7 archard:7
    """
)

#: Bins of a ledger: `start` is where the first begins, in widths; `width` of a bin [m]; `distance` the next solution is for [m].
LEDGER = _record("start width distance")


class Strip(IntEnum):
    """Rows of `strips`: longitudinal strips of all patches, one panel of strips after the other."""

    Y = 0
    DY = 1
    XC = 2
    A = 3  # half length
    P0 = 4  # peak of the semi-elliptic pressure, or of the one with the strip's load where the pressure is cut
    ASPECT = 5
    PATCH = 6
    BOUND = 7  # peak over the patch's coefficient of friction of the semi-ellipse that bounds the traction
    VX = 8  # creepages: rigid slip VX - PHI·y, VY + PHI·x
    VY = 9
    PHI = 10
    TILT = 11  # slope of the surface against the plane; 0 where it is one
    TO_X = 12  # what effective creepages add to those of the strip, and to the exponent of mapped strip marching
    TO_Y = 13
    TO_PHI = 14
    TO_EXPONENT = 15


class Field(IntEnum):
    """Rows of `fields[row, strip, element]`; element 0 is at the leading edge, x = x_c + a."""

    X = 0
    DX = 1
    P = 2
    QX = 3
    QY = 4
    SX = 5
    SY = 6
    STICK = 7


class DamageField(IntEnum):
    """Rows of `damage_fields[row, strip, element]`."""

    DEPTH = 0
    STRESS_INDEX = 1
    ENERGY_INDEX = 2


class Element(IntEnum):
    """Rows of `elements[row, k]`: constants of element k of a strip from the leading edge, x = x_c + a·s, s = cos(angle)."""

    S = 0
    SINE = 1  # √(1 - s²), the semi-elliptic pressure over its peak
    DX = 2  # width over a
    STEP = 3  # s of the element before (or of the edge) minus s
    MIDDLE = 4  # s half-way to the element before
    ATANH = 5  # ∫ds/(1 - s²) from the element before; infinite from the edge
    ANGLE_END = 6  # angle of the trailing side of the element
    LOAD_END = 7  # ∫√(1 - s²) ds from the leading edge to the trailing side
    MOMENT_END = 8  # ∫s√(1 - s²) ds likewise
    END = 9  # s of the trailing side


class Sample(IntEnum):
    """Rows of the work array of the normal methods, as long as the separation."""

    GAP_SLOPE = 0
    EFFECTIVE_GAP = 1
    EFFECTIVE_SLOPE = 2
    STRETCHED_A = 3
    SHARE = 4
    NR = 5
    LOG_ASPECT = 6


class Sep(IntEnum):
    """Rows of `separations[k, row, sample]`."""

    Y = 0
    G = 1
    A = 2
    XC = 3
    TILT = 4  # slope of the mean of both surfaces against the plane


class Curve(IntEnum):
    """Rows of a curve z(y), of a profile (with the angle of its tangent) and of a trace line (with the gap above it)."""

    Y = 0
    Z = 1
    SLOPE = 2  # dz/dy of a curve
    ANGLE = 2  # of the tangent of a profile [rad]
    GAP = 3  # rail minus wheel at pose.z = 0 [m]
    OPENING = 4  # its slope along y [-]


class Vector(IntEnum):
    """Rows of the vectors of interacting strips, one number a strip of all panels."""

    Y = 0
    HALF = 1
    GAP = 2
    A = 3
    CURVATURE = 4
    XC = 5
    P = 6
    Q1 = 7
    Q2 = 8
    R = 9
    R_OLD = 10
    LN_A = 11
    STEP = 12
    ACTIVE = 13
    INDEX = 14
    FLOORED = 15  # the half length stands at its lower bound
    U = 16  # displacement at the strip's ends
    STEPS = 17  # first of DEPTH rows: steps of the last iterations
    CHANGES = 20  # first of DEPTH rows: changes of the residual


#: Steps of the strip half space's iteration that are remembered.
DEPTH = 3


class Bin(IntEnum):
    """Rows of `rates[row, strip]` per metre rolled and of `bins[row, bin]`; the names of `contact.accumulation`."""

    ROLLED = 0
    WEAR = 1
    VOLUME = 2
    T_GAMMA = 3
    ENERGY_INDEX = 4
    STRESS_EXCEEDANCE = 5
    FATIGUE_EXCEEDANCE = 6
    ENERGY_INDEX_MAX = 7  # a maximum; the others are sums


class Body(IntEnum):
    """First index of `bins[body, row, bin]`."""

    WHEEL = 0
    RAIL = 1


N_STRIP_ROWS, N_FIELD_ROWS, N_DAMAGE_FIELDS, N_ELEMENT_ROWS = len(Strip), len(Field), len(DamageField), len(Element)
N_SAMPLE_ROWS, N_SEP_ROWS, N_BIN_ROWS = len(Sample), len(Sep), len(Bin)
N_PROFILE_ROWS, N_LINE_ROWS, N_VECTOR_ROWS = 3, 5, Vector.CHANGES + DEPTH
