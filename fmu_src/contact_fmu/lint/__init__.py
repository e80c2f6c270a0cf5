"""Check FMUs by fmpy, by the schemas of FMI and by rules that these do not have: ``python -m contact_fmu.lint FILE.fmu …``

The rules for descriptions are those of FMI 2.0.5, also applied to FMI 3.0 where it has them. Clause numbers refer to FMI 2.0.5.
Each rule is a function that takes the root of a modelDescription.xml and yields findings. Its docstring states the rule and is
printed before each finding.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from xml.etree import ElementTree
from zipfile import ZipFile

from . import files, structure, variables

RULES = (*structure.RULES, *variables.RULES)


def check(description: str) -> list[str]:
    """Return the findings in the text of a modelDescription.xml. Versions other than 2.0 and 3.0 are not checked."""
    root = ElementTree.fromstring(description)
    if root.get("fmiVersion") not in ("2.0", "3.0"):
        return []
    return [f"{rule.__doc__} {finding}" for rule in RULES for finding in rule(root)]


def of_fmpy(path: Path) -> list[str]:
    """Return what fmpy and the schema find in the description of an FMU, a file or a folder."""
    from fmpy.model_description import read_model_description
    from fmpy.validation import validate_model_description

    try:
        found = read_model_description(str(path), validate_variable_names=True, validate_model_structure=True)
    except Exception as error:  # noqa: BLE001 - fmpy raises no narrower one
        return [str(error)]
    return list(map(str, validate_model_description(found)))


def check_file(path: Path) -> list[str]:
    """Return the findings in an FMU file."""
    with ZipFile(path) as archive:
        content = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    if "modelDescription.xml" not in content:
        return ["There is a modelDescription.xml: it is missing"]
    text = content.pop("modelDescription.xml").decode()
    return (
        [f"fmpy: {finding}" for finding in of_fmpy(path)]
        + check(text)
        + [f"{rule.__doc__} {f}" for rule in files.RULES for f in rule(ElementTree.fromstring(text), content)]
    )


def main(paths: Iterable[str]) -> int:
    """Print the findings of each file. Return 1 if there were any, else 0."""
    wrong = 0
    for path in paths:
        findings = check_file(Path(path))
        wrong += bool(findings)
        print(f"{path}: {len(RULES) + len(files.RULES)} rules, {len(findings) or 'no'} finding(s)")
        print("".join(f"  {finding}\n" for finding in findings), end="")
    return wrong > 0
