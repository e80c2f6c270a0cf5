"""An independent host: libcosim parses the description with FMI Library and drives the FMU from C++.

It runs in its own process, which unloads the FMU and ends. It prints a line for each load.
"""

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

execution = CosimExecution.from_step_size(step_size=1e6)  # ns
index = execution.add_local_slave(local_slave=CosimLocalSlave(fmu_path=sys.argv[1], instance_name="contact"))
reference = {v.name.decode(): v.reference for v in execution.slave_variables(index)}
execution.real_initial_value(index, reference["creepage.longitudinal"], 1e-3)
observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
execution.add_observer(observer=observer)
execution.add_manipulator(manipulator=manipulator)
outputs = [reference[name] for name in ("force.n", "force.x", "total.energy")]
for load in (80e3, 50e3):
    manipulator.slave_real_values(index, [reference["load.normal_force"]], [load])
    assert execution.step(step_count=2)
    print("result", *map(float.hex, observer.last_real_values(index, outputs)), flush=True)
