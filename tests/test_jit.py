"""Sources that hold no kernel do not count for the cache of compiled kernels; then no kernel may come from them."""

import re
from pathlib import Path

import contact
import models
from contact import _jit

ROOTS = [Path(package.__path__[0]) for package in (contact, models)]
WITHOUT = [(root, root / part) for part in _jit._WITHOUT_KERNELS for root in ROOTS if (root / part).exists()]


def sources(path):
    return sorted(path.rglob("*.py")) if path.is_dir() else [path]


def test_excluded_sources_exist_and_hold_no_kernel():
    assert len(WITHOUT) == len(_jit._WITHOUT_KERNELS)
    for _, part in WITHOUT:
        for path in sources(part):
            assert not re.search(r"^\s*@kernel|import.*\bkernel\b", path.read_text(encoding="utf-8"), re.M), path


def test_no_source_with_kernels_imports_an_excluded_one():
    names = "|".join(
        re.escape(".".join((root.name, *p.relative_to(root).with_suffix("").parts))) for root, p in WITHOUT
    )
    for path in [path for root in ROOTS for path in sources(root)]:
        text = path.read_text(encoding="utf-8")
        if re.search(r"^@kernel", text, re.M):
            assert not re.search(rf"^\s*(from|import) ({names})\b", text, re.M), path
