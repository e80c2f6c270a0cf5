"""PathSim: the coupled wheelset from its SSP as three blocks. Usage: pathsim_coupled.py SSP [STEP STEPS]."""

import sys
import tempfile

from pathsim import Connection, Simulation
from pathsim_fmi import CoSimulationFMU
from structure import read

ssp, step, steps = sys.argv[1], *(sys.argv[2:] or ("2e-5", "60"))
h = float(step)
with tempfile.TemporaryDirectory() as folder:
    paths, parameters, connections = read(ssp, folder)
    blocks = {name: CoSimulationFMU(path, name, parameters[name], dt=h) for name, path in paths.items()}
    lines = [Connection(blocks[a][output], blocks[b][input_]) for a, output, b, input_ in connections]
    simulation = Simulation(list(blocks.values()), lines, dt=h, log=False)
    for block in blocks.values():  # PathSim starts every port at 0 instead of its start value
        for port, name in enumerate(block.fmu_wrapper.input_refs):
            block.inputs[port] = float(block.fmu_wrapper.variable_map[name].start)
    vehicle = blocks["vehicle"]
    lateral = list(vehicle.fmu_wrapper.output_refs).index("wheel[1].pose.y")
    for _ in range(int(steps)):
        simulation.timestep(h)
        print("lateral", repr(float(vehicle.outputs[lateral])))
