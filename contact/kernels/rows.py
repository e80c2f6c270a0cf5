"""Rows of the arrays that kernels share: ``strips[Strip.Y, i]``. The rows of `lanes` are in `tangential.lanes`."""

from enum import IntEnum

from contact.core import COMPILING


class Strip(IntEnum):
    """Rows of `strips`: longitudinal strips of all patches, one panel of strips after the other."""

    Y = 0
    DY = 1
    XC = 2
    A = 3  # half length
    P0 = 4  # peak of the semi-elliptic pressure; where the pressure is limited, of the semi-ellipse with the same load
    ASPECT = 5  # a/b; its logarithm while the tangential problem is solved
    PATCH = 6
    BOUND = 7  # peak of the traction bound over the patch's coefficient of friction
    VX = 8  # creepages: rigid slip VX - PHI·y, VY + PHI·x
    VY = 9
    PHI = 10
    TILT = 11  # slope of the surface against the contact plane; 0 for a plane contact
    TO_X = 12  # corrections of the effective creepages, added to VX, VY, PHI (fastrip_mapped)
    TO_Y = 13
    TO_PHI = 14
    TO_EXPONENT = 15  # correction of the map exponent
    TIE = 16  # coupling to the previous strip, 0 to 1 (`tangential.ties`)
    SHARE = 17  # weight of a strip in the shape that it forms with its neighbours
    STIFFNESS = 18  # longitudinal stiffness C11·a·dy [m²]
    CENTRE = 19  # y of the centre of stiffness of the strip's shape [m]
    OFFSET = 20  # centre of a skewed strip minus the line of least gap [m]; 0 for other normal methods
    LN_ASPECT = 21  # ln(a/b) from the normal method
    BY_FALL_X = 22  # what falling friction does to a stick zone, as a change of VX and VY (`tangential.falling`)
    BY_FALL_Y = 23
    BY_PULL_X = 24  # what the tractions of other lobes and patches do, as a change of VX and VY (`tangential.pulls`)
    BY_PULL_Y = 25
    FORCE_X = 26  # estimated force of the strip [N]
    FORCE_Y = 27
    BEHIND = 28  # of its middle, where that force acts [m]
    TURN = 29  # what the turn of the strip's shape adds to ln(a/b) (`tangential.skew`)
    COUPLING = 30  # of longitudinal and lateral creepage, by that turn
    SPIN_STIFFNESS = 31  # STIFFNESS times 4 C33 (a/b)/C11 [m²]
    SPIN_FACTOR = 32  # mean of that factor over the strip's shape


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


class Node(IntEnum):
    """Rows of `nodes[slice, row, path]` of a surface: points, and derivatives per path at both ends of the segment after them.

    They are followed by as many rows with their derivatives along the surface.
    """

    Y = 0
    Z = 1
    Y_START = 2
    Z_START = 3
    Y_END = 4
    Z_END = 5


class Section(IntEnum):
    """Rows of a cross-section of a surface in a frame, one number a path: `Node` with s for y and n for z."""

    S = 0
    N = 1
    S_START = 2
    N_START = 3
    S_END = 4
    N_END = 5
    S_ALONG = 6  # derivatives along the surface
    N_ALONG = 7


class Over(IntEnum):
    """Rows of one column of heights over a frame, one number a row of the grid."""

    RAIL = 0  # height along the normal [m]
    RAIL_X = 1  # x of this height [m]; cross-sections may be skew in the frame
    RAIL_SLOPE_X = 2
    RAIL_SLOPE_S = 3
    WHEEL = 4
    WHEEL_X = 5
    GAP = 6  # at WHEEL_X


class Cell(IntEnum):
    """Layers of a grid over a region of the track plane."""

    GAP = 0  # vertical, at pose.z = 0 [m]
    RAIL = 1  # height of the rail [m]
    SLOPE_X = 2  # of the rail
    SLOPE_Y = 3
    X = 4  # x of the point [m], close to that of its column
    LABEL = 5  # number of the connected region, 0 for none, negative for excluded points


class Box(IntEnum):
    """Columns of `boxes`: one row for each grid, the coarse one first, then the rough and the fine ones.

    The columns from COLUMNS on describe the whole search, not one grid. Only their first row is used.
    """

    X = 0
    DX = 1
    Y = 2
    DY = 3
    LABEL = 4  # label of the region in the coarse grid
    LEAST = 5  # least gap [m]
    COLUMNS = 6  # of the coarse grid
    GRIDS = 7  # number of rough grids, and of fine ones
    ROUGH = 8  # pose.z of the rough grids [m]
    LAID = 9  # pose.z of the fine grids [m]
    TOUCH = 10  # pose.z at first touch [m]
    FIRST = 11  # pose.z of the first rough grids [m]


class Event(IntEnum):
    """What happened in an iteration of interacting strips; bits of `Iterate.EVENTS`."""

    AGAIN = 1  # the warm start did not converge: restart from ANALYN's patch
    CUT = 2  # strips without load removed at an end
    LOST = 4  # panel without load removed
    FIXED = 8  # ends fixed from here on
    FOUND = 16  # panel added on a lobe that overlapped
    JOINED = 32  # panels joined
    PARTED = 64  # panels parted where strips between loaded ones are idle


class Iterate(IntEnum):
    """Columns of the iterations of interacting strips (`contact.view.trace`)."""

    ERROR = 0  # load-weighted mean residual of ln a
    MOVED = 1  # largest change of an end over the width
    APPROACH = 2  # above first touch [m]
    PANELS = 3
    EVENTS = 4
    ENDS = 5  # of all panels [m]


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
    FLOOR = 15  # lower bound of the half length
    U = 16  # displacement at the strip's ends
    REACH = 17  # displacement at unit distance by the strip's load
    SPREAD = 18  # mean square distance of its points from its centre
    REACH_OF_PANEL = 19  # of the whole panel, in its first strip, as the next two rows
    SPREAD_OF_PANEL = 20
    MIDDLE_OF_PANEL = 21
    LN_LENGTH = 22  # ln of the half length at the last solution of the pressures
    BEST = 23  # ln a of the best iterate; in the end strips the ends of their panel
    STEPS = 24  # first of DEPTH rows: steps of the last iterations
    CHANGES = 27  # first of DEPTH rows: changes of the residual
    INSIDE = 30  # in the end strips: inner end of the bracket of the panel's end
    OUTSIDE = 31  # outer end of the bracket
    # pressure of an end strip, negative where it would have to pull; `ends.end_move` replaces it by the weight of its rule
    END = 32
    OFFSET = 33  # centre of the strip along x minus the line of least gap [m]
    DIFFERENCE = 34  # displacement at the leading minus that at the trailing end of the strip [m]
    OFFSET_R = 35  # residual of the offset [m]
    OFFSET_R_OLD = 36
    OFFSET_STEP = 37
    OFFSET_BEST = 38  # offset of the best iterate
    OFFSET_STEPS = 39  # first of DEPTH rows, as STEPS
    OFFSET_CHANGES = 42  # first of DEPTH rows, as CHANGES
    LOCUS_OF_PANEL = 45  # x of a whole panel's load [m], as MIDDLE_OF_PANEL
    OF_MIDDLE = 46  # factors of the displacement by the panel's own strips (`normal.factors`): at the strip's middle,
    OF_ENDS = 47  # in the mean of its ends,
    OF_DIFFERENCE = 48  # and of their difference
    PAIRS = 49  # first of the rows of `Pair`


class Pair(IntEnum):
    """Scratch rows of `normal.many_strips`: one strip that displaces a point per column."""

    X = 0  # x distance of the point from the strip's centre over the half length
    LN_X = 1  # its logarithm
    LOW = 2  # logarithm of the y distance from the strip's lower side over the half length
    HIGH = 3  # the same from its upper side
    ROW = 4  # row of the table that follows from these


#: Depth of the history of Anderson mixing in the strip half space.
DEPTH = 3


class Moved(IntEnum):
    """Columns of the derivatives of a pair: the members of GIVEN, then what prescribes the height, and friction."""

    Y = 0
    Z = 1
    ROLL = 2
    YAW = 3
    VX = 4
    VY = 5
    VZ = 6
    ROLL_RATE = 7
    YAW_RATE = 8
    SPIN = 9
    RAIL_Y = 10
    RAIL_Z = 11
    RAIL_ROLL = 12
    RAIL_VY = 13
    RAIL_VZ = 14
    RAIL_ROLL_RATE = 15
    AMOUNT = 16
    FRICTION = 17


class Tangent(IntEnum):
    """Last rows of `tangent`, after four matrices (`normal.tangent`): state of the solved patch, and scratch."""

    GAP = 0
    CURVATURE = 1
    OVERLAP = 2  # at the ends of a strip
    P = 3  # tension included
    A = 4
    ONE = 5
    OTHER = 6
    AT_LOW = 7  # slopes of the move of an end by the four pressures beside it
    AT_HIGH = 8
    NUMBERS = 9  # ends of the panel, approach, factor of the pressures, whether all is mirrored


class Bin(IntEnum):
    """Rows of `rates[row, strip]` per metre rolled and of `bins[row, bin]`; the names of `contact.accumulation`."""

    ROLLED = 0
    WEAR = 1
    VOLUME = 2
    T_GAMMA = 3
    ENERGY_INDEX = 4
    STRESS_EXCEEDANCE = 5
    FATIGUE_EXCEEDANCE = 6
    RCF_FORWARD = 7  # Burstow's index for creep forces on the wheel that point forward
    RCF_BACKWARD = 8  # and backward
    ENERGY_INDEX_MAX = 9  # a maximum; the others are sums


class Body(IntEnum):
    """First index of `bins[body, row, bin]`."""

    WHEEL = 0
    RAIL = 1


#: Number of rows y, z and angle of a profile, of all rows of a trace line, and of vectors.
N_PROFILE_ROWS, N_LINE_ROWS, N_VECTOR_ROWS = 3, 5, Vector.PAIRS + len(Pair)
#: Number of iterations that a trace keeps; the last row holds the last iteration.
MOST_ITERATES = 64


if COMPILING:
    from numba import types
    from numba.extending import overload

    @overload(len)
    def _number_of_rows(rows):
        """Let kernels call ``len(Strip)``, as Python does."""
        if not isinstance(rows, types.IntEnumClass):
            return None
        count = len(rows.instance_class)
        return lambda rows: count
