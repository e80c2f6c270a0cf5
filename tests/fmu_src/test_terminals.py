"""Terminals of the FMUs for FMI 3.0 follow its schema and group variables that exist."""

from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest

from contact_fmu.catalogue import models, surfaces
from contact_fmu.terminals import of_table, terminals

TABLES = {model.table.name: model.table for model in (*models(41, accumulation=True), surfaces())}
SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"


@pytest.mark.parametrize("name", TABLES)
def test_terminals_follow_the_schema_of_fmi_3(name):
    lxml = pytest.importorskip("lxml.etree", reason="THE SCHEMA IS NOT CHECKED: lxml is not installed")
    schema = lxml.XMLSchema(lxml.parse(str(SCHEMA)))
    schema.assertValid(lxml.fromstring(terminals(TABLES[name]).encode()))


@pytest.mark.parametrize("name", TABLES)
def test_members_are_variables(name):
    variables = {row.element("") for row in TABLES[name].rows}
    found = list(of_table(TABLES[name]))
    assert found
    for terminal in found:
        assert set(terminal.members.values()) <= variables
    root = ElementTree.fromstring(terminals(TABLES[name]))
    assert [t.get("name") for t in root.iter("Terminal")] == [t.name for t in found]


def test_terminals_that_are_connected_have_the_same_members():
    """The wheels of a vehicle ask what a pair takes, and take what it answers."""
    (wheels,) = of_table(TABLES["Wheelset"])
    pair = {row.element("") for row in TABLES["WheelRailPair"].rows}
    assert {"pose.y", "velocity.spin", "force.z", "moment.x"} <= set(wheels.members) <= pair
    (contact,), (small,) = (of_table(TABLES[name]) for name in ("WheelRailContact", "EllipticContact"))
    assert {"geometry.g", "load.normal_force", "force.x"} <= set(contact.members) > set(small.members)


def test_a_pair_has_terminals_for_its_wheelset_its_rail_and_its_patches():
    found = {terminal.name: terminal.members for terminal in of_table(TABLES["WheelRailPair"])}
    assert {"pose.y", "velocity.spin", "load.normal_force", "force.z", "moment.x"} <= set(found["wheelset"])
    assert {"irregularity.y", "irregularity.roll_rate"} <= set(found["rail"])
    assert {"patch.angle", "patch.pmax", "patches.count_real"} <= set(found["patches"])
    connectors = [row for row in TABLES["WheelRailPair"].rows if row.causality == "input"]
    grouped = {variable for members in found.values() for variable in members.values()}
    assert {row.name for row in connectors} - grouped == {"friction.coefficient"}  # not of a wheelset or a rail
