"""Import paths of earlier versions lead to the same objects, with a warning."""

import importlib
import sys

import pytest

import contact
from contact.moved import MOVED


@pytest.mark.parametrize("name", sorted(MOVED))
def test_an_earlier_path_has_the_names_of_the_present_one(name, monkeypatch):
    monkeypatch.delitem(sys.modules, name, raising=False)
    with pytest.warns(DeprecationWarning, match=f"{name} has moved: import {MOVED[name]}"):
        old = importlib.import_module(name)
    now = importlib.import_module(MOVED[name])
    public = {key for key in vars(now) if not key.startswith("__")}
    assert public
    assert all(getattr(old, key) is getattr(now, key) for key in public)


def test_functions_of_the_package_are_not_hidden_by_modules():
    assert callable(contact.hertz)
    assert not {name.rpartition(".")[2] for name in MOVED} & set(contact.__all__)


def test_a_name_that_never_was_is_not_found():
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("contact.never")
