"""Names of the packages in an installation, without building a wheel (`.ci/try_wheel` does)."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
INSTALLED = {"contact": "contact", "contact_fmu": "fmu_src", "contact_models": "models"}


def test_setuptools_installs_contact_and_names_that_begin_with_it(tmp_path):
    pytest.importorskip("setuptools")
    code = (
        "import setuptools, runpy; found = {}; setuptools.setup = lambda **given: found.update(given); "
        "runpy.run_path('setup.py'); print(found['package_dir'], *found['packages'])"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    folders, packages = done.stdout.split("}")
    assert folders + "}" == str(INSTALLED)
    for name, folder in INSTALLED.items():
        modules = {path.parent for path in (ROOT / folder).rglob("*.py") if "__pycache__" not in path.parts}
        wanted = {".".join((name, *path.relative_to(ROOT / folder).parts)) for path in modules}
        assert wanted <= set(packages.split())


def test_packages_are_imported_beside_modules_of_a_user_that_have_the_old_names(tmp_path):
    installed, user = tmp_path / "installed", tmp_path / "user"
    for folder in (installed, user):
        folder.mkdir()
    for name, folder in INSTALLED.items():
        (installed / name).symlink_to(ROOT / folder, target_is_directory=True)
    for name in ("models.py", "fmu_src.py", "tests.py"):
        (user / name).write_text("raise RuntimeError('a module of the user was imported')\n")
    modules = [
        ".".join((name, *path.relative_to(ROOT / folder).with_suffix("").parts))
        for name, folder in INSTALLED.items()
        for path in (ROOT / folder).rglob("*.py")
        if name != "contact" and path.name != "__init__.py"
    ]
    assert len(modules) > 50
    code = (
        f"import sys; sys.path[:0] = ['', {str(installed)!r}]; import importlib\n"
        f"for name in {modules!r}: importlib.import_module(name)\n"
        "assert not {'models', 'fmu_src', 'tests'} & set(sys.modules)"
    )
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=user, env=clean, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_the_names_of_an_installation_work_in_a_checkout(tmp_path):
    """And they give the same modules, so that objects of both names are of the same classes."""
    code = (
        "import contact_models.vehicle.track as installed; from contact_models.vehicle import spectra; "
        "import models.vehicle.track, models.vehicle.spectra; from contact_fmu import variables; import fmu_src.variables; "
        "assert installed is models.vehicle.track and spectra is models.vehicle.spectra and variables is fmu_src.variables"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True)
    for module in ("contact_fmu.lint", "contact_fmu.lint.__main__"):  # a package and a module, as programs
        command = [sys.executable, "-m", module, "no_file.fmu"]
        done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
        assert "no_file.fmu" in done.stderr
