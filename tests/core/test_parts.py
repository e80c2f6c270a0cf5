"""The parts of a checkout's library: each is kept under a hash of what it is made from, and of nothing else."""

import ast
import shutil

import pytest

from contact.core import checkout

PARTS = ("first", "halfspace", "", "systems")
MARKS = {"kernel", "entry", "inlined", "shared", "arranging", "group"}


@pytest.fixture
def clone(tmp_path, monkeypatch):
    """Return a copy of the sources, of which `checkout` then makes the names of the parts."""
    for path in {path for part in PARTS for path in checkout.sources(part)} | {checkout._PROJECT}:
        copied = tmp_path / path.relative_to(checkout._ROOT)
        copied.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, copied)
    original = checkout._ROOT
    for name in ("_ROOT", "_HERE", "_PROJECT"):
        monkeypatch.setattr(checkout, name, tmp_path / getattr(checkout, name).relative_to(original))
    return tmp_path


def names() -> dict[str, str]:
    """Return the name of each part."""
    return {part: checkout.fingerprint.__wrapped__(part) for part in PARTS}


@pytest.mark.parametrize(
    ("file", "renamed"),
    [
        ("contact/halfspace/norm.py", {"halfspace", "systems"}),
        ("contact/kernels/stress/below.py", {"halfspace", "", "systems"}),
        ("contact/kernels/damage/archard.py", {"first", "", "systems"}),
        ("contact/kernels/geometry/search.py", {"", "systems"}),
        ("contact/kernels/entries/pair.py", {"", "systems"}),  # imported within a function
        ("models/contact_models/vehicle/kernels/layout.py", {"", "systems"}),  # has records and no kernel
        ("contact/kernels/records.py", set(PARTS)),
        ("contact/data/creep_table.csv", {"first", "", "systems"}),
        ("contact/data/effective_creepage.csv", {"first", "", "systems"}),
        ("contact/theory/kalker.py", {"first", "", "systems"}),
        ("contact/theory/strips.py", {"first", "", "systems"}),
        ("contact/compile/emit.py", set(PARTS)),
        ("contact/c/pair.c", {"", "systems"}),
        ("contact/c/library.c", set(PARTS)),
        ("contact/include/wheelrail.h", set(PARTS)),
    ],
)
def test_a_changed_file_renames_the_parts_that_are_made_from_it_and_no_other(clone, file, renamed):
    before = names()
    with (clone / file).open("a") as changed:
        changed.write("\n")
    after = names()
    assert {part for part in PARTS if before[part] != after[part]} == renamed


@pytest.mark.parametrize(
    "line", ["    from contact.kernels.geometry import far", "    from .geometry.far import (\n        f,\n    )"]
)
def test_a_file_that_a_kernel_comes_to_import_is_a_source_from_then_on(clone, line):
    """Also if it is imported in a function, by whatever name."""
    far = clone / "contact/kernels/geometry/far.py"
    far.write_text("f = 1\n")
    assert all(far not in checkout.sources(part) for part in PARTS)
    with (clone / "contact/kernels/solver.py").open("a") as changed:
        changed.write(f"\n\ndef of_far():\n{line}\n")
    assert {part for part in PARTS if far in checkout.sources(part)} == {"first", "", "systems"}


def test_the_sources_are_kernels_builder_and_tables_and_nothing_of_python_alone():
    named = {part: {path.name for path in checkout.sources(part)} for part in PARTS}
    assert {"strip_halfspace.py", "motion.py", "emit.py", "force_table.py", "creep_table.csv"} <= named[""]
    assert {"zones.py", "heat.py", "below.py", "emit.py"} <= named["halfspace"]
    for names in named.values():
        assert not names & {"solve.py", "errors.py", "solution.py", "workspace.py"}


def test_the_imports_that_are_found_are_those_of_python():
    for name, path in checkout._known().items():
        found, package = set(checkout._imported(name, path)), checkout._package(name, path)
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                assert found >= {one.name for one in node.names}
            elif isinstance(node, ast.ImportFrom):
                module = checkout.resolve_name("." * node.level + (node.module or ""), package)
                assert found >= {module, *(f"{module}.{one.name}" for one in node.names)}, path


def used_by_kernels(tree: ast.Module) -> set[str]:
    """Return the names from outside of them that kernels, groups of arrays and constants of a module use."""
    used: set[str] = set()
    for statement in tree.body:
        marks = {getattr(mark, "id", "") for mark in getattr(statement, "decorator_list", ())}
        if isinstance(statement, ast.Assign | ast.AnnAssign | ast.Expr) or MARKS & marks:
            nodes = list(ast.walk(statement))
            own = {node.arg for node in nodes if isinstance(node, ast.arg)}
            own |= {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
            used |= {node.id for node in nodes if isinstance(node, ast.Name)} - own
    return used


def test_a_kernel_uses_nothing_that_is_no_source():
    """Else the library would keep its name after a change of what is compiled into it."""
    known, here = checkout._known(), {"contact", "contact_models", "contact_fmu"}
    for name, path in known.items():
        if not checkout._has_kernels(path) or name.startswith("contact.compile"):
            continue
        tree = ast.parse(path.read_text())
        used = used_by_kernels(tree)
        for node in tree.body:
            if not isinstance(node, ast.ImportFrom):
                continue
            module = checkout.resolve_name("." * node.level + (node.module or ""), checkout._package(name, path))
            if module.split(".")[0] in here:
                for one in node.names:
                    if (one.asname or one.name) in used:
                        assert {module, f"{module}.{one.name}"} & set(known), f"{path}: {one.name}"


def test_the_parts_have_all_entries_between_them():
    every = {name for _, name in checkout.modules()}
    assert {name for name in every if checkout.has("systems", name)} == every
    assert {name for name in every if checkout.has("", name) or checkout.has("halfspace", name)} == every
    assert {name for name in every if checkout.has("first", name)} < {name for name in every if checkout.has("", name)}
    for name in every:
        assert checkout.has(checkout.part_of(name), name)
