"""Read a system of FMUs (SSP 1.0) for hosts that do not: its FMUs, their parameters and the connections."""

import zipfile
from pathlib import Path
from xml.etree import ElementTree

_SPACES = {
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
}


def read(ssp, folder):
    """Unzip the system into `folder`. Return component → path, component → {parameter: value}, and connections.

    A connection is (component, output, component, input). Parameters are numbers.
    """
    with zipfile.ZipFile(ssp) as archive:
        archive.extractall(folder)
    root = ElementTree.parse(Path(folder) / "SystemStructure.ssd").getroot()
    paths = {e.get("name"): str(Path(folder) / e.get("source")) for e in root.iterfind(".//ssd:Component", _SPACES)}
    parameters = {name: {} for name in paths}
    for parameter in root.iterfind(".//ssv:Parameter", _SPACES):
        component, _, name = parameter.get("name").partition(".")
        parameters[component][name] = float(parameter[0].get("value"))
    ends = ("startElement", "startConnector", "endElement", "endConnector")
    connections = [tuple(c.get(end) for end in ends) for c in root.iterfind(".//ssd:Connection", _SPACES)]
    return paths, parameters, connections
