"""Commands of other packages: entry points of the group `contact.commands`, each a function for typer.

`contact` must not import `models`, so `contact demo` is added to the command line in this way.
"""

from __future__ import annotations

from collections.abc import Iterable
from importlib.metadata import EntryPoint, entry_points

import typer

GROUP = "contact.commands"


def add_plugins(app: typer.Typer, found: Iterable[EntryPoint] | None = None) -> list[str]:
    """Add every command of the group to `app`. Return a message for each command that cannot be loaded."""
    problems = []
    for point in sorted(entry_points(group=GROUP) if found is None else found, key=lambda p: p.name):
        try:
            command = point.load()
        except (ImportError, AttributeError) as error:
            problems.append(f"the command {point.name!r} of {point.value} cannot be loaded: {error}")
        else:
            if isinstance(command, typer.Typer):
                app.add_typer(command, name=point.name, rich_help_panel="Models")
            else:
                app.command(point.name, rich_help_panel="Models")(command)
    return problems
