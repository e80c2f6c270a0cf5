"""Build FMU files with binaries for every platform. They need no installation."""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
from collections.abc import Callable, Sequence
from importlib.metadata import version
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

import fmpy

import contact
from fmu_src import archive
from fmu_src.catalogue import Model
from fmu_src.description import model_description
from fmu_src.description_fmi3 import build_description
from fmu_src.description_fmi3 import model_description as description_fmi3
from fmu_src.documentation import markdown, page
from fmu_src.icon import png
from fmu_src.native import source
from fmu_src.native.emit import OWN_LIBM, TRIPLES, objects, sources
from fmu_src.native.libm import compile_libm
from fmu_src.native.licences import licences
from fmu_src.terminals import terminals
from models import wheelset

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

_BEAT = 15.0  # between two signs of life of a long command [s]
WRAPPER = Path(__file__).parent / "c"
HEADERS = Path(fmpy.__file__).parent / "c-code"  # headers of the FMI project (2-clause BSD licence)
#: -ffp-contract=off: fused operations would make the results differ between processors.
FLAGS = ("-std=c11", "-O2", "-ffp-contract=off", "-fvisibility=hidden", "-Wall", "-Wextra", "-shared", "-s")
_LINKED_AS = {"linux64": ".so", "win64": ".dll", "darwin64": ".dylib"}
_FMI3 = {"linux64": "x86_64-linux", "win64": "x86_64-windows", "darwin64": "x86_64-darwin"}
_ZIG = {"linux64": "x86_64-linux-gnu.2.17", "win64": "x86_64-windows-gnu", "darwin64": "x86_64-macos.11.0"}
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
            "ssp",
            "terminals",
            "units",
            "packaging",
            "source",
            "licences",
            "libm",
            "records",
        ),
    },
    Path(wheelset.__file__).parent: set(),
}
#: Section of the documentation in an FMU.
_TRIED = """
The libraries are for 64-bit Linux (glibc 2.17 or newer), Windows and macOS (11 or newer, Intel). They need only the C library
of the system. The Linux library is tested; the Windows library is tested under Wine. The macOS library is UNTESTED: it has
never been run.
"""


def build(model: Model, folder: Path, cache: Path, say: Callable[[str], None]) -> list[Path]:
    """Write `folder`/<name>.fmu (FMI 2.0) and `folder`/fmi3/<name>.fmu (FMI 3.0) and return their paths.

    Both have the same libraries. The same sources and tools give the same bytes.

    Parameters
    ----------
    cache : Path
        Folder in which compiled kernels are kept from one build to the next.
    say : callable
        Called with a message on progress, since the first build takes minutes.
    """
    component = model.module("native").component(**model.all_options)
    table = component.table
    objects_of = kernels(model, cache, say)
    kernels_in_c = sources(_kept(model, cache))
    code = b"".join(
        path.read_bytes() for path in (*chain.from_iterable(objects_of.values()), *sorted(WRAPPER.iterdir()))
    )
    compiled = [path.name for path in (*sorted(WRAPPER.glob("*.c")), *kernels_in_c)] + ["model.c"]
    guid, xml = model_description(
        table, INTERFACES, code + description_fmi3(table, INTERFACES_3, "").encode(), compiled
    )
    with TemporaryDirectory() as directory:
        generated = Path(directory)
        source.write(component, guid, generated)
        in_c = generated / "sources"
        in_c.mkdir()
        in_c_files = [
            *source.write(component, guid, in_c, kernels_in_c=True),
            *kernels_in_c,
            *sorted(WRAPPER.iterdir()),
        ]
        in_c_files += sorted(HEADERS.glob("fmi[23]*.h"))
        documents = [
            (f"documentation/{table.name}.md", (markdown(table) + _TRIED).encode()),
            *((f"resources/{resource}", content) for resource, content in model.resources.items()),
            *((f"documentation/licenses/{name}", text.encode()) for name, text in licences(HEADERS)),
            ("documentation/index.html", page(table).encode()),
            *((f"sources/{path.name}", path.read_bytes()) for path in in_c_files),
        ]
        of_version = {
            folder: [("model.png", png(table.name))],
            folder / "fmi3": [("terminalsAndIcons/icon.png", png(table.name))],
        }
        of_version[folder / "fmi3"].append(
            ("sources/buildDescription.xml", build_description(table.name, compiled).encode())
        )
        if found := terminals(table):
            of_version[folder / "fmi3"].append(("terminalsAndIcons/terminalsAndIcons.xml", found.encode()))
        libraries = {}
        for platform, parts in objects_of.items():
            say(f"linking for {platform}")
            libraries[platform] = link(platform, table.name, parts, generated)
        return [
            archive.write(
                where / f"{table.name}.fmu",
                [
                    ("modelDescription.xml", description.encode()),
                    *documents,
                    *of_version[where],
                    *((f"binaries/{names[p]}/{path.name}", path.read_bytes()) for p, path in libraries.items()),
                ],
            )
            for where, description, names in (
                (folder, xml, {platform: platform for platform in libraries}),
                (folder / "fmi3", description_fmi3(table, INTERFACES_3, guid), _FMI3),
            )
        ]


def link(platform: str, name: str, kernels: list[Path], generated: Path) -> Path:
    """Compile the wrapper with the code in `generated`, link it with the kernels and return the path of the library."""
    library = generated / platform / (name + _LINKED_AS[platform])
    library.parent.mkdir(exist_ok=True)
    sources = [*sorted(WRAPPER.glob("*.c")), generated / "model.c"]
    libm = compile_libm(compiler(platform), library.parent, run) if platform in OWN_LIBM else []
    run(
        *compiler(platform), *FLAGS, f"-I{generated}", f"-I{WRAPPER}", f"-I{HEADERS}", *sources, *kernels, *libm,
        "-o", library,
        *_own_flags(platform, library.name),
    )  # fmt: skip
    return library


def _own_flags(platform: str, name: str) -> list[str]:
    """Return the linker options of a platform. A macOS library stores its own path, which must not be that of the build."""
    own = {"linux64": ["-fPIC", "-Wl,-z,defs", "-lm"], "darwin64": ["-fPIC", f"-Wl,-install_name,@rpath/{name}"]}
    return own.get(platform, [])


def compiler(platform: str) -> list[str]:
    """Return the command of the C compiler for a platform."""
    return [sys.executable, "-m", "ziglang", "cc", "-target", _ZIG[platform], "-fno-sanitize=undefined"]


def run(*command: str | Path, waiting: Callable[[], None] | None = None) -> None:
    """Run a command. If it fails, raise an error with its output. Every 15 s that it lasts, `waiting` is called."""
    words = list(map(str, command))
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        said = None
        while said is None:
            try:
                said, _ = process.communicate(timeout=_BEAT)
            except subprocess.TimeoutExpired:
                if waiting is not None:
                    waiting()
    if process.returncode:
        raise RuntimeError(f"{' '.join(words)}\n{said}")


def kernels(model: Model, cache: Path, say: Callable[[str], None]) -> dict[str, list[Path]]:
    """Return the object files of a model's kernels by platform. They are compiled only if their sources or numba changed."""
    compile_kernels([model], cache, say)
    folder = _kept(model, cache)
    return {platform: objects(folder, platform) for platform in TRIPLES}


def compile_kernels(chosen: Sequence[Model], cache: Path, say: Callable[[str], None]) -> None:
    """Compile the kernels that are not in the cache, in one process, where the models share most of the work."""
    words: list[str | Path] = []
    for folder, model in {_kept(model, cache): model for model in chosen}.items():
        parts = chain(sources(folder), *(objects(folder, platform) for platform in TRIPLES))
        if not all(path.exists() for path in parts):
            folder.mkdir(parents=True, exist_ok=True)
            words += [model.name, json.dumps(dict(model.options)), folder]
    if words:
        say(f"compiling the kernels of {len(words) // 3} FMUs for 3 systems, some minutes the first time")
        run(sys.executable, "-m", "fmu_src.native.emit", *words, waiting=lambda: say("still compiling the kernels"))


def _kept(model: Model, cache: Path) -> Path:
    """Return the cache folder of a model's kernels. Its name is a hash of everything that they are made from."""
    options = json.dumps(dict(model.options))
    fingerprint = hashlib.sha256(f"{model.name} {options} {version('numba')} {version('llvmlite')}".encode())
    for package, others in _SOURCES.items():
        for path in sorted(package.rglob("*.py")):
            if not set(path.relative_to(package).with_suffix("").parts) & others:
                fingerprint.update(path.read_bytes())
    return cache / fingerprint.hexdigest()[:16]
