"""Compile the kernels to WebAssembly: ``python -m explorer.emit FOLDER`` writes kernels.o and data.o.

The module of all kernels is that of the libraries (`contact_fmu.native.systems`). LLVM compiles what the page calls. The
objects are kept beside those of the other systems.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

from llvmlite import binding as llvm

from contact.compile import c_tables
from contact.compile.emit import data_as_ir, refuse_the_rest
from contact.compile.objects import only
from contact.core import checkout
from contact_fmu.archive import digest
from contact_fmu.native import kinds, systems

TRIPLE = "wasm32-unknown-unknown"
FEATURES = "+simd128,+bulk-memory,+bulk-memory-opt,+nontrapping-fptoint,+sign-ext,+mutable-globals"


def _object(module: Any) -> bytes:
    """Return the optimised object of a module. The triple is set before the passes, which depend on it."""
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(
        cpu="generic", features=FEATURES, opt=3, reloc="static", codemodel="default"
    )
    module.triple, module.data_layout = TRIPLE, str(machine.target_data)
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
    builder.getModulePassManager().run(module, builder)
    refuse_the_rest(module)
    return bytes(machine.emit_object(module))


def main() -> None:
    """Write kernels.o and data.o into the folder that the command line names."""
    kept = systems.kernels() / f"wasm32-{digest(Path(__file__))}"
    with checkout.locked(kept):
        if not kept.is_dir():
            with tempfile.TemporaryDirectory(dir=kept.parent) as made:
                _compile(Path(made))
                shutil.copytree(made, kept)
    shutil.copytree(kept, sys.argv[1], dirs_exist_ok=True)


def _compile(folder: Path) -> None:
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    kernels = llvm.parse_bitcode((systems.kernels() / "kernels.bc").read_bytes())
    (folder / "kernels.o").write_bytes(_object(only(kernels, kinds.names("page"))))
    (folder / "data.o").write_bytes(_object(llvm.parse_assembly(data_as_ir(c_tables.data()))))


if __name__ == "__main__":
    main()
