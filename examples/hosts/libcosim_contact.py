"""libcosim: a tangential method by its number, as libcosim has no Enumerations. It reads FMUs by the FMI Library.

Usage: libcosim_contact.py FMU [METHOD [INPUT VALUE OUTPUT]]. The method 0 leaves the default.
"""

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

method = sys.argv[2] if len(sys.argv) > 2 else "0"
given, value, wanted = sys.argv[3:] or ("creepage.longitudinal", "1e-3", "force.x")
execution = CosimExecution.from_step_size(step_size=1e6)  # ns
contact = execution.add_local_slave(local_slave=CosimLocalSlave(fmu_path=sys.argv[1], instance_name="contact"))
reference = {v.name.decode(): v.reference for v in execution.slave_variables(contact)}
execution.real_initial_value(contact, reference[given], float(value))
execution.integer_initial_value(contact, reference["method.tangential_integer"], int(method))
observer = CosimObserver.create_last_value()
execution.add_observer(observer=observer)
assert execution.step(step_count=2)
values = observer.last_real_values(contact, [reference[name] for name in (wanted, "status_real")])
print(wanted, repr(values[0]))
print("status", repr(values[1]), flush=True)
