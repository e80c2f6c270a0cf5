"""Names of the packages in an installation, without building a wheel (`.ci/try_wheel` does)."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
INSTALLED = {"contact": "contact", "contact_fmu": "fmu_src/contact_fmu", "contact_models": "models/contact_models"}


def test_packages_are_imported_beside_modules_of_a_user_that_have_the_names_of_our_folders(tmp_path):
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
