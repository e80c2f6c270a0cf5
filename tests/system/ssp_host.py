"""Run an SSP with libcosim: python ssp_host.py PATH STEP COUNT prints lateral position and yaw after each step."""

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver

path, step, count = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
execution = CosimExecution.from_ssp_file(path, step_size=round(step * 1e9))  # ns
observer = CosimObserver.create_last_value()
execution.add_observer(observer=observer)
(index,) = (slave.index for slave in execution.slave_infos() if slave.name.decode() == "wheelset")
reference = {v.name.decode(): v.reference for v in execution.slave_variables(index)}
for _ in range(count):
    assert execution.step(step_count=1)
    values = observer.last_real_values(index, [reference["lateral"], reference["yaw"]])
    print("result", *map(float.hex, values), flush=True)
