"""Check the built site: links inside it, and figures that are shown.

`make docs` runs it; it needs no network.

python docs/check.py build/docs/html
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """Names that can be linked to, and links, of one page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.names: set[str] = set()
        self.links: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if value and name in ("id", "name"):
                self.names.add(value)
            if value and name in ("href", "src") and tag in ("a", "img", "link", "script", "iframe", "source"):
                self.links.append(value)


def broken_links(site: Path) -> Iterator[str]:
    """Yield every link of the site that leads to no file or to no place in its page."""
    pages = {path.resolve(): Page(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            target = target / "index.html" if target.is_dir() else target
            where = path.relative_to(site.resolve())
            if not target.exists():
                yield f"{where}: {link} leads to no file"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].names:
                yield f"{where}: {link} leads to no place in {target.name}"


def missing_figures(site: Path) -> Iterator[str]:
    """Yield every page that has the name of a figure in place of its picture."""
    for path in sorted(site.rglob("*.html")):
        if "&lt;Figure size" in path.read_text(encoding="utf-8"):
            yield f"{path.relative_to(site)}: a figure is not drawn"


def main() -> None:
    """Print what is wrong; the exit code is 1 if anything is."""
    site = Path(sys.argv[1])
    if not (site / "index.html").is_file():
        raise SystemExit(f"{site} holds no site")
    wrong = [*broken_links(site), *missing_figures(site)]
    sys.stderr.writelines(f"{line}\n" for line in wrong)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
