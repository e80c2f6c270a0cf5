"""libcosim: another tangential method by its number, since libcosim knows no Enumerations. Usage: libcosim_contact.py FMU."""

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

execution = CosimExecution.from_step_size(step_size=1e6)  # ns
contact = execution.add_local_slave(local_slave=CosimLocalSlave(fmu_path=sys.argv[1], instance_name="contact"))
reference = {v.name.decode(): v.reference for v in execution.slave_variables(contact)}
execution.real_initial_value(contact, reference["creepage.longitudinal"], 1e-3)
if len(sys.argv) > 2:
    execution.integer_initial_value(contact, reference["method.tangential_integer"], int(sys.argv[2]))
observer = CosimObserver.create_last_value()
execution.add_observer(observer=observer)
assert execution.step(step_count=2)
values = observer.last_real_values(contact, [reference[name] for name in ("force.x", "status_real")])
print("force.x", repr(values[0]))
print("status", repr(values[1]), flush=True)
