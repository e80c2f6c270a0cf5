"""PathSim: ten steps of an FMU with one input given. Usage: pathsim_contact.py FMU [INPUT VALUE OUTPUT]."""

import sys

from pathsim import Connection, Simulation
from pathsim.blocks import Source
from pathsim_fmi import CoSimulationFMU

given, value, wanted = sys.argv[2:] or ("creepage.longitudinal", "1e-3", "force.x")
contact = CoSimulationFMU(sys.argv[1], dt=1e-3)
fmu = contact.fmu_wrapper
source = Source(lambda t: float(value))
simulation = Simulation([source, contact], [Connection(source, contact[given])], dt=1e-3, log=False)
for port, name in enumerate(fmu.input_refs):  # PathSim starts every port at 0 instead of its start value
    contact.inputs[port] = float(fmu.variable_map[name].start)
simulation.run(0.01, reset=False)
print(wanted, repr(float(contact.outputs[list(fmu.output_refs).index(wanted)])))
