"""What Simulink's documentation says of imported FMUs, as far as modelDescription.xml shows it (docs/use/fmu/simulink.md)."""

import re
from xml.etree import ElementTree

import pytest

from contact_fmu.catalogue import models, surfaces, vehicles
from contact_fmu.description import model_description
from contact_fmu.native.packaging import INTERFACES
from contact_fmu.tables.wheel_rail_contact import POINTS
from reference.native import SCENARIO

#: Words that cannot name an element of a bus in MATLAB, and the longest name.
KEYWORDS = {
    *("break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function", "global", "if"),
    *("otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while"),
}
LONGEST = 63


@pytest.fixture(scope="module")
def roots():
    """Return the description of every FMU by its name."""
    found = {}
    for model in (*models(POINTS), *vehicles(SCENARIO), surfaces()):
        component = model.component
        interfaces = {k: v for k, v in INTERFACES.items() if component.exchange or k == "CoSimulation"}
        found[component.table.name] = ElementTree.fromstring(
            model_description(component.table, interfaces)[1].encode("utf-8")
        )
    return found


def variables(roots):
    for root in roots.values():
        yield from root.find("ModelVariables")


def groups_and_elements(names):
    """Return the buses and the elements that structured names make: `pose.y` is element y of bus pose."""
    names = [re.sub(r"\[[\d,]+\]", "", name) for name in names]
    groups = {".".join(name.split(".")[:k]) for name in names for k in range(1, name.count(".") + 1)}
    return groups, set(names)


def test_names_make_buses(roots):
    """Each part is a MATLAB identifier, and no signal has the name of a bus."""
    for root in roots.values():
        assert root.get("variableNamingConvention") == "structured"
        names = [v.get("name") for v in root.find("ModelVariables")]
        groups, elements = groups_and_elements(names)
        assert not groups & elements
        for part in {part for name in elements for part in name.split(".")}:
            assert re.fullmatch(r"[A-Za-z]\w*", part, re.ASCII), part
            assert len(part) <= LONGEST
            assert part not in KEYWORDS
    groups, _ = groups_and_elements(v.get("name") for v in roots["WheelRailPair"].find("ModelVariables"))
    assert {"pose", "velocity", "force", "moment", "patch"} <= groups


def test_parameters_of_the_mask_have_a_start(roots):
    """It is the default of the edit field or of the list. Integers fit 32 bits, and there are no Booleans and no texts."""
    for variable in variables(roots):
        kind = variable[0]
        assert kind.tag in ("Real", "Integer", "Enumeration")
        if variable.get("causality") == "parameter":
            start = kind.get("start")
            assert start is not None
            if kind.tag != "Real":
                assert abs(int(start)) < 2**31


def test_states_are_saved_for_fast_restart_and_the_stepper(roots):
    for root in roots.values():
        for kind in root.iter():
            if kind.tag in ("ModelExchange", "CoSimulation"):
                assert kind.get("canGetAndSetFMUstate") == kind.get("canSerializeFMUstate") == "true"
                assert kind.get("providesDirectionalDerivative") == "true"  # the solver's Jacobian
                assert re.fullmatch(r"[A-Za-z]\w*", kind.get("modelIdentifier"), re.ASCII)
