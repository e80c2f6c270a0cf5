"""`contact.cite` agrees with CITATION.cff."""

import re
from pathlib import Path

import contact

CITATION = (Path(__file__).parents[1] / "CITATION.cff").read_text(encoding="utf-8")


def cited(name):
    """Return every value of a key of the file, without quotation marks."""
    return [value.strip('"') for value in re.findall(rf"^\s*{name}: (.+)$", CITATION, re.MULTILINE)]


def entry(kind):
    """Return the fields of an entry of the BibTeX text."""
    (body,) = re.findall(rf"^@{kind}\{{\w+,\n(.*?)^\}}", contact.cite(), re.MULTILINE | re.DOTALL)
    return dict(re.findall(r"^  (\w+)\s*= \{(.*)\},$", body, re.MULTILINE))


def test_software_has_title_version_and_licence_of_the_citation_file():
    software = entry("software")
    assert software["title"] == cited("title")[0]
    assert [software["version"]] == cited("version") == [contact.__version__]
    assert [software["license"]] == cited("license")
    assert software["author"] == "{The wheelrail-contact authors}"  # in braces: one name, not a family name
    assert software["year"] == "2026"


def test_thesis_has_title_number_and_isbn_of_the_citation_file():
    thesis = entry("phdthesis")
    assert thesis["title"] == cited("title")[1]
    assert [thesis["number"]] == cited("number")
    assert [thesis["isbn"]] == cited("isbn")
    assert thesis["author"] == "Shahzamanian Sichani, Matin"
    assert (thesis["school"], thesis["address"], thesis["year"]) == (
        "KTH Royal Institute of Technology",
        "Stockholm",
        "2016",
    )


def test_braces_are_balanced():
    assert contact.cite().count("{") == contact.cite().count("}")
