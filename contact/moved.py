"""Import paths of earlier versions: `contact.roller` is now `contact.pair.roller`. They work until 1.0, with a warning."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

#: Earlier name → name now.
MOVED = {
    "contact.absence": "contact.errors",
    "contact.contact_damping": "contact.pair.contact_damping",
    "contact.driven": "contact.pair.earlier",
    "contact.elastic_rail": "contact.pair.elastic_rail",
    "contact.force_table": "contact.theory.force_table",
    "contact.friction_memory": "contact.pair.friction_memory",
    "contact.in_time": "contact.pair.earlier",
    "contact.jacobian": "contact.solution.jacobian",
    "contact.kalker": "contact.theory.kalker",
    "contact.passage": "contact.pair.earlier",
    "contact.poses": "contact.pair.poses",
    "contact.pressure": "contact.solution.pressure",
    "contact.resultants": "contact.solution.resultants",
    "contact.rising_root": "contact.given_force",
    "contact.roller": "contact.pair.roller",
    "contact.surface_pair": "contact.pair.halfspace",
    "contact.temperature": "contact.damage.temperature",
}


class MovedModule(MetaPathFinder, Loader):
    """Finds modules by their earlier names. It comes last, so it is asked only for what nobody else finds."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return a spec for an earlier name, None for every other."""
        return ModuleSpec(fullname, self) if fullname in MOVED else None

    def exec_module(self, module: ModuleType) -> None:
        """Fill `module` with the names of the module that has taken its place."""
        now = MOVED[module.__name__]
        warnings.warn(f"{module.__name__} has moved: import {now}", DeprecationWarning, stacklevel=2)
        names = vars(import_module(now))
        vars(module).update({name: value for name, value in names.items() if not name.startswith("__")})
