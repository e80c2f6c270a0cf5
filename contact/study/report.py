"""What the results of a study have in common: tables, a picture, and the files that they are written to."""

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
    """Results that can be shown as text, as a picture and as a page."""

    title: ClassVar[str]

    @property
    @abstractmethod
    def about(self) -> Sequence[str]:
        """Paragraphs: what a reader of the tables needs to know."""

    @abstractmethod
    def tables(self) -> list[Table]:
        """What a terminal shows."""

    @abstractmethod
    def figure(self) -> Figure:
        """The picture."""

    @abstractmethod
    def parts(self) -> Iterable[str]:
        """What a page shows below the paragraphs, in HTML."""

    @abstractmethod
    def csv(self) -> str:
        """Every number, one line a result, SI units."""

    @abstractmethod
    def json(self) -> str:
        """Everything but fields, in SI units, under the names of the Python API."""

    def markdown(self) -> str:
        """The tables in Markdown."""
        return "\n\n".join([f"# {self.title}", *self.about, *(table.markdown() for table in self.tables())]) + "\n"

    def html(self) -> str:
        """A page by itself: nothing outside is needed."""
        from contact.study.page import document

        return document(self.title, self.about, self.parts())

    def write(self, path: str | Path) -> None:
        """Write numbers (.json, .csv), tables (.md), the picture (.png, .pdf, .svg) or a page (.html), as the name says.

        Raises
        ------
        ContactError
            Another ending, or a file that cannot be written.
        """
        texts = {".html": self.html, ".md": self.markdown, ".json": self.json, ".csv": self.csv}
        write(path, texts, self.figure)
