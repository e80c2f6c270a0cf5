"""Sources that hold no kernel do not count for the cache of compiled kernels; then no kernel may come from them."""

import re
from pathlib import Path

import contact
from contact import _jit

ROOT = Path(contact.__file__).parent
WITHOUT = [ROOT / part for part in _jit._WITHOUT_KERNELS]


def sources(path):
    return sorted(path.rglob("*.py")) if path.is_dir() else [path]


def test_excluded_sources_exist_and_hold_no_kernel():
    for part in WITHOUT:
        assert part.exists(), part
        for path in sources(part):
            assert not re.search(r"^\s*@kernel|import.*\bkernel\b", path.read_text(encoding="utf-8"), re.M), path


def test_no_source_with_kernels_imports_an_excluded_one():
    names = "|".join(re.escape(".".join(("contact", *p.relative_to(ROOT).with_suffix("").parts))) for p in WITHOUT)
    for path in sources(ROOT):
        text = path.read_text(encoding="utf-8")
        if re.search(r"^@kernel", text, re.M):
            assert not re.search(rf"^\s*(from|import) ({names})\b", text, re.M), path
