"""The slave of the FMU `Wheelset`: `models.wheelset.model.WheelsetModel` behind its table."""

from __future__ import annotations

from typing import Any

from contact.geometry import profile
from fmu_src.python.slave import TableSlave
from fmu_src.python.values import Rows, Values
from fmu_src.tables.wheelset import KEYWORDS, table
from models.wheelset.model import WheelsetModel
from models.wheelset.parameters import WheelsetParameters
from models.wheelset.ports import (
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


class WheelsetSlave(TableSlave):
    """One wheelset whose contact forces come from outside."""

    def __init__(self, guid: str, **kwargs: Any) -> None:
        super().__init__(table(), guid, **kwargs)
        self.model: WheelsetModel | None = None
        self.built_with: dict[str, Any] = {}

    def outputs(self, values: Values, step_size: float) -> Rows:
        """Advance the model with the forces held; without a step report where it starts."""
        model = self._model(values)
        if step_size > 0.0:
            for side in SIDES:
                model.set_forces(side, *(values[f"{side}.{name}"] for name in REACTION))
            model.set_irregularity(*(values[name] for name in IRREGULARITY))
            model.step(step_size)
        return _report(model)

    def memory(self) -> str | None:
        """What the model remembers besides its outputs."""
        return None if self.model is None else self.model.save().hex()

    def recall(self, memory: str | None) -> None:
        """Take the model back to a `memory`."""
        if memory is None:
            self.model = None
        else:
            self._model(self.values).restore(bytes.fromhex(memory))

    def _model(self, values: Values) -> WheelsetModel:
        """The model with these parameters: a new one, at its start, when they differ from those of the last."""
        wanted = {keyword: values[name] for name, keyword in KEYWORDS.items()}
        wanted |= {"substeps": values["resolution.substeps"], "inclination": values["rail.inclination"]}
        if self.model is None or wanted != self.built_with:
            keywords = wanted.copy()
            rail = profile.rail_60e1(keywords.pop("inclination"))
            self.model = WheelsetModel(WheelsetParameters(rail=rail, **keywords))
            self.built_with = wanted
        return self.model


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
