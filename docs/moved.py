"""Addresses of pages that moved: `stubs` writes a page at each old address that leads to the new one."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from pathlib import Path

#: New folder → pages that once lay in the folder before the colon, or at the top. explorer.html is the explorer itself.
_FOLDERS = {
    "use": "getting_started install command_line scenarios gallery signs measured_profiles profiles which_model side_by_side "
    "surfaces own_vehicle lookup c_interface",
    "use/fmu": "fmu_guide fmu tools/fmpy tools/simulink tools/simpack tools/modelica tools/exudyn",
    "use/lessons": "lessons/by_hand lessons/five_methods lessons/run_and_damage",
    "understand": "theory strip_halfspace mapped_strip subsurface given_forces damage vehicle wear constants",
    "understand/thesis": "thesis/index thesis/chapter2 thesis/chapter3 thesis/chapter4 thesis/chapter5 thesis/chapter7 "
    "thesis/chapter9",
    "check": "measured proof accuracy normal_methods statistics manchester halfspace contact_features smoothness derivatives "
    "uncertainty coupling limits",
    "extend": "architecture style",
}
#: Old page → the place in the page that it was joined with.
_JOINED = {
    "transient": "understand/other_contacts.html#shift-and-transient-rolling",
    "unlike": "understand/other_contacts.html#unlike-materials",
    "third_body": "understand/other_contacts.html#third-body",
    "curved": "understand/other_contacts.html#curved-contact",
    "elastic_rail": "understand/other_wheels.html#a-rail-that-gives-way",
    "roller": "understand/other_wheels.html#roller-rig",
    "in_time": "understand/other_wheels.html#over-time",
    "thesis/errata": "understand/thesis/index.html#errors-in-the-thesis",
    "api/friction": "api/contact.html#friction",
    "api/halfspace": "api/contact.html#half-space",
    "api/stress": "api/contact.html#stresses-below-the-surface",
    "api/pair": "api/geometry.html#a-wheel-on-a-rail",
    "api/temperature": "api/damage.html#flash-temperature",
    "api/accumulation": "api/damage.html#over-a-profile",
    "api/plot": "api/study.html#pictures",
}


def moved() -> Iterator[tuple[str, str]]:
    """Yield old and new address, relative to the site."""
    for folder, pages in _FOLDERS.items():
        for page in pages.split():
            yield f"{page}.html", f"{folder}/{posixpath.basename(page)}.html"
    for page, place in _JOINED.items():
        yield f"{page}.html", place


def stubs(site: Path) -> None:
    """Write a page that leads on at every old address of the built site."""
    for old, new in moved():
        target = posixpath.relpath(new, posixpath.dirname(old) or ".")
        path = site / old
        if path.exists() and "http-equiv" not in path.read_text(encoding="utf-8"):
            raise FileExistsError(f"{path} is a page: it cannot lead to {new}")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(
            f'<!doctype html><meta charset="utf-8"><title>Moved</title><meta http-equiv="refresh" content="0; url={target}">'
            f'<p>This page is now <a href="{target}">{new}</a>.</p>\n',
            encoding="utf-8",
        )
