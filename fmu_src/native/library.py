"""Build the library of all native FMUs for each system, once: kernels by numba and LLVM, the wrapper in C by zig.

The folder of a library has ``<platform>/wheelrail.so`` …, ``sources/<kind>/`` with the kernels in C, ``sources/`` with headers
that the wrapper needs, and ``licenses/``. Packing an FMU (`packaging`) needs nothing else.
"""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from shutil import copy

import contact
from models import vehicle, wheelset

NAME = "wheelrail"
WRAPPER = Path(__file__).parent / "c"
#: Kind of model → module of its kernels in this package.
KINDS = {
    "contact": "wheel_rail_contact",
    "pair": "wheel_rail_pair",
    "surfaces": "wheel_rail_surfaces",
    "wheelset": "wheelset",
    "vehicle": "vehicle",
    "open_vehicle": "open_vehicle",
}
#: Kind → kinds whose kernels its own call.
CALLS = {"vehicle": ("pair",)}
PLATFORMS = {"linux64": ".so", "win64": ".dll", "darwin64": ".dylib"}
ARM = {"aarch64-linux": ".so", "aarch64-darwin": ".dylib"}
#: Modules and folders that have no part in the kernels or the libraries.
_WITHOUT = {
    *("cli", "plot", "study", "halfspace", "python", "lint", "archive", "build", "catalogue", "command"),
    *("description", "description_fmi3", "documentation", "icon", "place", "ssp", "terminals", "packaging", "table"),
}


#: Modules that have a part in the libraries but not in the kernels.
_OF_WRAPPER = {"library", "linking", "libm", "licences", "records"}


def folder_of(cache: Path) -> Path:
    """Return the folder of the libraries. Its name is a hash of everything that they are made from."""
    content = _hash(_WITHOUT, "*.py", "*.[ch]")
    return cache / content


def objects_of(cache: Path) -> Path:
    """Return the folder of the compiled kernels, which do not depend on the wrapper."""
    return cache / f"kernels-{_hash(_WITHOUT | _OF_WRAPPER, '*.py')}"


def _hash(without: set[str], *patterns: str) -> str:
    tools = []
    for tool in ("numba", "llvmlite", "ziglang"):
        try:
            tools.append(f"{tool} {version(tool)}")
        except PackageNotFoundError:
            continue  # a machine that only packs has libraries, and no tools
    content = hashlib.sha256(" ".join(tools).encode())
    for package in (contact, sys.modules[__package__.partition(".")[0]], wheelset, vehicle):
        root = Path(package.__file__).parent
        for path in sorted(path for pattern in patterns for path in root.rglob(pattern)):
            if not set(path.relative_to(root).with_suffix("").parts) & without:
                content.update(path.read_bytes())
    return content.hexdigest()[:16]


def kinds_of(kind: str) -> tuple[str, ...]:
    """Return the kinds whose kernels an FMU of this kind needs."""
    return (kind, *CALLS.get(kind, ()))


def build_header(prefix: str, kinds: tuple[str, ...], *, in_c: bool) -> str:
    """Return build.h: which kernels are linked, and a prefix for all names that one file of the wrapper uses of another."""
    listed = " ".join(f"DO({kind}, cpu)" for kind in kinds)
    lines = ["/* Generated: which kernels are here, and what all names begin with. */", "#ifndef BUILD_H", "#define BUILD_H"]
    lines += ["#define KERNELS_IN_C"] if in_c else []
    lines += [f"#define OWN(name) {prefix}_##name", f"#define KINDS(DO, cpu) {listed}"]
    if in_c:
        entries = ("memory", "size", "prepare", "start", "outputs", "lazy", "difference", "field")
        names = [f"{kind}_{entry}_any" for kind in kinds for entry in entries]
        names += [f"{kind}_data{i}" for kind in kinds for i in range(6)]
        lines += [f"#define {name} OWN({name})" for name in names]
    return "\n".join([*lines, "#endif", ""])


def libraries(cache: Path, say: Callable[[str], None], *, arm: bool = False) -> Path:
    """Return the folder of the libraries, which are built if they are not there."""
    folder = folder_of(cache)
    ready = folder / "ready"
    if not ready.exists():
        _build(folder, cache, say)
        ready.write_text("")
    if arm and not all((folder / platform / f"{NAME}{end}").exists() for platform, end in ARM.items()):
        _build_arm(folder, say)
    return folder


def _build(folder: Path, cache: Path, say: Callable[[str], None]) -> None:
    try:
        from fmu_src.native.emit import objects, sources
        from fmu_src.native.licences import licences
        from fmu_src.native.linking import HEADERS, link, run
        from fmu_src.native.records import header
    except ModuleNotFoundError as error:
        raise SystemExit(f"{error}: native FMUs need  pip install 'wheelrail-contact[native]'") from None
    parts = {kind: objects_of(cache) / kind for kind in KINDS}
    for part in parts.values():
        part.mkdir(parents=True, exist_ok=True)
    missing = {kind for kind, part in parts.items() if not all(p.exists() for p in sources(part, kind))}
    if missing:
        say(f"compiling the kernels of {len(missing)} kinds of FMUs for 3 systems, some minutes the first time")
        words = [word for kind in parts if kind in missing for word in (KINDS[kind], parts[kind])]
        run(sys.executable, "-m", "fmu_src.native.emit", *words, waiting=lambda: None)
    common = folder / "sources"
    common.mkdir(parents=True, exist_ok=True)
    (common / "records.h").write_text(header())
    for path in HEADERS.glob("fmi[23]*.h"):
        copy(path, common)
    for kind, part in parts.items():
        (common / kind).mkdir(exist_ok=True)
        for path in sources(part, kind):
            text = '#include "build.h"\n' + path.read_text(encoding="utf-8")
            (common / kind / path.name).write_text(text, encoding="utf-8")
    (folder / "licenses").mkdir(exist_ok=True)
    for name, text in licences(HEADERS):
        (folder / "licenses" / name).write_text(text, encoding="utf-8")
    (folder / "build").mkdir(exist_ok=True)
    (folder / "build" / "build.h").write_text(build_header(NAME, tuple(KINDS), in_c=False))
    wrapper = [*sorted(WRAPPER.iterdir()), folder / "build" / "build.h", common / "records.h"]
    for platform in PLATFORMS:
        say(f"linking the library for {platform}")
        link(platform, NAME, wrapper, [path for part in parts.values() for path in objects(part, platform)], folder)


def _build_arm(folder: Path, say: Callable[[str], None]) -> None:
    from fmu_src.native.linking import link

    made = folder / "arm"
    made.mkdir(exist_ok=True)
    (made / "build.h").write_text(build_header(NAME, tuple(KINDS), in_c=True))
    parts = [*sorted(WRAPPER.iterdir()), made / "build.h", *(folder / "sources").rglob("*.[ch]")]
    for platform in ARM:
        say(f"compiling the library for {platform}, some minutes")
        link(platform, NAME, parts, [], folder)
