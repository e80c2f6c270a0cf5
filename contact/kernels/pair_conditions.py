"""Derivatives of a pair under its conditions: a load, a penetration, springs under the rail, a wheel off its wheelset.

`pair_jacobian` gives the columns at one height and with the rail in one place. A condition lets one of these follow: with
f = 0, df/dz dz + df/dq dq = 0, the column of q gains the column of z times dz/dq.
"""

from contact.core import entry, kernel
from contact.kernels.arrays import DerivativeArrays, PairArrays, Search, SurfaceSearch
from contact.kernels.enumerations import Height
from contact.kernels.flexible import displace, reflect
from contact.kernels.geometry.prepare import move
from contact.kernels.geometry.settle import begin
from contact.kernels.pair_jacobian import HEIGHT, NO_SIDE, UPWARD, derive
from contact.kernels.rows import Moved

#: Steps of the height at first touch [m], [rad], and of the displacement of a wheel by the wheelset's motion.
_SHIFT = 1e-7


@kernel
def _add_column(jacobian, j, share, to):
    """Add a share of column j to another column."""
    for i in range(jacobian.shape[0]):
        jacobian[i, to] += share * jacobian[i, j]


@kernel
def _clear_column(jacobian, j):
    for i in range(jacobian.shape[0]):
        jacobian[i, j] = 0.0


@kernel
def _touch(derivatives):
    """Return z at first touch at the pose of the neighbour [m]."""
    near = derivatives.neighbour
    search = near.search
    move(near.given[0], search.motion[0])
    return begin(search, search.motion[0].z)[1]


@kernel
def _follow_load(row, sign, derivatives):
    """Let z follow the condition that `sign` times the force in `row` is the load."""
    jacobian = derivatives.jacobian
    slope = sign * jacobian[row, Moved.Z]
    if not slope > 0.0:  # the force does not rise with the depth, so the height is not determined
        for j in range(jacobian.shape[1]):
            derivatives.sides[j] = NO_SIDE
        return
    for j in range(jacobian.shape[1]):
        if j != Moved.Z and j != Moved.AMOUNT:
            rise = -sign * jacobian[row, j] / slope
            _add_column(jacobian, Moved.Z, rise, j)
            jacobian[HEIGHT, j] += rise
    _add_column(jacobian, Moved.Z, 1.0 / slope, Moved.AMOUNT)
    jacobian[HEIGHT, Moved.AMOUNT] += 1.0 / slope
    _clear_column(jacobian, Moved.Z)


@kernel
def _follow_touch(derivatives):
    """Let z keep its depth below first touch."""
    jacobian, numbers = derivatives.jacobian, derivatives.numbers
    for j in range(Moved.RAIL_ROLL + 1):
        if j == Moved.Z or Moved.VX <= j <= Moved.SPIN:
            continue
        before = numbers[j]
        numbers[j] = before + _SHIFT
        high = _touch(derivatives)
        numbers[j] = before - _SHIFT
        rise = (high - _touch(derivatives)) / (2.0 * _SHIFT)
        numbers[j] = before
        _add_column(jacobian, Moved.Z, rise, j)
        jacobian[HEIGHT, j] += rise
    _add_column(jacobian, Moved.Z, 1.0, Moved.AMOUNT)
    jacobian[HEIGHT, Moved.AMOUNT] += 1.0
    _clear_column(jacobian, Moved.Z)


@kernel
def _follow_springs(rail, derivatives):
    """Let the rail's deflection keep its balance k d + F = P."""
    jacobian = derivatives.jacobian
    y, z = Moved.RAIL_Y.value, Moved.RAIL_Z.value
    yy, yz = rail.ky + jacobian[1, y], jacobian[1, z]
    zy, zz = jacobian[2, y], rail.kz + jacobian[2, z]
    if rail.ky <= 0.0:
        yy, yz = 1.0, 0.0
    if rail.kz <= 0.0:
        zy, zz = 0.0, 1.0
    determinant = yy * zz - yz * zy
    if not abs(determinant) > 1e-9 * (abs(yy * zz) + abs(yz * zy)):
        for j in range(jacobian.shape[1]):
            derivatives.sides[j] = NO_SIDE
        return
    for j in range(jacobian.shape[1]):  # the columns of the rail last, since all others need them
        if j != y and j != z:
            _deflect(rail, (yy, yz, zy, zz, determinant), j, jacobian)
    at_y, at_z = (jacobian[1, y], jacobian[2, y]), (jacobian[1, z], jacobian[2, z])
    to_y = _deflection(rail, (yy, yz, zy, zz, determinant), at_y)
    to_z = _deflection(rail, (yy, yz, zy, zz, determinant), at_z)
    for i in range(jacobian.shape[0]):
        by_y, by_z = jacobian[i, y], jacobian[i, z]
        jacobian[i, y] = by_y + to_y[0] * by_y + to_y[1] * by_z
        jacobian[i, z] = by_z + to_z[0] * by_y + to_z[1] * by_z


@kernel
def _deflection(rail, system, force):
    """Return the change of the deflection that balances a change of the force (Fy, Fz)."""
    yy, yz, zy, zz, determinant = system
    fy, fz = force[0] if rail.ky > 0.0 else 0.0, force[1] if rail.kz > 0.0 else 0.0
    return (yz * fz - zz * fy) / determinant, (zy * fy - yy * fz) / determinant


@kernel
def _deflect(rail, system, j, jacobian):
    """Let the rail give way to the change of the forces in column j."""
    dy, dz = _deflection(rail, system, (jacobian[1, j], jacobian[2, j]))
    _add_column(jacobian, Moved.RAIL_Y, dy, j)
    _add_column(jacobian, Moved.RAIL_Z, dz, j)


@kernel
def _refer_to_wheelset(given, arrays, derivatives):
    """Refer columns and moments to the wheelset instead of the rigid one that has the displaced wheel (`flexible`)."""
    jacobian, numbers, forces = derivatives.jacobian, derivatives.numbers, derivatives.middle
    tape = arrays.search.motion[0].mirror * arrays.search.motion[0].tape
    moved, near = arrays.displaced, derivatives.neighbour.given
    near[0] = given
    x, y, z = displace(near[0], arrays.offset[0], tape, moved)
    for j in range(Moved.ROLL, Moved.YAW_RATE + 1):
        if Moved.VX <= j <= Moved.VZ:
            continue
        before = numbers[j]
        numbers[j] = before + _SHIFT
        high = displace(near[0], arrays.offset[0], tape, moved)
        speeds = moved[0].vx, moved[0].vy, moved[0].vz
        numbers[j] = before - _SHIFT
        low = displace(near[0], arrays.offset[0], tape, moved)
        numbers[j] = before
        per = 0.5 / _SHIFT
        dx, dy, dz = per * (high[0] - low[0]), per * (high[1] - low[1]), per * (high[2] - low[2])
        _add_column(jacobian, Moved.Y, dy, j)
        _add_column(jacobian, Moved.Z, dz, j)
        _add_column(jacobian, Moved.VX, per * (speeds[0] - moved[0].vx), j)
        _add_column(jacobian, Moved.VY, per * (speeds[1] - moved[0].vy), j)
        _add_column(jacobian, Moved.VZ, per * (speeds[2] - moved[0].vz), j)
        jacobian[HEIGHT, j] -= dz
        jacobian[3, j] += dy * forces[2] - dz * forces[1]
        jacobian[4, j] += dz * forces[0] - dx * forces[2]
        jacobian[5, j] += dx * forces[1] - dy * forces[0]
    for j in range(jacobian.shape[1]):
        jacobian[3, j] += y * jacobian[2, j] - z * jacobian[1, j]
        jacobian[4, j] += z * jacobian[0, j] - x * jacobian[2, j]
        jacobian[5, j] += x * jacobian[1, j] - y * jacobian[0, j]
    displace(given, arrays.offset[0], tape, moved)


@kernel
def _derive_forwards(mode, given, arrays, derivatives):
    """Fill `derivatives.jacobian` for the last solution of `arrays`, of the motion `given`. Return the number of patches.

    Columns are `Moved`. Rows are force and moment of `arrays.total`, then its z.
    """
    total, rail, numbers = arrays.total[0], arrays.rail[0], derivatives.numbers
    motion = arrays.search.motion[0]
    _, _, z = displace(given, arrays.offset[0], motion.mirror * motion.tape, arrays.displaced)
    derivatives.neighbour.given[0] = arrays.displaced[0]
    numbers[Moved.Z] = total.z + z
    numbers[Moved.RAIL_Y] += rail.dy
    numbers[Moved.RAIL_Z] += rail.dz
    rigid = rail.ky <= 0.0 and rail.kz <= 0.0
    by_load = mode == Height.LOAD or mode == Height.VERTICAL
    n = derive(arrays, mode == Height.GIVEN and rigid, by_load, derivatives)
    jacobian = derivatives.jacobian
    if n > 0:
        if mode == Height.LOAD:
            _follow_load(UPWARD, 1.0, derivatives)
        elif mode == Height.VERTICAL:
            _follow_load(2, -1.0, derivatives)
        elif mode == Height.PENETRATION:
            _follow_touch(derivatives)
    if mode == Height.GIVEN:
        jacobian[HEIGHT, Moved.Z] = 1.0
    if n > 0 and not rigid:
        _follow_springs(rail, derivatives)
    offset = arrays.offset[0]
    still = offset.x == 0.0 and offset.y == 0.0 and offset.z == 0.0 and offset.roll == 0.0 and offset.yaw == 0.0
    still = still and offset.roll_rate == 0.0 and offset.yaw_rate == 0.0
    if not still:
        _refer_to_wheelset(given, arrays, derivatives)
    return n


@kernel
def derive_pair(mode, arrays, derivatives):
    """As `_derive_forwards`, also for a wheelset that rolls backwards: the derivatives of what is seen in the mirror."""
    given = arrays.given[0]
    if not given.vx < 0.0:
        return _derive_forwards(mode, given, arrays, derivatives)
    memory, jacobian = arrays.memory, derivatives.jacobian
    memory[0] = abs(memory[0])
    reflect(given, arrays.offset[0])
    n = _derive_forwards(mode, given, arrays, derivatives)
    reflect(given, arrays.offset[0])
    memory[0] = -memory[0]
    for j in range(jacobian.shape[1]):
        for i in (0, 4, 5):
            jacobian[i, j] = -jacobian[i, j]
    for j in (Moved.YAW.value, Moved.VX.value, Moved.YAW_RATE.value, Moved.SPIN.value):
        for i in range(jacobian.shape[0]):
            jacobian[i, j] = -jacobian[i, j]
    return n


@entry
def derive_on_profiles(mode: int, arrays: PairArrays[Search], derivatives: DerivativeArrays[Search]) -> int:
    """As `derive_pair`, of constant profiles."""
    return derive_pair(mode, arrays, derivatives)


@entry
def derive_on_surfaces(
    mode: int, arrays: PairArrays[SurfaceSearch], derivatives: DerivativeArrays[SurfaceSearch]
) -> int:
    """As `derive_pair`, of surfaces that change along the way."""
    return derive_pair(mode, arrays, derivatives)
