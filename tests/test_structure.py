"""Allowed imports, checked in the sources, including imports inside functions."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = ("contact", "fmu_src", "models", "reference", "tests", "benchmarks", "examples", "docs")


def sources(*folders: str) -> list[Path]:
    return sorted(path for folder in folders for path in (ROOT / folder).rglob("*.py"))


def parts_of(path: Path) -> tuple[str, ...]:
    """Return the parts of the name under which a file is imported; the folders `fmu_src` and `models` hold packages."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return parts[1:] if parts[0] in ("fmu_src", "models") else parts


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def imports(path: Path) -> tuple[str, ...]:
    """Return the full names that a file imports, `a.b.c` for `from a.b import c`, in functions too."""
    return tuple(imported(tree(path), path))


def imported(part: ast.AST, path: Path) -> Iterator[str]:
    """Yield the full names that a part of the file `path` imports."""
    package = parts_of(path)[:-1]
    for node in ast.walk(part):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            module = ".".join((*above, *(node.module or "").split("."))).strip(".")
            yield from (f"{module}.{alias.name}" for alias in node.names)


def strings(path: Path) -> Iterator[str]:
    """Yield all strings of a file except docstrings and other expression statements."""
    alone = {id(node.value) for node in ast.walk(tree(path)) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in alone:
            yield node.value


def is_test(name: str) -> bool:
    return any(part.startswith("test_") or part == "conftest" for part in name.split("."))


def found(folders: tuple[str, ...], refused) -> list[str]:
    """Return the refused imports of files in `folders`, as "file: name"."""
    return [
        f"{path.relative_to(ROOT)}: {name}" for path in sources(*folders) for name in imports(path) if refused(name)
    ]


def test_no_test_is_imported():
    modules = {path.stem for path in sources("tests") if is_test(path.stem)}

    def refused(name):
        parts = name.split(".")
        return parts[0] in modules or (parts[0] == "tests" and any(part in modules for part in parts[1:3]))

    assert found(("tests", "benchmarks", "reference"), refused) == []


def test_tests_import_no_benchmark():
    assert found(("tests",), lambda name: name.split(".")[0] == "benchmarks") == []


def test_benchmarks_and_reference_do_not_import_tests():
    assert found(("benchmarks", "reference"), lambda name: name.split(".")[0] == "tests") == []
    assert found(("reference",), lambda name: name.split(".")[0] == "benchmarks") == []
    read = [
        f"{path.relative_to(ROOT)}: {text}"
        for path in sources("benchmarks", "reference")
        for text in strings(path)
        if text == "tests" or "tests/" in text
    ]
    assert read == []


def test_the_library_imports_neither_tests_nor_what_they_share():
    others = {"tests", "benchmarks", "reference"}
    assert found(("contact", "fmu_src", "models"), lambda name: name.split(".")[0] in others) == []


def test_private_modules_of_contact_stay_in_contact():
    def private(name):
        parts = name.split(".")
        return parts[0] == "contact" and any(is_private_module(parts[: k + 1]) for k in range(1, len(parts)))

    for path in [*sources(*(folder for folder in FOLDERS if folder != "contact")), ROOT / "build_fmu.py"]:
        assert not set(filter(private, imports(path))), path


def counted_names(path: Path) -> list[str]:
    """Return the names to which a file assigns a list of numbers, as in ``A, B, C = range(3)``."""
    names: list[str] = []
    for node in tree(path).body:
        if not (isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Tuple)):
            continue
        value = node.value
        counted = isinstance(value, ast.Call) and getattr(value.func, "id", "") in {"range", "map"}
        if counted or (isinstance(value, ast.GeneratorExp) and "range" in ast.dump(value)):
            names += [ast.unparse(target) for target in node.targets[0].elts]
    return names


def test_rows_and_states_are_enumerations():
    """An `IntEnum` names them. So nobody imports a list of row names."""
    counted = {path.relative_to(ROOT).as_posix(): counted_names(path) for path in sources("contact", "fmu_src")}
    assert {path: names for path, names in counted.items() if names} == {}


@pytest.mark.parametrize("line", ["A, B = range(2)", "A, B = (16 * row for row in range(2))"])
def test_counted_names_are_found(line, tmp_path):
    path = tmp_path / "some.py"
    path.write_text(line + "\nC, D = 1.0, 2.0\n")
    assert counted_names(path) == ["A", "B"]


def is_private_module(parts: list[str]) -> bool:
    path = ROOT.joinpath(*parts)
    private = parts[-1].startswith("_") and not parts[-1].startswith("__")
    return private and (path.with_suffix(".py").exists() or path.is_dir())


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("import a.b", "a.b"),
        ("from a.b import c as d", "a.b.c"),
        ("def f():\n    from a import b", "a.b"),
        ("from . import b", "tests.b"),
        ("from .a import b", "tests.a.b"),
    ],
)
def test_imports_are_found(line, name, tmp_path, monkeypatch):
    """Test the reader itself, since all rules above would hold if it found nothing."""
    monkeypatch.setattr(f"{__name__}.ROOT", tmp_path)
    (tmp_path / "tests").mkdir()
    path = tmp_path / "tests" / "some.py"
    path.write_text(line)
    assert list(imports(path)) == [name]


#: Imports inside functions that close a circle, and why.
CLOSING = {
    ("contact.core.calls", "contact.core.compiled"),  # only where numba compiles: without it, numba is not there
    ("contact.inp.case", "contact.inp.run"),  # `Case.solve` stands for `contact.inp.solve([case])`
}


def imports_to_run(path: Path) -> Iterator[str]:
    """Yield what a file imports, in functions too and by strings, but not for types alone."""
    for_types = {
        name
        for node in tree(path).body
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        for name in imported(node, path)
    }
    yield from (name for name in imports(path) if name not in for_types)
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
            yield from (word.value for word in ast.walk(node) if isinstance(word, ast.Constant))


def module_of(name: str) -> str:
    """Return the module of the library in which a name is; empty for other names, and for packages as a whole."""
    parts = name.split(".")
    while len(parts) > 1:
        for folder in ("", "fmu_src", "models"):
            path = ROOT.joinpath(folder, *parts)
            if path.with_suffix(".py").is_file() or (path / "__init__.py").is_file():
                return ".".join(parts)
        parts.pop()
    return ""


def circle(modules: dict[str, set[str]]) -> list[str]:
    """Return modules of which each imports the next and the last the first; none if there is no such circle."""
    try:
        tuple(TopologicalSorter(modules).static_order())
    except CycleError as error:
        return error.args[1]
    return []


def test_no_import_closes_a_circle():
    """Nor does one in a function or by a string, `import_module("contact.plot")`, which import-linter does not see."""
    modules = {}
    for path in sources("contact", "fmu_src", "models"):
        parts = parts_of(path)
        name = ".".join(parts[:-1] if path.stem == "__init__" else parts)
        modules[name] = {module for one in imports_to_run(path) if (module := module_of(one)) != name} - {""}
    assert all(module in modules[name] for name, module in CLOSING)
    for name, module in CLOSING:
        assert circle(modules) != []
        modules[name].discard(module)
    assert circle(modules) == []


def test_a_circle_by_a_string_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr(f"{__name__}.ROOT", tmp_path)
    (tmp_path / "tests").mkdir()
    one, other = tmp_path / "tests" / "one.py", tmp_path / "tests" / "other.py"
    one.write_text("from tests.other import x")
    other.write_text('def f():\n    return import_module("tests.one")')
    assert circle({f"tests.{path.stem}": set(map(module_of, imports_to_run(path))) for path in (one, other)})


def test_no_source_is_longer_than_400_lines():
    """The header of records is generated."""
    folders = (*FOLDERS, "explorer", "tools")
    files = [path for folder in folders for end in ("py", "c", "h", "js") for path in (ROOT / folder).rglob(f"*.{end}")]
    lines = {path: path.read_text(encoding="utf-8").count("\n") for path in files if path.name != "wheelrail_records.h"}
    assert len(lines) > 700
    assert [str(path.relative_to(ROOT)) for path, n in lines.items() if n > 400] == []


def test_every_page_that_a_source_names_exists():
    pages = {
        path.name for folder in ("docs", "reference", "examples", "models") for path in (ROOT / folder).rglob("*.md")
    }
    pages |= {path.name for path in ROOT.glob("*.md")}
    files = [
        path
        for folder in ("contact", "fmu_src", "models", "benchmarks", "explorer")
        for path in (ROOT / folder).rglob("*")
    ]
    named = {
        f"{path.relative_to(ROOT)}: {name}"
        for path in files
        if path.suffix in {".py", ".c", ".h", ".js"}
        for name in re.findall(r"\b([\w-]+\.md)\b", path.read_text(encoding="utf-8"))
        if name not in pages
    }
    assert named == set()


def test_no_kernel_indexes_a_tuple_by_enumerate_or_zip():
    """Such an index could raise, which plain C code of the kernels keeps: then no native FMU is built, minutes later."""
    calls = {
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in sources("contact/kernels")
        for node in ast.walk(tree(path))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("enumerate", "zip")
    }
    assert calls == set()
