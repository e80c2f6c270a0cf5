"""Packages and the folders that hold them: `fmu_src` and `models` are installed as `contact_fmu` and `contact_models`.

Their names in the repository could clash with those of other packages: a user's own `models.py` would break the command line.
Both import their own modules relatively, and each other by the installed names. An editable installation has both names.
"""

import sys

from setuptools import find_namespace_packages, setup

FOLDERS = {"contact": "contact", "contact_fmu": "fmu_src", "contact_models": "models"}

if "editable_wheel" in sys.argv:
    setup(packages=find_namespace_packages(include=["contact*", "fmu_src*", "models*"]))
else:
    parts = ((name, part) for name, folder in FOLDERS.items() for part in ("", *find_namespace_packages(folder)))
    setup(package_dir=FOLDERS, packages=[f"{name}.{part}".rstrip(".") for name, part in parts])
