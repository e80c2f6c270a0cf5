"""From the motion of a wheelset to the forces of one wheel on one rail: the kernel of `WheelRailPair` and its FMU."""

import math

from contact.core import kernel
from contact.kernels.arrays import Samples, Space, Workspace
from contact.kernels.damage.assess import clear_damage, damage_kernel
from contact.kernels.enumerations import Height, LoadKind, NoAnswer, NormalFamily, Status
from contact.kernels.geometry.prepare import move
from contact.kernels.geometry.search import axle
from contact.kernels.geometry.settle import begin, describe, settle
from contact.kernels.ledger import enter
from contact.kernels.pipeline import press_case, solve_case
from contact.kernels.records import LARGEST_CREEPAGE, MAX_PATCHES
from contact.kernels.rows import Sep, Strip

#: Search of the height for a load or a vertical force: largest number of trials, and of whole ones from nothing among them,
#: target and accepted relative residual, and the largest height [m].
_MAX_HEIGHTS, _MAX_LAST, _TOLERANCE, _ACCEPTABLE, _FURTHEST = 20, 8, 1e-9, 1e-3, 1.0
#: Target for methods that iterate, whose own noise is about that large.
_ITERATED = 8e-7
#: The first two residuals on surfaces that change along the way, the second with friction. On the edge of a fresh flat the
#: force is not smooth in z.
_ROUGHER, _ACCEPTABLE_ROUGH = 1e-7, 1e-2


@kernel
def _bounded(creepage):
    """Return the creepage, limited to its range. A wheelset almost at rest leaves the range, in full slip."""
    return min(max(creepage, -LARGEST_CREEPAGE), LARGEST_CREEPAGE)


@kernel
def pressure_wrench(strips, n):
    """Return the moments ∬ y p dA and ∬ x p dA of the pressure [N m], its lateral force [N] and the spin moment of this.

    The last two vanish in a plane. A strip carries π/2 p0 a per unit of width.
    """
    by_y, by_x, lateral, spin = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        load = 0.5 * math.pi * strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        by_y += load * strips[Strip.Y, i]
        by_x += load * strips[Strip.XC, i]
        lateral += load * strips[Strip.TILT, i]
        spin += load * strips[Strip.TILT, i] * strips[Strip.XC, i]
    return by_y, by_x, lateral, spin


@kernel
def report(patch, case, result, pressure, contact):
    """Fill the contact of one patch on the right side. Forces, moments and area are multiplied by the patch's share."""
    by_y, by_x, _, _ = pressure
    share = patch.share
    contact.N, contact.Fx, contact.Fy = share * result.N, share * result.Fx, share * result.Fy
    contact.Mx, contact.My, contact.Mz = -share * by_y, share * by_x, share * result.Mz
    contact.x, contact.y = patch.x, patch.point_y
    contact.z, contact.angle = patch.point_z, patch.angle
    contact.area, contact.pmax = share * result.area, result.pmax
    contact.longitudinal, contact.lateral = case.vx, case.vy
    contact.spin, contact.approach = case.phi, result.approach
    contact.gap_error = max(result.gap_error, patch.fit_error)
    contact.rail_y, contact.rail_z = patch.rail_y, patch.rail_z
    contact.wheel_y, contact.wheel_z = patch.wheel_y, patch.wheel_z
    creep = math.sqrt(result.Fx**2 + (result.Fy - result.pressure_y) ** 2)
    contact.used_friction = creep / result.N if result.N > 0.0 else 0.0
    contact.status, contact.pitch = result.status, patch.pitch


@kernel
def add_wrench(contact, pressure, share, motion, total):
    """Add force and moment of a contact about the wheelset's centre (0, y, z - radius), in track coordinates.

    Before it is tilted by its pitch, the frame's axes are x, (0, c, s) and (0, -s, c); the pressure acts along -z of the
    frame.
    """
    c, s = math.cos(contact.angle), math.sin(contact.angle)
    cp, sp = math.cos(contact.pitch), math.sin(contact.pitch)
    fx, fy, n = contact.Fx * cp - contact.N * sp, contact.Fy, contact.N * cp + contact.Fx * sp
    y_force, z_force = fy * c + n * s, fy * s - n * c
    x, y, z = contact.x, contact.y - motion.y, contact.z - motion.z + motion.radius
    mx, my, mz = contact.Mx * cp + contact.Mz * sp, contact.My, contact.Mz * cp - contact.Mx * sp
    # The pressure on a body of revolution has no moment about its axle. In one plane for all strips it has, under yaw,
    # because each strip's own normal meets the axle and the plane's does not. That part is taken away.
    _, _, lateral, spin = pressure
    y_press, z_press = share * lateral * c + n * s, share * lateral * s - n * c
    lx, ly, lz = axle(motion.roll, motion.yaw)
    turning = lx * (y * z_press - z * y_press + contact.Mx) + ly * (-x * z_press + my * c - share * spin * s)
    turning += lz * (x * y_press + my * s + share * spin * c)
    turning = 0.0 if motion.changing else turning
    total.Fx += fx
    total.Fy += y_force
    total.Fz += z_force
    total.Mx += y * z_force - z * y_force + mx - turning * lx
    total.My += z * fx - x * z_force + my * c - mz * s - turning * ly
    total.Mz += x * y_force - y * fx + my * s + mz * c - turning * lz
    total.N += contact.N
    total.used_friction += contact.used_friction * contact.N


@kernel
def _compare_forces(total):
    """Set what compares the summed forces on the right side: Q, Y, their ratio, and the used friction."""
    total.Q, total.Y = -total.Fz, -total.Fy
    total.Y_over_Q = total.Y / total.Q if total.Q > 0.0 else 0.0
    total.used_friction = total.used_friction / total.N if total.N > 0.0 else 0.0


@kernel
def _worse(status, other):
    """Return the status of two loaded patches: full slip if both slip, not trustworthy if one of them is not."""
    if status == Status.NO_CONTACT:  # so far
        return other
    untrusted = status == Status.OUT_OF_RANGE or status == Status.NOT_CONVERGED
    if untrusted or other == Status.OUT_OF_RANGE or other == Status.NOT_CONVERGED:
        return max(status, other)
    return status if status == other else Status.OK.value


@kernel
def _add_results(result, damage, share, total):
    """Add the results of a loaded patch except forces and moments: rates are summed by `share`, indices take the maximum."""
    first = total.area == 0.0
    total.status = _worse(total.status, result.status)
    total.pmax = max(total.pmax, result.pmax)
    total.area += share * result.area
    total.slip_area += share * result.slip_area
    total.power += share * result.power
    total.T_gamma += share * damage.T_gamma
    total.T_gamma_spin += share * damage.T_gamma_spin
    total.dissipation += share * damage.dissipation
    total.pearce_sherratt += share * damage.pearce_sherratt
    total.archard_volume += share * damage.archard_volume
    total.burstow = damage.burstow if first else max(total.burstow, damage.burstow)
    total.usfd = damage.usfd if first else max(total.usfd, damage.usfd)
    total.archard_depth = damage.archard_depth if first else max(total.archard_depth, damage.archard_depth)
    total.fatigue_index = damage.fatigue_index if first else max(total.fatigue_index, damage.fatigue_index)
    total.stress_index = damage.stress_index if first else max(total.stress_index, damage.stress_index)
    total.energy_index = damage.energy_index if first else max(total.energy_index, damage.energy_index)


@kernel
def clear_contact(contact):
    """Set every member of a contact to zero."""
    contact.N, contact.Fx, contact.Fy, contact.Mx, contact.My, contact.Mz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    contact.x, contact.y, contact.z, contact.angle = 0.0, 0.0, 0.0, 0.0
    contact.area, contact.pmax = 0.0, 0.0
    contact.longitudinal, contact.lateral, contact.spin, contact.approach = 0.0, 0.0, 0.0, 0.0
    contact.rail_y, contact.rail_z, contact.wheel_y, contact.wheel_z = 0.0, 0.0, 0.0, 0.0
    contact.used_friction, contact.gap_error, contact.pitch, contact.status = 0.0, 0.0, 0.0, 0


@kernel
def clear_total(total):
    """Set every member of a total to zero, the status to no contact."""
    total.Fx, total.Fy, total.Fz, total.Mx, total.My, total.Mz, total.z = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    total.n_patches, total.status = 0, Status.NO_CONTACT
    total.pmax, total.area, total.slip_area, total.power, total.gap_error = 0.0, 0.0, 0.0, 0.0, 0.0
    total.N, total.Q, total.Y, total.Y_over_Q, total.used_friction, total.bend = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    clear_damage(total)


@kernel
def _mirror(mirror, n, contacts, total):
    """Change the signs of `n` contacts and the total to those of the actual side."""
    total.Fy, total.Mx, total.Mz = mirror * total.Fy, mirror * total.Mx, mirror * total.Mz
    for k in range(n):
        contact = contacts[k]
        contact.Fy, contact.Mx, contact.Mz = mirror * contact.Fy, mirror * contact.Mx, mirror * contact.Mz
        contact.y, contact.angle = mirror * contact.y, mirror * contact.angle
        contact.lateral, contact.spin = mirror * contact.lateral, mirror * contact.spin


@kernel
def set_case(patch, motion, template, case):
    """Fill the case of one patch, at its approach, from the `template` of the pair."""
    case.load_kind, case.amount = LoadKind.APPROACH, patch.approach
    case.vx, case.vy, case.phi = _bounded(patch.vx), _bounded(patch.vy), _bounded(patch.phi)
    case.rolling = math.cos(patch.angle) / patch.radius
    # from the rail's profile into the plane of the patch
    per_cosine = 1.0 / math.cos(patch.angle - motion.rail_roll)
    case.border = (template.border - patch.rail_y) * per_cosine
    case.border_width = template.border_width * per_cosine


@kernel
def space_of_patch(space, memory, tangent):
    """Return the scratch arrays with memory and tangent of one patch."""
    return Space(
        space.grid,
        space.turned,
        space.vectors,
        space.logs,
        space.matrix,
        space.lu,
        space.iteration,
        space.iterates,
        memory,
        space.lanes,
        space.trace,
        space.case,
        tangent,
    )


@kernel
def workspace_of(k, bench):
    """Return separation and workspace of patch k of the last search. Strips and fields are those of `bench.own`."""
    own, memory, sep = bench.own, bench.memory, bench.search.separations[k]
    piece = (memory.size - 3) // MAX_PATCHES
    space = space_of_patch(own.space, memory[1 + k * piece : 1 + (k + 1) * piece], own.space.tangent)
    samples = Samples(sep[Sep.Y], sep[Sep.G], sep[Sep.A], sep[Sep.XC], sep[Sep.TILT])
    return samples, Workspace(own.rule, own.tables, space, own.strips, own.fields)


@kernel
def solve_patch(k, bench):
    """Solve patch k of the last search at its approach, with its damage. Return the number of strips.

    Strips and fields are those of `bench.own`, until the next patch is solved. `bench.patch_case` has to hold the case of
    the pair.
    """
    search, own = bench.search, bench.own
    patch, parameters = search.patches[k], bench.damage_parameters[0]
    case = bench.patch_case[0]
    set_case(patch, search.motion[0], bench.case[0], case)
    samples, of_patch = workspace_of(k, bench)
    n_strips = solve_case(samples, bench.patch_case, of_patch, bench.result)
    parameters.speed, parameters.wheel_radius = search.motion[0].vx, patch.radius
    damage_kernel(
        own.strips, n_strips, own.fields, case, bench.result[0], parameters, bench.damage_fields, bench.damage[0]
    )
    return n_strips


@kernel
def _prepared(n, bench):
    """Prepare to solve the `n` patches of a search, if there are any. Return n."""
    memory = bench.memory
    if n >= 0:
        if memory[0] != n:  # a patch came or went: none starts from another one
            memory[:] = 0.0
            memory[0] = n
        bench.patch_case[0] = bench.case[0]
    return n


@kernel
def _press(n, bench):
    """Solve the normal problems of the `n` patches of the last search. Return the vertical part of their forces [N]."""
    search, force = bench.search, 0.0
    for k in range(n):
        patch = search.patches[k]
        set_case(patch, search.motion[0], bench.case[0], bench.patch_case[0])
        samples, of_patch = workspace_of(k, bench)
        if press_case(samples, bench.patch_case[0], of_patch, bench.result[0]) > 0:
            force += patch.share * bench.result[0].N * math.cos(patch.angle) * math.cos(patch.pitch)
    return force


@kernel
def _solve(n, enters, bench):
    """Solve the `n` patches of the last search and add up. The ledger is filled if `enters` says so."""
    own, total, result = bench.own, bench.total[0], bench.result[0]
    damage, case, motion = bench.damage[0], bench.patch_case[0], bench.search.motion[0]
    for k in range(MAX_PATCHES):
        clear_contact(bench.contacts[k])
    clear_total(total)
    for k in range(n):
        patch, contact = bench.search.patches[k], bench.contacts[k]
        n_strips = solve_patch(k, bench)
        total.bend = max(total.bend, result.bend)
        pressure = pressure_wrench(own.strips, n_strips)
        report(patch, case, result, pressure, contact)
        if n_strips > 0:
            patch.load = result.N
            add_wrench(contact, pressure, patch.share, motion, total)
            _add_results(result, damage, patch.share, total)
            total.gap_error = max(total.gap_error, contact.gap_error)
            if enters and bench.ledger.bins.shape[2] > 0 and bench.ledger.settings[0].distance > 0.0:
                enter(patch, n_strips, damage, bench)
    total.z, total.n_patches = motion.z, n
    _compare_forces(total)
    _mirror(motion.mirror, n, bench.contacts, total)


@kernel
def _carried(mode, n, bench):
    """Return the force that is to equal the load [N]: the vertical part of normal forces, or of all (Height.VERTICAL)."""
    force = 0.0
    for k in range(n):
        contact = bench.contacts[k]
        force += contact.N * math.cos(contact.angle) * math.cos(contact.pitch)
    return -bench.total[0].Fz if mode == Height.VERTICAL else force


@kernel
def _solve_under(mode, force, bench):
    """As `solve_pair` for Height.LOAD and Height.VERTICAL: find the height by bracketed secants over the own forces.

    It begins at the height at which the normal forces by ANALYN carry the load. The force grows with the power 3/2 of the
    depth, so the secants are those of its power 2/3. Where it jumps over the load, the nearest height found is the answer,
    with the status NOT_CONVERGED.

    Trials start from one another and, under a load, have no tangential problem. The last ones start from nothing and are
    whole. So the answer is that of the height alone.
    """
    search, total, memory, motion = bench.search, bench.total[0], bench.memory, bench.search.motion[0]
    n = settle(Height.LOAD, force, search)
    if n <= 0 or force <= 0.0:
        if n >= 0:
            _solve(_prepared(n, bench), False, bench)
        return n
    z, changing = motion.z, motion.changing
    _, _, nodes = begin(search, z)
    tolerance = _ROUGHER if changing else _TOLERANCE
    if bench.case[0].normal_family == NormalFamily.STRIP_HALFSPACE:
        tolerance = max(tolerance, _ITERATED)
    acceptable = _ACCEPTABLE_ROUGH if changing and mode == Height.VERTICAL else _ACCEPTABLE
    deepest, target = 0.0, force ** (2.0 / 3.0)
    for k in range(n):
        deepest = max(deepest, search.patches[k].approach / math.cos(search.patches[k].angle))
    touch, low, high = z - deepest, z - deepest, math.inf
    z_before, f_before, missing_before, slope = z, 0.0, math.inf, 0.0
    best, z_best, last, first_last = math.inf, z, False, _MAX_HEIGHTS - _MAX_LAST
    for number in range(_MAX_HEIGHTS):
        if changing:  # grids that are laid for another height would change the force
            begin(search, z)
        n = _prepared(describe(search, z, nodes), bench)
        if last:
            memory[:] = 0.0
            memory[0] = n
        if last or mode == Height.VERTICAL:
            _solve(n, False, bench)
            carried = _carried(mode, n, bench)
        else:
            carried = _press(n, bench)
        f, missing = max(carried, 0.0) ** (2.0 / 3.0) - target, abs(carried - force) / force
        if last and missing < best:
            best, z_best = missing, z
        if last and missing <= tolerance:
            break
        if z != z_before and (f - f_before) / (z - z_before) > 0.0:
            slope = (f - f_before) / (z - z_before)
        elif number == 0:
            slope = (f + target) / deepest
        if f > 0.0:
            high = z
        else:
            low = z
        new = z - f / slope if slope > 0.0 else math.inf
        if not low < new < high:
            new = 0.5 * (low + high) if high < math.inf else z + 0.5 * deepest
        if abs(new) > _FURTHEST or (last and new == z):
            break
        # the error of a secant is proportional to both errors
        if not last and (missing * missing_before <= tolerance or new == z or number >= first_last):
            last, low, high = True, touch, math.inf
        z_before, f_before, missing_before, z = z, f, missing, new
    missed = best > acceptable
    if missed and high == math.inf:
        return NoAnswer.NOT_SETTLED.value
    distance = bench.ledger.settings[0].distance
    if motion.z != z_best or distance > 0.0:
        if changing:
            begin(search, z_best)
        n = _prepared(describe(search, z_best, nodes), bench)
        memory[:] = 0.0
        memory[0] = n
        _solve(n, True, bench)
    if missed:  # the force jumps with the height: on surfaces, and by ANALYN where a lobe appears
        total.status = Status.NOT_CONVERGED.value
    return n


@kernel
def solve_pair(mode, amount, given, bench):
    """Find the patches, solve each of them, add up.

    `given` is a record GIVEN of `layout`, `mode` and `amount` are those of `settle`. Under a load the height is found at
    which the vertical parts of the normal forces add up to it, with Height.VERTICAL those of all forces, friction included.
    The forces are those of the normal method. Damage is per patch, with its own rolling radius. What adds up does so with
    the patches' shares (`search.combine`), which are 1 nearly always. Fills bench.contacts and bench.total, and enters what
    the patches do into bench.ledger. Returns the number of patches, or a code of `settle` where there is no answer.
    """
    move(given, bench.search.motion[0])
    if mode == Height.VERTICAL or mode == Height.LOAD:
        return _solve_under(mode, amount, bench)
    n = _prepared(settle(mode, amount, bench.search), bench)
    if n >= 0:
        _solve(n, True, bench)
    return n
