"""Build libwheelrail.so for Linux on x86-64: ``python -m fmu_src.build_library FOLDER [--keep]``.

The entries of `contact.kernels.entries` are compiled for the processors of `emit.CPUS`. C chooses between them at run time.
With ``--keep`` objects that are in the folder already are linked again, for who changes only the C.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from fmu_src.native import emit

_ROOT = Path(__file__).parents[1]
PREFIX = "wrk"
_FLAGS = ("-std=c11", "-O2", "-ffp-contract=off", "-fvisibility=hidden", "-Wall", "-Wextra", "-Wpedantic", "-fPIC")


def _make_objects(folder: Path) -> None:
    """Write the objects of the entries and their declarations for C into `folder`."""
    from numba import types

    from contact.kernels.entries import all_entries
    from contact.kernels.entries.tables import data
    from fmu_src.native import component
    from fmu_src.native.memory import Doubles

    kinds = {"i64": types.int64, "f64": types.float64, "ptr": Doubles}
    entries = all_entries()
    component.SIGNATURES = {
        f"model_{name}": (kinds[result], tuple(kinds[kind] for kind in arguments))
        for name, (result, arguments) in ((name, entry[1:]) for name, entry in entries.items())
    }
    constants = data()
    emit.make_no_machine_code()
    linked = emit.linked({f"model_{name}": entry[0] for name, entry in entries.items()}, constants, PREFIX)
    emit._llvm_for_all()
    plain = emit._optimised(linked.as_bitcode(), emit.PLAIN, vectors=False).as_bitcode()
    names = [f"{PREFIX}_{name}" for name in entries]
    for suffix, cpu in emit.CPUS.items():
        module = emit._named(emit._optimised(plain, cpu), names, suffix)
        emit._write(module, "linux64", cpu, folder / f"kernels-{suffix}.o")
    text = emit.data_as_ir(constants, PREFIX)
    emit._write(emit._llvm_for_all().parse_assembly(text), "linux64", "", folder / "data.o")


def declarations() -> str:
    """Return the C header of the entries, one function for each processor."""
    from contact.kernels.entries import all_entries

    kinds = {"i64": "int64_t", "f64": "double", "ptr": "void *"}
    lines = ["/* Generated from contact/kernels/entries. */", "#include <stdint.h>"]
    for name, (_, result, arguments) in all_entries().items():
        types = ", ".join([*(kinds[kind] for kind in arguments), "void *"])
        lines += [f"{kinds[result]} {PREFIX}_{name}_{suffix}({types});" for suffix in emit.CPUS]
    return "\n".join(lines) + "\n"


def link(folder: Path, *options: str, name: str = "libwheelrail.so") -> Path:
    """Compile the C part, link it with the objects in `folder`, and return the library."""
    (folder / "wheelrail_entries.h").write_text(declarations())
    library = folder / name
    objects = [folder / f"kernels-{suffix}.o" for suffix in emit.CPUS]
    command = ["gcc", *_FLAGS, *options, "-shared", f"-I{_ROOT / 'contact/include'}", f"-I{folder}"]
    command += ["-o", library, _ROOT / "contact/c/wheelrail.c", *objects, folder / "data.o", "-lm", "-Wl,-z,defs"]
    subprocess.run(list(map(str, command)), check=True)
    return library


def main() -> None:
    """Build the library in the folder that the command line names."""
    if any(os.environ.get(name) != value for name, value in emit.ENVIRONMENT.items()):
        arguments = [sys.executable, "-m", "fmu_src.build_library", *sys.argv[1:]]
        os.execve(sys.executable, arguments, os.environ | emit.ENVIRONMENT)
    import warnings

    from numba.core.errors import NumbaWarning

    warnings.simplefilter("ignore", NumbaWarning)
    folder = Path(sys.argv[1]).absolute()
    folder.mkdir(parents=True, exist_ok=True)
    if "--keep" not in sys.argv:
        _make_objects(folder)
    sys.stdout.write(f"{link(folder)}\n")


if __name__ == "__main__":
    main()
