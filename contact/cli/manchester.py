"""The command `manchester`."""

from __future__ import annotations

from typing import Annotated

from contact.cli import options as opt
from contact.cli.compare import All, Elements, Resolution, compared
from contact.cli.output import prepare, reported
from contact.cli.progress import progress_bar
from contact.cli.tables import STUDY, show_study
from contact.study.compare import REFERENCE_ELEMENTS
from contact.study.manchester import METHODS, NOTES
from contact.study.manchester import manchester as compute
from contact.study.pairs import RESOLUTION

Methods = Annotated[
    list[str] | None,
    compared(
        "--method",
        help="normal+tangential, like analyn+fastrip; may be repeated. Default: " + ", ".join(map(str, METHODS)),
    ),
]


@reported
def manchester(
    methods: Methods = None,
    every: All = False,
    resolution: Resolution = RESOLUTION,
    reference_elements: Elements = REFERENCE_ELEMENTS,
    as_json: opt.Json = False,
    out: opt.Pages = None,
) -> None:
    """Compute the Manchester contact benchmark (A-2.2) and compare it with the results of CONTACT.

    Example:  contact manchester --method analyn+fastrip --method hertz+fastsim --out page.html
    """
    prepare(out, STUDY)
    with progress_bar() as bar:
        found = compute(
            [*(methods or []), "all"] if every else (methods or METHODS),
            n_strips=resolution,
            n_elements=resolution,
            reference_elements=reference_elements,
            progress=bar,
        )
    show_study(found, as_json=as_json, out=out, notes=NOTES)
