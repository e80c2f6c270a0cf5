"""Forces of a wheel between two solutions of its contact: a step of first order from the last one (vehicle.md, 8).

Most steps change a contact by little. Its solution costs a hundred times as much as that change to first order: the normal
force follows the approach with Hertz's power, and creep forces follow the creepages with Kalker's stiffness on the part that
sticks. What this leaves out is measured at every solution: its difference from what was expected. Where the approach has
changed, the difference corrects the power of the normal force, elsewhere the next steps continue it as a linear drift. Its
size says how many steps may pass until the next solution. A contact that has moved far is solved at once.
"""

from __future__ import annotations

import math
from enum import IntEnum
from typing import Annotated, NamedTuple

from contact.core import group, kernel
from contact.kernels import kalker
from contact.kernels.arrays import Givens, Matrix, Numbers
from contact.kernels.block import layout
from contact.kernels.geometry.search import axle
from .layout import ELASTIC

#: Changes since the last solution from which on a contact is solved anew: of the approach, relative to it, and along the
#: surface [m]. A contact that moves further may meet another part of the rail.
_DEEPER, _ASIDE = 0.1, 5e-5
#: Change of the normal force, relative to it, that a motion along the surface by `_ASIDE` may have. Where the force changes
#: less by the approach, no power is learned. With 0 a wheelset gains 2.7 % of its dissipation on worn profiles (with .05
#: .5 %); with .1 a wheel at a kink is .053 of its load off between solutions (.033).
_UNCERTAIN = 0.05
#: Error of the prediction, relative to the tolerance, below which one more step may pass.
_EASY = 0.3
#: Weight of the newest error in the mean error after one step, and the largest error that counts, relative to the tolerance.
_NEWEST, _LOUDEST = 0.01, 2.0
#: Share of the error of the prediction that is added to the drift.
_TAKEN = 0.5
#: Hertz's power of the normal force over the approach, and the least and largest one of a contact that grows otherwise.
_HERTZ, _LEAST_POWER, _LARGEST_POWER = 1.5, 1.0, 4.0


#: Most steps from one solution of a contact to the next that may be asked for, and the default; tolerance of a predicted force
#: over the static load.
LONGEST_PACE, PACE, TOLERANCE = 5, 4, 7e-4


class Load(IntEnum):
    """Loads of a wheel that are predicted between solutions: members of WHEEL."""

    X = 0
    Y = 1
    Z = 2
    MX = 3
    MY = 4
    MZ = 5
    NORMAL = 6
    DISSIPATION = 7
    ELASTIC = 8
    T_GAMMA = 9


@group
class LastSolution(NamedTuple):
    """The last solution of every wheel, besides its contacts, and the prediction of the next. None where all is zero."""

    asked: Annotated[Givens, "n_wheels"]
    answers: Annotated[Matrix, "n_wheels, len(Load)"]
    drifts: Annotated[Matrix, "n_wheels, len(Load)"]  # per step
    expected: Annotated[Matrix, "n_wheels, len(Load)"]
    ages: Annotated[Numbers, "n_wheels"]  # steps since the last solution; 0 where there is none
    paces: Annotated[Numbers, "n_wheels"]  # steps from the last solution to the next
    noises: Annotated[Numbers, "n_wheels"]  # mean error of the predicted force after one step [N]
    powers: Annotated[Numbers, "n_wheels"]  # of the normal force over the approach, less Hertz's 1.5
    slopes: Annotated[Numbers, "n_wheels"]  # derivative of the expected normal force by the power [N]
    loads: Annotated[Numbers, "n_wheels"]  # static load [N]
    solutions: Annotated[Numbers, "n_wheels"]  # their number so far
    pending: Annotated[
        Numbers, "n_wheels"
    ]  # amount of past steps that is not counted yet, less that of coming steps that is (`count_around`)
    limits: Annotated[
        Numbers, "2"
    ]  # largest of `paces` (1: every step is a solution), and tolerance of a force over the static load


lay_last = layout(LastSolution, "n_wheels", globals())


@kernel
def read_loads(wheel, row):
    """Copy the loads of a wheel to a row."""
    row[Load.X], row[Load.Y], row[Load.Z] = wheel.longitudinal, wheel.lateral, wheel.vertical
    row[Load.MX], row[Load.MY], row[Load.MZ] = wheel.moment_x, wheel.moment_y, wheel.moment_z
    row[Load.NORMAL], row[Load.DISSIPATION] = wheel.normal, wheel.dissipation
    row[Load.ELASTIC], row[Load.T_GAMMA] = wheel.elastic, wheel.T_gamma


@kernel
def set_loads(row, wheel):
    """Copy the loads of a row to a wheel."""
    wheel.longitudinal, wheel.lateral, wheel.vertical = row[Load.X], row[Load.Y], row[Load.Z]
    wheel.moment_x, wheel.moment_y, wheel.moment_z = row[Load.MX], row[Load.MY], row[Load.MZ]
    wheel.normal, wheel.dissipation = row[Load.NORMAL], row[Load.DISSIPATION]
    wheel.elastic, wheel.T_gamma = row[Load.ELASTIC], row[Load.T_GAMMA]


@kernel
def _slip(given, x, y, z):
    """Return the velocity of a wheel's point over the rail. (x, y, z) is the point from the wheelset's centre [m]."""
    lx, ly, lz = axle(given.roll, given.yaw)
    wx, wy, wz = given.roll_rate + given.spin * lx, given.spin * ly, given.yaw_rate + given.spin * lz
    turn = given.rail_roll_rate
    return (
        given.vx + wy * z - wz * y,
        given.vy + wz * x - (wx - turn) * z - given.rail_vy,
        given.vz + (wx - turn) * y - wy * x - given.rail_vz,
    )


@kernel
def _creep_forces(contact, stiffness, bound, stick, more, ratio):
    """Return the creep forces after creepages have changed by `more`, and the normal force in the `ratio`.

    `stiffness` is dF/d(creepage) without slip [N], `bound` friction times normal force [N], `stick` the share of the area.
    In the theory of Vermeulen and Johnson (1964) the slope of the force is the stiffness times that share, spin or not, and
    across the force it is that of a force which turns with its creepage.
    """
    force = math.sqrt(contact.Fx**2 + contact.Fy**2)
    stick = min(stick, max(1.0 - force / bound, 0.0) ** (2.0 / 3.0))
    turning = math.sqrt(contact.longitudinal**2 + contact.lateral**2)
    turning += abs(contact.spin) * math.sqrt(contact.area / math.pi)
    along, across = stick * stiffness, stiffness
    if force > 0.0:
        across = min(max(along, force / max(turning, 1e-300)), stiffness)
    nx, ny = (contact.Fx / force, contact.Fy / force) if force > 0.0 else (1.0, 0.0)
    grown = force * ratio ** (1.0 - stick / 3.0) - along * (more[0] * nx + more[1] * ny)
    aside = -across * (more[1] * nx - more[0] * ny)
    size = math.sqrt(grown * grown + aside * aside)
    scale = min(1.0, ratio * max(bound, force) / size) if size > 0.0 else 0.0
    return scale * (grown * nx - aside * ny), scale * (grown * ny + aside * nx)


@kernel
def _lever(axis, x, y, z, c, s):
    """Return the moment about the axle of a unit force along the normal at (x, y, z) from the wheelset's centre [m]."""
    return axis[0] * (-y * c - z * s) + axis[1] * x * c + axis[2] * x * s


@kernel
def _predict(asked, now, friction, arrays, contacts, stick, power, n, row):
    """Add to `row` the change of the loads of `n` contacts since the last solution.

    `now` and `asked` are the inputs of the contacts now and at the last solution, `stick` is the share of their area without
    slip, `power` that of the normal force. Return whether they have hardly moved, and the derivative of the normal force by
    the power [N]; 0 if the motion along the surface may have changed that force more.
    """
    motion, slope, sideways = arrays.search.motion[0], 0.0, 0.0
    shear = arrays.case[0].G * arrays.case[0].slope
    c11, c22, _, _ = kalker.coefficients(arrays.workspace.tables.kalker, 0.0)
    dy, dz, droll, dyaw = now.y - asked.y, now.z - asked.z, now.roll - asked.roll, now.yaw - asked.yaw
    before, after = axle(asked.roll, asked.yaw), axle(now.roll, now.yaw)
    lx, ly, lz = after
    near = n > 0 and (asked.vx < 0.0) == (now.vx < 0.0)
    speed = max(abs(now.vx), motion.slowest)
    for k in range(n):
        contact = contacts[k]
        if contact.N <= 0.0 or contact.approach <= 0.0:
            near = False
            continue
        c, s = math.cos(contact.angle), math.sin(contact.angle)
        x, y = contact.x, contact.y - asked.y
        z = contact.z - asked.z + motion.radius
        across = dy - droll * z + dyaw * x - (now.rail_y - asked.rail_y)
        down = dz + droll * y - (now.rail_z - asked.rail_z)
        deeper, aside = c * down - s * across, c * across + s * down
        near = near and abs(deeper) < _DEEPER * contact.approach and abs(aside) < _ASIDE
        closer = max(1.0 + deeper / contact.approach, 0.0)
        ratio = closer**power
        if closer > 0.0:
            slope += contact.N * ratio * math.log(closer)
        sideways += _UNCERTAIN * contact.N * abs(aside) / _ASIDE
        before_x, before_y, before_z = _slip(asked, x, y, z)
        # the place on the wheel turns with the wheelset
        x_turned, y_turned, z_turned = x - dyaw * y, y + dyaw * x - droll * z, z + droll * y
        now_x, now_y, now_z = _slip(now, x_turned, y_turned, z_turned)
        more_x = (now_x - before_x) / speed
        more_y = (c * (now_y - before_y) + s * (now_z - before_z)) / speed
        bound, ab = friction * contact.N, contact.area / math.pi
        Fx, Fy = contact.Fx, contact.Fy
        if bound > 0.0 and ratio > 0.0:
            Fx, Fy = _creep_forces(contact, 0.5 * (c11 + c22) * shear * ab, bound, stick, (more_x, more_y), ratio)
        x_force, along, normal = Fx - contact.Fx, Fy - contact.Fy, contact.N * (ratio - 1.0)
        y_force, z_force = along * c + normal * s, along * s - normal * c
        row[Load.X] += x_force
        row[Load.Y] += y_force
        row[Load.Z] -= z_force
        all_y, all_z = Fy * c + contact.N * ratio * s, Fy * s - contact.N * ratio * c
        old_y, old_z = all_y - y_force, all_z - z_force
        # the pressure has no moment about the axle, wherever this points
        turning = contact.N * (
            ratio * _lever(after, x_turned, y_turned, z_turned, c, s) - _lever(before, x, y, z, c, s)
        )
        row[Load.MX] += y_turned * all_z - z_turned * all_y - (y * old_z - z * old_y) - turning * lx
        row[Load.MY] += z_turned * Fx - x_turned * all_z - (z * contact.Fx - x * old_z) - turning * ly
        row[Load.MZ] += x_turned * all_y - y_turned * Fx - (x * old_y - y * contact.Fx) - turning * lz
        row[Load.NORMAL] += normal
        creep_x, creep_y = contact.longitudinal + more_x, contact.lateral + more_y
        row[Load.DISSIPATION] += contact.Fx * contact.longitudinal + contact.Fy * contact.lateral
        row[Load.DISSIPATION] -= Fx * creep_x + Fy * creep_y
        row[Load.ELASTIC] += ELASTIC * (contact.N * ratio * (contact.approach + deeper) - contact.N * contact.approach)
        row[Load.T_GAMMA] += abs(Fx * creep_x) + abs(Fy * creep_y)
        row[Load.T_GAMMA] -= abs(contact.Fx * contact.longitudinal) + abs(contact.Fy * contact.lateral)
    return near, slope if abs(slope) > sideways else 0.0


@kernel
def expect(last, w, given, friction, arrays, contacts, stick, n):
    """Fill the loads that wheel `w` is expected to have now. Return whether its `n` contacts have hardly moved.

    `contacts` and `stick` are those of the last solution, `arrays` has the constants of its pair. Other arguments as for
    `_predict`.
    """
    if last.ages[w] <= 0.0:
        return False
    expected = last.expected[w]
    for i in range(expected.size):
        expected[i] = last.answers[w, i] + last.ages[w] * last.drifts[w, i]
    power = _HERTZ + last.powers[w]
    near, slope = _predict(last.asked[w], given, friction, arrays, contacts, stick, power, n, expected)
    last.slopes[w] = slope
    return near


@kernel
def take_expected(last, w, amount, wheel):
    """Give wheel `w` the loads of `expect` if it need not be solved yet; return whether it has them.

    `amount` is what `count_around` counts.
    """
    if last.ages[w] >= last.paces[w]:
        return False
    set_loads(last.expected[w], wheel)
    last.ages[w] += 1.0
    last.pending[w] += amount
    return True


@kernel
def count_around(last, w, amount):
    """Return the amount for which the solution of wheel `w` at this step counts, of which each step has `amount`.

    It counts for half of the steps since the last one and half of those until the next one, whose number is the present pace.
    If the next solution comes earlier or later, it corrects the difference.
    """
    due = amount + last.pending[w]
    counted = max(due + 0.5 * (max(last.paces[w], 1.0) - 1.0) * amount, 0.0)
    last.pending[w] = due - counted
    return counted


@kernel
def keep_solution(last, w, given, wheel, near):
    """Compare the solution of wheel `w` with what was expected, and set drift, power and pace until the next solution.

    `near` says whether anything was expected.
    """
    answer, drift, expected = last.answers[w], last.drifts[w], last.expected[w]
    read_loads(wheel, answer)
    last.solutions[w] += 1.0
    age = last.ages[w]
    last.asked[w] = given
    last.ages[w] = 1.0
    if not near:
        drift[:] = 0.0
        last.powers[w], last.paces[w] = 0.0, 1.0
        return
    missed = max(
        abs(answer[Load.X] - expected[Load.X]),
        max(abs(answer[Load.Y] - expected[Load.Y]), abs(answer[Load.Z] - expected[Load.Z])),
    )
    allowed = last.limits[1] * last.loads[w]
    # The more the approach has changed against what else is not known, the more of the error is that of the power.
    slope, unknown = last.slopes[w], allowed + last.noises[w]
    by_power = slope * slope / (slope * slope + unknown * unknown)
    if by_power > 0.0:
        power = last.powers[w] + by_power * (answer[Load.NORMAL] - expected[Load.NORMAL]) / slope
        last.powers[w] = min(max(power, _LEAST_POWER - _HERTZ), _LARGEST_POWER - _HERTZ)
    for i in range(drift.size):
        drift[i] += _TAKEN * (1.0 - by_power) * (answer[i] - expected[i]) / age
    if age == 1.0:  # no pace is better than that
        last.noises[w] += _NEWEST * (min(missed, _LOUDEST * allowed) - last.noises[w])
    if missed > allowed + 2.0 * last.noises[w]:
        last.paces[w] = 1.0
    elif missed < _EASY * allowed + last.noises[w]:
        last.paces[w] = min(last.paces[w] + 1.0, last.limits[0])
