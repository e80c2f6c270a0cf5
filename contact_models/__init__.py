"""The name that the package `models` has in an installation, in a checkout too: pages and examples import `contact_models`.

`contact_models.life.scenario` is the same module as `models.life.scenario`. A wheel does not hold this file: it installs the
folder `models` as `contact_models` (`setup.py`). `contact_fmu` does the same for `fmu_src`.
"""

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType


class Alias(MetaPathFinder, Loader):
    """Finds `folder.x` for `name.x`. It comes first: otherwise the folders would make every module twice."""

    def __init__(self, name: str, folder: str) -> None:
        self._name, self._folder = name, folder
        sys.meta_path.insert(0, self)

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return a spec for a module of the package, None for every other."""
        return ModuleSpec(fullname, self) if fullname.startswith(f"{self._name}.") else None

    def exec_module(self, module: ModuleType) -> None:
        """Put the module of the checkout in the place of `module`."""
        sys.modules[module.__name__] = import_module(module.__name__.replace(self._name, self._folder, 1))


Alias(__name__, "models")
