"""Our own rules for FMUs: each finds a fault that fmpy and the schema do not find. A description without faults passes."""

import re
from zipfile import ZipFile

import pytest

from contact_fmu import lint
from contact_fmu.lint import files, structure, variables

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="M" guid="{123}" variableNamingConvention="structured">
  <CoSimulation modelIdentifier="M" canGetAndSetFMUstate="true" canSerializeFMUstate="true"/>
  <UnitDefinitions><Unit name="m"><BaseUnit m="1"/></Unit><Unit name="m/s"><BaseUnit m="1" s="-1"/></Unit></UnitDefinitions>
  <TypeDefinitions><SimpleType name="T"><Enumeration><Item name="A" value="1"/><Item name="B" value="2"/></Enumeration>
  </SimpleType></TypeDefinitions>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.1"/>
  <ModelVariables>
    <ScalarVariable name="mode" valueReference="0" causality="parameter" variability="fixed" initial="exact">
      <Enumeration declaredType="T" start="1"/></ScalarVariable>
    <ScalarVariable name="u[1].x" valueReference="1" causality="input" variability="continuous">
      <Real unit="m" min="0" max="9" nominal="2" start="4"/></ScalarVariable>
    <ScalarVariable name="u[2].x" valueReference="2" causality="input" variability="continuous">
      <Real unit="m" start="0"/></ScalarVariable>
    <ScalarVariable name="x" valueReference="3" causality="output" variability="continuous" initial="exact">
      <Real unit="m" start="0"/></ScalarVariable>
    <ScalarVariable name="der(x)" valueReference="4" causality="output" variability="continuous" initial="calculated">
      <Real unit="m/s" derivative="4"/></ScalarVariable>
    <ScalarVariable name="n" valueReference="5" causality="output" variability="discrete" initial="calculated">
      <Integer min="0"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="4" dependencies=""/><Unknown index="5" dependencies="2 3 4"/>
      <Unknown index="6" dependencies="2" dependenciesKind="dependent"/></Outputs>
    <Derivatives><Unknown index="5" dependencies="2 3 4"/></Derivatives>
    <InitialUnknowns><Unknown index="5" dependencies="1 2 3 4"/><Unknown index="6" dependencies="2"/></InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
"""
#: In place of a rule: what fmpy or the schema of FMI finds.
FMPY = None
FAULTS = [  # rule, replaced text, new text
    (FMPY, r"(<Unit.*)(<TypeDef.*</TypeDefinitions>)", r"\2\1"),
    (FMPY, 'name="n"', 'name="n-1"'),
    (FMPY, 'name="n"', 'name="n[1"'),
    (FMPY, 'name="n"', 'name="x"'),
    (variables.arrays_are_whole, r"u\[2\]", "u[3]"),
    (variables.arrays_are_whole, r"u\[([12])\]", lambda m: f"u[{int(m[1]) - 1}]"),
    (variables.arrays_are_whole, r"u\[([12])\]", lambda m: f"u[{3 - int(m[1])}]"),
    (variables.arrays_are_whole, r"u\[2\]", "u[2,1]"),
    (variables.references_are_unique, 'valueReference="5"', 'valueReference="0"'),
    (FMPY, 'variability="fixed" ', ""),
    (FMPY, 'variability="fixed"', 'variability="discrete"'),
    (FMPY, 'variability="discrete"', 'variability="continuous"'),
    (variables.starts_are_given, ' start="4"', ""),
    (variables.starts_are_given, '<Integer min="0"', '<Integer min="0" start="0"'),
    (variables.starts_are_given, 'causality="input"', 'causality="input" initial="exact"'),
    (variables.numbers_are_within_range, 'start="4"', 'start="-1"'),
    (variables.numbers_are_within_range, 'start="4"', 'start="9.5"'),
    (variables.numbers_are_within_range, 'start="4"', 'start="nan"'),
    (variables.numbers_are_within_range, 'max="9"', 'max="inf"'),
    (variables.numbers_are_within_range, 'nominal="2"', 'nominal="0"'),
    (variables.units_are_defined, '<Unit name="m"><BaseUnit m="1"/></Unit>', ""),
    (variables.units_are_defined, '<BaseUnit m="1"/>', ""),
    (variables.units_are_defined, 's="-1"', 's="-1.5"'),
    (variables.units_are_defined, 's="-1"', 'min="-1"'),
    (variables.units_are_defined, 'unit="m" start="0"', 'start="0"'),
    (variables.types_are_declared, 'declaredType="T"', 'declaredType="U"'),
    (variables.types_are_declared, 'declaredType="T"', ""),
    (variables.types_are_declared, '<Integer min="0"', '<Integer declaredType="T" min="0"'),
    (variables.types_are_declared, 'declaredType="T" start="1"', 'declaredType="T" start="3"'),
    (variables.types_are_declared, 'value="2"', 'value="1"'),
    (structure.structure_is_complete, '<Unknown index="4" dependencies=""/>', ""),
    (structure.structure_is_complete, r"(<InitialUnknowns>)(<[^>]*>)(<[^>]*>)", r"\1\3\2"),
    (structure.structure_is_complete, r"<Derivatives>.*</Derivatives>", ""),
    (structure.structure_is_complete, 'derivative="4"', 'derivative="6"'),
    (structure.structure_is_complete, 'derivative="4"', 'derivative="7"'),
    (structure.dependencies_are_known, '(Outputs>.*)dependencies="2 3 4"', r'\1dependencies="1 2 3 4"'),
    (structure.dependencies_are_known, 'dependencies="1 2 3 4"', 'dependencies="1 2 3 6"'),
    (structure.dependencies_are_known, 'dependencies="1 2 3 4"', 'dependencies="1 2 2 3"'),
    (structure.dependencies_are_known, 'dependenciesKind="dependent"', 'dependenciesKind="dependent dependent"'),
    (structure.capabilities_are_consistent, 'canGetAndSetFMUstate="true"', ""),
    (structure.capabilities_are_consistent, 'modelIdentifier="M"', 'modelIdentifier="M-1"'),
    (structure.capabilities_are_consistent, "<CoSimulation.*?/>", ""),
    (structure.experiment_is_one, 'stopTime="1"', 'stopTime="0"'),
    (structure.experiment_is_one, 'stepSize="0.1"', 'stepSize="0"'),
]


DESCRIPTION_3 = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="M" instantiationToken="{123}" variableNamingConvention="structured">
  <CoSimulation modelIdentifier="M" canGetAndSetFMUState="true" canSerializeFMUState="true"/>
  <UnitDefinitions><Unit name="m"><BaseUnit m="1"/></Unit><Unit name="m/s"><BaseUnit m="1" s="-1"/></Unit>
  <Unit name="s"><BaseUnit s="1"/></Unit></UnitDefinitions>
  <TypeDefinitions><EnumerationType name="T"><Item name="A" value="1"/><Item name="B" value="2"/></EnumerationType>
  </TypeDefinitions>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.1"/>
  <ModelVariables>
    <Float64 name="time" valueReference="10" causality="independent" variability="continuous" unit="s"/>
    <UInt64 name="size" valueReference="9" causality="structuralParameter" variability="fixed" start="2"/>
    <Enumeration name="mode" valueReference="0" causality="parameter" variability="fixed" declaredType="T" start="1"/>
    <Float64 name="u" valueReference="1" causality="input" unit="m" min="0" max="9" start="4 5">
      <Dimension valueReference="9"/></Float64>
    <Float64 name="x" valueReference="3" causality="output" unit="m" initial="exact" start="0"/>
    <Float64 name="der(x)" valueReference="4" causality="output" unit="m/s" derivative="3"/>
    <Float64 name="K" valueReference="6" causality="output"><Dimension start="2"/></Float64>
    <Int64 name="n" valueReference="5" causality="output" min="0"/>
    <Float64 name="a" valueReference="7" unit="m"/><Float64 name="b" valueReference="8" unit="m"/>
  </ModelVariables>
  <ModelStructure>
    <Output valueReference="3" dependencies=""/><Output valueReference="4" dependencies="1 3"/><Output valueReference="6"/>
    <Output valueReference="5" dependencies="1"/>
    <ContinuousStateDerivative valueReference="4" dependencies="1 3"/>
    <InitialUnknown valueReference="4" dependencies="0 1 3"/><InitialUnknown valueReference="6"/>
    <InitialUnknown valueReference="5" dependencies="9"/>
  </ModelStructure>
</fmiModelDescription>
"""
FAULTS_3 = [
    (FMPY, r"(<Unit.*)(<TypeDef.*</TypeDefinitions>)", r"\2\1"),
    (FMPY, 'name="n"', 'name="n-1"'),
    (variables.dimensions_fit, 'Dimension valueReference="9"', 'Dimension valueReference="0"'),
    (variables.dimensions_fit, 'start="4 5"', 'start="4 5 6"'),
    (variables.references_are_unique, 'valueReference="8"', 'valueReference="7"'),
    (FMPY, 'output" min', 'output" variability="continuous" min'),
    (variables.starts_are_given, ' start="4 5"', ""),
    (variables.numbers_are_within_range, 'start="4 5"', 'start="4 9.5"'),
    (variables.units_are_defined, 'unit="m/s"', 'unit="kg"'),
    (variables.types_are_declared, 'declaredType="T" start="1"', 'declaredType="T" start="3"'),
    (structure.structure_is_complete, '<InitialUnknown valueReference="6"/>', ""),
    (structure.structure_is_complete, "<ContinuousStateD.*?/>", ""),
    (structure.dependencies_are_known, 'dependencies="0 1 3"', 'dependencies="0 1 5"'),
    (structure.capabilities_are_consistent, 'canGetAndSetFMUState="true"', ""),
    (structure.experiment_is_one, 'stopTime="1"', 'stopTime="0"'),
]


def rules(findings):
    """Return the rules to which the findings belong."""
    return [rule for rule in (*lint.RULES, *files.RULES) if any(f.startswith(rule.__doc__) for f in findings)]


def of_fmpy(description, folder):
    (folder / "modelDescription.xml").write_text(description)
    return lint.of_fmpy(folder)


def broken(description, old, new):
    changed, count = re.subn(old, new, description, flags=re.DOTALL)
    assert count
    return changed


@pytest.mark.parametrize("description", [DESCRIPTION, DESCRIPTION_3])
def test_a_description_without_faults_passes(description, tmp_path):
    assert lint.check(description) == []
    assert not of_fmpy(description, tmp_path)


@pytest.mark.parametrize(
    ("description", "rule", "old", "new"),
    [*((DESCRIPTION, *fault) for fault in FAULTS), *((DESCRIPTION_3, *fault) for fault in FAULTS_3)],
)
def test_a_fault_is_found(description, rule, old, new, tmp_path):
    changed = broken(description, old, new)
    assert of_fmpy(changed, tmp_path) if rule is FMPY else rule in rules(lint.check(changed))


@pytest.mark.parametrize(("description", "faults"), [(DESCRIPTION, FAULTS), (DESCRIPTION_3, FAULTS_3)])
def test_every_rule_has_a_fault_that_neither_fmpy_nor_another_rule_finds(description, faults, tmp_path):
    alone = set()
    for _, old, new in faults:
        changed = broken(description, old, new)
        found = rules(lint.check(changed))
        alone |= {found[0]} if len(found) == 1 and not of_fmpy(changed, tmp_path) else set()
    if description is DESCRIPTION:
        assert alone == {*lint.RULES} - {variables.dimensions_fit}
    else:
        assert variables.dimensions_fit in alone


FILES = {
    "modelDescription.xml": DESCRIPTION.encode(),
    "binaries/linux64/M.so": b"... {123} ...",
    "documentation/licenses/M.txt": b"MIT",
}


@pytest.mark.parametrize(
    ("changed", "found"),
    [
        ({}, []),
        ({"binaries/win64/M.dll": b"{123}"}, []),
        ({"resources/script.py": b"guid='{123}'", "binaries/linux64/M.so": b""}, []),
        ({"binaries/win64/N.dll": b"{123}"}, [files.libraries_are_named]),
        ({"binaries/linux64/M.so": None}, [files.libraries_are_named]),
        ({"binaries/win64/M.dll": b"{124}"}, [files.guid_is_the_same]),
        ({"resources/script.py": b"guid='{124}'"}, [files.guid_is_the_same]),
        ({"documentation/licenses/M.txt": None}, [files.licences_are_enclosed]),
        ({"documentation/licenses/M.txt": b" "}, [files.licences_are_enclosed]),
        ({"resources/a b.txt": b""}, [files.names_are_portable]),
        ({"resources/../b.txt": b""}, [files.names_are_portable]),
        ({"resources/a.txt": b"", "resources/A.txt": b""}, [files.names_are_portable]),
    ],
)
def test_file_rules_find_each_fault(tmp_path, capsys, changed, found):
    path = tmp_path / "M.fmu"
    with ZipFile(path, "w") as archive:
        for name, content in (FILES | changed).items():
            if content is not None:
                archive.writestr(name, content)
    assert rules(lint.check_file(path)) == found
    assert lint.main([str(path)]) == bool(found)
    assert f"{'no' if not found else len(lint.check_file(path))} finding(s)" in capsys.readouterr().out


def test_a_file_without_a_description_is_reported(tmp_path):
    with ZipFile(tmp_path / "empty.fmu", "w"):
        pass
    assert lint.check_file(tmp_path / "empty.fmu") == ["There is a modelDescription.xml: it is missing"]
