"""Build FMU files with binaries for every platform. They need no installation."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Callable, Sequence
from importlib.metadata import version
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

import contact
from fmu_src import archive
from fmu_src.catalogue import Model
from fmu_src.description import model_description
from fmu_src.description_fmi3 import build_description
from fmu_src.description_fmi3 import model_description as description_fmi3
from fmu_src.documentation import markdown, page
from fmu_src.icon import png
from fmu_src.native import source
from fmu_src.native.emit import TRIPLES, objects, sources
from fmu_src.native.headers import HEADERS
from fmu_src.native.licences import licences
from fmu_src.native.linking import FROM_C, WRAPPER, link, run
from fmu_src.terminals import terminals
from models import vehicle, wheelset
from models.vehicle.declared import find

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
}
#: The same in FMI 3.0.
INTERFACES_3 = {
    "ModelExchange": {**_COMMON_3, "needsCompletedIntegratorStep": "true"},
    "CoSimulation": {**_COMMON_3, "canHandleVariableCommunicationStepSize": "true"},
}

#: Platform of a library → name of its folder in FMI 3.0. Those that are not listed have the same name.
_FMI3 = {"linux64": "x86_64-linux", "win64": "x86_64-windows", "darwin64": "x86_64-darwin"}
#: Folder of sources of the kernels → names of folders and modules in it of which kernels are not made.
_SOURCES: dict[Path, set[str]] = {
    Path(contact.__file__).parent: {"cli", "plot", "study", "halfspace"},
    Path(__file__).parents[1]: {
        *("python", "archive", "build", "catalogue", "command", "description", "description_fmi3", "documentation"),
        *(
            "icon",
            "lint",
            "place",
            "profiles",
            "surfaces",
            "resources",
            "ssp",
            "terminals",
            "units",
            "packaging",
            "source",
            "licences",
            "libm",
            "linking",
            "records",
        ),
    },
    Path(wheelset.__file__).parent: set(),
}
#: Modules in them of which only the kernels of vehicles are made, and the folder of these kernels.
_ONLY_VEHICLES = {"vehicle", "open_vehicle", "vehicle_parts", "track"}
_OF_VEHICLES = Path(vehicle.__file__).parent / "kernels"
#: Section of the documentation in an FMU.
_TRIED = """
The libraries are for 64-bit Linux (glibc 2.17 or newer), Windows and macOS (11 or newer, Intel). They need only the C library
of the system. The Linux library is tested; the Windows library is tested under Wine. The macOS library is UNTESTED: it has
never been run. `sources/` has the FMU in C11 for other systems and processors; compile it with -ffp-contract=off. It was run
on 64-bit Linux, with x86 and, by qemu, ARM.
"""


def build(model: Model, folder: Path, cache: Path, say: Callable[[str], None], *, arm: bool = False) -> list[Path]:
    """Write `folder`/<name>.fmu (FMI 2.0) and `folder`/fmi3/<name>.fmu (FMI 3.0) and return their paths.

    Both have the same libraries and sources. The same sources and tools give the same bytes.

    Parameters
    ----------
    cache : Path
        Folder in which compiled kernels are kept from one build to the next.
    say : callable
        Called with a message on progress, since the first build takes minutes.
    arm : bool
        Add the libraries for 64-bit ARM, which are compiled from the sources.
    """
    component = model.module("native").component(**model.all_options)
    table, kinds = component.table, ("ModelExchange", "CoSimulation")[not component.exchange :]
    interfaces, interfaces_3 = ({kind: each[kind] for kind in kinds} for each in (INTERFACES, INTERFACES_3))
    objects_of = kernels(model, cache, say)
    in_c = [path for part in (model, *model.linked) for path in _sources(part, cache)]
    parts = (*chain.from_iterable(objects_of.values()), *in_c, *sorted(WRAPPER.iterdir()))
    code = b"".join(path.read_bytes() for path in parts)
    listed = [path.name for path in (*sorted(WRAPPER.glob("*.c")), *in_c)] + ["model.c"]
    guid, xml = model_description(table, interfaces, code + description_fmi3(table, interfaces_3, "").encode(), listed)
    with TemporaryDirectory() as directory:
        made = Path(directory)
        wrapper = [*sorted(WRAPPER.iterdir()), *source.write(component, guid, made)]
        whole = source.write_whole(
            component, guid, (*wrapper, *in_c, *sorted(HEADERS.glob("fmi[23]*.h"))), made / "sources"
        )
        libraries = {}
        for platform in (*objects_of, *(FROM_C if arm else ())):
            say(f"linking for {platform}")
            of_platform = (whole, []) if platform in FROM_C else (wrapper, objects_of[platform])
            libraries[platform] = link(platform, table.name, *of_platform, made)
        common = [
            (f"documentation/{table.name}.md", (markdown(table) + _TRIED).encode()),
            *((f"resources/{resource}", content) for resource, content in model.resources.items()),
            *((f"documentation/licenses/{name}", text.encode()) for name, text in licences(HEADERS)),
            ("documentation/index.html", page(table).encode()),
            *((f"sources/{path.name}", path.read_bytes()) for path in whole),
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
        for platform, path in libraries.items():
            of_2.append((f"binaries/{platform}/{path.name}", path.read_bytes()))
            of_3.append((f"binaries/{_FMI3.get(platform, platform)}/{path.name}", path.read_bytes()))
        return [
            archive.write(where / f"{table.name}.fmu", files)
            for where, files in ((folder, of_2), (folder / "fmi3", of_3))
        ]


def kernels(model: Model, cache: Path, say: Callable[[str], None]) -> dict[str, list[Path]]:
    """Return the object files of a model's kernels by platform. They are compiled only if their sources or numba changed."""
    parts = (model, *model.linked)
    compile_kernels(parts, cache, say)
    return {
        platform: [path for part in parts for path in objects(_kept(part, cache), platform)] for platform in TRIPLES
    }


def _sources(model: Model, cache: Path) -> list[Path]:
    """Return the C sources of a model's kernels."""
    return sources(_kept(model, cache), model.module("native").component(**model.options).prefix)


def compile_kernels(chosen: Sequence[Model], cache: Path, say: Callable[[str], None]) -> None:
    """Compile the kernels that are not in the cache, in one process, where the models share most of the work."""
    words: list[str | Path] = []
    awaited: dict[str, list[Path]] = {}
    every = chain.from_iterable((model, *model.linked) for model in chosen)
    for folder, model in {_kept(model, cache): model for model in every}.items():
        parts = chain(_sources(model, cache), *(objects(folder, platform) for platform in TRIPLES))
        if not all(path.exists() for path in parts):
            folder.mkdir(parents=True, exist_ok=True)
            words += [model.name, json.dumps(dict(model.options)), folder]
            awaited |= {f"{model.table.name} for {platform}": objects(folder, platform) for platform in TRIPLES}
    if words:
        say(f"compiling the kernels of {len(words) // 3} FMUs for 3 systems, some minutes the first time")
        tell = _teller(awaited, say)
        run(sys.executable, "-m", "fmu_src.native.emit", *words, waiting=tell)
        tell()


def _teller(awaited: dict[str, list[Path]], say: Callable[[str], None]) -> Callable[[], None]:
    """Return a function that says once of each name that all its files are there, and how many of how many are done."""
    left = {name: paths for name, paths in awaited.items() if not all(path.exists() for path in paths)}
    total = len(left)

    def tell() -> None:
        for name in [name for name, paths in left.items() if all(path.exists() for path in paths)]:
            del left[name]
            say(f"kernels of {name}: compiled, {total - len(left)} of {total}")

    return tell


def _kept(model: Model, cache: Path) -> Path:
    """Return the cache folder of a model's kernels. Its name is a hash of everything that they are made from."""
    options = json.dumps(dict(model.options))
    fingerprint = hashlib.sha256(f"{model.name} {options} {version('numba')} {version('llvmlite')}".encode())
    is_vehicle = "vehicle" in model.options
    for package, others in _SOURCES.items():
        for path in sorted(package.rglob("*.py")):
            if not set(path.relative_to(package).with_suffix("").parts) & (
                others if is_vehicle else others | _ONLY_VEHICLES
            ):
                fingerprint.update(path.read_bytes())
    for path in (*sorted(_OF_VEHICLES.glob("*.py")), find(model.options["vehicle"])) if is_vehicle else ():
        fingerprint.update(path.read_bytes())
    return cache / fingerprint.hexdigest()[:16]
