"""Rules for the content of an FMU file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree.ElementTree import Element

from . import reading

#: Platform of FMI 2.0 or 3.0 → ending of its libraries.
_LIBRARIES = {
    **{"linux64": ".so", "win64": ".dll", "darwin64": ".dylib"},
    **{"x86_64-linux": ".so", "x86_64-windows": ".dll", "x86_64-darwin": ".dylib", "aarch64-darwin": ".dylib"},
    "aarch64-linux": ".so",
}


def libraries_are_named(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """At least one platform has a library, and each platform has one for every interface:"""
    platforms = {name.split("/")[1] for name in files if name.startswith("binaries/")}
    for platform in platforms or {"any platform"}:
        for interface in reading.interfaces(root):
            name = f"binaries/{platform}/{interface.get('modelIdentifier')}{_LIBRARIES.get(platform, '')}"
            if name not in files:
                yield f"{name} is missing"


def guid_is_the_same(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """The guid is contained in the file of the model or the script, or without one in every library:"""
    guid = (root.get("guid", "") or root.get("instantiationToken", "")).encode()
    models = {name for name in files if re.fullmatch(r"resources/([^/]+\.py|model\.bin)", name)}
    for name in models or {name for name in files if name.startswith("binaries/")}:
        if not guid or guid not in files[name]:
            yield f"not in {name}"


def licences_are_enclosed(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """The licences are included:"""
    if not any(name.startswith("documentation/licenses/") and content.strip() for name, content in files.items()):
        yield "documentation/licenses is empty"


def names_are_portable(root: Element, files: dict[str, bytes]) -> Iterator[str]:
    """File names are portable and differ in more than upper and lower case:"""
    for name in files:
        if not re.fullmatch(r"[\w.-]+(/[\w.-]+)*", name, re.ASCII) or ".." in name.split("/"):
            yield name
    if len({name.lower() for name in files}) < len(files):
        yield "some differ only in upper and lower case"


RULES = (libraries_are_named, guid_is_the_same, licences_are_enclosed, names_are_portable)
