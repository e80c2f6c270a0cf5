"""Text of files as it comes: usual encodings, typographic signs. Files that hold no text are named.

One reader serves profiles, signals over time, series of a track, tables of cases and TOML. `columns` finds the numbers.
"""

from __future__ import annotations

import codecs
import re
import tomllib
from os import PathLike
from pathlib import Path
from typing import Any

from contact.errors import ContactError

LARGEST_FILE = 20e6  # bytes

#: First bytes of files that hold no text, what they are, and what helps.
_MAGIC = (
    (b"%PDF", "a PDF document", "copy its table into a text file"),
    (b"\x89PNG", "a picture", "its points are not in it as numbers"),
    (b"\xff\xd8\xff", "a picture", "its points are not in it as numbers"),
    (b"GIF8", "a picture", "its points are not in it as numbers"),
    (b"II*\0", "a picture", "its points are not in it as numbers"),
    (b"MM\0*", "a picture", "its points are not in it as numbers"),
    (b"\x1f\x8b", "an archive (gzip)", "unpack it"),
    (b"7z\xbc\xaf", "an archive (7z)", "unpack it"),
    (b"Rar!", "an archive (rar)", "unpack it"),
    (b"BZh", "an archive (bzip2)", "unpack it"),
    (b"\xfd7zXZ", "an archive (xz)", "unpack it"),
    (b"\xd0\xcf\x11\xe0", "a file of an old office program (.xls, .doc)", "save it as .xlsx or .csv"),
    (b"\x89HDF", "an HDF5 or MATLAB 7.3 file", "write its numbers as text"),
    (b"MATLAB 5.0", "a MATLAB file", "write its numbers as text"),
    (b"\x93NUMPY", "a file of numpy", "write it by numpy.savetxt"),
    (b"AC10", "a DWG drawing", "save it as .dxf"),
    (b"{\\rtf", "an RTF document", "save it as plain text"),
    (b"ISO-10303-21", "a STEP model", "save the section as .dxf"),
    (b"<!DOCTYPE", "a web page", "save its table as text"),
    (b"<html", "a web page", "save its table as text"),
    (b"<?xml", "an XML file", "write its numbers as text"),
    (b"<svg", "an SVG drawing", "save it as .dxf"),
)
_STRANGE = re.compile("[\\x00-\\x08\\x0e-\\x19\\x1b-\\x1f]")  # control characters that no text has
_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
#: Signs that word processors and spreadsheets write for the plain ones.
_PLAIN = str.maketrans(
    dict.fromkeys("\u2212\u2010\u2011\u2012\u2013\u2014\ufe58\ufe63\uff0d", "-")
    | dict.fromkeys("\u00a0\u202f\u3000\u1680" + "".join(map(chr, range(0x2000, 0x200B))), " ")
    | dict.fromkeys("\u200b\u200c\u200d\u200e\u200f\u2060\ufeff", "")
    | dict.fromkeys("\u201c\u201d\u201e\u201f\u00ab\u00bb\uff02", '"')
    | {"\uff0b": "+", "\uff0c": ",", "\uff0e": ".", "\uff1b": ";", "\u066b": ".", "\x0b": " ", "\x0c": " "}
    | {chr(0xFF10 + digit): str(digit) for digit in range(10)}
)


def read(path: str | PathLike[str], name: str = "path", largest: float = LARGEST_FILE) -> str:
    """Return the text of a file: UTF-8 with or without byte order mark, UTF-16, UTF-32, or Windows' and Latin letters.

    Raises
    ------
    ContactError
        If the file is missing, larger than `largest` [bytes], no regular file, empty, or no text. The message names what it is.
    """
    return decoded(content(path, name, largest), f"{name} = {str(path)!r}")


def content(path: str | PathLike[str], name: str = "path", largest: float = LARGEST_FILE) -> bytes:
    """Return the bytes of a file. Raise a ContactError if it is missing, too large, or no regular file."""
    require_file(path, name, largest)
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise ContactError(f"{name} = {str(path)!r} cannot be read: {error.strerror}") from None


def require_file(path: str | PathLike[str], name: str = "path", largest: float = LARGEST_FILE) -> None:
    """Raise a ContactError if a file is missing, too large, or no regular file."""
    path = Path(path)
    try:
        found = path.exists()
    except (OSError, ValueError) as error:  # a name that is too long, or holds a zero
        raise ContactError(f"{name} = {str(path)[:200]!r} cannot be read: {error}") from None
    if not found:
        raise ContactError(
            f"{name} = {str(path)!r} is missing: there is no such file in {str(path.absolute().parent)!r}"
        )
    if path.is_dir():
        raise ContactError(f"{name} = {str(path)!r} is a folder")
    if not path.is_file():  # reading a named pipe would wait for ever
        raise ContactError(f"{name} = {str(path)!r} is not a regular file")
    size = path.stat().st_size
    if size > largest:
        raise ContactError(f"{name} = {str(path)!r} holds {1e-6 * size:.0f} MB; allowed: {1e-6 * largest:.0f} MB")


def decoded(given: bytes, where: str) -> str:
    """Return the text in the bytes of a file. `where` begins the message of an error."""
    if not given.strip():
        raise ContactError(f"{where} is empty")
    for start, kind, cure in _MAGIC:
        if given.lstrip().lower().startswith(start.lower()):
            raise ContactError(f"{where} is {kind}, no text; {cure}")
    if given.startswith(b"PK\x03\x04") or given.startswith(b"PK\x05\x06"):
        raise ContactError(f"{where} is {_packed(given)}")
    marked = [encoding for mark, encoding in _MARKS if given.startswith(mark)]
    encoding = marked[0] if marked else _unmarked(given, where)
    try:
        text = given.decode(encoding)
    except UnicodeDecodeError as error:
        raise ContactError(f"{where} is no text in {encoding.upper()}: {error.reason} at byte {error.start}") from None
    strange = len(_STRANGE.findall(text))
    if "\0" in text or strange > 0.02 * len(text):
        raise ContactError(f"{where} is a binary file, no text")
    return text.removeprefix("\ufeff").rstrip("\x1a")


def _packed(given: bytes) -> str:
    """Return what an archive is."""
    for part, kind in (
        (b"xl/", "an .xlsx workbook, no text; give its name the suffix .xlsx"),
        (b"opendocument.spreadsheet", "an OpenDocument workbook, no text; save it as .xlsx or .csv"),
        (b"word/", "a .docx document, no text; copy its table into a text file"),
        (b"modelDescription.xml", "an FMU, no text"),
    ):
        if part in given:
            return kind
    return "an archive (zip), no text; unpack it"


def _unmarked(given: bytes, where: str) -> str:
    """Return the encoding of bytes without a byte order mark."""
    if b"\0" in given:
        even, odd = given[0::2].count(0), given[1::2].count(0)
        half = 0.5 * len(given)
        if odd > 0.8 * half and even < 0.05 * half:
            return "utf-16-le"
        if even > 0.8 * half and odd < 0.05 * half:
            return "utf-16-be"
        raise ContactError(f"{where} is a binary file, no text")
    for encoding in ("utf-8", "cp1252"):
        try:
            given.decode(encoding)
        except UnicodeDecodeError:
            continue
        return encoding
    return "latin-1"


def lines_of(path: str | PathLike[str], name: str = "path", largest: float = LARGEST_FILE) -> list[str]:
    """Return the lines of a file, with plain signs for the typographic ones of numbers, blanks and quotes."""
    return re.split(r"\r\n|\n|\r", plain(read(path, name, largest)))


def plain(text: str) -> str:
    """Return the text with plain minus signs, blanks, quotes and digits."""
    return text.translate(_PLAIN)


def toml(path: str | PathLike[str]) -> dict[str, Any]:
    """Return the tables of a TOML file. Outside texts and remarks, typographic signs are taken for the plain ones.

    Raises
    ------
    ContactError
        If the file cannot be read or is not TOML. The message has line and column.
    """
    return toml_of(read(path), str(path))


def toml_of(text: str, where: str) -> dict[str, Any]:
    """Return the tables in a text of TOML. `where` is the file's name, for messages."""
    text = text.replace("\r\n", "\n")
    try:
        try:
            return tomllib.loads(text)
        except tomllib.TOMLDecodeError:
            return tomllib.loads(_TOML_KEPT.sub(lambda found: found[1] or plain(found[0]), text))
    except (ValueError, RecursionError) as error:  # also numbers of thousands of digits, and nesting as deep
        raise ContactError(f"{where} is not TOML: {error}") from None


#: Texts and remarks of TOML, kept as group 1; other parts.
_TOML_KEPT = re.compile(r"""("{3}.*?"{3}|'{3}.*?'{3}|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|\#[^\n]*)|[^"'#]+""", re.DOTALL)
