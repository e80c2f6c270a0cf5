"""What the patches of one wheel on one rail add up to: force, moment, status, results of damage."""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Contact, Damage, Motion, Result, Total
from contact.kernels.damage.assess import clear_damage
from contact.kernels.enumerations import Status
from contact.kernels.geometry.search import axle
from contact.kernels.rows import Strip


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


@entry
def compare_forces(mirror: float, total: Total) -> None:
    """Set what compares the summed forces: Q, Y, their ratio, and the used friction. `mirror` is -1 on the left side."""
    total.Q, total.Y = -total.Fz, -mirror * total.Fy
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
def add_results(result, damage, share, total):
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


@entry
def add_patch(contact: Contact, result: Result, damage: Damage, share: float, motion: Motion, total: Total) -> None:
    """Add a patch that Python has solved, on either side. Its plane is that of elements, as on changing surfaces."""
    add_wrench(contact, (0.0, 0.0, 0.0, 0.0), share, motion, total)
    add_results(result, damage, share, total)
    total.gap_error, total.bend = max(total.gap_error, contact.gap_error), max(total.bend, result.bend)


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
    total.N, total.Q, total.Y, total.Y_over_Q, total.used_friction = 0.0, 0.0, 0.0, 0.0, 0.0
    total.bend, total.beyond = 0.0, 0.0
    clear_damage(total)


@kernel
def mirror_answer(mirror, n, contacts, total):
    """Change the signs of `n` contacts and the total to those of the actual side."""
    total.Fy, total.Mx, total.Mz = mirror * total.Fy, mirror * total.Mx, mirror * total.Mz
    for k in range(n):
        contact = contacts[k]
        contact.Fy, contact.Mx, contact.Mz = mirror * contact.Fy, mirror * contact.Mx, mirror * contact.Mz
        contact.y, contact.angle = mirror * contact.y, mirror * contact.angle
        contact.lateral, contact.spin = mirror * contact.lateral, mirror * contact.spin
