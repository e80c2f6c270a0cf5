"""Read a modelDescription.xml of FMI 2.0 or 3.0 in one way: variables, their attributes, and ModelStructure."""

from __future__ import annotations

from xml.etree.ElementTree import Element

CONTINUOUS = {"Real", "Float64", "Float32"}
_SECTIONS = {  # sections of ModelStructure → paths of their elements in FMI 2.0 and FMI 3.0
    "Outputs": ("Outputs/Unknown", "Output"),
    "Derivatives": ("Derivatives/Unknown", "ContinuousStateDerivative"),
    "InitialUnknowns": ("InitialUnknowns/Unknown", "InitialUnknown"),
}


def variables(root: Element) -> list[Element]:
    return root.findall("ModelVariables/*")


def is_3(root: Element) -> bool:
    return root.get("fmiVersion") == "3.0"


def numbered(root: Element) -> dict[int, Element]:
    """Return the variables by index (FMI 2.0) or value reference (FMI 3.0), as dependencies and derivatives refer to them."""
    in_order = enumerate(variables(root), start=1)
    return {int(v.get("valueReference", -1)) if is_3(root) else i: v for i, v in in_order}


def interfaces(root: Element) -> list[Element]:
    return [element for element in root if element.tag in ("ModelExchange", "CoSimulation")]


def causality(variable: Element) -> str:
    return variable.get("causality", "local")


def variability(variable: Element) -> str:
    """Return the declared variability or the default, in FMI 2.0 "continuous" even for an Integer (then not allowed)."""
    discrete = variable.tag != "ScalarVariable" and variable.tag not in CONTINUOUS
    return variable.get("variability", "discrete" if discrete else "continuous")


def initial(variable: Element) -> str | None:
    """Return the declared `initial` or the default (2.2.7)."""
    exact = causality(variable) in ("parameter", "structuralParameter") or variability(variable) == "constant"
    none = causality(variable) in ("input", "independent")
    return variable.get("initial") or ("exact" if exact else None if none else "calculated")


def type_of(variable: Element) -> Element:
    """Return the element that has start, unit and range. In FMI 3.0 it is the variable itself."""
    return next(e for e in variable if e.tag != "Annotations") if variable.tag == "ScalarVariable" else variable


def of_type(root: Element, variable: Element, attribute: str) -> str | None:
    """Return an attribute of the variable's type element, or else of its declared type."""
    kind = type_of(variable)
    declared = root.find(
        f"TypeDefinitions/{{}}[@name='{kind.get('declaredType')}']{{}}".format(
            *((f"{kind.tag}Type", "") if is_3(root) else ("SimpleType", f"/{kind.tag}"))
        )
    )
    return kind.get(attribute, declared.get(attribute) if declared is not None else None)


def unknowns(root: Element, section: str) -> list[tuple[int, Element]]:
    """Return (number, element) of each unknown in a section of ModelStructure."""
    key = "valueReference" if is_3(root) else "index"
    return [(int(u.get(key, 0)), u) for u in root.findall(f"ModelStructure/{_SECTIONS[section][is_3(root)]}")]


def listed(root: Element, section: str) -> list[int]:
    return [number for number, _ in unknowns(root, section)]


def states(root: Element) -> set[int]:
    return {int(of) for v in variables(root) if (of := type_of(v).get("derivative"))}
