"""Check FMUs for rules that common validators do not check: ``python -m fmu_src.lint FILE.fmu …``

The rules for descriptions are those of FMI 2.0.5, also applied to FMI 3.0 where it has them. Clause numbers refer to FMI 2.0.5.
Each rule is a function that takes the root of a modelDescription.xml and yields findings. Its docstring states the rule and is
printed before each finding.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterable, Iterator
from itertools import product
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element
from zipfile import ZipFile

_ELEMENTS = (
    *(
        "ModelExchange",
        "CoSimulation",
        "ScheduledExecution",
        "UnitDefinitions",
        "TypeDefinitions",
        "LogCategories",
        "DefaultExperiment",
    ),
    *("VendorAnnotations", "ModelVariables", "ModelStructure", "Annotations"),
)
_INDEX = r"\[\d+(?:,\d+)*\]"
_IDENTIFIER = rf"(?:[A-Za-z_]\w*|'(?:[^'\\]|\\.)+')(?:{_INDEX})?"
_NAME = re.compile(
    rf"{_IDENTIFIER}(?:\.{_IDENTIFIER})*|der\({_IDENTIFIER}(?:\.{_IDENTIFIER})*(?:,[1-9]\d*)?\)", re.ASCII
)
_BASE_UNITS = {"kg", "m", "s", "A", "K", "mol", "cd", "rad"}
#: Causality → allowed variability (2.2.7).
_VARIABILITY = {
    "parameter": {"fixed", "tunable"},
    "structuralParameter": {"fixed", "tunable"},
    "calculatedParameter": {"fixed", "tunable"},
    "input": {"discrete", "continuous"},
    "output": {"constant", "discrete", "continuous"},
    "local": {"constant", "fixed", "tunable", "discrete", "continuous"},
    "independent": {"continuous"},
}
_CONTINUOUS = {"Real", "Float64", "Float32"}
_SECTIONS = {  # sections of ModelStructure → paths of their elements in FMI 2.0 and FMI 3.0
    "Outputs": ("Outputs/Unknown", "Output"),
    "Derivatives": ("Derivatives/Unknown", "ContinuousStateDerivative"),
    "InitialUnknowns": ("InitialUnknowns/Unknown", "InitialUnknown"),
}
#: Platform of FMI 2.0 or 3.0 → ending of its libraries.
_LIBRARIES = {
    **{"linux64": ".so", "win64": ".dll", "darwin64": ".dylib"},
    **{"x86_64-linux": ".so", "x86_64-windows": ".dll", "x86_64-darwin": ".dylib", "aarch64-darwin": ".dylib"},
}


def check(description: str) -> list[str]:
    """Return the findings in the text of a modelDescription.xml. Versions other than 2.0 and 3.0 are not checked."""
    root = ElementTree.fromstring(description)
    if root.get("fmiVersion") not in ("2.0", "3.0"):
        return []
    return [f"{rule.__doc__} {finding}" for rule in RULES for finding in rule(root)]


def check_file(path: Path) -> list[str]:
    """Return the findings in an FMU file."""
    with ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    if "modelDescription.xml" not in files:
        return ["There is a modelDescription.xml: it is missing"]
    text = files.pop("modelDescription.xml").decode()
    return check(text) + [
        f"{rule.__doc__} {f}" for rule in FILE_RULES for f in rule(ElementTree.fromstring(text), files)
    ]


# ---------------------------------------------------------------- reading a description


def _variables(root: Element) -> list[Element]:
    return root.findall("ModelVariables/*")


def _is_3(root: Element) -> bool:
    return root.get("fmiVersion") == "3.0"


def _numbered(root: Element) -> dict[int, Element]:
    """Return the variables by index (FMI 2.0) or value reference (FMI 3.0), as dependencies and derivatives refer to them."""
    variables = _variables(root)
    return (
        {int(v.get("valueReference", -1)): v for v in variables} if _is_3(root) else dict(enumerate(variables, start=1))
    )


def _interfaces(root: Element) -> list[Element]:
    return [element for element in root if element.tag in ("ModelExchange", "CoSimulation")]


def _causality(variable: Element) -> str:
    return variable.get("causality", "local")


def _variability(variable: Element) -> str:
    """Return the declared variability or the default, in FMI 2.0 "continuous" even for an Integer (then not allowed)."""
    discrete = variable.tag != "ScalarVariable" and variable.tag not in _CONTINUOUS
    return variable.get("variability", "discrete" if discrete else "continuous")


def _initial(variable: Element) -> str | None:
    """Return the declared `initial` or the default (2.2.7)."""
    exact = _causality(variable) in ("parameter", "structuralParameter") or _variability(variable) == "constant"
    none = _causality(variable) in ("input", "independent")
    return variable.get("initial") or ("exact" if exact else None if none else "calculated")


def _type(variable: Element) -> Element:
    """Return the element that has start, unit and range. In FMI 3.0 it is the variable itself."""
    return next(e for e in variable if e.tag != "Annotations") if variable.tag == "ScalarVariable" else variable


def _of_type(root: Element, variable: Element, attribute: str) -> str | None:
    """Return an attribute of the variable's type element, or else of its declared type."""
    kind = _type(variable)
    declared = root.find(
        f"TypeDefinitions/{{}}[@name='{kind.get('declaredType')}']{{}}".format(
            *((f"{kind.tag}Type", "") if _is_3(root) else ("SimpleType", f"/{kind.tag}"))
        )
    )
    return kind.get(attribute, declared.get(attribute) if declared is not None else None)


def _unknowns(root: Element, section: str) -> list[tuple[int, Element]]:
    """Return (number, element) of each unknown in a section of ModelStructure."""
    key = "valueReference" if _is_3(root) else "index"
    return [(int(u.get(key, 0)), u) for u in root.findall(f"ModelStructure/{_SECTIONS[section][_is_3(root)]}")]


def _listed(root: Element, section: str) -> list[int]:
    return [number for number, _ in _unknowns(root, section)]


def _states(root: Element) -> set[int]:
    return {int(of) for v in _variables(root) if (of := _type(v).get("derivative"))}


# ---------------------------------------------------------------- rules for a description


def elements_in_order(root: Element) -> Iterator[str]:
    """The elements have a fixed order:"""
    tags = [element.tag for element in root]
    if tags != [tag for tag in _ELEMENTS if tag in tags]:
        yield ", ".join(tags)


def names_are_structured(root: Element) -> Iterator[str]:
    """Names are unique and follow the structured convention:"""
    seen = set()
    for variable in _variables(root):
        name = variable.get("name", "")
        if root.get("variableNamingConvention") == "structured" and not _NAME.fullmatch(name):
            yield f"{name!r} does not follow it"
        if name in seen:
            yield f"{name!r} occurs twice"
        seen.add(name)


def arrays_are_whole(root: Element) -> Iterator[str]:
    """Array indices start at one and are complete, row by row:"""
    arrays: dict[str, list[tuple[int, ...]]] = {}
    for variable in _variables(root):
        name = variable.get("name", "")
        indices = tuple(int(i) for part in re.findall(_INDEX, name) for i in part[1:-1].split(","))
        if indices:
            arrays.setdefault(re.sub(_INDEX, "[]", name), []).append(indices)
    for name, found in arrays.items():
        if len({len(indices) for indices in found}) > 1:
            yield f"{name} has elements of several dimensions"
        elif found != list(product(*(range(1, max(i) + 1) for i in zip(*found, strict=True)))):
            yield name


def dimensions_fit(root: Element) -> Iterator[str]:
    """Dimensions of arrays are structural parameters or numbers, and there is one start for each element or one for all:"""
    structural = {n: v for n, v in _numbered(root).items() if _causality(v) == "structuralParameter"}
    for variable in _variables(root):
        sizes = []
        for dimension in variable.findall("Dimension"):
            by = int(dimension.get("valueReference", -1))
            if dimension.get("start") is None and by not in structural:
                yield f"{variable.get('name')} has the dimension of variable {by}"
            sizes.append(
                int(dimension.get("start") or (structural[by].get("start") if by in structural else None) or 0)
            )
        starts = (variable.get("start") or "").split()
        if sizes and starts and len(starts) not in (1, math.prod(sizes)):
            yield f"{variable.get('name')} has {len(starts)} starts for {math.prod(sizes)} elements"


def references_are_unique(root: Element) -> Iterator[str]:
    """Value references are unique:"""
    seen: dict[str | None, str | None] = {}
    for variable in _variables(root):
        reference = variable.get("valueReference")
        if reference in seen:
            yield f"{seen[reference]} and {variable.get('name')} share {reference}"
        seen[reference] = variable.get("name")


def variability_fits(root: Element) -> Iterator[str]:
    """Variability fits causality, and only Reals are continuous:"""
    for variable in _variables(root):
        causality, variability = _causality(variable), _variability(variable)
        if variability not in _VARIABILITY[causality]:
            yield f"{variable.get('name')} is a {variability} {causality}"
        elif variability == "continuous" and _type(variable).tag not in _CONTINUOUS:
            yield f"{variable.get('name')} is a continuous {_type(variable).tag}"


def starts_are_given(root: Element) -> Iterator[str]:
    """A start value is given where a variable is set before the start, and nowhere else:"""
    for variable in _variables(root):
        if _causality(variable) in ("input", "independent") and variable.get("initial"):
            yield f"{variable.get('name')} is an {_causality(variable)} and has an initial"
        wanted = _causality(variable) == "input" or _initial(variable) in ("exact", "approx")
        if wanted != (_type(variable).get("start") is not None):
            yield f"{variable.get('name')} has {'none' if wanted else 'one'}"


def numbers_are_within_range(root: Element) -> Iterator[str]:
    """min, start and max are finite and in this order, a nominal is not zero:"""
    for variable in _variables(root):
        kind, name = _type(variable), variable.get("name")
        if kind.tag in ("Boolean", "String", "Binary", "Clock"):
            continue
        minimum, maximum, starts = (_of_type(root, variable, key) for key in ("min", "max", "start"))
        for start in [None] if starts is None else starts.split():
            numbers = [float(number) for number in (minimum, start, maximum) if number is not None]
            if numbers != sorted(numbers) or not all(map(math.isfinite, numbers)):
                yield f"{name}: min {minimum}, start {start}, max {maximum}"
        nominal = float(_of_type(root, variable, "nominal") or 1.0)
        if nominal == 0.0 or not math.isfinite(nominal):
            yield f"{name}: nominal {nominal:g}"


def units_are_defined(root: Element) -> Iterator[str]:
    """Every Real has a unit, defined by integer exponents of SI base units (an array in FMI 3.0 may have several units):"""
    defined = {unit.get("name"): unit.find("BaseUnit") for unit in root.findall("UnitDefinitions/Unit")}
    for name, base in defined.items():
        exponents = {
            k: v for k, v in (base.attrib if base is not None else {"": ""}).items() if k not in ("factor", "offset")
        }
        if not set(exponents) <= _BASE_UNITS or not all(re.fullmatch(r"-?\d+", e) for e in exponents.values()):
            yield f"{name} is not defined so"
    for variable in _variables(root):
        unit = _of_type(root, variable, "unit")
        mixed = unit is None and variable.find("Dimension") is not None
        if _type(variable).tag in _CONTINUOUS and unit not in defined and not mixed:
            yield f"{variable.get('name')} has {unit}"


def types_are_declared(root: Element) -> Iterator[str]:
    """Declared types exist and fit the kind of the variable, and the start of an enumeration is one of its items:"""
    types = {d.get("name"): d if _is_3(root) else d[0] for d in root.findall("TypeDefinitions/*")}
    for variable in _variables(root):
        kind, name = _type(variable), variable.get("name")
        declared = types.get(kind.get("declaredType"))
        if declared is None:
            if kind.tag == "Enumeration" or kind.get("declaredType"):
                yield f"{name}: {kind.get('declaredType')}"
        elif declared.tag.removesuffix("Type") != kind.tag:
            yield f"{name} is a {kind.tag}, its type {kind.get('declaredType')} is a {declared.tag}"
        elif kind.get("start") and declared.findall("Item"):
            values = [item.get("value") for item in declared.findall("Item")]
            if kind.get("start") not in values or len(set(values)) < len(values):
                yield f"{name}: start {kind.get('start')}, items {', '.join(map(str, values))}"


def structure_is_complete(root: Element) -> Iterator[str]:
    """ModelStructure lists all outputs, derivatives and initial unknowns (in FMI 2.0 in the order of their indices):"""
    variables, ordered = _numbered(root), sorted if _is_3(root) else list
    states = _states(root)
    derivatives = [i for i, v in variables.items() if _type(v).get("derivative")]
    unknown = [
        i
        for i, v in variables.items()
        if (_causality(v) in ("output", "calculatedParameter") or i in states or i in derivatives)
        and _initial(v) in ("calculated", "approx")
    ]
    outputs = [i for i, v in variables.items() if _causality(v) == "output"]
    for section, wanted in (("Outputs", outputs), ("InitialUnknowns", unknown)):
        if ordered(_listed(root, section)) != ordered(wanted):
            yield f"{section} are {_listed(root, section)}, not {wanted}"
    if sorted(_listed(root, "Derivatives")) != derivatives:
        yield f"Derivatives are {_listed(root, 'Derivatives')}, not {derivatives}"
    for state in states:
        if (
            state not in variables
            or _type(variables[state]).tag not in _CONTINUOUS
            or _variability(variables[state]) != "continuous"
        ):
            yield f"variable {state} has a derivative but is not a continuous Real"


def dependencies_are_known(root: Element) -> Iterator[str]:
    """Dependencies are knowns, each listed once:"""
    variables = _numbered(root)
    inputs = {i for i, v in variables.items() if _causality(v) in ("input", "independent")}
    exact = {i for i, v in variables.items() if _initial(v) == "exact"}
    for section, knowns in (
        ("Outputs", inputs | _states(root)),
        ("Derivatives", inputs | _states(root)),
        ("InitialUnknowns", inputs | exact),
    ):
        for number, unknown in _unknowns(root, section):
            found = [int(i) for i in unknown.get("dependencies", "").split()]
            kinds = unknown.get("dependenciesKind")
            if not set(found) <= knowns or len(set(found)) < len(found):
                yield f"{section} {number} depends on {unknown.get('dependencies')}"
            if kinds is not None and len(kinds.split()) != len(found):
                yield f"{section} {number} has {len(kinds.split())} kinds for {len(found)} dependencies"


def capabilities_are_consistent(root: Element) -> Iterator[str]:
    """There is an interface, its identifier is valid in C, and a state that can be serialised can also be got and set:"""
    if not _interfaces(root):
        yield "no interface"
    for interface in _interfaces(root):
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


_EXPERIMENT = {"startTime": "0", "stopTime": "1", "stepSize": "1"}

RULES = (
    *(elements_in_order, names_are_structured, arrays_are_whole, dimensions_fit, references_are_unique),
    *(
        variability_fits,
        starts_are_given,
        numbers_are_within_range,
        units_are_defined,
        types_are_declared,
        structure_is_complete,
    ),
    *(dependencies_are_known, capabilities_are_consistent, experiment_is_one),
)


# ---------------------------------------------------------------- rules for a file


def libraries_are_named(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """At least one platform has a library, and each platform has one for every interface:"""
    platforms = {name.split("/")[1] for name in files if name.startswith("binaries/")}
    for platform in platforms or {"any platform"}:
        for interface in _interfaces(root):
            name = f"binaries/{platform}/{interface.get('modelIdentifier')}{_LIBRARIES.get(platform, '')}"
            if name not in files:
                yield f"{name} is missing"


def guid_is_the_same(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """The guid is contained in every library, or in the script if there is one:"""
    guid = (root.get("guid", "") or root.get("instantiationToken", "")).encode()
    scripts = {name for name in files if re.fullmatch(r"resources/[^/]+\.py", name)}
    for name in scripts or {name for name in files if name.startswith("binaries/")}:
        if not guid or guid not in files[name]:
            yield f"not in {name}"


def licences_are_enclosed(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """The licences are included:"""
    if not any(name.startswith("documentation/licenses/") and content.strip() for name, content in files.items()):
        yield "documentation/licenses is empty"


def names_are_portable(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """File names are portable and differ in more than upper and lower case:"""
    for name in files:
        if not re.fullmatch(r"[\w.-]+(/[\w.-]+)*", name, re.ASCII) or ".." in name.split("/"):
            yield name
    if len({name.lower() for name in files}) < len(files):
        yield "some differ only in upper and lower case"


FILE_RULES = (libraries_are_named, guid_is_the_same, licences_are_enclosed, names_are_portable)


def main(paths: Iterable[str]) -> int:
    """Print the findings of each file. Return 1 if there were any, else 0."""
    wrong = 0
    for path in paths:
        findings = check_file(Path(path))
        wrong += bool(findings)
        print(f"{path}: {len(RULES) + len(FILE_RULES)} rules, {len(findings) or 'no'} finding(s)")
        print("".join(f"  {finding}\n" for finding in findings), end="")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
