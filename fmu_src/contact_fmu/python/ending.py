"""The end of a process that has loaded FMUs for hosts with Python.

pythonfmu 0.7.0 releases its state twice then: as a static object, and in the function `finalizePythonInterpreter`, which is
also the destructor of the FMU's library and writes into the freed block (seen with valgrind). Now and then glibc therefore
ended a process after all results were right: "corrupted double-linked list". Called before, while the state is valid, the
function clears the pointer to it, and neither of the two finds anything later.
"""

from __future__ import annotations

import atexit
import ctypes
import os
from functools import cache
from pathlib import Path


@cache
def release_once(resources: str) -> None:
    """Let Python release, when it ends, what pythonfmu's library keeps. `resources` is the folder of the FMU's resources."""
    if not hasattr(os, "RTLD_NOLOAD"):  # Windows, where the library has no such destructor
        return
    for path in Path(resources).resolve().parent.glob("binaries/*/pythonfmu-export.so"):
        try:
            library = ctypes.CDLL(str(path), os.RTLD_NOLOAD)
        except OSError:  # not the library that the host has loaded
            continue
        atexit.register(library.finalizePythonInterpreter)
