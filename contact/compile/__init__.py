"""How kernels become the library: numba's code, LLVM's objects for each system, the same as C, and the linker.

`library` runs in a process of its own. What packages add beside `contact` stands in pyproject.toml, `[tool.contact.library]`.
"""
