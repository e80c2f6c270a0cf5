"""Build systems of FMUs as one file (System Structure and Parameterization 1.0): a vehicle without contacts and a pair for each
wheel, of the included wheelset or of a scenario.

The structure is made from the tables of the FMUs, so connectors and units always agree with the FMUs. Parameters are bound in
the structure itself. Only the step size is not part of the standard: it is in annotations that libcosim and OMSimulator read.

Most masters of an SSP use the Jacobi scheme: every FMU steps with the values that were exchanged before the step. The contacts
are elastic, so late forces need short steps; a master that steps the pairs before the vehicle is not late
(`examples.coupled_vehicle`). libcosim exchanges outputs during initialisation until the inputs have followed. fmpy starts every
connector at 0: the wheelset then falls for two steps.

The file of the wheelset has a second structure, Connected.ssd: the same with connectors of the whole, so that it can be a part
of another system. libcosim 0.0.6 and Ecos 0.7.2 refuse such connections, so it is not the default.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from contact_models.runs.scenario import Scenario
from contact_models.vehicle.coupling import QUESTION
from contact_models.vehicle.declared import SIDES
from contact_models.wheelset import system as wheelset
from . import archive, starts
from .description import number, text_of
from .tables import open_vehicle, vehicle, wheel_rail_pair
from .tables.solver import NORMAL_METHOD, TANGENTIAL_METHOD
from .tables.wheel_rail_pair import LOAD_KIND, SIDE
from .units import BASE_UNITS, UNITS
from .variables import Causality, Kind, Table

NAME, VEHICLE = "coupled", "coupled_vehicle"
CONNECTED = "Connected.ssd"
STEP, STOP = 2e-5, 1.0  # [s]; a master that steps all FMUs at once is late (docs/use/own_vehicle.md)
_MOTION = tuple(f"body[2].{name}" for name in ("y", "yaw"))  # of a wheelset on its frame

_NAMESPACES = {
    "xmlns:ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "xmlns:ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "xmlns:ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    # declared here, since libcosim takes a declaration further down for an algorithm
    "xmlns:osp": "http://opensimulationplatform.com/SSP/OSPAnnotations",
    "xmlns:oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
}


@dataclass(frozen=True)
class SspComponent:
    """An FMU of the system: its name there and its parameter values."""

    name: str
    table: Table
    parameters: Mapping[str, float]


Connection = tuple[str, str, str, str]  # from element, connector, to element, connector


@dataclass(frozen=True)
class System:
    """FMUs and the connections between them; `step` is in s.

    `shown` are connectors that are not connected. `inputs` and `outputs` are those of the first FMU that the whole may offer.
    """

    name: str
    components: list[SspComponent]
    connections: list[Connection]
    shown: frozenset[str]
    step: float
    inputs: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()


def wheelset_on_rails() -> System:
    """Return the included wheelset with its two pairs."""
    axle = wheelset.scenario()
    its = starts.of_simulation(axle, wheelset.simulation(axle), 0.0)
    made = _on_rails(axle, open_vehicle.table(axle.declared.vehicle, its, "Wheelset"), its)
    return replace(made, name=NAME, inputs=tuple(row.name for row in vehicle.inputs()), outputs=("distance", *_MOTION))


def vehicle_on_rails(given: Scenario, start: float) -> System:
    """Return the vehicle of a scenario without contacts at the place `start` [m], and a pair for each wheel.

    The FMUs have the scenario's profiles and track; its speed at the start and its friction are parameters.
    """
    return _on_rails(given, open_vehicle.table(str(given.declared.vehicle)), starts.open_vehicle(given, start))


def _on_rails(given: Scenario, whole: Table, its: vehicle.Starts) -> System:
    declared, methods = given.vehicle, given.declared.methods
    parameters: dict[str, float] = {}
    for name, value in its:
        for k, one in enumerate(value if isinstance(value, tuple) else (value,), 1):
            parameters[f"{name}[{k}]" if isinstance(value, tuple) else name] = float(one)
    of_wheel = {
        "load.kind_integer": LOAD_KIND.number("Position"),
        "method.normal_integer": NORMAL_METHOD.number(methods.normal),
        "method.tangential_integer": TANGENTIAL_METHOD.number(methods.tangential),
        "resolution.n_strips": methods.strips,
        "resolution.n_elements": methods.elements,
        **vehicle.sizes(declared),
    }
    pair = wheel_rail_pair.table()
    names = [f"axle{axle}_{side}" for axle in range(1, len(declared.wheelsets) + 1) for side in SIDES]
    components, connections = [SspComponent("vehicle", whole, parameters)], []
    for k, name in enumerate(names):
        side = SIDE.number(SIDES[k % 2].title())
        components.append(SspComponent(name, pair, {"side_integer": side, **of_wheel}))
        connections += [("vehicle", f"wheel[{k + 1}].{ask}", name, ask) for ask in QUESTION]
        connections += [(name, answer, "vehicle", f"wheel[{k + 1}].{answer}") for answer in open_vehicle.ANSWER]
    outputs = ("wheel.Q", "wheel.Y", "wheel.Y_over_Q", "damage.T_gamma", "pressure.max", "power.friction")
    return System(VEHICLE, components, connections, frozenset(("distance", *_MOTION, *outputs)), STEP)


def build(folder: Path, made: System) -> Path:
    """Write `folder`/<name of the system>.ssp from the FMUs in `folder` and return its path."""
    files = {f"resources/{c.table.name}.fmu": (folder / f"{c.table.name}.fmu").read_bytes() for c in made.components}
    files["SystemStructure.ssd"] = structure(made).encode()
    if made.inputs:
        files[CONNECTED] = structure(made, connected=True).encode()
    return archive.write(folder / f"{made.name}.ssp", files.items())


def structure(made: System, *, connected: bool = False) -> str:
    """Return the text of a structure. If it is `connected`, the whole has the inputs and outputs of the system."""
    root = Element("ssd:SystemStructureDescription", {**_NAMESPACES, "version": "1.0", "name": made.name})
    system = SubElement(root, "ssd:System", name=made.name)
    first, inputs, outputs = made.components[0], made.inputs if connected else (), made.outputs if connected else ()
    if connected:
        connectors, row = SubElement(system, "ssd:Connectors"), {s.name: s for s in first.table.scalars}
        for kind, names in (("input", inputs), ("output", outputs)):
            for name in names:
                connector = SubElement(connectors, "ssd:Connector", name=name, kind=kind)
                SubElement(connector, "ssc:Real", unit=row[name].unit)
    _parameters(system, made)
    elements = SubElement(system, "ssd:Elements")
    used = set()
    for component in made.components:
        used |= _component(elements, component, made, inputs)
    lines = SubElement(system, "ssd:Connections")
    for a, output, b, input_ in made.connections:
        SubElement(lines, "ssd:Connection", startElement=a, startConnector=output, endElement=b, endConnector=input_)
    for name in inputs:
        SubElement(lines, "ssd:Connection", startConnector=name, endElement=first.name, endConnector=name)
    for name in outputs:
        SubElement(lines, "ssd:Connection", startElement=first.name, startConnector=name, endConnector=name)
    _master_of_omsimulator(system, made.step)
    _units(root, used)
    experiment = SubElement(root, "ssd:DefaultExperiment", startTime="0.0", stopTime=number(STOP))
    annotation = SubElement(
        SubElement(experiment, "ssd:Annotations"), "ssc:Annotation", type="com.opensimulationplatform"
    )
    algorithm = SubElement(annotation, "osp:Algorithm")
    SubElement(algorithm, "osp:FixedStepAlgorithm", baseStepSize=number(made.step))
    return text_of(root)


def _master_of_omsimulator(system: Element, step: float) -> None:
    """Add the master that OMSimulator uses with `step` [s]. Without it OMSimulator ends with an internal error."""
    annotation = SubElement(SubElement(system, "ssd:Annotations"), "ssc:Annotation", type="org.openmodelica")
    information = SubElement(SubElement(annotation, "oms:Annotations"), "oms:SimulationInformation")
    size, tolerance = number(step), "0.0001"  # the tolerance that OMSimulator writes itself
    attributes = {"stepSize": size, "absoluteTolerance": tolerance, "relativeTolerance": tolerance}
    SubElement(information, "oms:FixedStepMaster", {"description": "oms-ma", **attributes})


def _parameters(system: Element, made: System) -> None:
    binding = SubElement(SubElement(system, "ssd:ParameterBindings"), "ssd:ParameterBinding")
    values = SubElement(SubElement(binding, "ssd:ParameterValues"), "ssv:ParameterSet", version="1.0", name=made.name)
    parameters = SubElement(values, "ssv:Parameters")
    for component in made.components:
        of = {scalar.name: scalar for scalar in component.table.scalars}
        for name, value in component.parameters.items():
            parameter = SubElement(parameters, "ssv:Parameter", name=f"{component.name}.{name}")
            if of[name].row.kind is Kind.REAL:
                SubElement(parameter, "ssv:Real", value=number(value), unit=of[name].unit)
            else:
                SubElement(parameter, f"ssv:{of[name].row.kind}", value=str(int(value)))


def _component(elements: Element, component: SspComponent, made: System, inputs: tuple[str, ...]) -> set[str]:
    """Add the element of a component, with `inputs` among its connectors, and return the units of these."""
    shown = {end for a, output, b, input_ in made.connections for end in ((a, output), (b, input_))}
    shown |= {(component.name, name) for name in (*made.shown, *inputs)}
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
    return units | {
        s.unit for s in component.table.scalars if s.name in component.parameters and s.row.kind is Kind.REAL
    }


def _units(root: Element, used: set[str]) -> None:
    definitions = SubElement(root, "ssd:Units")
    for name, exponents in UNITS.items():
        if name in used:
            unit = SubElement(definitions, "ssc:Unit", name=name)
            base = {base: str(e) for base, e in zip(BASE_UNITS, exponents, strict=True) if e}
            SubElement(unit, "ssc:BaseUnit", base)
