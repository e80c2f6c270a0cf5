"""Base class of the results of studies: tables, a picture, and files."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from contact.study.files import write
from contact.study.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Report(ABC):
    """Results of a study, which can be shown as text, as a picture and as a page."""

    title: ClassVar[str]

    @property
    @abstractmethod
    def about(self) -> Sequence[str]:
        """Paragraphs of explanation for the tables."""

    @abstractmethod
    def tables(self) -> list[Table]:
        """Return the tables for a terminal."""

    @abstractmethod
    def figure(self) -> Figure:
        """Return the picture."""

    @abstractmethod
    def parts(self) -> Iterable[str]:
        """Return the parts of a page below the paragraphs, in HTML."""

    @abstractmethod
    def csv(self) -> str:
        """Return all numbers as CSV, one line per result, in SI units."""

    @abstractmethod
    def json(self) -> str:
        """Return all results without fields as JSON, in SI units, under the names of the Python API."""

    def markdown(self) -> str:
        """Return the tables in Markdown."""
        return "\n\n".join([f"# {self.title}", *self.about, *(table.markdown() for table in self.tables())]) + "\n"

    def html(self) -> str:
        """Return a self-contained HTML page."""
        from contact.study.page import document

        return document(self.title, self.about, self.parts())

    def write(self, path: str | Path) -> None:
        """Write numbers (.json, .csv), tables (.md), the picture (.png, .pdf, .svg) or a page (.html).

        The ending of `path` selects which of them.

        Raises
        ------
        ContactError
            For any other ending, or if the file cannot be written.
        """
        texts = {".html": self.html, ".md": self.markdown, ".json": self.json, ".csv": self.csv}
        write(path, texts, self.figure)
