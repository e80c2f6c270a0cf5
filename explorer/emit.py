"""Compile the kernels to WebAssembly: numba's IR without anything of Python, then LLVM, then zig's linker.

``python -m explorer.emit FOLDER`` writes the objects. It is a program of its own, because numba must be told not to optimise
before it is imported (`fmu_src.native.emit`).
"""

from __future__ import annotations

import os
import re
import sys
import warnings
from pathlib import Path

from fmu_src.native.emit import ENVIRONMENT

TRIPLE = "wasm32-unknown-unknown"
FEATURES = "+simd128,+bulk-memory,+bulk-memory-opt,+nontrapping-fptoint,+sign-ext,+mutable-globals"


def _object(text: str, entries: tuple[str, ...]) -> bytes:
    """Return the optimised object of a module's IR. The triple is set before the passes, which depend on it."""
    from llvmlite import binding as llvm

    from fmu_src.native.emit import refuse_the_rest

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    module = llvm.parse_assembly(re.sub(r"^target .*$", "", text, flags=re.MULTILINE))
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(
        cpu="generic", features=FEATURES, opt=3, reloc="static", codemodel="default"
    )
    module.triple, module.data_layout = TRIPLE, str(machine.target_data)
    if entries:
        builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
        builder.getModulePassManager().run(module, builder)
        refuse_the_rest(module)
    return machine.emit_object(module)


def main() -> None:
    """Write kernels.o and data.o into the folder that the command line names."""
    if any(os.environ.get(name) != value for name, value in ENVIRONMENT.items()):
        os.execve(sys.executable, [sys.executable, "-m", "explorer.emit", *sys.argv[1:]], os.environ | ENVIRONMENT)
    from numba.core.errors import NumbaWarning

    warnings.simplefilter("ignore", NumbaWarning)  # unoptimised code cannot be cached
    from explorer import patch
    from fmu_src.native import emit, solver
    from fmu_src.native.kinds import SIGNATURES
    from fmu_src.tables.wheel_rail_pair import table

    folder = Path(sys.argv[1])
    entries, data = patch.entries(table()), solver.data()
    emit.make_no_machine_code()
    text = str(emit.linked(entries, data))
    (folder / "kernels.o").write_bytes(_object(text, tuple(SIGNATURES)))
    (folder / "data.o").write_bytes(_object(emit.data_as_ir(data), ()))


if __name__ == "__main__":
    main()
