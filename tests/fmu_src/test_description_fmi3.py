"""modelDescription.xml of FMI 3.0, for every native FMU: properties that no installed validator checks."""

from xml.etree import ElementTree

import pytest

from contact_fmu.catalogue import models, surfaces
from contact_fmu.description_fmi3 import model_description, value_references
from contact_fmu.documentation import markdown
from contact_fmu.native.packaging import INTERFACES_3
from contact_fmu.rows import output, parameter
from contact_fmu.variables import Causality, Table

TABLES = [*(model.table for model in models(41)), surfaces().table]


@pytest.fixture(params=TABLES, ids=[table.name for table in TABLES])
def table(request):
    return request.param


@pytest.fixture
def xml(table):
    return ElementTree.fromstring(model_description(table, INTERFACES_3, "{token}"))


@pytest.fixture
def variables(xml):
    return {v.get("name"): v for v in xml.find("ModelVariables")}


def test_integers_are_written_as_integers(variables):
    for variable in variables.values():
        if variable.tag in ("Int64", "UInt64", "Enumeration"):
            assert all(word.isdigit() for a in ("min", "max", "start") for word in variable.get(a, "").split())


def test_value_references_are_those_of_fmi_2_and_each_is_of_one_variable(table, variables):
    references = {name: int(v.get("valueReference")) for name, v in variables.items()}
    hidden = {row.name for row in table.rows} - {row.name for row in table.shown}
    wanted = {name: reference for name, reference in value_references(table).items() if name not in hidden}
    assert list(references.values()) == list(wanted.values())
    for row in table.shown:
        assert table.scalars[references[row.element("")]].row is row


def test_dimensions_of_fields_are_structural_parameters(table, variables):
    structural = {v.get("valueReference") for v in variables.values() if v.get("causality") == "structuralParameter"}
    assert len(structural) == len(table.structural)
    named = {d.get("valueReference") for v in variables.values() for d in v.findall("Dimension")} - {None}
    assert named == structural
    for name in table.structural:
        assert variables[name].tag == "UInt64"


def test_outputs_depend_on_inputs_and_initial_values_on_parameters_too(table, xml, variables):
    knowns = {v.get("valueReference") for v in variables.values() if v.get("causality") == "input"}
    outputs = {v.get("valueReference") for v in variables.values() if v.get("causality") == "output"}
    assert {o.get("valueReference") for o in xml.findall("ModelStructure/Output")} == outputs
    for output_ in xml.findall("ModelStructure/Output"):
        assert set(output_.get("dependencies").split()) <= knowns
    parameters = {str(value_references(table)[r.name]) for r in table.rows if r.causality is Causality.PARAMETER}
    assert any(set(u.get("dependencies").split()) & parameters for u in xml.findall("ModelStructure/InitialUnknown"))


def test_the_same_table_gives_the_same_bytes_and_carries_the_token(table, xml):
    assert model_description(table, INTERFACES_3, "{a}") == model_description(table, INTERFACES_3, "{a}")
    assert xml.get("instantiationToken") == "{token}"


def test_fields_are_documented(table):
    text = markdown(table)
    assert all(
        f"| `{field.name}[1..4,1..resolution.n_strips,1..resolution.n_elements]` |" in text for field in table.fields
    )


def test_fields_of_two_shapes_are_refused():
    rows = [parameter("n", "Count", integer=True, start=3, minimum=1)]
    fields = [output("a", "One", shape=("n",)), output("b", "Other", shape=(2, "n"))]
    with pytest.raises(ValueError, match="fields must have the same shape"):
        Table("T", "Test", rows, 1e-3, fields)
