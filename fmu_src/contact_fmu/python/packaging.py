"""Build FMU files for hosts with Python: description, our library (`c/entry.c`), and what the model is (`runtime`).

The solver is not included; the library asks the package that is installed in the host's Python.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path

from .. import archive, documentation
from ..catalogue import Model
from ..description import model_description
from ..icon import png
from ..native.table import NAME, content
from ..place import licence
from . import entry
from .runtime import DECLARED, declared

#: Capabilities of this packaging: attributes of the element CoSimulation.
INTERFACES = {
    "CoSimulation": {
        "needsExecutionTool": "true",
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    }
}


def build(model: Model, folder: Path, platforms: Collection[str] = tuple(entry.FILES)) -> Path:
    """Write `folder`/<name>.fmu, for those `platforms` that have our library. The same sources give the same bytes."""
    return archive.write(folder / f"{model.table.name}.fmu", _files(model, platforms))


def _files(model: Model, platforms: Collection[str]) -> Iterator[tuple[str, bytes]]:
    name = model.table.name
    guid, xml = model_description(model.table, INTERFACES)
    yield "modelDescription.xml", xml.encode()
    yield f"resources/{DECLARED}", declared(model.declared, model.options, guid).encode()
    yield f"resources/{NAME}", content(model.component, guid)
    for resource, its in model.resources.items():
        yield f"resources/{resource}", its
    for system, library in entry.libraries().items():
        if system in platforms:
            yield f"binaries/{system}/{name}{Path(entry.FILES[system]).suffix}", library
    yield from documentation.files(model.table)
    yield "model.png", png(name)
    yield "documentation/licenses/wheelrail-contact.txt", licence().encode()
