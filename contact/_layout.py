"""Where each number lives in the arrays that kernels share. Names, not indices, are written everywhere else."""

# strips[ROW, i]: longitudinal strips of all patches, one panel of strips after the other
(
    STRIP_Y,
    STRIP_DY,
    STRIP_XC,
    STRIP_A,  # half length
    STRIP_P0,  # peak of the semi-elliptic pressure, or of the one with the strip's load where the pressure is cut
    STRIP_ASPECT,
    STRIP_PATCH,
    STRIP_BOUND,  # peak over the patch's coefficient of friction of the semi-ellipse that bounds the traction
    STRIP_VX,  # creepages: rigid slip VX - PHI·y, VY + PHI·x
    STRIP_VY,
    STRIP_PHI,
    STRIP_TILT,  # slope of the surface against the plane, where it is no plane
    STRIP_TO_X,  # what effective creepages add to those of the strip, and to the exponent of mapped strip marching
    STRIP_TO_Y,
    STRIP_TO_PHI,
    STRIP_TO_EXPONENT,
) = range(16)
N_STRIP_ROWS = 16

# fields[ROW, strip, element]: element 0 is at the leading edge (x = x_c + a)
FIELD_X, FIELD_DX, FIELD_P, FIELD_QX, FIELD_QY, FIELD_SX, FIELD_SY, FIELD_STICK = range(8)
N_FIELD_ROWS = 8

# case[...]: one contact problem besides its separation
(
    CASE_LOAD_KIND,  # LOAD or APPROACH
    CASE_LOAD,  # [N] or [m]
    CASE_VX,
    CASE_VY,
    CASE_PHI,
    CASE_MU,  # coefficient of friction; at rest, when it falls
    CASE_G,  # shear modulus
    CASE_NU,
    CASE_PRESSURE_LIMIT,  # [Pa]; 0 or infinite for none
    CASE_NORMAL,  # id of the normal method
    CASE_TANGENTIAL,  # id of the tangential method
    CASE_LAW,  # friction law, see `contact.friction`
    CASE_KINETIC,  # coefficient in fast sliding
    CASE_HALF_SPEED,  # [m/s]
    CASE_VELOCITY,  # GLOBAL, LOCAL or GREATEST slip velocity of `contact.friction`
    CASE_SLOPE,  # factor on the creep stiffness at small creepage, its limit at large, its rate
    CASE_SLOPE_FAR,
    CASE_SLOPE_RATE,
    CASE_GAUGE_FACTOR,  # on the coefficient of friction on one side of the border
    CASE_BORDER,  # [m]
    CASE_BORDER_WIDTH,  # [m]; its sign says on which side
    CASE_CONFORMAL,  # 1 where the surface of contact is not taken as a plane (`contact.pair`)
    CASE_SPEED,  # [m/s]
    CASE_K_A,  # Polach's reduction factors, of adhesion and of slip
    CASE_K_S,
    CASE_DROP,  # what heat takes off the coefficient of friction, over that of the cold surface; 0: nothing
    CASE_WARM,  # rise of temperature above that of the bodies from which on it falls [K]
    CASE_WARM_RANGE,  # over which it falls [K]
    CASE_HEATING,  # share of heat over 2 √(π λ ρ c) [m² K/(W √s)]
) = range(29)
N_CASE = 29
LOAD, APPROACH = 0.0, 1.0

# result[...]: what a solver says besides fields
(
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_N,
    RES_APPROACH,
    RES_PMAX,
    RES_AREA,
    RES_SLIP_AREA,
    RES_POWER,  # dissipated energy per metre rolled [N], -∬ q·s dA
    RES_STIFFNESS,  # dN/d(approach) [N/m]
    RES_LENGTH,
    RES_WIDTH,
    RES_PATCHES,
    RES_ITERATIONS,
    RES_STATUS,
    RES_PRESSURE_Y,  # what of RES_FY is the pressure on a bent surface, no creep force
    RES_TOUCH,  # approach at which the bodies first touch: the least gap [m]
    RES_EDGES,  # first of 2·MAX_PATCHES lateral patch edges
) = range(18)
MAX_PATCHES = 4
N_RES = RES_EDGES + 2 * MAX_PATCHES
