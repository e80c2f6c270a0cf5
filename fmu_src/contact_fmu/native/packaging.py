"""Build FMU files with binaries for every platform. They need no installation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from .. import archive, documentation
from ..catalogue import Model
from ..description import model_description
from ..description_fmi3 import build_description
from ..description_fmi3 import model_description as description_fmi3
from ..icon import png
from ..terminals import terminals
from . import systems
from .component import Component
from .table import NAME, content

_COMMON = {
    "needsExecutionTool": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "true",
}
#: Capabilities of this packaging: attributes of the elements ModelExchange and CoSimulation.
INTERFACES = {
    "ModelExchange": {**_COMMON, "completedIntegratorStepNotNeeded": "false"},
    "CoSimulation": {
        **_COMMON,
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": "false",
        "maxOutputDerivativeOrder": "0",
    },
}

_COMMON_3 = {
    "needsExecutionTool": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canGetAndSetFMUState": "true",
    "canSerializeFMUState": "true",
    "providesDirectionalDerivatives": "true",
    "providesAdjointDerivatives": "true",
}
#: The same in FMI 3.0.
INTERFACES_3 = {
    "ModelExchange": {**_COMMON_3, "needsCompletedIntegratorStep": "true"},
    "CoSimulation": {**_COMMON_3, "canHandleVariableCommunicationStepSize": "true"},
}

#: Platform of a library → name of its folder in FMI 3.0. Those that are not listed have the same name.
_FMI3 = {"linux64": "x86_64-linux", "win64": "x86_64-windows", "darwin64": "x86_64-darwin"}
#: Section of the documentation in an FMU.
_TRIED = """
The libraries are for 64-bit Linux (glibc 2.17 or newer), Windows and macOS (11 or newer, Intel). They need only the C library
of the system. The Linux library is tested; the Windows library is tested under Wine. The macOS library is UNTESTED: it has
never been run. `sources/` has the FMU in C11 for other systems and processors; compile it with -ffp-contract=off. It was run
on 64-bit Linux, with x86 and, by qemu, ARM.
"""


def build(
    model: Model,
    folder: Path,
    say: Callable[[str], None] = print,
    versions: Sequence[int] = (2, 3),
    platforms: Sequence[str] = systems.USUAL,
) -> list[Path]:
    """Write `folder`/<name>.fmu (FMI 2.0) and `folder`/fmi3/<name>.fmu (FMI 3.0) and return their paths.

    Both have the same libraries and sources. The same sources and tools give the same bytes.

    Parameters
    ----------
    say : callable
        Called with a message on progress, since a checkout builds the libraries first, which takes minutes.
    versions : sequence of int
        Versions of FMI.
    platforms : sequence of str
        Systems of the libraries; those of 64-bit ARM are compiled from the sources.
    """
    component = model.component
    table, kinds = component.table, ("ModelExchange", "CoSimulation")[not component.exchange :]
    interfaces, interfaces_3 = ({kind: each[kind] for kind in kinds} for each in (INTERFACES, INTERFACES_3))
    made = systems.folder(platforms, say)
    libraries = {system: made / system / systems.SYSTEMS[system] for system in platforms}
    binaries = {system: (path.suffix, path.read_bytes()) for system, path in libraries.items()}
    files = _sources(component, made)
    listed = [name for name in files if name.endswith(".c")]
    code = b"".join((*(binary for _, binary in binaries.values()), *files.values(), content(component, "")))
    guid, xml = model_description(table, interfaces, code + description_fmi3(table, interfaces_3, "").encode(), listed)
    common = [
        *documentation.files(table, _TRIED),
        *((f"resources/{resource}", its) for resource, its in model.resources.items()),
        (f"resources/{NAME}", content(component, guid)),
        *((f"documentation/licenses/{path.name}", path.read_bytes()) for path in (made / "licenses").iterdir()),
        *((f"sources/{name}", text) for name, text in files.items()),
    ]
    of_2 = [("modelDescription.xml", xml.encode()), *common, ("model.png", png(table.name))]
    of_3 = [
        ("modelDescription.xml", description_fmi3(table, interfaces_3, guid).encode()),
        *common,
        ("terminalsAndIcons/icon.png", png(table.name)),
        ("sources/buildDescription.xml", build_description(table.name, listed).encode()),
    ]
    if found := terminals(table):
        of_3.append(("terminalsAndIcons/terminalsAndIcons.xml", found.encode()))
    for platform, (end, binary) in binaries.items():
        of_2.append((f"binaries/{platform}/{table.name}{end}", binary))
        of_3.append((f"binaries/{_FMI3.get(platform, platform)}/{table.name}{end}", binary))
    return [
        archive.write(where / f"{table.name}.fmu", files)
        for version, where, files in ((2, folder, of_2), (3, folder / "fmi3", of_3))
        if version in versions
    ]


def _sources(component: Component, made: Path) -> dict[str, bytes]:
    """Return the names and contents of sources/: the wrapper, the kernels of this kind of model, and headers."""
    common, kind = made / "sources", component.kind
    header = systems.header(component.table.name, (kind,), in_c=True)
    paths = [*systems.WRAPPER, *common.glob("*.h"), common / f"{kind}.c", common / "data.c"]
    files = {path.name: path.read_bytes() for path in sorted(paths, key=lambda path: path.name)}
    for name in (f"{kind}.c", "data.c"):
        files[name] = b'#include "build.h"\n' + files[name]
    return files | {"build.h": header.encode()}
