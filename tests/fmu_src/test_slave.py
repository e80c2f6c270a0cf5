"""The slave, called as pythonfmu calls it: it passes calls on to the functions of the native FMU, and says what these say."""

import math
import sys

import pytest
from pythonfmu.enums import Fmi2Status

from contact_fmu.description import model_description
from contact_fmu.native.components import contact
from contact_fmu.native.table import NAME, content
from contact_fmu.python import slave as module
from contact_fmu.python.slave import INTERFACES, ModelSlave

COMPONENT = contact(41, elliptic=True)
AT = {name: span.start for name, span in COMPONENT.table.span.items()}
LATERAL, FORCE, COUNT = (AT[name] for name in ("creepage.lateral", "force.y", "patch.count"))
GUID = model_description(COMPONENT.table, INTERFACES)[0]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return resources below a name that has to be quoted in a URI."""
    made = tmp_path_factory.mktemp("a b ü%41")
    (made / NAME).write_bytes(content(COMPONENT, GUID))
    return made


@pytest.fixture
def made(folder):
    """Return a function that makes a slave."""
    return lambda: ModelSlave(
        "contact", {"points": 41, "elliptic": True}, GUID, instance_name="q", resources=str(folder)
    )


@pytest.fixture
def slave(made):
    slave = made()
    slave.setup_experiment(0.0, 10.0, None)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert not slave.log_queue
    return slave


def messages(slave, status):
    found = [m.msg for m in slave.log_queue if m.status == status]
    slave.log_queue.clear()
    return found


def test_a_step_follows_the_inputs(slave):
    slave.set_real([LATERAL], [-1e-3])
    assert slave.get_real([FORCE]) == [0.0]
    assert slave.do_step(0.0, 0.1) is True
    (force,), count = slave.get_real([FORCE]), slave.get_integer([COUNT])
    assert force > 1e3
    assert (type(force), count, type(count[0])) == (float, [1], int)
    slave.terminate()
    assert not slave.log_queue


def test_a_bad_input_is_a_discard_and_a_refused_call_an_error_with_the_words_of_the_native_fmu(slave):
    slave.set_real([LATERAL], [math.nan])
    assert slave.do_step(0.0, 0.1) is False
    assert messages(slave, Fmi2Status.discard) == [
        "creepage.lateral = nan is outside the allowed range [-1e+06, 1e+06]"
    ]
    assert slave.do_step(math.nan, 0.1) is False
    assert slave.get_real([FORCE, 10**6]) == [0.0, 0.0]
    assert slave.get_string([LATERAL]) == [""]
    slave.set_integer([AT["method.normal"]], [1])
    slave.set_boolean([LATERAL], [True])
    slave.set_string([LATERAL], ["a"])
    assert messages(slave, Fmi2Status.error) == [
        "currentCommunicationPoint = nan is not finite",
        "fmi2GetReal: there is no value reference 1000000",
        "creepage.lateral is not a variable for fmi2GetString now",
        "method.normal is not a variable for fmi2SetInteger now",
        "creepage.lateral is not a variable for fmi2SetBoolean now",
        "creepage.lateral is not a variable for fmi2SetString now",
    ]


def test_an_unusual_input_is_a_warning(slave):
    slave.set_real([LATERAL], [0.9])
    assert slave.do_step(0.0, 0.1) is True
    assert messages(slave, Fmi2Status.warning)[0].startswith("creepage.lateral = 0.9: ")


def test_reading_nothing_before_initialisation_says_nothing(made):
    """`entry.c` does so as soon as there is an instance."""
    slave = made()
    assert slave.get_real([]) == []
    assert not slave.log_queue
    assert slave.get_real([FORCE]) == [0.0]
    assert messages(slave, Fmi2Status.error)


@pytest.mark.parametrize(("start", "stop"), [(math.nan, None), (0.0, math.nan), (1.0, 0.0)])
def test_a_start_or_a_stop_without_meaning_is_an_error(made, start, stop):
    slave = made()
    slave.setup_experiment(start, stop, None)
    assert messages(slave, Fmi2Status.error)[0].endswith("allowed: numbers, the stop not before it")


@pytest.mark.parametrize("state", [b"", b"nonsense", bytes(10000)])
def test_a_foreign_state_is_refused_and_changes_nothing(slave, state):
    slave._set_fmu_state(ModelSlave._fmu_state_from_bytes(state))
    assert "not a state of this FMU" in messages(slave, Fmi2Status.error)[0]
    assert slave.do_step(0.0, 0.1) is True


def test_an_instance_that_cannot_be_made_is_an_error_that_says_why(folder):
    """pythonfmu passes on the text of the exception."""
    with pytest.raises(RuntimeError, match="the instance has no name"):
        ModelSlave("contact", {"points": 41, "elliptic": True}, GUID, instance_name="", resources=str(folder))


def test_a_slave_that_is_gone_has_freed_its_instance(slave, monkeypatch):
    called = []
    monkeypatch.setattr(module._Instance, "call", lambda self, function, *arguments: called.append(function))
    del slave._instance
    assert called == ["FreeInstance"]


def test_instances_leave_the_module_path_as_it_was_and_release_their_library_at_the_end(made, folder, monkeypatch):
    released: list[str] = []
    monkeypatch.setattr("contact_fmu.python.slave.release_once", released.append)
    monkeypatch.setattr(sys, "path", [str(folder), *sys.path])  # as pythonfmu does before it instantiates
    made()
    assert str(folder) not in sys.path
    assert released == [str(folder)]
