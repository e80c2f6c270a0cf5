"""PathSim: the creep force of the FMU for a given creepage. Usage: pathsim_contact.py FMU."""

import sys

from pathsim import Connection, Simulation
from pathsim.blocks import Source
from pathsim_fmi import CoSimulationFMU

contact = CoSimulationFMU(sys.argv[1], dt=1e-3)
fmu = contact.fmu_wrapper
creepage = Source(lambda t: 1e-3)
simulation = Simulation(
    [creepage, contact], [Connection(creepage, contact["creepage.longitudinal"])], dt=1e-3, log=False
)
for port, name in enumerate(fmu.input_refs):  # PathSim starts every port at 0 instead of its start value
    contact.inputs[port] = float(fmu.variable_map[name].start)
simulation.run(0.01, reset=False)
print("force.x", repr(float(contact.outputs[list(fmu.output_refs).index("force.x")])))
