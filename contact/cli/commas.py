"""Numbers with a decimal comma among the words of a command: a message that names the decimal point."""

from __future__ import annotations

import re
from typing import Any

from typer.core import TyperGroup

from contact.cli.output import BAD_INPUT, stop

_COMMA = re.compile(r"[-+]?\d*,\d+([eE][-+]?\d+)?")


class Commands(TyperGroup):
    """The commands. A word that is a number with a decimal comma ends them with a message."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the words of the command line."""
        for k, word in enumerate(args):
            if _COMMA.fullmatch(word):
                option = f"{args[k - 1]} " if k and args[k - 1].startswith("--") else ""
                stop(f"{option}{word}: numbers have a decimal point, {word.replace(',', '.')}", BAD_INPUT)
        return super().parse_args(ctx, args)
