"""Parse a page of a report."""

from html.parser import HTMLParser


class Page(HTMLParser):
    """Links, texts and tags of a page."""

    def __init__(self):
        super().__init__()
        self.links, self.cells, self.tags = [], [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.links += [value for name, value in attrs if name in ("src", "srcset", "href", "data")]

    def handle_data(self, data):
        self.cells.append(data.strip())
