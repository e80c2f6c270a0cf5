"""The name that the package `models` has in an installation, in a checkout too: pages and examples import `contact_models`.

`contact_models.runs.scenario` is the same module as `models.runs.scenario`. A wheel does not hold this file: it installs the
folder `models` as `contact_models` (`setup.py`). `contact_fmu` does the same for `fmu_src`.
"""

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import InspectLoader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from types import CodeType, ModuleType


class Alias(MetaPathFinder, InspectLoader):
    """Finds `folder.x` for `name.x`. It comes first: otherwise the folders would make every module twice."""

    def __init__(self, name: str, folder: str) -> None:
        self._name, self._folder = name, folder
        sys.meta_path.insert(0, self)

    def _found(self, fullname: str) -> ModuleSpec | None:
        return find_spec(fullname.replace(self._name, self._folder, 1))

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return a spec for a module of the package, None for every other."""
        if not fullname.startswith(f"{self._name}.") or (found := self._found(fullname)) is None:
            return None
        package = found.submodule_search_locations is not None
        return ModuleSpec(fullname, self, origin=found.origin, is_package=package)

    def exec_module(self, module: ModuleType) -> None:
        """Put the module of the checkout in the place of `module`."""
        sys.modules[module.__name__] = import_module(module.__name__.replace(self._name, self._folder, 1))

    def get_code(self, fullname: str) -> CodeType | None:
        """Return the code of a module, for ``python -m``."""
        found = self._found(fullname)
        return found.loader.get_code(found.name) if found and isinstance(found.loader, InspectLoader) else None

    def get_source(self, fullname: str) -> str | None:
        """Return the source of a module."""
        found = self._found(fullname)
        return found.loader.get_source(found.name) if found and isinstance(found.loader, InspectLoader) else None


Alias(__name__, "models")
