"""A massless rail on springs under a wheel: its deflection balances the contact force (other_wheels.md).

    k_y dy = F_y + P_y,   k_z dz = F_z + P_z,

with the contact force F on the rail and an external force P on it, in track coordinates. The rail moves before the contact
search. A stiffness of 0 in the record means that the rail is rigid in that direction.
"""

from contact.core import kernel
from contact.kernels.enumerations import Height, Status
from contact.kernels.pair import solve_pair
from contact.kernels.root import advance, begin

#: Reach of the search for a deflection beyond where it starts [m], the shortest bracket [m], the error of the balance over the
#: vertical force at which it ends, and most deflections. The force of a warm pair repeats to about this error, seldom to a
#: few times it. So a search that has ended otherwise is in balance within `_NOISE`.
_REACH, _SHORTEST, _TOLERANCE, _NOISE, _MOST = 0.03, 1e-12, 2e-5, 1e-4, 60


@kernel
def _left(residual, total):
    """Return the residual [N], or 0.0 if it is within the tolerance."""
    return 0.0 if abs(residual) <= _TOLERANCE * max(abs(total.Q), 1.0) else residual


@kernel
def _balanced(root, total):
    """Return 1 if what the search has left is no more than the noise of the force, else 0: the force jumps."""
    return 1 if abs(root.value) <= _NOISE * max(abs(total.Q), 1.0) else 0


@kernel
def _solve_moved(mode, amount, given, arrays):
    """As `solve_pair`, with the rail displaced by its deflection."""
    rail = arrays.rail[0]
    arrays.moved[0] = given
    arrays.moved[0].rail_y = given.rail_y + rail.dy
    arrays.moved[0].rail_z = given.rail_z + rail.dz
    return solve_pair(mode, amount, arrays.moved[0], arrays)


@kernel
def _solve_settled(mode, amount, given, arrays):
    """As `solve_pair`, with the vertical deflection in balance."""
    rail, total, root = arrays.rail[0], arrays.total[0], arrays.roots[1]
    if rail.kz <= 0.0:
        rail.dz = 0.0
        return _solve_moved(mode, amount, given, arrays)
    if mode != Height.GIVEN:  # the wheel's height follows from its load, so the force does not depend on dz
        code = _solve_moved(mode, amount, given, arrays)
        left = _left(rail.kz * rail.dz + total.Fz - rail.preload_z, total)
        if code < 0 or left == 0.0:
            return code
        rail.dz -= left / rail.kz
        return _solve_moved(mode, amount, given, arrays)
    begin(root, rail.dz, rail.kz, rail.dz - _REACH, rail.dz + _REACH)
    while True:
        rail.dz = root.x
        code = _solve_moved(mode, amount, given, arrays)
        value = _left(rail.kz * rail.dz + total.Fz - rail.preload_z, total)
        if code < 0 or not advance(root, value, _SHORTEST, _MOST):
            rail.balanced = _balanced(root, total)
            return code


@kernel
def _settle(mode, amount, given, arrays):
    """As `solve_pair`, with both deflections in balance."""
    rail, total, root = arrays.rail[0], arrays.total[0], arrays.roots[0]
    rail.balanced = 1
    if rail.ky <= 0.0:
        rail.dy = 0.0
        return _solve_settled(mode, amount, given, arrays)
    begin(root, rail.dy, rail.ky, rail.dy - _REACH, rail.dy + _REACH)
    while True:
        rail.dy, rail.balanced = root.x, 1
        code = _solve_settled(mode, amount, given, arrays)
        value = _left(rail.ky * rail.dy + total.Fy - rail.preload_y, total)
        if code < 0 or not advance(root, value, _SHORTEST, _MOST):
            rail.balanced = min(rail.balanced, _balanced(root, total))
            return code


@kernel
def _sane(deflection):
    """Return a deflection to start from [m]; 0 for a number that no search leaves, which a host can restore."""
    return deflection if abs(deflection) <= 1.0 else 0.0


@kernel
def solve_on_rail(mode, amount, given, arrays):
    """As `solve_pair`, on the rail of `arrays.rail`.

    The search starts at the deflection of the last call, the last two numbers of `arrays.memory`. If the force jumps and no
    deflection is in balance, the status is NOT_CONVERGED. Wear is added only for the balance.
    """
    rail, memory, settings = arrays.rail[0], arrays.memory, arrays.ledger.settings[0]
    rail.dy, rail.dz = 0.0, 0.0
    if rail.ky <= 0.0 and rail.kz <= 0.0:
        return solve_pair(mode, amount, given, arrays)
    rail.dy, rail.dz = _sane(memory[memory.size - 2]), _sane(memory[memory.size - 1])
    dy, dz = rail.dy, rail.dz
    distance = settings.distance
    settings.distance = 0.0
    code = _settle(mode, amount, given, arrays)
    settings.distance = distance
    if code >= 0 and distance > 0.0 and rail.balanced == 1 and arrays.ledger.bins.shape[2] > 0:
        code = _solve_moved(mode, amount, given, arrays)
    if code >= 0:
        dy, dz = rail.dy, rail.dz
        if rail.balanced == 0:
            arrays.total[0].status = Status.NOT_CONVERGED
    memory[memory.size - 2], memory[memory.size - 1] = dy, dz
    return code
