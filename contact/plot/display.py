"""Figures of this package show themselves in notebooks, which draw only those of pyplot unless they are told."""

from __future__ import annotations

import sys
from typing import Any

from matplotlib.figure import Figure


def show_in_notebooks() -> None:
    """Register PNG for figures in a notebook that has no format for them. Elsewhere this does nothing."""
    ipython: Any = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is None or any(
        Figure in formatter.type_printers for formatter in shell.display_formatter.formatters.values()
    ):
        return
    from IPython.core.pylabtools import select_figure_formats

    select_figure_formats(shell, {"png"})
