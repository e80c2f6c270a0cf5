"""The documentation site: `make docs` builds it into build/docs/html; warnings are errors."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from pathlib import Path

from jupyter_client.manager import KernelManager
from sphinx.application import Sphinx

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "docs")]

import generated  # noqa: E402

import contact  # noqa: E402

project = "wheelrail-contact"
author = "the wheelrail-contact authors"
copyright = f"2026, {author}"
release = version = contact.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx-mathjax-offline", "sphinx.ext.viewcode", "numpydoc"]
exclude_patterns = ["pictures"]
myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

html_theme = "furo"
html_title = "wheelrail-contact"
html_static_path = ["_static"]
# `make docs` writes the explorer before; without it the frame on the first page stays empty.
html_extra_path = [str(path) for path in [ROOT / "dist" / "explorer.html"] if path.exists()]
html_css_files = ["site.css"]
html_show_sourcelink = False

# Docstrings name things in single backticks: a link where Sphinx knows the name, code where it does not.
default_role = "py:obj"
autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False


def _sources() -> str:
    """A key of what executed pages compute with besides their own text."""
    digest = hashlib.sha256()
    for folder in ("contact", "docs"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


# A page is executed again when its text or one of these sources has changed.
nb_execution_mode = "cache"
nb_execution_cache_path = str(ROOT / "build" / "docs" / "executed" / _sources())
nb_execution_timeout = 1800  # [s] a cell; the first one may compile all kernels on a busy machine
nb_execution_raise_on_error = True
nb_execution_show_tb = True
if hasattr(
    KernelManager, "transport_encryption"
):  # without it every executed page warns of a kernel that is not encrypted
    KernelManager.transport_encryption.default_value = "auto"
nb_render_markdown_format = "myst"
nb_code_prompt_show = "How this is drawn"
nb_code_prompt_hide = "How this is drawn"


def _escape_bars(app: Sphinx, what: str, name: str, item: object, options: object, lines: list[str]) -> None:
    """In docstrings |F| is an absolute value, in reStructuredText a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def _is_alias(app: Sphinx, what: str, name: str, item: object, skip: bool, options: object) -> bool | None:
    """Fields of a named tuple have no documentation of their own: the class has it."""
    return True if (item.__doc__ or "").startswith("Alias for field number") else None


def _append_generated(app: Sphinx, page: str, source: list[str]) -> None:
    """Append what is made from the code: variables of the FMUs, keys of scenarios, options of the command line."""
    if page in ("use/scenarios", "use/command_line"):
        source[0] += getattr(generated, page.removeprefix("use/"))()
    if page == "use/fmu/fmu":
        command = [sys.executable, ROOT / "build_fmu.py", "--packaging", "all", "--surfaces", "--describe"]
        source[0] += subprocess.run(command, check=True, capture_output=True, text=True).stdout


def setup(app: Sphinx) -> None:
    app.connect("autodoc-process-docstring", _escape_bars, priority=400)  # before numpydoc
    app.connect("autodoc-skip-member", _is_alias)
    app.connect("source-read", _append_generated)
