"""CoFMUPy: two contacts, the second under the normal force of the first. Usage: cofmupy_contact.py FMU."""

import json
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree
from zipfile import ZipFile

from cofmupy import Coordinator

description = ElementTree.fromstring(ZipFile(sys.argv[1]).read("modelDescription.xml"))
inputs = [v for v in description.iter("ScalarVariable") if v.get("causality") == "input"]
# CoFMUPy starts every input at 0 instead of its start value
starts = {v.get("name"): float(v[0].get("start")) for v in inputs} | {"creepage.longitudinal": 1e-3}
system = {
    "fmus": [
        {"id": name, "path": str(Path(sys.argv[1]).resolve()), "initialization": starts} for name in ("one", "two")
    ],
    "connections": [
        {"source": {"id": "one", "variable": "force.n"}, "target": {"id": "two", "variable": "load.normal_force"}}
    ],
    "cosim_method": "jacobi",
    "edge_sep": " -> ",
    "root": "",
}
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "system.json"
    path.write_text(json.dumps(system))
    coordinator = Coordinator()
    coordinator.start(str(path))
    for _ in range(3):
        coordinator.do_step(1e-3)
    print("force.x", repr(float(coordinator.get_variable(("two", "force.x"))[-1])))
