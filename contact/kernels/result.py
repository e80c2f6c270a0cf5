"""Operations on a result that all solvers share."""

from contact.core import kernel


@kernel
def clear(result):
    """Set every member of a result to zero."""
    result.Fx, result.Fy, result.Mz, result.N = 0.0, 0.0, 0.0, 0.0
    result.approach, result.pmax, result.area, result.slip_area, result.power = 0.0, 0.0, 0.0, 0.0, 0.0
    result.stiffness, result.length, result.width = 0.0, 0.0, 0.0
    result.n_patches, result.iterations, result.status, result.limited = 0, 0, 0, 0
    result.pressure_y, result.touch, result.gap_error, result.bend, result.beyond = 0.0, 0.0, 0.0, 0.0, 0.0
    result.edges[:] = 0.0


@kernel
def clear_forces(result):
    """Set what the tangential problem adds to a result to zero."""
    result.Fx, result.Fy, result.Mz = 0.0, 0.0, 0.0
    result.slip_area, result.power, result.pressure_y, result.beyond = 0.0, 0.0, 0.0, 0.0
