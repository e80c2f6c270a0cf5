"""Derivatives of force and moment of one rail on the wheelset, by pose, velocity, irregularity, load and friction.

* **Velocities** act through the creepages, which are linear in them. Their columns are those of the creepages, differences of
  the tangential problem on the same strips (`jacobian`), times the exact slopes of the creepages.
* **Poses.** The search describes a neighbouring pose, with its frame and its separation. The strips follow their tangent
  (`normal.tangent`). Where a patch has none, its normal problem starts from the solved one and is iterated until its own error
  is far below the step. The creepages are kept; what the pose changes in them counts as for the velocities.
* **Rail.** Wheelset and rail displaced together have the same forces. So the columns of the rail's displacement and of its
  velocity are minus those of the wheelset.

All this is at one height, or near that of a given load. `pair_conditions` lets height and deflections follow their conditions.
"""

import math

from contact.core import kernel
from contact.kernels.arrays import Samples, Workspace
from contact.kernels.enumerations import FrictionLaw, Height, NormalFamily
from contact.kernels.geometry.frame import slip
from contact.kernels.geometry.prepare import move
from contact.kernels.geometry.section import tilted
from contact.kernels.geometry.settle import settle
from contact.kernels.jacobian import (
    ITERATED,
    SMALL,
    TOLERANCE,
    creepage_step,
    has_tangent,
    is_even,
    move_column,
    step_of,
)
from contact.kernels.jacobian import MU as FRICTION
from contact.kernels.memory import CREEPS, PAIR_ROWS
from contact.kernels.normal.tangent import follow, loaded_strips
from contact.kernels.pair_patches import set_case, space_of_patch
from contact.kernels.pipeline import press_case, roll_case
from contact.kernels.records import MAX_PATCHES, SLOWEST
from contact.kernels.result import clear, clear_forces
from contact.kernels.resultants import add_wrench, clear_contact, clear_total, pressure_wrench, report
from contact.kernels.rows import Moved, Sep
from contact.kernels.together import COPIES, fits_together, roll_together, sum_copy

#: What the forces of a patch are derived by: three creepages, the coefficient of friction, the speed of a friction law.
MU, SPEED = 3, 4
#: Rows of a column: force and moment, the height, and the normal forces' upward part.
HEIGHT, UPWARD, ROWS = 6, 7, PAIR_ROWS
#: The step of the height over the approach is that of `jacobian`. The others change the gap by about as much: by the slope of
#: the contact [-], at least the first number; by the rise of a flange over its yaw, at least the second one [m]; by the lever
#: of a rail's roll [m].
_LEAST_SLOPE, _LEAST_RISE, _RAIL_LEVER = 0.1, 0.01, 0.04
#: Where a patch is solved: at the pose whose derivatives are wanted, at a neighbouring pose with the same patches or with other
#: ones; or it was solved already, at the wanted pose.
_AT_POSE, _SAME_PATCHES, _OTHER_PATCHES, _SOLVED_BEFORE = 0, 1, 2, 3
#: On which sides of the pose a column is a derivative (`DerivativeArrays.sides`): on both, on the side of negative steps, where
#: patches come or go on the other one; or on none.
BOTH_SIDES, NEGATIVE_SIDE, NO_SIDE = 0.0, -1.0, 2.0
#: Relative step of the speed.
_SMALL = 1e-6


@kernel
def _workspace_of(k, derivatives):
    """Return separation and workspace of patch k. Fields are left out unless the tangential problem reads them."""
    arrays = derivatives.neighbour
    sep, workspace, memory, case = arrays.search.separations[k], arrays.workspace, arrays.memory, arrays.case[0]
    piece = (memory.size - 3) // MAX_PATCHES
    samples = Samples(sep[Sep.Y], sep[Sep.G], sep[Sep.A], sep[Sep.XC], sep[Sep.TILT])
    space = space_of_patch(workspace.space, memory[1 + k * piece : 1 + (k + 1) * piece], derivatives.tangents[k])
    fields = workspace.fields if case.conformal != 0 or case.pressure_limit > 0.0 else derivatives.row
    return samples, Workspace(workspace.rule, workspace.tables, space, workspace.strips, fields)


@kernel
def _press(k, place, samples, workspace, derivatives):
    """Solve the normal problem of patch k at its approach: by its tangent, or closely. Return the number of strips."""
    case, result = derivatives.neighbour.patch_case[0], derivatives.neighbour.result[0]
    if place == _SOLVED_BEFORE:
        return loaded_strips(workspace)
    if place == _AT_POSE:
        case.tolerance = derivatives.neighbour.case[0].tolerance
        n = press_case(samples, case, workspace, result)
        derivatives.linear[k] = 1.0 if n > 0 and has_tangent(samples, case, workspace, result) else 0.0
        if n == 0 or derivatives.linear[k] > 0.0 or case.normal_family != NormalFamily.STRIP_HALFSPACE:
            return n
    elif place == _SAME_PATCHES and derivatives.linear[k] > 0.0:
        clear(result)
        return follow(samples, case.amount, workspace, result)
    case.tolerance = TOLERANCE
    return press_case(samples, case, workspace, result)


@kernel
def _solve_patch(k, place, samples, workspace, derivatives):
    """Solve patch k at its approach and add its forces to `derivatives.forces`. Return the number of strips."""
    arrays = derivatives.neighbour
    patch, case, result, contact = arrays.search.patches[k], arrays.patch_case[0], arrays.result[0], arrays.contacts[k]
    set_case(patch, arrays.search.motion[0], arrays.case[0], case)
    n = _press(k, place, samples, workspace, derivatives)
    if n > 0 and place != _SOLVED_BEFORE:
        roll_case(samples, n, case, workspace, result)
    pressure = pressure_wrench(workspace.strips, n)
    report(patch, case, result, pressure, contact)
    if n > 0:
        total = arrays.total[0]
        clear_total(total)
        add_wrench(contact, pressure, patch.share, arrays.search.motion[0], total)
        _add(total, 1.0, derivatives.forces)
        derivatives.forces[UPWARD] += contact.N * math.cos(contact.angle) * math.cos(contact.pitch)
    return n


@kernel
def _add(total, scale, to):
    """Add force and moment times `scale` to a column."""
    to[0] += scale * total.Fx
    to[1] += scale * total.Fy
    to[2] += scale * total.Fz
    to[3] += scale * total.Mx
    to[4] += scale * total.My
    to[5] += scale * total.Mz


@kernel
def _move(c, case, result):
    """Move creepage, friction or speed `c` of a case. Return the step."""
    if c == SPEED:
        before, case.speed = case.speed, case.speed + max(_SMALL * case.speed, 1e-9)
        return case.speed - before
    column = FRICTION if c == MU else c
    return move_column(case, column, step_of(column, case, 0.0, result))


@kernel
def _add_tangential(scale, Fx, Fy, Mz, contact, arrays, to):
    """Add `scale` times the wrench of tangential forces at a contact to a column. The contact's forces are overwritten."""
    total = arrays.total[0]
    contact.N, contact.Mx, contact.My = 0.0, 0.0, 0.0
    contact.Fx, contact.Fy, contact.Mz = scale * Fx, scale * Fy, scale * Mz
    clear_total(total)
    add_wrench(contact, (0.0, 0.0, 0.0, 0.0), 0.0, arrays.search.motion[0], total)
    _add(total, 1.0, to)


@kernel
def _roll_moved(k, samples, n, workspace, derivatives):
    """Fill `derivatives.by_creep[k]`: the derivatives of the forces of patch k, which is solved."""
    arrays = derivatives.neighbour
    patch, contact = arrays.search.patches[k], arrays.contacts[k]
    arrays.case[1], arrays.result[1] = arrays.patch_case[0], arrays.result[0]
    case, result, middle = arrays.case[1], arrays.result[1], arrays.result[0]
    together = fits_together(n, case, middle, workspace.strips)
    if together:
        creepage, spin = creepage_step(case.mu, middle.N, case.G, middle.area)
        roll_together(n, creepage, spin, case, workspace)
    for c in range(CREEPS):
        even = is_even(case) and case.mu > 0.0
        if c == SPEED and case.law == FrictionLaw.COULOMB and not case.drop > 0.0:
            continue
        if c == MU and even:  # by Euler's theorem, as in `jacobian`
            _add_tangential(
                patch.share / case.mu, middle.Fx, middle.Fy, middle.Mz, contact, arrays, derivatives.by_creep[k, c]
            )
            for i in range(ROWS):
                along = case.vx * derivatives.by_creep[k, 0, i] + case.vy * derivatives.by_creep[k, 1, i]
                along += case.phi * derivatives.by_creep[k, 2, i]
                derivatives.by_creep[k, c, i] -= along / case.mu
            continue
        arrays.case[1] = arrays.patch_case[0]
        step = _move(c, case, middle)
        clear_forces(result)
        if together and c < COPIES:
            result.Fx, result.Fy, result.Mz, result.power = sum_copy(n, c, workspace.strips)
        else:
            roll_case(samples, n, case, workspace, result)
        scale, Fx, Fy = patch.share / step if step > 0.0 else 0.0, result.Fx - middle.Fx, result.Fy - middle.Fy
        _add_tangential(scale, Fx, Fy, result.Mz - middle.Mz, contact, arrays, derivatives.by_creep[k, c])


@kernel
def _locate(derivatives):
    """Describe the patches at the pose of the neighbour. Return their number."""
    near = derivatives.neighbour
    move(near.given[0], near.search.motion[0])
    return settle(Height.GIVEN, 0.0, near.search)


@kernel
def _take_solved(arrays, derivatives):
    """Take the single patch of the last solution, whose strips are still there. Return whether it has a tangent."""
    near = derivatives.neighbour
    near.search.patches[0], near.result[0] = arrays.search.patches[0], arrays.result[0]
    samples, workspace = _workspace_of(0, derivatives)
    sep = arrays.search.separations[0]
    samples = Samples(sep[Sep.Y], sep[Sep.G], sep[Sep.A], sep[Sep.XC], sep[Sep.TILT])
    fits = has_tangent(samples, arrays.patch_case[0], workspace, near.result[0])
    derivatives.linear[0] = 1.0 if fits else 0.0
    return fits


@kernel
def _solve_middle(n, place, derivatives):
    """Solve the patches of the pose itself, with their derivatives by creepages.

    Return a step of the height, and the largest slope.
    """
    arrays = derivatives.neighbour
    approach, steepest, share = 0.0, _LEAST_SLOPE, SMALL
    for k in range(n):
        samples, workspace = _workspace_of(k, derivatives)
        strips = _solve_patch(k, place, samples, workspace, derivatives)
        derivatives.patches[k] = arrays.search.patches[k]
        approach = max(approach, arrays.contacts[k].approach)
        steepest = max(steepest, abs(math.tan(arrays.contacts[k].angle)))
        if derivatives.linear[k] == 0.0 and arrays.case[0].normal_family == NormalFamily.STRIP_HALFSPACE:
            share = ITERATED
        if strips > 0:
            _roll_moved(k, samples, strips, workspace, derivatives)
    for i in range(ROWS):
        derivatives.middle[i] = derivatives.forces[i]
    for i in range(arrays.memory.size):
        derivatives.start[i] = arrays.memory[i]
    return share * approach, steepest


@kernel
def _solve_neighbour(n, holds, derivatives):
    """Find the forces at the pose described. If the patches are those of the middle, the creepages are too."""
    arrays = derivatives.neighbour
    derivatives.forces[:] = 0.0
    for i in range(derivatives.start.size):
        arrays.memory[i] = derivatives.start[i] if holds else 0.0
    for k in range(n):
        patch, middle = arrays.search.patches[k], derivatives.patches[k]
        if holds:
            patch.vx, patch.vy, patch.phi = middle.vx, middle.vy, middle.phi
        samples, workspace = _workspace_of(k, derivatives)
        _solve_patch(k, _SAME_PATCHES if holds else _OTHER_PATCHES, samples, workspace, derivatives)


@kernel
def _pose_step(j, height, steepest, motion):
    """Return the step of column j, a member of the pose or the rail's roll, for a step of the height."""
    if j == Moved.Z:
        return height
    if j == Moved.Y:
        return height / steepest
    if j == Moved.ROLL:
        return height / motion.tape
    if j == Moved.YAW:
        return height / max(motion.radius * steepest * steepest * abs(motion.yaw), _LEAST_RISE)
    return height / (_RAIL_LEVER * max(steepest, 1.0))


@kernel
def _rise(j, n, mirror, derivatives):
    """Return the change of z per step of column j at which the wheel lies about as deep in the rail, at its deepest patch."""
    deepest, motion = 0, derivatives.neighbour.search.motion[0]
    for k in range(n):
        deepest = k if derivatives.patches[k].approach > derivatives.patches[deepest].approach else deepest
    patch = derivatives.patches[deepest]
    slope = math.tan(patch.angle)
    if j == Moved.Y:
        return mirror * slope
    if j == Moved.ROLL:
        return -mirror * (patch.point_y - motion.y + slope * (patch.point_z - motion.z + motion.radius))
    if j == Moved.RAIL_ROLL:
        return mirror * (patch.y - motion.rail_y + slope * (patch.z - motion.rail_z))
    return 0.0


@kernel
def _derive_by_pose(j, width, rise, n, derivatives):
    """Fill column j of the jacobian with forces over the step `width`, or over minus it where patches come or go otherwise.

    Where they do so on both sides, the difference over the step is kept, with the forces of all patches, and
    `derivatives.sides[j]` is NO_SIDE. Along the step z changes by `rise` times it.
    """
    numbers, patches, creeps = derivatives.numbers, derivatives.neighbour.search.patches, derivatives.creeps
    before, height, step, found = numbers[j], numbers[Moved.Z], width, n
    for attempt in range(3):
        numbers[j] = before + (-width if attempt == 1 else width)
        step = numbers[j] - before
        if j != Moved.Z:
            numbers[Moved.Z] = height + rise * step
        found = _locate(derivatives)
        if found == n or attempt == 2:
            kept = BOTH_SIDES if attempt == 0 else NEGATIVE_SIDE
            derivatives.sides[j] = kept if found == n else NO_SIDE
            break
    numbers[j], numbers[Moved.Z] = before, height
    if found < 0 or step == 0.0:
        return
    for k in range(n if found == n else 0):
        creeps[k, 0, j] = (patches[k].vx - derivatives.patches[k].vx) / step
        creeps[k, 1, j] = (patches[k].vy - derivatives.patches[k].vy) / step
        creeps[k, 2, j] = (patches[k].phi - derivatives.patches[k].phi) / step
    _solve_neighbour(found, found == n, derivatives)
    for i in range(ROWS):
        derivatives.jacobian[i, j] = (derivatives.forces[i] - derivatives.middle[i]) / step
    derivatives.jacobian[HEIGHT, j] = rise


@kernel
def _derive_by_velocity(j, n, derivatives):
    """Fill column j of the slopes of the creepages of the middle pose."""
    numbers, creeps, motion = derivatives.numbers, derivatives.creeps, derivatives.neighbour.search.motion[0]
    slowest = motion.slowest if motion.slowest > 0.0 else SLOWEST
    speed = max(numbers[Moved.VX], slowest)
    before = numbers[j]
    numbers[j] = before + 1.0
    move(derivatives.neighbour.given[0], motion)
    numbers[j] = before
    faster = max(before + 1.0, slowest) if j == Moved.VX else speed
    for k in range(n):
        patch, moved = derivatives.patches[k], derivatives.neighbour.search.patches[k]
        axes = tilted(0.0, 0.0, 0.0, patch.angle, patch.pitch)[3:]
        slip(motion, axes, patch.x, patch.point_y, patch.point_z, moved)
        refers = 1.0 if j == Moved.VX and before > slowest else 0.0  # the creepages refer to this speed
        creeps[k, 0, j] = (moved.vx * faster - patch.vx * speed - refers * patch.vx) / speed
        creeps[k, 1, j] = (moved.vy * faster - patch.vy * speed - refers * patch.vy) / speed
        creeps[k, 2, j] = (moved.phi * faster - patch.phi * speed - refers * patch.phi) / speed
        creeps[k, SPEED, j] = 1.0 if j == Moved.VX else 0.0


@kernel
def derive(arrays, is_there, by_load, derivatives):
    """Fill `derivatives.jacobian` at the pose `neighbour.given` of the rigid wheelset and rail. Return the number of patches.

    `by_load` says that z will follow a load. Then it follows about already, as the row HEIGHT says: at one height the wheel
    would sink or lift by far more than it does, and the difference of two large changes would remain. `arrays` holds the last
    solution, which is the start. If it `is_there`, it is the solution of this pose itself.
    """
    near = derivatives.neighbour
    jacobian, mirror = derivatives.jacobian, arrays.search.motion[0].mirror
    jacobian[:, :] = 0.0
    derivatives.by_creep[:, :, :] = 0.0
    derivatives.creeps[:, :, :] = 0.0
    derivatives.forces[:] = 0.0
    derivatives.middle[:] = 0.0
    derivatives.sides[:] = BOTH_SIDES
    near.search.motion[0] = arrays.search.motion[0]
    near.case[0] = arrays.case[0]
    near.patch_case[0] = near.case[0]
    for k in range(MAX_PATCHES):
        clear_contact(near.contacts[k])
    for i in range(near.memory.size):
        near.memory[i] = arrays.memory[i]
    move(near.given[0], near.search.motion[0])
    solved = is_there and arrays.total[0].n_patches == 1 and _take_solved(arrays, derivatives)
    n = 1 if solved else _locate(derivatives)
    if n <= 0:
        return n
    if arrays.memory[0] != n:
        near.memory[:] = 0.0
    height, steepest = _solve_middle(n, _SOLVED_BEFORE if solved else _AT_POSE, derivatives)
    # a loop over a tuple would leave an exception in the library
    for j in range(Moved.RAIL_ROLL_RATE + 1):
        if Moved.VX <= j <= Moved.SPIN or j == Moved.RAIL_ROLL_RATE:
            _derive_by_velocity(j, n, derivatives)
    for j in range(Moved.RAIL_ROLL + 1):
        if j <= Moved.YAW or j == Moved.RAIL_ROLL:
            rise = _rise(j, n, mirror, derivatives) if by_load else 0.0
            _derive_by_pose(j, _pose_step(j, height, steepest, near.search.motion[0]), rise, n, derivatives)
    for j in range(Moved.AMOUNT):
        for k in range(n):
            for c in range(CREEPS):
                for i in range(ROWS):
                    jacobian[i, j] += derivatives.by_creep[k, c, i] * derivatives.creeps[k, c, j]
    for k in range(n):
        for i in range(ROWS):
            jacobian[i, Moved.FRICTION] += derivatives.by_creep[k, MU, i]
    for i in range(ROWS):
        jacobian[i, Moved.RAIL_Y], jacobian[i, Moved.RAIL_Z] = 0.0 - jacobian[i, Moved.Y], 0.0 - jacobian[i, Moved.Z]
        jacobian[i, Moved.RAIL_VY], jacobian[i, Moved.RAIL_VZ] = (
            0.0 - jacobian[i, Moved.VY],
            0.0 - jacobian[i, Moved.VZ],
        )
    derivatives.sides[Moved.RAIL_Y], derivatives.sides[Moved.RAIL_Z] = (
        derivatives.sides[Moved.Y],
        derivatives.sides[Moved.Z],
    )
    for i in range(1, 6, 2):  # Fy, Mx, Mz
        derivatives.middle[i] *= mirror
        for j in range(jacobian.shape[1]):
            jacobian[i, j] *= mirror
    return n
