"""The contact of one wheel, in Python or in the FMU `WheelRailPair`."""

from __future__ import annotations

import shutil
from dataclasses import astuple
from pathlib import Path
from types import TracebackType
from typing import Self

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Model, FMU2Slave

from contact.arrays import Array
from contact.geometry.wheelset import Irregularity, Pose, Velocity
from contact.pair import WheelRailPair
from contact_models.vehicle.coupling import QUESTION

_PATCHES = 3
_WRENCH = tuple(f"{kind}.{axis}" for kind in ("force", "moment") for axis in "xyz")
_PATCH = ("n", "fx", "fy", "mz", "longitudinal", "lateral", "spin", "approach")
_ELASTIC = 0.4  # of normal force times approach is stored, exact for an elliptic patch


def _answer(wrench: Array, patches: Array) -> Array:
    """Return the answer from the wrench and the values `_PATCH` of each patch."""
    n, fx, fy, mz, longitudinal, lateral, spin, approach = patches.T
    dissipation = -float(np.sum(fx * longitudinal + fy * lateral + mz * spin))
    return np.array([*wrench, n.sum(), dissipation, _ELASTIC * float(np.dot(n, approach))])


class InPython:
    """A `contact.pair.WheelRailPair`."""

    def __init__(self, pair: WheelRailPair) -> None:
        self._pair = pair

    def answer(self, question: Array, time: float, step: float) -> Array:
        y, z, roll, yaw, *rest = question.tolist()
        velocity, irregularity, friction = Velocity(*rest[:6]), Irregularity(*rest[6:12]), rest[12]
        found = self._pair.solve(Pose(y, z, roll, yaw), velocity, irregularity=irregularity, friction=friction)
        rows = [(c.N, c.Fx, c.Fy, c.Mz, *astuple(c.creepage), c.approach) for c in found.contacts]
        return _answer(np.concatenate((found.force, found.moment)), np.array(rows).reshape(-1, len(_PATCH)))


class InFmu:
    """A native FMU `WheelRailPair`, driven by fmpy. As a context manager it frees the FMU.

    Parameters
    ----------
    fmu : Path
    side : {"right", "left"}
    start : dict
        Names and values of parameters; of Enumerations the names of their items.
    co_simulation : bool
        Step the FMU: its outputs after a step belong to the inputs before it. Otherwise model exchange: they belong to the
        inputs at once. Here both give the same answer, since the vehicle moves only after it has been given.
    """

    def __init__(self, fmu: Path, side: str, start: dict[str, float | str], *, co_simulation: bool = False) -> None:
        description = fmpy.read_model_description(str(fmu))
        variables = {v.name: v for v in description.modelVariables}
        self._folder = fmpy.extract(str(fmu))
        kind, about = (FMU2Slave, description.coSimulation) if co_simulation else (FMU2Model, description.modelExchange)
        self._fmu = kind(
            guid=description.guid, unzipDirectory=self._folder, instanceName=side, modelIdentifier=about.modelIdentifier
        )
        self._steps = co_simulation
        self._inputs = [variables[name].valueReference for name in QUESTION]
        names = (*_WRENCH, *(f"patch[{k}].{name}" for k in range(1, _PATCHES + 1) for name in _PATCH))
        self._outputs = [variables[name].valueReference for name in names]
        self._fmu.instantiate()
        self._fmu.setupExperiment(startTime=0.0)
        for name, value in ({"load.kind": "Position", "side": side.title()} | start).items():
            variable = variables[name]
            if isinstance(value, str):
                items = {item.name: item.value for item in variable.declaredType.items}
                self._fmu.setInteger([variable.valueReference], [int(items[value])])
            elif variable.type == "Integer":
                self._fmu.setInteger([variable.valueReference], [int(value)])
            else:
                self._fmu.setReal([variable.valueReference], [value])
        self._fmu.enterInitializationMode()
        self._fmu.exitInitializationMode()
        if not co_simulation:
            self._fmu.newDiscreteStates()
            self._fmu.enterContinuousTimeMode()

    def answer(self, question: Array, time: float, step: float) -> Array:
        self._fmu.setReal(self._inputs, question.tolist())
        if self._steps:
            self._fmu.doStep(time, step)
        else:
            self._fmu.setTime(time)
        values = np.array(self._fmu.getReal(self._outputs))
        return _answer(values[:6], values[6:].reshape(_PATCHES, len(_PATCH)))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._fmu.terminate()
        self._fmu.freeInstance()
        shutil.rmtree(self._folder, ignore_errors=True)
