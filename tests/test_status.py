"""The status of a solution says what it is in words, and remains a number where one is needed."""

import json

import pytest

import contact


@pytest.mark.parametrize("status", contact.Status)
def test_a_status_is_printed_as_its_name_and_explained(status):
    assert (str(status), f"{status}") == (status.name, status.name)
    assert f"{status.name} : {int(status)}, " in contact.Status.__doc__
    assert json.dumps(status) == str(int(status))
