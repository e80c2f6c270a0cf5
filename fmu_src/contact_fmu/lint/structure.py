"""Rules for the other parts of a description: ModelStructure, interfaces and the default experiment."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree.ElementTree import Element

from . import reading

_EXPERIMENT = {"startTime": "0", "stopTime": "1", "stepSize": "1"}


def structure_is_complete(root: Element) -> Iterator[str]:
    """ModelStructure lists all outputs, derivatives and initial unknowns (in FMI 2.0 in the order of their indices):"""
    variables, ordered = reading.numbered(root), sorted if reading.is_3(root) else list
    states = reading.states(root)
    derivatives = [i for i, v in variables.items() if reading.type_of(v).get("derivative")]
    unknown = [
        i
        for i, v in variables.items()
        if (reading.causality(v) in ("output", "calculatedParameter") or i in states or i in derivatives)
        and reading.initial(v) in ("calculated", "approx")
    ]
    outputs = [i for i, v in variables.items() if reading.causality(v) == "output"]
    for section, wanted in (("Outputs", outputs), ("InitialUnknowns", unknown)):
        if ordered(reading.listed(root, section)) != ordered(wanted):
            yield f"{section} are {reading.listed(root, section)}, not {wanted}"
    if sorted(reading.listed(root, "Derivatives")) != derivatives:
        yield f"Derivatives are {reading.listed(root, 'Derivatives')}, not {derivatives}"
    for state in states:
        if (
            state not in variables
            or reading.type_of(variables[state]).tag not in reading.CONTINUOUS
            or reading.variability(variables[state]) != "continuous"
        ):
            yield f"variable {state} has a derivative but is not a continuous Real"


def dependencies_are_known(root: Element) -> Iterator[str]:
    """Dependencies are knowns, each listed once:"""
    variables = reading.numbered(root)
    inputs = {i for i, v in variables.items() if reading.causality(v) in ("input", "independent")}
    exact = {i for i, v in variables.items() if reading.initial(v) == "exact"}
    for section, knowns in (
        ("Outputs", inputs | reading.states(root)),
        ("Derivatives", inputs | reading.states(root)),
        ("InitialUnknowns", inputs | exact),
    ):
        for number, unknown in reading.unknowns(root, section):
            found = [int(i) for i in unknown.get("dependencies", "").split()]
            kinds = unknown.get("dependenciesKind")
            if not set(found) <= knowns or len(set(found)) < len(found):
                yield f"{section} {number} depends on {unknown.get('dependencies')}"
            if kinds is not None and len(kinds.split()) != len(found):
                yield f"{section} {number} has {len(kinds.split())} kinds for {len(found)} dependencies"


def capabilities_are_consistent(root: Element) -> Iterator[str]:
    """There is an interface, its identifier is valid in C, and a state that can be serialised can also be got and set:"""
    if not reading.interfaces(root):
        yield "no interface"
    for interface in reading.interfaces(root):
        if not re.fullmatch(r"[A-Za-z_]\w*", interface.get("modelIdentifier", ""), re.ASCII):
            yield f"{interface.tag} has the modelIdentifier {interface.get('modelIdentifier')}"
        for state in ("FMUstate", "FMUState"):
            if interface.get(f"canSerialize{state}") == "true" and interface.get(f"canGetAndSet{state}") != "true":
                yield f"{interface.tag} serialises a state that it cannot get"


def experiment_is_one(root: Element) -> Iterator[str]:
    """The default experiment ends after its start and has a step:"""
    experiment = root.find("DefaultExperiment")
    if experiment is None:
        return
    start, stop, step = (float(experiment.get(key, default)) for key, default in _EXPERIMENT.items())
    if not (start < stop and 0.0 < step <= stop - start):
        yield f"from {start:g} to {stop:g} by {step:g}"


RULES = (structure_is_complete, dependencies_are_known, capabilities_are_consistent, experiment_is_one)
