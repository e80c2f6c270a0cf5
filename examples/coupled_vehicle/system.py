"""Run coupled_vehicle.ssp: the vehicle without contacts and eight pairs, all as FMUs.

    contact fmu --packaging native --vehicle examples/scenarios/vehicle_300.toml
    python -m examples.coupled_vehicle.system dist/native/coupled_vehicle.ssp

In each step the pairs answer first, and then the vehicle moves with their answers. So nothing is late. The order is not part of
an SSP; a master that steps all FMUs at the same time needs steps ten times shorter (docs/use/own_vehicle.md).
"""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path
from types import TracebackType
from typing import Self

import fmpy
from fmpy.ssp.ssd import read_ssd

from contact_models.wheelset.fmu import Fmu

VEHICLE = "vehicle"  # moves last


class VehicleSystem:
    """The FMUs of coupled_vehicle.ssp. As a context manager it frees them."""

    def __init__(self, path: Path) -> None:
        system = read_ssd(str(path)).system
        self._folder = Path(fmpy.extract(str(path)))
        start: dict[str, dict[str, float]] = {element.name: {} for element in system.elements}
        for binding in system.parameterBindings:
            for parameter in binding.parameterValues[0].parameters:
                element, name = parameter.name.split(".", 1)
                start[element][name] = float(parameter.value)
        self.fmus = {
            each.name: Fmu(self._folder / each.source, start[each.name], name=each.name) for each in system.elements
        }
        self.time = 0.0
        self._order = sorted(self.fmus, key=lambda name: name == VEHICLE)
        self._lines: dict[str, list[tuple[Fmu, list[int], list[int]]]] = {name: [] for name in self.fmus}
        for to in self.fmus:
            for source in self.fmus:
                pairs = [
                    (c.startConnector, c.endConnector)
                    for c in system.connections
                    if (c.startElement, c.endElement) == (source, to)
                ]
                if pairs:
                    outputs, inputs = (list(names) for names in zip(*pairs, strict=True))
                    own = self.fmus[to].references(inputs)
                    self._lines[to].append((self.fmus[source], self.fmus[source].references(outputs), own))

    def step(self, h: float) -> None:
        """Advance all FMUs by `h` [s]: the pairs, then the vehicle."""
        for name in self._order:
            fmu = self.fmus[name]
            for source, outputs, inputs in self._lines[name]:
                fmu.set(inputs, source.get(outputs))
            fmu.step(self.time, h)
        self.time += h

    def get(self, element: str, name: str) -> float:
        """Return the value of an output."""
        fmu = self.fmus[element]
        return float(fmu.get(fmu.references([name]))[0])

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        for fmu in self.fmus.values():
            fmu.free()
        shutil.rmtree(self._folder, ignore_errors=True)


def main() -> None:
    """Print the lateral positions of the wheelsets and Y/Q of the first wheel."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("system", type=Path)
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--step", type=float, default=2e-4)
    arguments = parser.parse_args()
    with VehicleSystem(arguments.system) as system:
        axles = len({name.split("_")[0] for name in system.fmus if name != VEHICLE})
        for k in range(round(arguments.seconds / arguments.step)):
            system.step(arguments.step)
            if k % 500 == 499:
                y = [1e3 * system.get(VEHICLE, f"wheel[{2 * axle + 1}].pose.y") for axle in range(axles)]
                places = "  ".join(f"{each:7.3f}" for each in y)
                ratio = system.get("axle1_left", "wheel.Y_over_Q")
                print(f"{system.get(VEHICLE, 'distance'):8.2f} m  y {places} mm  Y/Q {ratio:.3f}")


if __name__ == "__main__":
    main()
