"""Every public name of `contact` has an example in its docstring, and the examples of the whole library run."""

import doctest
import importlib
import pkgutil
import time

import pytest

import contact

#: Public names that are data: their class has the example.
DATA = {"STEEL", "THESIS"}
PLACES = [name for _, name, _ in pkgutil.walk_packages(contact.__path__, "contact.") if ".kernels" not in name]


@pytest.mark.parametrize("name", sorted(set(contact.__all__) - DATA))
def test_a_public_name_has_an_example_that_runs_in_two_seconds(name):
    thing = getattr(contact, name)
    (found,) = (test for test in doctest.DocTestFinder(recurse=False).find(thing, name, globs={}) if test.examples)
    begin = time.process_time()
    result = doctest.DocTestRunner(verbose=False).run(found)
    assert result.attempted > 1
    assert result.failed == 0
    assert time.process_time() - begin < 2.0


def test_all_other_examples_of_the_library_run():
    attempted = 0
    for place in PLACES:
        try:
            module = importlib.import_module(place)
        except ImportError:  # of an extra that is not installed
            continue
        result = doctest.testmod(module)
        assert result.failed == 0, place
        attempted += result.attempted
    assert attempted > 50
