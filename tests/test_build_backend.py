"""Build backend: the sources of a wheel, without building one (`.ci/try_wheel` does)."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("setuptools")
ROOT = Path(__file__).parents[1]
_found = importlib.util.spec_from_file_location("build_backend", ROOT / "tools" / "build_backend.py")
backend = importlib.util.module_from_spec(_found)
_found.loader.exec_module(backend)


@pytest.fixture(scope="module")
def laid_out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    backend.lay_out(ROOT, folder)
    return folder


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("from fmu_src import archive", "from contact_fmu import archive"),
        ("import fmu_src.ssp", "import contact_fmu.ssp"),
        ('run("-m", "fmu_src.native.emit")', 'run("-m", "contact_fmu.native.emit")'),
        ("    from models.life import report", "    from contact_models.life import report"),
        ("import models", "import contact_models"),
        ('demo = "models.wheelset.demo:demo"', 'demo = "contact_models.wheelset.demo:demo"'),
        (
            "`models.wheelset.ports`, models/life/wear.py",
            "`contact_models.wheelset.ports`, contact_models/life/wear.py",
        ),
        ("from fmu_src.catalogue import Model, models", "from contact_fmu.catalogue import Model, models"),
        ("for model in models(points): models.append(1)", "for model in models(points): models.append(1)"),
        ("Constants of the damage models. models.py", "Constants of the damage models. models.py"),
        ("from contact.models import x", "from contact.models import x"),
    ],
)
def test_only_the_names_of_the_two_packages_change(text, expected):
    assert backend.renamed(text) == expected


def test_a_wheel_is_built_of_contact_and_names_that_begin_with_it(laid_out):
    assert {path.name for path in laid_out.iterdir() if path.is_dir()} == {"contact", "contact_fmu", "contact_models"}


def test_the_solver_is_packed_as_it_is(laid_out):
    for path in (ROOT / "contact").rglob("*.py"):
        assert (laid_out / path.relative_to(ROOT)).read_bytes() == path.read_bytes()


def test_an_import_by_the_old_name_is_refused(tmp_path):
    path = tmp_path / "module.py"
    path.write_text("import contact, models\n")
    with pytest.raises(RuntimeError, match=r"module.py, line 1: models is imported by its name in the repository"):
        backend._rename_in(path)


def test_packages_are_imported_beside_modules_of_a_user_that_have_the_old_names(laid_out, tmp_path):
    for name in ("models.py", "fmu_src.py", "tests.py"):
        (tmp_path / name).write_text("raise RuntimeError('a module of the user was imported')\n")
    modules = [
        ".".join(path.relative_to(laid_out).with_suffix("").parts)
        for package in ("contact_fmu", "contact_models")
        for path in (laid_out / package).rglob("*.py")
        if path.name != "__init__.py"
    ]
    assert len(modules) > 50
    code = (
        f"import sys; sys.path[:0] = ['', {str(laid_out)!r}]; import importlib\n"
        f"for name in {modules!r}: importlib.import_module(name)\n"
        "assert not {'models', 'fmu_src', 'tests'} & set(sys.modules)"
    )
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, env=clean, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_the_name_of_an_installation_works_in_a_checkout(tmp_path):
    """And it gives the same modules, so that objects of both names are of the same classes."""
    code = (
        "import contact_models.life.track as installed; from contact_models.life import spectra; "
        "import models.life.track, models.life.spectra; "
        "assert installed is models.life.track and spectra is models.life.spectra"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True)
