"""The model description made from a table, for every FMU of both packagings."""

import re
from importlib.metadata import version
from pathlib import Path
from xml.etree import ElementTree

import pytest

import contact
from contact_fmu.catalogue import models, surfaces
from contact_fmu.description import model_description
from contact_fmu.documentation import markdown
from contact_fmu.native.packaging import INTERFACES as NATIVE
from contact_fmu.python.packaging import INTERFACES
from contact_fmu.tables import solver, wheel_rail_contact
from contact_fmu.variables import Causality, Kind

TABLES = [*(model.table for points in (41, 4) for model in models(points)), surfaces().table]


@pytest.fixture(params=TABLES, ids=[f"{t.name}-{len(t.scalars)}" for t in TABLES])
def table(request):
    return request.param


@pytest.fixture(params=[INTERFACES, NATIVE], ids=["python", "native"])
def xml(request, table):
    return ElementTree.fromstring(model_description(table, request.param)[1])


def variables(xml):
    return xml.findall("ModelVariables/ScalarVariable")


def shown(table):
    return [(r, table.scalars[r]) for row in table.shown for r in table.references(row.name)]


def test_value_references_are_the_positions_of_the_whole_table(table, xml):
    assert [int(v.get("valueReference")) for v in variables(xml)] == [reference for reference, _ in shown(table)]


def test_starts_read_back_exactly(table, xml):
    for (_, scalar), variable in zip(shown(table), variables(xml), strict=True):
        if scalar.start is not None:
            assert float(variable[0].get("start")) == scalar.start, scalar.name


def test_declared_dependencies_exist(table):
    for row in table.shown:
        assert row.depends is None or table.hidden or {known.name for known in table.knowns(row)} >= set(row.depends), (
            row.name
        )


def test_every_unit_is_defined_with_the_dimension_that_its_name_says(xml):
    derived = {"N": "kg.m.s-2", "Pa": "kg.m-1.s-2", "J": "kg.m2.s-2", "W": "kg.m2.s-3"}

    def dimension(name):
        exponents = dict.fromkeys(("kg", "m", "s", "rad", "K"), 0)
        for sign, part in zip((1, -1), name.split("/"), strict=False):
            for symbol, power in re.findall(r"([A-Za-z]+)(-?\d*)", part.strip("()")):
                inner = re.findall(r"([A-Za-z]+)(-?\d*)", derived.get(symbol, symbol))
                for base, exponent in inner:
                    exponents[base] += sign * int(power or 1) * int(exponent or 1)
        return {base: e for base, e in exponents.items() if e}

    defined = {u.get("name"): u.find("BaseUnit").attrib for u in xml.findall("UnitDefinitions/Unit")}
    for name, exponents in defined.items():
        assert {base: int(e) for base, e in exponents.items()} == dimension(name), name
    assert {v[0].get("unit") for v in variables(xml) if v[0].tag == "Real"} == set(defined)


def test_inputs_and_parameters_precede_outputs_in_the_table(table):
    order = [row.causality for row in table.rows if row.causality is not Causality.LOCAL]
    assert order == sorted(order, key=[Causality.PARAMETER, Causality.INPUT, Causality.OUTPUT].index)


def test_it_names_authors_licence_and_version(xml):
    licence = (Path(__file__).parents[2] / "LICENSE").read_text()
    assert xml.get("copyright") in licence
    assert xml.get("author") in xml.get("copyright")
    assert xml.get("license").startswith(licence.split()[0])
    assert xml.get("version") == contact.__version__
    assert xml.get("generationTool") == f"wheelrail-contact {contact.__version__}"
    assert contact.__version__ == version("wheelrail-contact")


def test_every_input_and_output_is_a_real_and_every_choice_is_possible_by_number(table):
    """CasADi and CoFMUPy read every output as a Real, libcosim knows no Enumerations."""
    for row in table.rows:
        assert row.causality not in (Causality.INPUT, Causality.OUTPUT) or row.kind is Kind.REAL, row.name
        if row.kind is Kind.ENUMERATION and row.is_given:
            twin = table.row[f"{row.name}_integer"]
            assert (twin.start, twin.maximum, twin.kind) == (0, len(row.enumeration.items), Kind.INTEGER)
        if row.causality is Causality.LOCAL:
            assert table.row[f"{row.name}_real"].depends == row.depends


def test_guid_follows_the_content():
    guids = [model_description(wheel_rail_contact.table(n), INTERFACES)[0] for n in (41, 41, 42)]
    assert guids[0] == guids[1] != guids[2]
    assert model_description(wheel_rail_contact.table(41), {"CoSimulation": {}})[0] != guids[0]


def test_status_and_methods_are_the_solvers():
    assert [solver.STATUS.number(n) for n in ("OK", "NoContact", "OutOfRange")] == [
        contact.Status.OK,
        contact.Status.NO_CONTACT,
        contact.Status.OUT_OF_RANGE,
    ]
    assert len(solver.STATUS.items) == len(contact.Status)
    assert [name for name, _ in solver.NORMAL_METHOD.items] == list(contact.methods().batched.normal)
    assert [name for name, _ in solver.TANGENTIAL_METHOD.items] == list(contact.methods().batched.tangential)


def test_documentation_has_a_line_for_every_row(table):
    lines = markdown(table).splitlines()
    for row in table.shown:
        name = re.escape(row.name).replace(r"\[\]", r"\[[\d.,]+\]")
        pattern = re.compile(rf"\| `{name}(\[[\d.,]+\])?` \|")
        assert sum(bool(pattern.match(line)) for line in lines) == 1, row.name
    assert all(line.replace(r"\|", "").count("|") == 7 for line in lines if line.startswith("|"))


def test_the_script_for_simulink_connects_the_inputs_in_their_order_with_their_starts():
    """No MATLAB is at hand, so what the script says of the FMU is compared with the description."""
    script = (Path(__file__).parents[2] / "examples" / "hosts" / "simulink_contact.m").read_text()
    (small,) = (table for table in TABLES[: len(models(41))] if table.name == "EllipticContact")
    inputs = [row for row in small.shown if row.causality is Causality.INPUT]
    names, starts = (
        re.findall(r"'([^']*)'", re.search(rf"{word} = \{{(.*)\}}", script)[1]) for word in ("names", "starts")
    )
    assert len(names) == len(inputs)
    assert all(name in row.name for name, row in zip(names, inputs, strict=True))
    assert [float(start) for start in starts] == pytest.approx([row.start for row in inputs])
    outputs = [row.name for row in small.shown if row.causality is Causality.OUTPUT]
    assert outputs[0] == "force.x"
