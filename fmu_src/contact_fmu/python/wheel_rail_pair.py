"""pythonfmu slave of the FMU `WheelRailPair`, which calls `contact.pair.WheelRailPair`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from pythonfmu.enums import Fmi2Status

from contact import Status
from contact.damage import WEAR_LAWS, DamageParameters
from contact.geometry.flexible import WheelOffset
from contact.geometry.profile import Profile
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.wheelset import Pair
from contact.instance import workspace
from contact.pair import ElasticRail, WheelRailPair
from .. import profiles
from ..tables.wheel_rail_pair import ACCUMULATED, BINS, MOTION, OFFSET, PATCHES, table
from .model import ModelSlave
from .surface import friction, methods
from .values import Rows, SlaveValues

_MOTION = [name for name, *_ in MOTION]


class WheelRailPairSlave(ModelSlave):
    """One wheel on one rail. Each patch starts from its last solution if the normal method can use a warm start."""

    def __init__(self, inclination: float, guid: str, accumulation: bool = False, **kwargs: Any) -> None:
        super().__init__(table(inclination, accumulation), guid, **kwargs)
        self.profiles = [profiles.read(Path(self.resources), kind) for kind in ("wheel", "rail")]

    def outputs(self, values: SlaveValues, step_size: float) -> Rows:
        """Solve for the present inputs, which are constant over the step. The first step is a cold start."""
        pair: WheelRailPair = self.made(values, self._pair)
        memory = pair.arrays.memory
        before = memory.copy() if step_size > 0.0 else np.zeros_like(memory)
        memory[:] = before
        motion = [values[name] for name in _MOTION]
        speed = abs(values["velocity.x"])
        bins = pair.arrays.ledger.bins
        bins[:] = np.reshape([values[name] for name in ACCUMULATED], (2, -1, BINS)) if bins.size else 0.0
        try:
            solution = pair.solve(
                Pose(*motion[:4]),
                Velocity(*motion[4:10]),
                irregularity=Irregularity(*motion[10:]),
                **_carried(values),
                friction=friction(values),
                distance=speed * step_size,
                rail=_rail(values),
                offset=WheelOffset(*(values[name] for name, *_ in OFFSET)),
            )
            arrays = pair.arrays
            rows: dict[str, Any] = {
                **self.copied("total", lambda name: arrays.total[name].item()),
                **self.copied("elastic_rail", lambda name: arrays.rail[name].item()),
                **self.copied("contact", lambda name: arrays.contacts[name][:PATCHES].tolist()),
                "slip.ratio": solution.slip_ratio,
                "power.friction": speed * solution.power_per_metre,
            }
            rows |= self.integrals(values, rows, step_size)
            if bins.size:
                rows |= zip(ACCUMULATED, bins.reshape(-1, BINS).tolist(), strict=True)
            values.updated(rows)
        except Exception:
            memory[:] = before  # a discarded step must not change the memory
            raise
        if step_size == 0.0:
            memory[:] = 0.0
        if solution.status in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED) and solution.status != values["status"]:
            self.log(f"status {solution.status.name}: {solution.status.message}", Fmi2Status.warning)
        return rows

    def memory(self) -> str | None:
        """Return the warm start of the normal method, as text."""
        return None if self.model is None else self.model.arrays.memory.tobytes().hex()

    def recall(self, memory: str | None) -> None:
        """Restore the warm start from `memory`."""
        if memory is None:
            self.model = None
        else:
            self.made(self.values, self._pair).arrays.memory[:] = np.frombuffer(bytes.fromhex(memory))

    def _pair(self, values: SlaveValues, old: WheelRailPair | None) -> WheelRailPair:
        """Return the pair with these parameters. It gets the memory of the old one."""
        wheel, rail = self.profiles[0], self.profiles[1].rotated(-np.arctan(values["rail.inclination"]))
        options = methods(values)
        geometry = Pair(
            wheel,
            rail,
            side="right" if values.item("side") == "Right" else "left",
            nominal_radius=values["wheel.radius"],
            gauge=values["track.gauge"],
            flange_back=values["wheel.flange_back"],
            gauge_point=values["track.gauge_point"],
            combine_distance=values["patches.combine_distance"],
            combine_angle=values["patches.combine_angle"],
            most_patches=values["patches.max"],
            samples=values["resolution.n_samples"],
            material=options["material"],
            reference_speed=values["reference_speed"],
        )
        pair = WheelRailPair(
            geometry,
            **options,
            conformal=values.item("patches.surface") == "Conformal",
            **_accumulation(values, wheel, rail),
        )
        if old is not None and old.arrays.memory.size == pair.arrays.memory.size:
            pair.arrays.memory[:] = old.arrays.memory
        return pair


def _carried(values: SlaveValues) -> dict[str, Any]:
    """Return the argument of `WheelRailPair.solve` for the load, none if the height is given."""
    name = {"NormalForce": "load", "VerticalForce": "vertical"}.get(values.item("load.kind"))
    return {} if name is None else {name: max(values["load.normal_force"], 0.0)}


def _rail(values: SlaveValues) -> ElasticRail:
    """Return the rail. A stiffness of 0 is rigid."""
    ky, kz = (values[f"rail.k{axis}"] or math.inf for axis in "yz")
    return ElasticRail(ky, kz, values["rail.preload_y"], values["rail.preload_z"])


def _accumulation(values: SlaveValues, wheel: Profile, rail: Profile) -> dict[str, Any]:
    """Return the options of the pair for damage that accumulates on both profiles, empty if nothing accumulates."""
    law = int(values["accumulation.wear_law"])
    if law == 1:
        return {}
    ledger = workspace.ledger(
        np.stack((wheel.y, wheel.z)),
        np.stack((rail.y, rail.z)),
        values["resolution.n_strips"],
        BINS,
        values["accumulation.first"],
        values["accumulation.width"],
    )
    return {"ledger": ledger, "damage": DamageParameters(wear_law=WEAR_LAWS[law - 2])}
