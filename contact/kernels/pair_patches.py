"""The patches of a wheel on a rail: each is solved at its approach, and what they do is added up."""

import math

from contact.core import arranging, kernel
from contact.kernels.arrays import Samples, Space, Workspace
from contact.kernels.block import part
from contact.kernels.damage.assess import bears_nothing, clear_damage, damage_kernel, damage_of_patch
from contact.kernels.enumerations import LoadKind
from contact.kernels.ledger import enter
from contact.kernels.normal.press import press
from contact.kernels.pipeline import complete_pressure, roll_case
from contact.kernels.records import LARGEST_CREEPAGE, MAX_PATCHES
from contact.kernels.resultants import (
    add_results,
    add_wrench,
    clear_contact,
    clear_total,
    compare_forces,
    mirror_answer,
    pressure_wrench,
    report,
)
from contact.kernels.rows import Sep


@kernel
def _bounded(creepage):
    """Return the creepage, limited to its range. A wheelset almost at rest leaves the range, in full slip."""
    return min(max(creepage, -LARGEST_CREEPAGE), LARGEST_CREEPAGE)


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
def workspace_of(k, arrays):
    """Return separation and workspace of patch k of the last search. Strips and fields are those of `arrays.workspace`."""
    workspace, memory, sep = arrays.workspace, arrays.memory, arrays.search.separations[k]
    piece = (memory.size - 3) // MAX_PATCHES
    space = space_of_patch(workspace.space, memory[1 + k * piece : 1 + (k + 1) * piece], workspace.space.tangent)
    samples = Samples(sep[Sep.Y], sep[Sep.G], sep[Sep.A], sep[Sep.XC], sep[Sep.TILT])
    return samples, Workspace(workspace.rule, workspace.tables, space, workspace.strips, workspace.fields)


@arranging
def _one_row(fields):
    """Return the fields with room for a single strip, which asks methods for forces only."""
    return part(fields, 0, fields.shape[0], 1, fields.shape[2])


@kernel
def press_patch(k, arrays):
    """Solve the normal problem of patch k of the last search at its approach. Return the number of strips.

    Strips are those of `arrays.workspace`, until the next patch is solved. `arrays.patch_case` holds the case of the pair.
    """
    set_case(arrays.search.patches[k], arrays.search.motion[0], arrays.case[0], arrays.patch_case[0])
    samples, of_patch = workspace_of(k, arrays)
    return press(samples, arrays.patch_case[0], of_patch, arrays.result[0])


@kernel
def _roll_patch(k, n_strips, brief, arrays):
    """Solve the tangential problem of patch k, pressed last, with its damage; `brief` as in `solve_patches`."""
    search, workspace, result, parameters = (
        arrays.search,
        arrays.workspace,
        arrays.result[0],
        arrays.damage_parameters[0],
    )
    case = arrays.patch_case[0]
    if n_strips > 0:
        samples, of_patch = workspace_of(k, arrays)
        if brief and case.conformal == 0 and not case.pressure_limit > 0.0:
            of_patch = Workspace(
                of_patch.rule, of_patch.tables, of_patch.space, of_patch.strips, _one_row(of_patch.fields)
            )
        complete_pressure(samples, n_strips, brief, case, of_patch, result)
        roll_case(samples, n_strips, case, of_patch, result)
    parameters.speed, parameters.wheel_radius = search.motion[0].vx, search.patches[k].radius
    if brief:
        clear_damage(arrays.damage[0])
        if not bears_nothing(n_strips, result):
            damage_of_patch(case, result, parameters, arrays.damage[0])
        return
    damage_kernel(
        workspace.strips, n_strips, workspace.fields, case, result, parameters, arrays.damage_fields, arrays.damage[0]
    )


@kernel
def solve_patch(k, arrays):
    """Solve patch k of the last search at its approach, as `press_patch`, and with its fields. Return the number of strips."""
    n_strips = press_patch(k, arrays)
    _roll_patch(k, n_strips, False, arrays)
    return n_strips


@kernel
def prepare_patches(n, arrays):
    """Prepare to solve the `n` patches of a search, if there are any. Return n."""
    memory = arrays.memory
    if n >= 0:
        if memory[0] != n:  # a patch came or went: none starts from another one
            memory[:] = 0.0
            memory[0] = n
        arrays.patch_case[0] = arrays.case[0]
    return n


@kernel
def keeps_ledger(arrays):
    """Return whether there is a ledger, and a distance over which its damage counts."""
    return arrays.ledger.bins.shape[2] > 0 and arrays.ledger.settings[0].distance > 0.0


@kernel
def press_patches(n, arrays):
    """Solve the normal problems of the `n` patches of the last search.

    Return the number of strips of the last one, the vertical force of all [N], its d(ln N)/dz [1/m] and the most iterations of
    a patch.
    """
    result, n_strips, force, stiffness, most = arrays.result[0], 0, 0.0, 0.0, 0
    for k in range(n):
        n_strips, patch = press_patch(k, arrays), arrays.search.patches[k]
        if n_strips > 0:
            patch.load = result.N
            cosine = math.cos(patch.angle) * math.cos(patch.pitch)
            force += patch.share * result.N * cosine
            stiffness += patch.share * result.stiffness * cosine * cosine
            most = max(most, result.iterations)
    return n_strips, force, stiffness / force if force > 0.0 else 0.0, most


@kernel
def solve_patches(n, pressed, brief, enters, arrays):
    """Solve the `n` patches of the last search and add up.

    Return d(ln N)/dz of their normal forces, vertically [1/m], and the most iterations of a patch.
    `pressed` is the number of strips of a single patch whose normal problem is solved already, or below 0. The ledger is
    filled if `enters` says so. A `brief` solution has forces, T-gamma and what follows from it, but neither damage of elements
    nor `gap_error`.
    """
    workspace, total, result = arrays.workspace, arrays.total[0], arrays.result[0]
    damage, case, motion = arrays.damage[0], arrays.patch_case[0], arrays.search.motion[0]
    for k in range(MAX_PATCHES):
        clear_contact(arrays.contacts[k])
    clear_total(total)
    normal, stiffness, most = 0.0, 0.0, 0
    for k in range(n):
        patch, contact = arrays.search.patches[k], arrays.contacts[k]
        n_strips = pressed if pressed >= 0 else press_patch(k, arrays)
        _roll_patch(k, n_strips, brief, arrays)
        total.bend, total.beyond = max(total.bend, result.bend), max(total.beyond, result.beyond)
        pressure = pressure_wrench(workspace.strips, n_strips)
        report(patch, case, result, pressure, contact)
        if n_strips > 0:
            patch.load, most = result.N, max(most, result.iterations)
            cosine = math.cos(patch.angle) * math.cos(patch.pitch)
            normal += patch.share * result.N * cosine
            stiffness += patch.share * result.stiffness * cosine * cosine
            add_wrench(contact, pressure, patch.share, motion, total)
            add_results(result, damage, patch.share, total)
            total.gap_error = max(total.gap_error, contact.gap_error)
            if enters and keeps_ledger(arrays):
                enter(patch, n_strips, damage, arrays)
    total.z, total.n_patches = motion.z, n
    mirror_answer(motion.mirror, n, arrays.contacts, total)
    compare_forces(motion.mirror, total)
    return stiffness / normal if normal > 0.0 else 0.0, most
