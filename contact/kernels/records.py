"""Records that the kernels, the Python library and the FMU's C code share: one problem, its result, a pose, a patch.

A record is a numpy structured type, aligned like a C struct: ``case.mu``, ``result.Fx``. All members are 8 bytes wide
(int64 or float64), so a record fills a whole number of float64 and can lie anywhere in a block of them.
`contact.compile.c_header` writes the same records as a C header.
"""

from __future__ import annotations

from typing import Any

import numpy as np

#: Largest number of separate patches of one separation.
MAX_PATCHES = 4
#: Largest number of runs of interpenetration that a contact search keeps apart.
MAX_LOBES = 16

#: Range of creepages [-] and spin [1/m]: slip beyond any use, and far from where squares overflow.
LARGEST_CREEPAGE = 1e6

#: Least speed to which creepages of a pair refer [m/s]. A wheelset at standstill has creepages, and those without motion are 0.
SLOWEST = 1e-3

#: Largest roll and yaw of a wheelset, and largest roll of a rail [rad], for which the search is designed.
LARGEST_ANGLE, LARGEST_RAIL_ROLL = 0.1, 0.05

#: Distance of the tape circle from the back of the flange [m] (EN 13715).
TAPE_FROM_FLANGE_BACK = 0.070

#: Record → member → meaning. `contact.compile.c_header` makes the C header from it.
MEANING: dict[str, dict[str, str]] = {}
_MADE: dict[str, np.dtype] = {}


def record(name: str, members: str) -> np.dtype:
    """Return the aligned record `name`. Each line of `members` is ``name meaning``.

    ``name`` is a float64, ``name:int`` an int64, ``name:8`` an array of 8 float64, ``name:case`` the record `case`.
    """
    fields: list[tuple[str, Any] | tuple[str, type, tuple[int]]] = []
    meaning = MEANING[name] = {}
    for line in filter(None, map(str.strip, members.splitlines())):
        word, _, text = line.partition(" ")
        member, _, kind = word.partition(":")
        meaning[member] = text.strip()
        if kind.isdigit():
            fields.append((member, np.float64, (int(kind),)))
        else:
            fields.append((member, np.int64 if kind == "int" else _MADE[kind] if kind else np.float64))
    _MADE[name] = np.dtype((np.record, np.dtype(fields, align=True)))
    return _MADE[name]


def unit_of(member: str) -> str:
    """Return the unit of a number "record.member", "1" for none."""
    name, _, its = member.partition(".")
    unit = MEANING[name][its].partition("[")[2].partition("]")[0]
    return unit.replace("-", "1") or "1"


#: One contact problem besides its separation.
CASE = record(
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
    max_iterations:int   of the strip half space
    mu              coefficient of friction, at rest if friction falls with sliding
    law:int         FrictionLaw
    kinetic         coefficient in fast sliding
    half_speed      [m/s]
    velocity:int    SlipVelocity
    slope           factor on the creep stiffness at small creepage
    slope_far       limit of this factor at large creepage
    slope_rate      rate at which it approaches the limit
    gauge_factor    factor on the coefficient of friction beyond the border
    border          position of the border along y [m]
    border_width    width of the transition [m]; the sign says on which side friction changes
    k_A             Polach's reduction factor in the area of adhesion
    k_S             and in the area of slip
    drop            relative loss of friction when hot [-]; 0 for none
    warm            temperature rise at which friction begins to fall [K]
    warm_range      range of temperature over which it falls [K]
    heating         share of heat over 2 sqrt(pi lambda rho c) [m2 K/(W sqrt(s))]
    conformal:int   1 for a curved contact surface, 0 for a plane
    rolling         rotation of the wheel about the plane's y axis per metre rolled [1/m]; for curved surfaces
    tolerance       residual at which the strip half space stops [-]; 0 for the default
    """,
)

#: What a solver says besides fields. Forces act on the wheel.
RESULT = record(
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
    limited:int     1 if the pressure reached its limit
    pressure_y      part of Fy from pressure on a curved surface [N]
    touch           approach at first touch [m]
    gap_error       largest remaining gap or overlap in the patch over the approach [-]
    bend            change of the contact angle over all patches of the separation [rad]
    beyond          share of the load on shapes whose a/b is beyond the table that the method reads [-]
    edges:{2 * MAX_PATCHES}         lateral edges of the patches, two each [m]
    """,
)

_GIVEN = """
    y               lateral position of the wheelset's centre, positive to the right [m]
    z               height of the wheelset, positive down: 0 with both tape circles on the plane of the rails' tops [m]
    roll            roll angle, positive lowers the right wheel [rad]
    yaw             yaw angle, clockwise seen from above [rad]
    vx              forward speed, negative when rolling backwards [m/s]
    vy              lateral velocity of the centre [m/s]
    vz              vertical velocity of the centre [m/s]
    roll_rate       roll rate [rad/s]
    yaw_rate        yaw rate [rad/s]
    spin            rotation about the axle, negative when rolling forward [rad/s]
    rail_y          lateral displacement of this rail [m]
    rail_z          vertical displacement of this rail, positive down [m]
    rail_roll       roll of this rail about its profile's origin [rad]
    rail_vy         rate of this rail's lateral displacement as the wheel meets it [m/s]
    rail_vz         rate of this rail's vertical displacement [m/s]
    rail_roll_rate  rate of this rail's roll [rad/s]
    """

#: Pose, velocity and irregularity of the rail as a caller gives them, of either side.
GIVEN = record("given", _GIVEN)

#: The same on the right side, `rail_y` and `rail_z` with the rail's origin added, and what a search needs besides.
MOTION = record(
    "motion",
    _GIVEN
    + """
    radius          nominal rolling radius [m]
    tape            distance of the tape circle from the wheelset's centre [m]
    combine_distance  largest distance of lobes that share a plane [m]
    combine_angle   largest difference of their angles [rad]
    most_patches:int
    mirror          1 for the right side, -1 for the left
    origin_y        of the rail's profile without irregularity [m]
    origin_z        [m]
    station         position of the axle along the slices of a rail that changes along the track [m]
    rotation        of the wheel about its axle, which decreases when rolling forward [rad]
    reach           distance before and behind the axle in which surfaces are searched [m]
    tilted:int      1 for frames along the normal of the surface, 0 for frames turned about x only
    changing:int    1 in a search over surfaces, where the wheel is no body of revolution
    missed          error of the last search under a load over the load [-]
    slowest         speed below which creepages refer to it [m/s]; 0 stands for SLOWEST
    """,
)

#: A run of interpenetration, later a whole patch. Moments are weighted with the interpenetration.
LOBE = record(
    "lobe",
    """
    low             begin of the run, track y [m]
    high            end of the run, track y [m]
    low_z           track z at its begin [m]
    high_z          track z at its end [m]
    weight
    moment          weight times y
    cosine          weight times cosine of the angle
    sine            weight times its sine
    tie             coupling to the previous lobe, 1 for one patch, 0 for separate patches
    x_low           range along the track [m]; only for surfaces, as the following
    x_high          [m]
    moment_x        weight times x
    slant           weight times the x component of the rail's normal
    step_x          between the points at which the lobe was measured [m]
    step_y          [m]
    """,
)

#: One patch of a search, on the right side.
PATCH = record(
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
    share           weight of the patch, normally 1; below 1 in the transition to separate planes
    pitch           inclination of the frame's normal along the track, forward positive [rad]
    fit_error       of the parabolas along x: root mean square over the approach, or in the slope of a row [-]
    back            range of the plane that contains the interpenetration, along x [m]; only for surfaces, as the following
    front           [m]
    left            and along y [m]
    right           [m]
    """,
)

#: One patch of a pair. Forces act on the wheel, in the contact frame.
CONTACT = record(
    "contact",
    """
    N               normal force [N]
    Fx              longitudinal creep force on the wheel [N]
    Fy              lateral creep force on the wheel, along the contact plane [N]
    Mx              moment of the normal pressure about the longitudinal axis [N m]
    My              moment of the normal pressure about the lateral axis [N m]
    Mz              spin moment on the wheel [N m]
    x               point of application of forces and moments, track coordinates, longitudinal [m]
    y               point of application of forces and moments, track coordinates, lateral [m]
    z               point of application of forces and moments, track coordinates, vertical, positive down [m]
    angle           contact angle; the contact frame is the track frame turned about x by this angle [rad]
    area            contact area [m2]
    pmax            greatest contact pressure [Pa]
    longitudinal    longitudinal creepage, wheel minus rail [-]
    lateral         lateral creepage, wheel minus rail [-]
    spin            spin creepage, wheel minus rail [1/m]
    approach        rigid approach from first touch, along the normal [m]
    rail_y          contact position on the rail's profile, lateral, positive to the field side [m]
    rail_z          contact position on the rail's profile, vertical, positive down [m]
    wheel_y         contact position on the wheel's profile, lateral from the tape circle, positive to the field side [m]
    wheel_z         contact position on the wheel's profile, vertical, positive down [m]
    used_friction   creep force over normal force [-]
    gap_error       [-]
    status:int      Status
    pitch           inclination of the frame's normal along the track, forward positive [rad]
    """,
)

_DAMAGE = """
    T_gamma         wear number |Fx vx| + |Fy vy|, of forces and creepages [N]
    T_gamma_spin    wear number with spin, |Fx vx| + |Fy vy| + |Mz phi| [N]
    dissipation     [N]
    pearce_sherratt tread area worn off, Pearce and Sherratt [m2/m]
    burstow         rolling contact fatigue index per axle pass, Burstow [-]
    usfd            volume worn off a unit of contact area, Sheffield [m/m]
    archard_depth   greatest wear depth, Archard [m/m]
    archard_volume  volume worn off, Archard [m3/m]
    fatigue_index   surface fatigue index, Ekberg [-]
    stress_index    greatest stress index |q| - k [Pa]
    energy_index    greatest energy index q.w [Pa]
    """

#: Damage of one patch; per metre rolled.
DAMAGE = record("damage", _DAMAGE)

#: All patches of a pair together; damage is added up or the greatest.
TOTAL = record(
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
    bend            largest change of the contact angle over the patches in one plane [rad]
    beyond          largest share of a patch's load on shapes whose a/b is beyond the table that the method reads [-]
    """
    + _DAMAGE,
)

#: Constants of the damage models. The arrays are those of the dataclasses of `contact.damage`.
DAMAGE_PARAMETERS = record(
    "damage_parameters",
    """
    speed           [m/s]
    wheel_radius    [m]
    hardness        [Pa]
    shear_yield     [Pa]
    rail_wear       wear of the rail over that of the wheel [-]
    with_spin:int   1 where laws take T_gamma_spin
    wear_law:int    WearLaw
    pearce_sherratt:7
    burstow:5
    usfd:7
    archard:7
    """,
)

#: A rail on springs, and its deflection.
ELASTIC_RAIL = record(
    "elastic_rail",
    """
    ky              lateral stiffness [N/m]; 0 is rigid
    kz              vertical stiffness [N/m]; 0 is rigid
    preload_y       external force on the rail [N]
    preload_z       [N]
    dy              lateral deflection [m]
    dz              vertical deflection [m]
    balanced:int    0 if the force jumps and no deflection is in balance
    """,
)

#: Displacement of a wheel against its wheelset, in track coordinates, as its axle and web bend.
WHEEL_OFFSET = record(
    "wheel_offset",
    """
    x               longitudinal displacement of the wheel's datum, on the axle at the tape circle, against its wheelset [m]
    y               lateral displacement of the wheel against its wheelset [m]
    z               vertical displacement of the wheel against its wheelset, positive down [m]
    roll            roll of the wheel against its wheelset [rad]
    pitch           pitch of the wheel against its wheelset; without effect on a wheel of revolution [rad]
    yaw             yaw of the wheel against its wheelset [rad]
    x_rate          rate of the longitudinal displacement [m/s]
    y_rate          rate of the lateral displacement [m/s]
    z_rate          rate of the vertical displacement [m/s]
    roll_rate       rate of the roll [rad/s]
    pitch_rate      rate of the pitch; adds to the rotation about the axle [rad/s]
    yaw_rate        rate of the yaw [rad/s]
    """,
)

#: Bins of a ledger.
LEDGER = record(
    "ledger",
    """
    start           where the first bin begins, in widths
    width           of a bin [m]
    distance        distance rolled in the next solution [m]
    """,
)

#: What a pair is asked at one instant, as the caller of the C interface gives it.
PAIR_INPUT = record(
    "pair_input",
    """
    size:int        sizeof(wr_pair_input), set by wr_pair_input_default
    height:int      Height: motion.z is given, or amount is a penetration [m], or the force that the wheel carries [N]
    amount          of the normal forces, or with WR_HEIGHT_VERTICAL of these and friction together
    motion:given    pose and velocity of the wheelset, irregularity of the rail; vx < 0 rolls backwards, on profiles only
    surface:case    methods, material, friction: as wr_contact_case fills it; loads and creepages are ignored
    rail:elastic_rail  springs; 0: rigid
    offset:wheel_offset  displacement of the wheel against its wheelset
    distance        rolled in this state [m], for the bins
    station         surfaces: position of the axle along the slices of the rail [m]
    rotation        surfaces: angle by which the wheel has turned [rad]; it decreases when rolling forward
    """,
)
