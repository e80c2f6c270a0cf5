"""What an FMU for hosts with Python asks the installed package: which library has the functions of the native FMUs."""

import os
from pathlib import Path

import pytest

from contact_fmu.catalogue import axle
from contact_fmu.description import model_description
from contact_fmu.native.components import contact
from contact_fmu.native.table import NAME, content
from contact_fmu.python.packaging import INTERFACES
from contact_fmu.python.runtime import DECLARED, _model, declared, library

COMPONENT, OPTIONS = contact(41, elliptic=True), {"points": 41, "elliptic": True}
GUID = model_description(COMPONENT.table, INTERFACES)[0]


@pytest.fixture
def folder(tmp_path):
    """Return resources below a name that is not plain."""
    made = tmp_path / "ü %41"
    made.mkdir()
    (made / DECLARED).write_text(declared("contact", OPTIONS, GUID))
    (made / NAME).write_bytes(content(COMPONENT, GUID))
    return made


@pytest.mark.parametrize("text", ["", "nonsense(", "(1, 2)", "('nobody', {}, 'x')", None])
def test_damaged_resources_are_refused_and_raise_nothing(folder, text):
    if text is None:
        (folder / DECLARED).unlink()
    else:
        (folder / DECLARED).write_text(text)
    assert library(os.fsencode(folder)).startswith(b"!")
    assert (
        library(b"/nowhere").decode()
        == f"!resource {Path('/nowhere', DECLARED)} cannot be read: No such file or directory"
    )


def test_the_starts_of_a_wheelset_read_back(folder):
    model = axle()
    text = declared(model.declared, model.options, GUID)
    assert _model(text) == ("Wheelset", content(model.component, GUID))
