"""The name that the package `models` has in an installation, in a checkout too: pages and examples import `contact_models`.

`contact_models.life.scenario` is the same module as `models.life.scenario`. A wheel does not hold this file: there `models`
itself is named `contact_models` (`tools/build_backend.py`).
"""

import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType


class _Checkout(MetaPathFinder, Loader):
    """Finds `models.x` for `contact_models.x`. It comes first: the folders of `models` would make every module twice."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return a spec for a module of this package, None for every other."""
        return ModuleSpec(fullname, self) if fullname.startswith(f"{__name__}.") else None

    def exec_module(self, module: ModuleType) -> None:
        """Put the module of the checkout in the place of `module`."""
        sys.modules[module.__name__] = import_module(module.__name__.replace(__name__, "models", 1))


sys.meta_path.insert(0, _Checkout())
