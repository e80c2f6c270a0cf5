"""The kernels behind `contact.Solver` and the FMUs of one contact: one problem after the other, in the same arrays."""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Samples, SolverArrays, Workspace
from contact.kernels.given_force import solve_under_force
from contact.kernels.jacobian import solve_with_jacobian
from contact.kernels.pipeline import solve_case


@kernel
def for_forces(arrays):
    """Return the workspace without room for fields, which would take time, unless the forces need them."""
    workspace, case = arrays.workspace, arrays.case[0]
    if case.conformal != 0 or 0.0 < case.pressure_limit < math.inf:
        return workspace
    return Workspace(workspace.rule, workspace.tables, workspace.space, workspace.strips, arrays.row)


@kernel
def _workspace(with_fields, arrays):
    return arrays.workspace if with_fields else for_forces(arrays)


@entry
def solve_contact(sep: Samples, with_fields: bool, arrays: SolverArrays) -> int:
    """Solve the first case into the first result. Return the strip count."""
    return solve_case(sep, arrays.case, _workspace(with_fields, arrays), arrays.result)


@entry
def derive_contact(sep: Samples, with_fields: bool, arrays: SolverArrays) -> int:
    """As `solve_contact`, and fill the derivatives (`jacobian.solve_with_jacobian`)."""
    return solve_with_jacobian(sep, arrays.case, _workspace(with_fields, arrays), arrays.result, arrays.slopes)


@entry
def solve_contact_under_force(sep: Samples, arrays: SolverArrays, given: int, Fx: float, Fy: float) -> int:
    """As `solve_contact`, for creepages that give a force, which become those of the case (`given_force`)."""
    return solve_under_force(sep, arrays.case, arrays.workspace, arrays.result, arrays.search, given, Fx, Fy)
