"""Build FMU files for hosts with Python: description, pythonfmu with its library, ours before it (`entry`), and a short script.

The solver is not included; the script imports the installed package. If two FMUs in one process include a package of the same
name, both run the code of the first, and numba's cache never hits for code in an unzipped FMU (both measured with pythonfmu
0.7.0). For the same reason the name of the script contains the hash of its content.
"""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterator
from importlib.metadata import distribution
from pathlib import Path

import pythonfmu

from contact import __version__
from .. import archive
from ..catalogue import Model
from ..description import model_description
from ..documentation import markdown, page
from ..icon import png
from ..native.table import NAME, content
from ..place import licence
from . import entry as entries
from .slave import INTERFACES

_SCRIPT = '''\
"""Slave of the FMU {name}. The code is in the package wheelrail-contact {version}, installed in the host's Python."""

import sys

try:
    from contact_fmu.python.slave import ModelSlave
except ImportError as error:
    from pythonfmu.enums import Fmi2Status
    from pythonfmu.fmi2slave import Fmi2Slave

    reason = f"the FMU {name} needs the package wheelrail-contact {version} in the host's Python: {{error}}"

    class ModelSlave(Fmi2Slave):
        """Stands for the model that is missing. An instance that logs an error while it is made is not given to the host."""

        def __init__(self, declared, options, guid, **kwargs):
            super().__init__(**kwargs)
            self.log(reason, Fmi2Status.error)

        def do_step(self, current_time, step_size):
            return False


class {name}(ModelSlave):
    def __init__(self, **kwargs):
        super().__init__("{declared}", {options!r}, guid="{guid}", **kwargs)
'''


def build(model: Model, folder: Path, platforms: Collection[str] = tuple(entries.FILES)) -> Path:
    """Write `folder`/<name>.fmu, for those `platforms` that pythonfmu serves. The same sources give the same bytes."""
    return archive.write(folder / f"{model.table.name}.fmu", _files(model, platforms))


def _files(model: Model, platforms: Collection[str]) -> Iterator[tuple[str, bytes]]:
    name = model.table.name
    guid, xml = model_description(model.table, INTERFACES)
    yield "modelDescription.xml", xml.encode()
    script = _SCRIPT.format(
        name=name,
        version=__version__,
        declared=model.declared,
        options=model.all_options,
        guid=guid,
    ).encode()
    module = f"{name.lower()}_{hashlib.sha256(script).hexdigest()[:16]}"
    yield f"resources/{module}.py", script
    yield "resources/slavemodule.txt", module.encode()
    yield f"resources/{NAME}", content(model.component(), guid)
    for resource, its in model.resources.items():
        yield f"resources/{resource}", its
    package = Path(pythonfmu.__file__).parent
    for source in package.glob("*.py"):
        yield f"resources/pythonfmu/{source.name}", source.read_bytes()
    for system, entry in entries.libraries().items():
        if system not in platforms:
            continue
        (library,) = (package / "resources" / "binaries" / system).iterdir()
        yield f"binaries/{system}/{name}{library.suffix}", entry
        yield f"binaries/{system}/pythonfmu-export{library.suffix}", library.read_bytes()
    yield f"documentation/{name}.md", markdown(model.table).encode()
    yield "documentation/index.html", page(model.table).encode()
    yield "model.png", png(name)
    yield "documentation/licenses/wheelrail-contact.txt", licence().encode()
    if text := distribution("pythonfmu").read_text("licenses/LICENSE"):
        yield "documentation/licenses/pythonfmu.txt", text.encode()
