"""A short run of the FMU `Wheelset` with forces that change in each step."""

import math

from fmu_instance import Instance

from contact_models.vehicle.declared import SIDES


def inputs(k: int) -> dict[str, float]:
    """Return the forces of step `k` by the names of the FMU's inputs."""
    found = {}
    for wheel, m in enumerate((1.0, -1.0), 1):
        force = (900.0 * m * math.sin(k), m * 2e3 + 300.0 * k, -54e3 - 500.0 * k)
        moment = (m * 40e3, 400.0 * m * math.sin(k), -600.0 * m)
        for kind, values in (("force", force), ("moment", moment)):
            found |= {f"wheel[{wheel}].{kind}.{axis}": v for axis, v in zip("xyz", values, strict=True)}
    assert wheel == len(SIDES)
    return found


def trajectory(fmu: Instance, start: int) -> list[dict[str, float]]:
    """Return the outputs of three steps with changing forces from step `start` on."""
    rows = []
    for k in range(start, start + 3):
        fmu.update(inputs(k))
        fmu.step(k * 1e-3)
        rows.append(fmu.all("output"))
    return rows
