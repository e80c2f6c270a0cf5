"""pythonfmu slave of the FMU `Wheelset`, which calls `contact_models.wheelset.model.WheelsetModel`."""

from __future__ import annotations

from typing import Any

from contact.geometry import profile
from contact_models.wheelset.model import WheelsetModel
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import (
    CHANGE,
    CREEPAGE,
    CURVATURE,
    ENERGY,
    FRAME,
    GAP,
    IRREGULARITY,
    LOAD,
    MOTION,
    PROBLEM,
    REACTION,
    SIDES,
)
from ..tables.wheelset import KEYWORDS, table
from .model import ModelSlave
from .values import Rows, SlaveValues


class WheelsetSlave(ModelSlave):
    """One wheelset whose contact forces are inputs."""

    def __init__(self, guid: str, **kwargs: Any) -> None:
        super().__init__(table(), guid, **kwargs)

    def outputs(self, values: SlaveValues, step_size: float) -> Rows:
        """Advance the model with constant forces. With a step size of 0, return the outputs at the start."""
        model: WheelsetModel = self.made(values, _model)
        if step_size > 0.0:
            for side in SIDES:
                model.set_forces(side, *(values[f"{side}.{name}"] for name in REACTION))
            model.set_irregularity(*(values[name] for name in IRREGULARITY))
            model.step(step_size)
        return _report(model)

    def memory(self) -> str | None:
        """Return the state of the model other than its outputs, as text."""
        return None if self.model is None else self.model.save().hex()

    def recall(self, memory: str | None) -> None:
        """Restore the state of the model from `memory`."""
        if memory is None:
            self.model = None
        else:
            self.made(self.values, _model).restore(bytes.fromhex(memory))


def _model(values: SlaveValues, old: WheelsetModel | None) -> WheelsetModel:
    """Return the model with these parameters, at its start."""
    keywords = {keyword: values[name] for name, keyword in KEYWORDS.items()}
    rail = profile.rail_60e1(values["rail.inclination"])
    return WheelsetModel(WheelsetParameters(rail=rail, substeps=values["resolution.substeps"], **keywords))


def _report(model: WheelsetModel) -> Rows:
    rows: dict[str, Any] = dict(zip(MOTION, model.motion().tolist(), strict=True))
    rows |= zip(ENERGY, model.energy().tolist(), strict=True)
    rows |= zip(CHANGE, model.change().tolist(), strict=True)
    for side in SIDES:
        problem = model.problem(side)
        rows[f"{side}.geometry.g"] = problem[GAP].tolist()
        rows[f"{side}.geometry.A"] = problem[CURVATURE].tolist()
        scalars = (*PROBLEM[CREEPAGE], PROBLEM[LOAD])
        rows |= zip((f"{side}.{name}" for name in scalars), problem[CREEPAGE.start :].tolist(), strict=True)
        rows |= zip((f"{side}.{name}" for name in FRAME), model.frame(side).tolist(), strict=True)
    return rows
