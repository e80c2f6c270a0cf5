"""Where each number lives in the arrays that the geometry kernels share; all on the right side, in track coordinates."""

# line[ROW, node]: the trace line as a curve (rows Y, Z, SLOPE of `curve`), and the vertical gap above it
GAP, OPENING = 3, 4  # rail minus wheel at pose.z = 0 [m], its slope along y [-]
N_LINE_ROWS = 5

# lobe[k, ...]: runs of interpenetration, later whole patches; moments are weighted with the interpenetration
LOBE_Y0, LOBE_Y1, LOBE_WEIGHT, LOBE_MOMENT, LOBE_COS, LOBE_SIN = range(6)
N_LOBE = 6
MAX_LOBES = 16

# motion[...]: pose, velocity, place of the rail, sizes
(
    POSE_Y,
    POSE_Z,
    POSE_ROLL,
    POSE_YAW,
    VEL_X,
    VEL_Y,
    VEL_Z,
    VEL_ROLL,
    VEL_YAW,
    VEL_SPIN,
    RAIL_Y,  # of the placed profile's origin [m]
    RAIL_Z,
    RAIL_ROLL,
    RAIL_VY,
    RAIL_VZ,
    RAIL_VROLL,
    RADIUS,  # nominal rolling radius [m]
    TAPE,  # distance of the tape circle from the wheelset's centre [m]
    COMBINE_DISTANCE,  # [m]
    COMBINE_ANGLE,  # [rad]
    MOST_PATCHES,  # 1 to MAX_PATCHES; further ones share the plane of the last
    MIRROR,  # 1 for the right side, -1 for the left
    ORIGIN_Y,  # of the rail's profile where there is no irregularity [m]
    ORIGIN_Z,
) = range(24)
N_MOTION = 24
N_GIVEN = RADIUS  # pose, velocity and irregularity, which change from step to step, come first
#: What changes its sign from one side to the other.
ODD = (POSE_Y, POSE_ROLL, POSE_YAW, VEL_Y, VEL_ROLL, VEL_YAW, RAIL_Y, RAIL_ROLL, RAIL_VY, RAIL_VROLL)

# patches[k, ...]
(
    PATCH_ANGLE,
    PATCH_X,
    PATCH_Y,
    PATCH_Z,
    PATCH_RAIL_Y,  # in profile coordinates
    PATCH_RAIL_Z,
    PATCH_WHEEL_Y,
    PATCH_WHEEL_Z,
    PATCH_RADIUS,
    PATCH_APPROACH,
    PATCH_VX,
    PATCH_VY,
    PATCH_PHI,
    PATCH_FROM,  # edges of the interpenetration along the plane [m]
    PATCH_TO,
    PATCH_LOAD,  # normal force [N], filled by a search for a load
    PATCH_POINT_Y,  # of the wheel, opposite the reference point; its x is PATCH_X
    PATCH_POINT_Z,
) = range(18)
N_PATCH = 18

# separations[k, ROW, sample]
SEP_Y, SEP_G, SEP_A, SEP_XC, SEP_TILT = range(5)  # the last: slope of the mean of both surfaces against the plane
N_SEP_ROWS = 5
