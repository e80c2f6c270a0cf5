"""Memory layout shared by the kernels, the Python library and the FMU's C code.

A record is a numpy structured type, aligned like a C struct: ``case.mu``, ``result.Fx``. All members are 8 bytes wide
(int64 or float64), so a record fills a whole number of float64 and can lie anywhere in a block of them. An `IntEnum` names
the rows of an array (``strips[Strip.Y, i]``) or the values of an integer member (``case.normal == Normal.HERTZ``).
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

#: Least speed to which creepages of a pair refer [m/s]. A wheelset at standstill has creepages, and those without motion are 0.
SLOWEST = 1e-3

#: Record → member → meaning. `fmu_src.native.records` makes the C header from it.
MEANING: dict[str, dict[str, str]] = {}


def _record(name: str, members: str) -> np.dtype:
    """Return the aligned record `name`. Each line of `members` is ``name meaning``.

    ``name`` is a float64, ``name:int`` an int64, ``name:8`` an array of 8 float64.
    """
    fields: list[tuple[str, type] | tuple[str, type, tuple[int]]] = []
    meaning = MEANING[name] = {}
    for line in filter(None, map(str.strip, members.splitlines())):
        word, _, text = line.partition(" ")
        member, _, kind = word.partition(":")
        meaning[member] = text.strip()
        if kind.isdigit():
            fields.append((member, np.float64, (int(kind),)))
        else:
            fields.append((member, np.int64 if kind == "int" else np.float64))
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
    """What the height of a wheel on its rail follows from.

    LOAD is the vertical part of the normal forces, VERTICAL the whole vertical force, with friction [N].
    """

    GIVEN = 0
    PENETRATION = 1
    LOAD = 2
    VERTICAL = 3


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


#: One contact problem besides its separation.
CASE = _record(
    "case",
    """
    load_kind:int   LoadKind
    amount          load [N] or approach [m]
    normal:int      Normal
    normal_family:int
    tangential:int  Tangential
    tangential_family:int
    vx              longitudinal creepage [-]
    vy              lateral creepage [-]
    phi             spin creepage [1/m]
    speed           rolling speed [m/s]
    G               shear modulus [Pa]
    nu              Poisson's ratio [-]
    pressure_limit  [Pa]; 0 or infinite for none
    mu              coefficient of friction; at rest, when it falls
    law:int         FrictionLaw
    kinetic         coefficient in fast sliding
    half_speed      [m/s]
    velocity:int    SlipVelocity
    slope           factor on the creep stiffness at small creepage
    slope_far       its limit at large creepage
    slope_rate      its rate
    gauge_factor    on the coefficient of friction on one side of the border
    border          [m]
    border_width    [m]; its sign says on which side
    k_A             Polach's reduction factor in the area of adhesion
    k_S             and in that of slip
    drop            what heat takes off the coefficient, over that of the cold surface; 0 for nothing
    warm            rise of temperature above that of the bodies from which on it falls [K]
    warm_range      over which it falls [K]
    heating         share of heat over 2 sqrt(pi lambda rho c) [m2 K/(W sqrt(s))]
    conformal:int   1 where the surface of contact is not taken as a plane
    rolling         turn of the wheel about the plane's y axis per metre rolled [1/m]; for a bent surface
    """,
)

#: What a solver says besides fields. Forces act on the wheel.
RESULT = _record(
    "result",
    f"""
    Fx              longitudinal force [N]
    Fy              lateral force [N]
    Mz              spin moment about the separation's origin [N m]
    N               normal force [N]
    approach        [m]
    pmax            greatest pressure [Pa]
    area            contact area [m2]
    slip_area       [m2]
    power           dissipated energy per metre rolled [N]
    stiffness       dN/d(approach) [N/m]
    length          of the patch along x [m]
    width           along y [m]
    n_patches:int
    iterations:int
    status:int      Status
    limited:int     1 where the pressure was cut at its limit
    pressure_y      what of Fy is pressure on a bent surface, no creep force [N]
    touch           approach at which the bodies first touch [m]
    gap_error       largest gap or overlap left in the patch over the approach [-]
    edges:{2 * MAX_PATCHES}         lateral edges of the patches, two each [m]
    """,
)

_GIVEN = """
    y               of the wheelset's centre [m]
    z               pose.z [m]; the centre is at z - radius
    roll            [rad]
    yaw             [rad]
    vx              forward velocity [m/s]
    vy              [m/s]
    vz              [m/s]
    roll_rate       [rad/s]
    yaw_rate        [rad/s]
    spin            about the axle, negative when rolling forward [rad/s]
    rail_y          displacement of the rail [m]
    rail_z          [m]
    rail_roll       [rad]
    rail_vy         [m/s]
    rail_vz         [m/s]
    rail_roll_rate  [rad/s]
    """

#: Pose, velocity and irregularity of the rail as a caller gives them, of either side.
GIVEN = _record("given", _GIVEN)

#: The same on the right side, `rail_y` and `rail_z` with the rail's origin added, and what a search needs besides.
MOTION = _record(
    "motion",
    _GIVEN
    + """
    radius          nominal rolling radius [m]
    tape            distance of the tape circle from the wheelset's centre [m]
    combine_distance  lobes that are nearer share a plane [m]
    combine_angle   as do those that differ by less [rad]
    most_patches:int
    mirror          1 for the right side, -1 for the left
    origin_y        of the rail's profile without irregularity [m]
    origin_z        [m]
    """,
)

#: A run of interpenetration, later a whole patch. Moments are weighted with the interpenetration.
LOBE = _record(
    "lobe",
    """
    low             where it begins, track y [m]
    high            where it ends [m]
    low_z           track z there [m]
    high_z          [m]
    weight
    moment          weight times y
    cosine          weight times cosine of the angle
    sine            weight times its sine
    tie             share with which it still forms one patch with the one before it
    """,
)

#: One patch of a search, on the right side.
PATCH = _record(
    "patch",
    """
    angle           contact angle [rad]
    x               reference point in track coordinates [m]
    y               [m]
    z               [m]
    rail_y          the same in the rail's profile [m]
    rail_z          [m]
    wheel_y         and in the wheel's [m]
    wheel_z         [m]
    radius          rolling radius there [m]
    approach        [m]
    vx              longitudinal creepage [-]
    vy              lateral creepage [-]
    phi             spin creepage [1/m]
    low             edges of the interpenetration along the plane [m]
    high            [m]
    load            normal force [N], filled by a search for a load
    point_y         the wheel's point opposite the reference point [m]
    point_z         [m]
    share           with which it counts; below 1 only while lobes pass into planes of their own
    """,
)

#: One patch of a pair. Forces act on the wheel, in the contact frame.
CONTACT = _record(
    "contact",
    """
    N               normal force [N]
    Fx              longitudinal creep force [N]
    Fy              lateral creep force [N]
    Mx              moments of the normal pressure about the reference point [N m]
    My              [N m]
    Mz              spin moment [N m]
    x               the wheel's point opposite the reference point, track coordinates [m]
    y               [m]
    z               [m]
    angle           contact angle [rad]
    area            [m2]
    pmax            [Pa]
    longitudinal    creepages there [-]
    lateral         [-]
    spin            [1/m]
    approach        [m]
    rail_y          reference point in the rail's profile, right side [m]
    rail_z          [m]
    wheel_y         the wheel's point in its profile, right side [m]
    wheel_z         [m]
    used_friction   creep force over normal force [-]
    gap_error       [-]
    status:int      Status
    """,
)

_DAMAGE = """
    T_gamma         |Fx vx| + |Fy vy| [N]
    T_gamma_spin    the same + |Mz phi| [N]
    dissipation     [N]
    pearce_sherratt tread area lost [m2/m]
    burstow         share of RCF life per pass [-]
    usfd            volume lost per contact area [m/m]
    archard_depth   greatest [m/m]
    archard_volume  [m3/m]
    fatigue_index   surface fatigue index [-]
    stress_index    greatest [Pa]
    energy_index    greatest [Pa]
    """

#: Damage of one patch; per metre rolled.
DAMAGE = _record("damage", _DAMAGE)

#: All patches of a pair together; damage is added up or the greatest.
TOTAL = _record(
    "total",
    """
    Fx              on the wheel, track coordinates [N]
    Fy              [N]
    Fz              [N]
    Mx              about the wheelset's centre [N m]
    My              [N m]
    Mz              [N m]
    z               pose.z, as given or as found [m]
    n_patches:int
    status:int      Status
    pmax            [Pa]
    area            [m2]
    slip_area       [m2]
    power           dissipated energy per metre rolled [N]
    gap_error       greatest of the patches [-]
    N               sum of the normal forces [N]
    Q               vertical force of the wheel on the rail, positive down [N]
    Y               lateral force of the wheel on the rail, positive outwards [N]
    Y_over_Q        [-]; 0 without vertical force
    used_friction   sum of the creep forces over that of the normal forces [-]
    """
    + _DAMAGE,
)

#: Constants of the damage models. The arrays are those of the dataclasses of `contact.damage`.
DAMAGE_PARAMETERS = _record(
    "damage_parameters",
    """
    speed           [m/s]
    wheel_radius    [m]
    hardness        [Pa]
    shear_yield     [Pa]
    with_spin:int   1 where laws take T_gamma_spin
    wear_law:int    WearLaw
    pearce_sherratt:7
    burstow:5
    usfd:7
    archard:7
    """,
)

#: Bins of a ledger.
LEDGER = _record(
    "ledger",
    """
    start           where the first bin begins, in widths
    width           of a bin [m]
    distance        that the next solution is for [m]
    """,
)


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
    REACH = 17  # displacement by the strip's load at unit distance
    SPREAD = 18  # mean square of its points' distances from its middle
    REACH_OF_PANEL = 19  # in the panel's first strip, as the next two
    SPREAD_OF_PANEL = 20
    MIDDLE_OF_PANEL = 21
    LN_LENGTH = 22  # ln of the half length with which the pressures were found
    BEST = 23  # ln a of the best iterate; in the end strips the ends of their panel
    STEPS = 24  # first of DEPTH rows: steps of the last iterations
    CHANGES = 27  # first of DEPTH rows: changes of the residual


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
