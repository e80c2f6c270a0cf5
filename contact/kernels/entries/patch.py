"""Entries of one contact patch or several in one plane, from a separation: `wr_contact_…` of wheelrail.h.

`sizes` are four numbers: 1 for interacting strips, strips per patch, elements per strip, largest number of samples. `work`
is the caller's memory. It begins with two copies of the warm start: the kept one, from which every solution starts, and
the one that the last solution has left.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from contact.core import arranging, group
from contact.kernels import block, memory
from contact.kernels.arrays import Samples, SolverArrays
from contact.kernels.damage.assess import damage_kernel
from contact.kernels.entries.layout import Entries, copy, fill, forget_forged, lay_out, size_of
from contact.kernels.given_force import solve_under_force
from contact.kernels.jacobian import COLUMNS, ROWS, solve_with_jacobian
from contact.kernels.pipeline import solve_case
from contact.kernels.records import CASE, DAMAGE, DAMAGE_PARAMETERS, MAX_PATCHES, RESULT
from contact.kernels.rows import DamageField


@group
class _Laid(NamedTuple):
    """All arrays in the caller's memory."""

    kept: Any
    solver: SolverArrays
    damage_fields: Any


@arranging
def _lay(sizes, work, constants):
    """Return all arrays, the index of the strips, and the total size in numbers."""
    size = size_of(sizes)
    kept, end = block.vector(work, 0, memory.memory_size(size))
    trial, end = block.vector(work, end, memory.memory_size(size))
    workspace, at_strips, end = lay_out(work, end, trial, size, constants)
    damage_fields, end = block.cube(work, end, len(DamageField), MAX_PATCHES * size.n_strips, size.n_elements)
    solver, end = memory.lay_solver(work, end, size, workspace)
    return _Laid(kept, solver, damage_fields), at_strips, end


@arranging
def _start(sizes, work, given):
    """Return all arrays. The next solution starts from the kept start."""
    a, _, _ = _lay(sizes, work, given.data)
    copy(a.kept, a.solver.workspace.space.memory)
    forget_forged(a.solver.workspace.space.memory)
    return a


@arranging
def _samples(n, y, g, A, x_c, tilt):
    """Return the separation of `n` samples."""
    return Samples(
        block.vector(y, 0, n)[0],
        block.vector(g, 0, n)[0],
        block.vector(A, 0, n)[0],
        block.vector(x_c, 0, n)[0],
        block.vector(tilt, 0, n)[0],
    )


def contact_size(sizes, given):
    """Return the size of `work` in float64."""
    return _lay(sizes, sizes, given.data)[2]


def contact_strips(sizes, given):
    """Return the index of the strips in `work`. The fields follow them."""
    return _lay(sizes, sizes, given.data)[1]


def contact_init(sizes, poisson_ratio, work, given):
    """Fill what depends only on resolution and material, and empty the warm start."""
    a, _, _ = _lay(sizes, work, given.data)
    fill(a.solver.workspace, poisson_ratio, given.data)
    a.kept[:] = 0.0
    a.solver.workspace.space.memory[:] = 0.0
    return 0


def contact_solve(sizes, work, cold, n, y, g, A, x_c, tilt, case, result, given):
    """Solve one case from the kept start, or with `cold` from nothing. Return the number of strips."""
    a = _start(sizes, work, given)
    if cold != 0:
        a.solver.workspace.space.memory[0] = 0.0
    samples = _samples(n, y, g, A, x_c, tilt)
    cases, _ = block.records(case, 0, 1, CASE)
    results, _ = block.records(result, 0, 1, RESULT)
    return solve_case(samples, cases, a.solver.workspace, results)


def contact_force(sizes, work, which, Fx, Fy, n, y, g, A, x_c, tilt, case, results, given):
    """Solve one case under a given force from the kept start; its creepages become the answer. The second result is scratch."""
    a = _start(sizes, work, given)
    samples = _samples(n, y, g, A, x_c, tilt)
    cases, _ = block.records(case, 0, 1, CASE)
    two_results, _ = block.records(results, 0, 2, RESULT)
    return solve_under_force(samples, cases, a.solver.workspace, two_results, a.solver.search, which, Fx, Fy)


def contact_derivatives(sizes, work, n, y, g, A, x_c, tilt, cases, results, jacobian, given):
    """Solve the first of two cases from the kept start, with its jacobian. The second case and result are scratch."""
    a = _start(sizes, work, given)
    samples = _samples(n, y, g, A, x_c, tilt)
    two_cases, _ = block.records(cases, 0, 2, CASE)
    two_results, _ = block.records(results, 0, 2, RESULT)
    matrix, _ = block.matrix(jacobian, 0, ROWS, COLUMNS)
    return solve_with_jacobian(samples, two_cases, a.solver.workspace, two_results, matrix)


def contact_accept(sizes, work, given):
    """Make what the last solution has left the start of the following ones."""
    a, _, _ = _lay(sizes, work, given.data)
    copy(a.solver.workspace.space.memory, a.kept)
    return 0


def contact_forget(sizes, work, given):
    """Let the following solutions start from nothing."""
    a, _, _ = _lay(sizes, work, given.data)
    a.kept[:] = 0.0
    a.solver.workspace.space.memory[:] = 0.0
    return 0


def contact_damage(sizes, work, n, case, result, parameters, damage, given):
    """Fill the record DAMAGE from the `n` strips of the last solution."""
    a, _, _ = _lay(sizes, work, given.data)
    cases, _ = block.records(case, 0, 1, CASE)
    results, _ = block.records(result, 0, 1, RESULT)
    constants, _ = block.records(parameters, 0, 1, DAMAGE_PARAMETERS)
    out, _ = block.records(damage, 0, 1, DAMAGE)
    workspace = a.solver.workspace
    damage_kernel(workspace.strips, n, workspace.fields, cases[0], results[0], constants[0], a.damage_fields, out[0])
    return 0


ENTRIES: Entries = {
    "contact_size": (contact_size, "i64", ("ptr",)),
    "contact_strips": (contact_strips, "i64", ("ptr",)),
    "contact_init": (contact_init, "i64", ("ptr", "f64", "ptr")),
    "contact_solve": (contact_solve, "i64", ("ptr", "ptr", "i64", "i64", *("ptr",) * 7)),
    "contact_force": (contact_force, "i64", ("ptr", "ptr", "i64", "f64", "f64", "i64", *("ptr",) * 7)),
    "contact_derivatives": (contact_derivatives, "i64", ("ptr", "ptr", "i64", *("ptr",) * 8)),
    "contact_accept": (contact_accept, "i64", ("ptr", "ptr")),
    "contact_forget": (contact_forget, "i64", ("ptr", "ptr")),
    "contact_damage": (contact_damage, "i64", ("ptr", "ptr", "i64", *("ptr",) * 4)),
}
