"""Run an SSP with libcosim: python ssp_host.py PATH STEP COUNT prints lateral position and yaw after each step.

libcosim 0.0.6 takes no Integer parameter from an SSP, without a word, so they are set here.
"""

import sys
import tempfile
from pathlib import Path

from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver

sys.path.insert(0, str(Path(__file__).parents[2] / "examples" / "hosts"))
from structure import read

path, step, count = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
execution = CosimExecution.from_ssp_file(path, step_size=round(step * 1e9))  # ns
observer = CosimObserver.create_last_value()
execution.add_observer(observer=observer)
with tempfile.TemporaryDirectory() as folder:
    _, parameters, _ = read(path, folder)
for slave in execution.slave_infos():
    given = parameters[slave.name.decode()]
    for variable in execution.slave_variables(slave.index):
        name = variable.name.decode()
        if name in given and variable.type == CosimVariableType.INTEGER.value:
            execution.integer_initial_value(slave.index, variable.reference, int(given[name]))
(index,) = (slave.index for slave in execution.slave_infos() if slave.name.decode() == "vehicle")
reference = {v.name.decode(): v.reference for v in execution.slave_variables(index)}
for _ in range(count):
    assert execution.step(step_count=1)
    values = observer.last_real_values(index, [reference["body[2].y"], reference["body[2].yaw"]])
    print("result", *map(float.hex, values), flush=True)
