"""Our own rules for FMUs: each finds what it is for, and finds nothing else in a description without faults."""

import re
from zipfile import ZipFile

import pytest

from fmu_src import lint

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
FAULTS = [  # rule, what is replaced by what
    (lint.elements_in_order, r"(<Unit.*)(<TypeDef.*</TypeDefinitions>)", r"\2\1"),
    (lint.names_are_structured, 'name="n"', 'name="n-1"'),
    (lint.names_are_structured, 'name="n"', 'name="n[1"'),
    (lint.names_are_structured, 'name="n"', 'name="x"'),
    (lint.arrays_are_whole, r"u\[2\]", "u[3]"),
    (lint.arrays_are_whole, r"u\[([12])\]", lambda m: f"u[{int(m[1]) - 1}]"),
    (lint.arrays_are_whole, r"u\[([12])\]", lambda m: f"u[{3 - int(m[1])}]"),
    (lint.arrays_are_whole, r"u\[2\]", "u[2,1]"),
    (lint.references_are_unique, 'valueReference="5"', 'valueReference="0"'),
    (lint.variability_fits, 'variability="fixed" ', ""),
    (lint.variability_fits, 'variability="fixed"', 'variability="discrete"'),
    (lint.variability_fits, 'variability="discrete"', 'variability="continuous"'),
    (lint.starts_are_given, ' start="4"', ""),
    (lint.starts_are_given, '<Integer min="0"', '<Integer min="0" start="0"'),
    (lint.starts_are_given, 'causality="input"', 'causality="input" initial="exact"'),
    (lint.numbers_are_within_range, 'start="4"', 'start="-1"'),
    (lint.numbers_are_within_range, 'start="4"', 'start="9.5"'),
    (lint.numbers_are_within_range, 'start="4"', 'start="nan"'),
    (lint.numbers_are_within_range, 'max="9"', 'max="inf"'),
    (lint.numbers_are_within_range, 'nominal="2"', 'nominal="0"'),
    (lint.units_are_defined, '<Unit name="m"><BaseUnit m="1"/></Unit>', ""),
    (lint.units_are_defined, '<BaseUnit m="1"/>', ""),
    (lint.units_are_defined, 's="-1"', 's="-1.5"'),
    (lint.units_are_defined, 's="-1"', 'min="-1"'),
    (lint.units_are_defined, 'unit="m" start="0"', 'start="0"'),
    (lint.types_are_declared, 'declaredType="T"', 'declaredType="U"'),
    (lint.types_are_declared, 'declaredType="T"', ""),
    (lint.types_are_declared, '<Integer min="0"', '<Integer declaredType="T" min="0"'),
    (lint.types_are_declared, 'declaredType="T" start="1"', 'declaredType="T" start="3"'),
    (lint.types_are_declared, 'value="2"', 'value="1"'),
    (lint.structure_is_complete, '<Unknown index="4" dependencies=""/>', ""),
    (lint.structure_is_complete, r"(<InitialUnknowns>)(<[^>]*>)(<[^>]*>)", r"\1\3\2"),
    (lint.structure_is_complete, r"<Derivatives>.*</Derivatives>", ""),
    (lint.structure_is_complete, 'derivative="4"', 'derivative="6"'),
    (lint.structure_is_complete, 'derivative="4"', 'derivative="7"'),
    (lint.dependencies_are_known, '(Outputs>.*)dependencies="2 3 4"', r'\1dependencies="1 2 3 4"'),
    (lint.dependencies_are_known, 'dependencies="1 2 3 4"', 'dependencies="1 2 3 6"'),
    (lint.dependencies_are_known, 'dependencies="1 2 3 4"', 'dependencies="1 2 2 3"'),
    (lint.dependencies_are_known, 'dependenciesKind="dependent"', 'dependenciesKind="dependent dependent"'),
    (lint.capabilities_are_consistent, 'canGetAndSetFMUstate="true"', ""),
    (lint.capabilities_are_consistent, 'modelIdentifier="M"', 'modelIdentifier="M-1"'),
    (lint.capabilities_are_consistent, "<CoSimulation.*?/>", ""),
    (lint.experiment_is_one, 'stopTime="1"', 'stopTime="0"'),
    (lint.experiment_is_one, 'stepSize="0.1"', 'stepSize="0"'),
]


def rules(findings):
    """Which rules the findings are of."""
    return [rule for rule in (*lint.RULES, *lint.FILE_RULES) if any(f.startswith(rule.__doc__) for f in findings)]


def test_a_description_without_faults_passes():
    assert lint.check(DESCRIPTION) == []


@pytest.mark.parametrize(("rule", "old", "new"), FAULTS)
def test_a_fault_is_found(rule, old, new):
    broken, count = re.subn(old, new, DESCRIPTION, flags=re.DOTALL)
    assert count
    assert rule in rules(lint.check(broken))


def test_every_rule_has_a_fault_that_it_alone_finds():
    alone = set()
    for _, old, new in FAULTS:
        found = rules(lint.check(re.sub(old, new, DESCRIPTION, flags=re.DOTALL)))
        alone |= {found[0]} if len(found) == 1 else set()
    assert alone == set(lint.RULES)


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
        ({"binaries/win64/N.dll": b"{123}"}, [lint.libraries_are_named]),
        ({"binaries/linux64/M.so": None}, [lint.libraries_are_named]),
        ({"binaries/win64/M.dll": b"{124}"}, [lint.guid_is_the_same]),
        ({"resources/script.py": b"guid='{124}'"}, [lint.guid_is_the_same]),
        ({"documentation/licenses/M.txt": None}, [lint.licences_are_enclosed]),
        ({"documentation/licenses/M.txt": b" "}, [lint.licences_are_enclosed]),
        ({"resources/a b.txt": b""}, [lint.names_are_portable]),
        ({"resources/../b.txt": b""}, [lint.names_are_portable]),
        ({"resources/a.txt": b"", "resources/A.txt": b""}, [lint.names_are_portable]),
    ],
)
def test_files(tmp_path, capsys, changed, found):
    path = tmp_path / "M.fmu"
    with ZipFile(path, "w") as archive:
        for name, content in (FILES | changed).items():
            if content is not None:
                archive.writestr(name, content)
    assert rules(lint.check_file(path)) == found
    assert lint.main([str(path)]) == bool(found)
    assert f"{'no' if not found else len(lint.check_file(path))} finding(s)" in capsys.readouterr().out


def test_a_file_without_description_is_said_to_be_one(tmp_path):
    with ZipFile(tmp_path / "empty.fmu", "w"):
        pass
    assert lint.check_file(tmp_path / "empty.fmu") == ["There is a modelDescription.xml: not here"]
