"""Build the coupled wheelset as one file (System Structure and Parameterization 1.0): the wheelset and its two contacts.

The structure is made from the tables of the FMUs, so connectors and units always agree with the FMUs. Parameters are bound in
the structure itself. Only the step size is not part of the standard: it is in an annotation that libcosim reads.

Most masters of an SSP use the Jacobi scheme: every FMU steps with the values that were exchanged before the step. They differ
in the first step. libcosim exchanges outputs during initialisation until the inputs have followed. fmpy starts every connector
at 0. The contacts then see no load, so there is no contact, and the wheelset runs without creep forces for two steps.

A second structure in the file, Connected.ssd, is the same with connectors of the whole, so that it can be a part of another
system. libcosim 0.0.6 and Ecos 0.7.2 refuse such connections, so it is not the default.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import fmpy

from fmu_src import archive
from fmu_src.description import number
from fmu_src.tables import wheel_rail_contact, wheelset
from fmu_src.units import BASE_UNITS, UNITS
from fmu_src.variables import Causality, Kind, Table
from models.wheelset.parameters import WheelsetParameters
from models.wheelset.ports import ENERGY, IRREGULARITY, MOTION, POINTS, PROBLEM, REACTION, REPORT, SIDES

NAME = "coupled"
CONNECTED = "Connected.ssd"
STEP, STOP = 1e-4, 1.0  # [s]; at 28 m/s the Jacobi scheme is stable up to 0.67 ms (docs/coupling.md)

_NAMESPACES = {
    "xmlns:ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "xmlns:ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "xmlns:ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    # declared here, since libcosim takes a declaration further down for an algorithm
    "xmlns:osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
}


@dataclass(frozen=True)
class Component:
    """An FMU of the system: its name there and its parameter values."""

    name: str
    table: Table
    parameters: Mapping[str, float]


Connection = tuple[str, str, str, str]  # from element, connector, to element, connector


def wheelset_on_rails(parameters: WheelsetParameters) -> tuple[list[Component], list[Connection]]:
    """Return the wheelset with its two contacts, and the connections between them."""
    p = parameters
    contact = {"speed": p.speed, "wheel.radius": p.radius}
    components = [
        Component(
            "wheelset", wheelset.table(), {name: float(getattr(p, key)) for name, key in wheelset.KEYWORDS.items()}
        ),
        *(Component(side, wheel_rail_contact.table(POINTS), contact) for side in SIDES),
    ]
    connections: list[Connection] = []
    for side in SIDES:
        connections += [("wheelset", f"{side}.{name}", side, name) for name in PROBLEM]
        connections += [(side, name, "wheelset", f"{side}.{name}") for name in REACTION]
    return components, connections


def obstacle(folder: Path) -> str:
    """Return the reason why the FMUs in `folder` cannot form this system, or "" if they can.

    The contact must take as many samples as the wheelset gives.
    """
    components, _ = wheelset_on_rails(WheelsetParameters())
    for table in (c.table for c in components):
        path = folder / f"{table.name}.fmu"
        if not path.is_file():
            return f"{path} is missing"
        if _inputs(path) != {s.name for s in table.scalars if s.row.causality is Causality.INPUT}:
            return f"{path.name} does not take the {POINTS} samples of a separation that Wheelset.fmu gives (--points)"
    return ""


def _inputs(fmu: Path) -> set[str]:
    return {v.name for v in fmpy.read_model_description(str(fmu)).modelVariables if v.causality == "input"}


def build(folder: Path, parameters: WheelsetParameters | None = None) -> Path:
    """Write `folder`/coupled.ssp from the FMUs in `folder` and return its path.

    Parameters
    ----------
    parameters : WheelsetParameters, optional
        Parameters of the wheelset. The profiles are those of the FMU.
    """
    components, connections = wheelset_on_rails(parameters or WheelsetParameters())
    files = {f"resources/{c.table.name}.fmu": (folder / f"{c.table.name}.fmu").read_bytes() for c in components}
    files["SystemStructure.ssd"] = structure(components, connections).encode()
    files[CONNECTED] = structure(components, connections, connected=True).encode()
    return archive.write(folder / f"{NAME}.ssp", files.items())


def structure(components: list[Component], connections: list[Connection], *, connected: bool = False) -> str:
    """Return the text of a structure. If it is `connected`, the whole has connectors: irregularity in, motion out."""
    root = Element("ssd:SystemStructureDescription", {**_NAMESPACES, "version": "1.0", "name": NAME})
    system = SubElement(root, "ssd:System", name=NAME)
    wheelset = components[0]
    if connected:
        _connectors(system, wheelset)
    _parameters(system, components)
    elements = SubElement(system, "ssd:Elements")
    used = set()
    for component in components:
        used |= _component(elements, component, connections, IRREGULARITY if connected else ())
    lines = SubElement(system, "ssd:Connections")
    for a, output, b, input_ in connections:
        SubElement(lines, "ssd:Connection", startElement=a, startConnector=output, endElement=b, endConnector=input_)
    for name in IRREGULARITY if connected else ():
        SubElement(lines, "ssd:Connection", startConnector=name, endElement=wheelset.name, endConnector=name)
    for name in MOTION if connected else ():
        SubElement(lines, "ssd:Connection", startElement=wheelset.name, startConnector=name, endConnector=name)
    _units(root, used)
    experiment = SubElement(root, "ssd:DefaultExperiment", startTime="0.0", stopTime=number(STOP))
    annotation = SubElement(
        SubElement(experiment, "ssd:Annotations"), "ssc:Annotation", type="com.opensimulationplatform"
    )
    algorithm = SubElement(annotation, "osp:Algorithm")
    SubElement(algorithm, "osp:FixedStepAlgorithm", baseStepSize=number(STEP))
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def _connectors(system: Element, wheelset: Component) -> None:
    """Add the connectors of the whole: the track's irregularity is its input, the wheelset's motion its output."""
    connectors = SubElement(system, "ssd:Connectors")
    for kind, names in (("input", IRREGULARITY), ("output", MOTION)):
        for name in names:
            connector = SubElement(connectors, "ssd:Connector", name=name, kind=kind)
            SubElement(connector, "ssc:Real", unit=_unit(wheelset, name))


def _parameters(system: Element, components: Iterable[Component]) -> None:
    binding = SubElement(SubElement(system, "ssd:ParameterBindings"), "ssd:ParameterBinding")
    values = SubElement(SubElement(binding, "ssd:ParameterValues"), "ssv:ParameterSet", version="1.0", name=NAME)
    parameters = SubElement(values, "ssv:Parameters")
    for component in components:
        for name, value in component.parameters.items():
            parameter = SubElement(parameters, "ssv:Parameter", name=f"{component.name}.{name}")
            SubElement(parameter, "ssv:Real", value=number(value), unit=_unit(component, name))


def _unit(component: Component, name: str) -> str:
    """Return the unit of a scalar row."""
    return component.table.scalars[component.table.span[name].start].unit


def _component(
    elements: Element, component: Component, connections: Iterable[Connection], others: Iterable[str]
) -> set[str]:
    """Add the element of a component, with `others` among its connectors, and return the units of these."""
    shown = {end for a, output, b, input_ in connections for end in ((a, output), (b, input_))}
    shown |= {(component.name, name) for name in itertools.chain(MOTION, ENERGY, REPORT, others)}
    attributes = {"type": "application/x-fmu-sharedlibrary", "implementation": "CoSimulation"}
    source = f"resources/{component.table.name}.fmu"
    element = SubElement(elements, "ssd:Component", {"name": component.name, "source": source, **attributes})
    connectors = SubElement(element, "ssd:Connectors")
    units = set()
    for scalar in component.table.scalars:
        if (component.name, scalar.name) in shown and scalar.row.kind is Kind.REAL:
            kind = "output" if scalar.row.causality is Causality.OUTPUT else "input"
            connector = SubElement(connectors, "ssd:Connector", name=scalar.name, kind=kind)
            SubElement(connector, "ssc:Real", unit=scalar.unit)
            units.add(scalar.unit)
    return units | {_unit(component, name) for name in component.parameters}


def _units(root: Element, used: set[str]) -> None:
    definitions = SubElement(root, "ssd:Units")
    for name, exponents in UNITS.items():
        if name in used:
            unit = SubElement(definitions, "ssc:Unit", name=name)
            base = {base: str(e) for base, e in zip(BASE_UNITS, exponents, strict=True) if e}
            SubElement(unit, "ssc:BaseUnit", base)
