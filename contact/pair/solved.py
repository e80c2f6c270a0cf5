"""The answer of the kernel of a pair as a `PairSolution`."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from contact.creepage import Creepage
from contact.kernels.arrays import Bench
from contact.pair.solution import Contact, PairDamage, PairSolution
from contact.solution import PairJacobian, Status


def of_kernel(total: SimpleNamespace, bench: Bench, n: int, spin: float, jacobian: PairJacobian | None) -> PairSolution:
    """Return the solution that a kernel has left in `bench`, with the numbers `total` of its record TOTAL and `n` patches."""
    return PairSolution(
        force=np.array([total.Fx, total.Fy, total.Fz]),
        moment=np.array([total.Mx, total.My, total.Mz]),
        Q=total.Q,
        Y=total.Y,
        Y_over_Q=total.Y_over_Q,
        used_friction=total.used_friction,
        z=total.z,
        contacts=tuple(_contact(numbers(row)) for row in bench.contacts[:n]),
        max_pressure=total.pmax,
        area=total.area,
        slip_area=total.slip_area,
        power_per_metre=total.power,
        damage=PairDamage(*(getattr(total, name) for name in PairDamage._fields)),
        status=Status(total.status),
        gap_error=total.gap_error,
        deflection=(float(bench.rail[0].dy), float(bench.rail[0].dz)),
        spin=spin,
        jacobian=jacobian,
    )


def numbers(row: np.record) -> SimpleNamespace:
    """Return a record with numbers of Python: numpy takes 2 µs for each member, more than the kernel for all."""
    return SimpleNamespace(**dict(zip(row.dtype.names or (), row.item(), strict=True)))


def _contact(found: SimpleNamespace) -> Contact:
    return Contact(
        N=found.N,
        Fx=found.Fx,
        Fy=found.Fy,
        Mx=found.Mx,
        My=found.My,
        Mz=found.Mz,
        position=(found.x, found.y, found.z),
        angle=found.angle,
        area=found.area,
        max_pressure=found.pmax,
        creepage=Creepage(found.longitudinal, found.lateral, found.spin),
        approach=found.approach,
        on_rail=(found.rail_y, found.rail_z),
        on_wheel=(found.wheel_y, found.wheel_z),
        used_friction=found.used_friction,
        status=Status(found.status),
        gap_error=found.gap_error,
        pitch=found.pitch,
    )
