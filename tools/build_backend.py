"""Build backend of wheelrail-contact: setuptools, and the libraries of compiled kernels in a wheel.

`build_wheel` copies the sources into a temporary folder, adds the libraries and calls setuptools. Editable installs are made
by setuptools alone.

A wheel is for one system and carries the library of compiled kernels for it. The libraries for the other systems are there
too, because an FMU has them all. numba and zig build them, and are needed nowhere else. ``--config-setting system=win64``
chooses another system than this one (`SYSTEMS`). An sdist has the kernels in C, so that a wheel is built from it for this
machine alone by any C compiler.
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
import tomllib
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import (  # hooks that a front end calls besides those below
    build_editable,
    get_requires_for_build_editable,
    prepare_metadata_for_build_editable,
)

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
]

#: System, by its name in `contact_fmu.native.systems` → tag of its wheels.
SYSTEMS = {
    "linux64": "manylinux_2_17_x86_64",
    "aarch64-linux": "manylinux_2_17_aarch64",
    "win64": "win_amd64",
    "darwin64": "macosx_11_0_x86_64",
    "aarch64-darwin": "macosx_11_0_arm64",
}


def this_system() -> str:
    """Return the name of this machine's system."""
    arm = platform.machine().lower() in ("aarch64", "arm64")
    names = {
        "linux": ("linux64", "aarch64-linux"),
        "darwin": ("darwin64", "aarch64-darwin"),
        "win32": ("win64", "win64"),
    }
    return names[sys.platform][arm]


#: Folder of an sdist with the kernels in C, and what else their library is compiled from.
IN_C = Path("contact", "library", "sources")


def get_requires_for_build_sdist(config_settings: Mapping[str, Any] | None = None) -> list[str]:
    """Return what writes the kernels in C (hook of PEP 517)."""
    return [] if (IN_C / "kernels.c").is_file() else _builders()


def get_requires_for_build_wheel(config_settings: Mapping[str, Any] | None = None) -> list[str]:
    """Return what builds the library: nothing for an sdist, which has the kernels in C (hook of PEP 517)."""
    return [] if (IN_C / "kernels.c").is_file() else _builders()


def _builders() -> list[str]:
    """Return what the package needs, which the builder imports, and numba, zig and what else builds its libraries."""
    project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    more = (name for name in (*extras["native"], *extras["fmu"]) if name.startswith(("ziglang", "fmpy")))
    return [*project["dependencies"], *extras["build"], *more]


def libraries(root: Path) -> Path:
    """Return the folder of the libraries for all systems, kept with those of checkouts: the same sources build them once."""
    code = (
        "import sys; sys.path[:0] = ['fmu_src', 'models']; from contact_fmu.native.systems import folder; "
        f"print(folder({tuple(SYSTEMS)}))"
    )
    told = subprocess.run([sys.executable, "-c", code], cwd=root, stdout=subprocess.PIPE, text=True, check=True)
    return Path(told.stdout.splitlines()[-1])


def build_sdist(sdist_directory: str, config_settings: Mapping[str, Any] | None = None) -> str:
    """Build an sdist with the kernels in C into a folder and return its name (hook of PEP 517)."""
    if (IN_C / "kernels.c").is_file():
        return str(build_meta.build_sdist(sdist_directory, config_settings))
    linked = libraries(Path.cwd())
    shutil.copytree(linked / "sources", IN_C)
    for name in ("kernels.c", "wheelrail_entries.h"):
        shutil.copy2(linked.parent / name, IN_C)
    try:
        return str(build_meta.build_sdist(sdist_directory, config_settings))
    finally:
        shutil.rmtree(IN_C.parent)


def compile_in_c(root: Path, library: Path) -> None:
    """Compile the library of this machine from the C of an sdist.

    Raises
    ------
    RuntimeError
        If there is no C compiler, or if it fails.
    """
    compiler = os.environ.get("CC") or next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        raise RuntimeError("no C compiler: install one (apt-get install gcc), or install a wheel of wheelrail-contact")
    native, given = root / "fmu_src" / "contact_fmu" / "native", root / IN_C
    folders = (root / "contact" / "c", native / "c_library", native / "c")
    parts = [path for folder in folders for path in sorted(folder.glob("*.c"))]
    (found,) = re.findall(r'__version__ = "(.*)"', (root / "contact" / "version.py").read_text(encoding="utf-8"))
    include = [f"-I{path}" for path in (given, native / "c", root / "contact" / "include")]
    flags = ["-std=c11", "-O2", "-fPIC", "-shared", "-ffp-contract=off", "-w", "-DWR_ANY", "-DKERNELS_IN_C"]
    library.parent.mkdir(parents=True)
    command = [
        *compiler.split(),
        *flags,
        f'-DWR_VERSION="{found}"',
        *include,
        *parts,
        given / "kernels.c",
        given / "data.c",
    ]
    done = subprocess.run([*map(str, command), "-o", str(library), "-lm"], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"the library could not be compiled:\n{done.stderr[-3000:]}")


def lay_out(root: Path, folder: Path) -> None:
    """Copy what a wheel is made of into `folder`."""
    for name in ("README.md", "LICENSE", "pyproject.toml"):
        shutil.copy2(root / name, folder / name)
    for name in ("contact", "fmu_src", "models"):
        shutil.copytree(root / name, folder / name, ignore=shutil.ignore_patterns("__pycache__", "*.pyc"))


def build_wheel(
    wheel_directory: str, config_settings: Mapping[str, Any] | None = None, metadata_directory: str | None = None
) -> str:
    """Build a wheel into a folder and return its name (hook of PEP 517)."""
    root, target = Path.cwd(), os.path.abspath(wheel_directory)
    system = (config_settings or {}).get("system") or this_system()
    if system not in SYSTEMS:
        raise ValueError(f"system = {system!r} is not one of {', '.join(SYSTEMS)}")
    with TemporaryDirectory() as folder:
        lay_out(root, Path(folder))
        of_sdist = (root / IN_C / "kernels.c").is_file()
        if of_sdist:
            ending = {"win32": "wheelrail.dll", "darwin": "libwheelrail.dylib"}.get(sys.platform, "libwheelrail.so")
            compile_in_c(root, Path(folder) / "contact" / "library" / this_system() / ending)
        else:
            shutil.copytree(libraries(root), Path(folder) / "contact" / "library")
        os.chdir(folder)
        try:
            tag = sysconfig.get_platform() if of_sdist else SYSTEMS[system]
            options = {"--build-option": ["--plat-name", tag.replace("-", "_").replace(".", "_")]}
            return str(build_meta.build_wheel(target, options, None))
        finally:
            os.chdir(root)
