"""The table-driven slave, called as pythonfmu calls it, with a model of one line."""

import math
import sys

import numpy as np
import pytest
from pythonfmu.enums import Fmi2Status

from contact_fmu.description import model_description
from contact_fmu.native.component import Component
from contact_fmu.python.slave import INTERFACES, TableSlave
from contact_fmu.rows import output, parameter, signal
from contact_fmu.variables import Enumeration, Table

TABLE = Table(
    "Quotient",
    "A quotient, for tests",
    [
        parameter(
            "mode", "What to do", enumeration=Enumeration("Mode", (("Divide", ""), ("Fail", ""))), start="Divide"
        ),
        signal("x", "Dividend", unit="m", start=(1.0, 2.0), shape=(2,), maximum=100.0),
        signal("y", "Divisor", unit="m", start=4.0, minimum=0.0),
        output("q", "Quotient", shape=(2,)),
        output("steps", "Number of steps", start=0, integer=True),
        output("slow", "Twice the first quotient"),
    ],
    step_size=0.1,
)
MODE, MODE_INTEGER, X1, X2, Y, Q1, Q2, STEPS, STEPS_REAL, SLOW = range(10)


COMPONENT = Component(kind="none", table=TABLE, lazy=("slow",), failures={3: "y = 3 is not to our taste"})


class Model:
    """Stands for an `Instance`."""

    def __init__(self, component, folder):
        self.memory, self.calls = np.zeros((2, 1)), 0

    def solve(self, values, h):
        if values[MODE] == 2:
            raise ZeroDivisionError("as asked")
        y = values[Y]
        values[[Q1, Q2]] = values[[X1, X2]] / y if y else math.inf
        values[STEPS] += h > 0.0
        return int(y == 3.0) * 3

    def accept(self, values, h):
        pass

    def solve_lazy(self, values):
        self.calls += 1
        values[SLOW] = 2.0 * values[X1] / values[Y]


class Quotient(TableSlave):
    def __init__(self):
        guid = model_description(TABLE, INTERFACES)[0]
        super().__init__(COMPONENT, guid, Model, instance_name="q", resources="/nowhere")


def messages(slave, status):
    found = [m.msg for m in slave.log_queue if m.status == status]
    slave.log_queue.clear()
    return found


@pytest.fixture
def slave():
    slave = Quotient()
    slave.setup_experiment(0.0, 10.0, None)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    assert not slave.log_queue
    return slave


def test_outputs_follow_the_inputs_during_initialisation():
    slave = Quotient()
    slave.enter_initialization_mode()
    assert slave.get_real([Q1, Q2]) == [0.25, 0.5]
    slave.set_real([X1, Y], [3.0, 2.0])
    assert slave.get_real([Q1, Q2]) == [1.5, 1.0]
    slave.exit_initialization_mode()
    assert slave.get_integer([STEPS]) == [0]


def test_outputs_change_only_with_a_step_afterwards(slave):
    slave.set_real([X1], [8.0])
    assert slave.get_real([Q1]) == [0.25]
    assert slave.do_step(0.0, 0.1) is True
    assert (slave.get_real([Q1]), slave.get_integer([STEPS])) == ([2.0], [1])


@pytest.mark.parametrize(
    ("reference", "value", "message"),
    [
        (X2, math.nan, "x[2] = nan is outside the allowed range ]-inf, 100]"),
        (Y, 0.0, "q[1] has no finite value for these inputs"),
        (Y, 3.0, "y = 3 is not to our taste"),
    ],
)
def test_a_bad_input_discards_the_step_and_keeps_the_outputs(slave, reference, value, message):
    start = slave.get_real([reference])
    slave.set_real([reference], [value])
    assert slave.do_step(0.0, 0.1) is False
    assert messages(slave, Fmi2Status.discard) == [message]
    assert (slave.get_real([Q1, Q2]), slave.get_integer([STEPS])) == ([0.25, 0.5], [0])
    slave.set_real([reference], start)
    assert slave.do_step(0.0, 0.1) is True


def test_the_last_step_may_end_at_the_stop_time_but_for_rounding(slave):
    assert slave.do_step(0.0, 10.0 + 1e-12) is True


def test_a_step_before_initialisation_is_an_error():
    slave = Quotient()
    assert slave.do_step(0.0, 0.1) is False
    assert messages(slave, Fmi2Status.error) == ["doStep is not allowed before initialisation; the call is ignored"]


def test_reading_before_initialisation_is_an_error():
    """Outputs are 0 then, which a host would take for an answer; native FMUs refuse it too."""
    slave = Quotient()
    slave.get_real([Q1])
    assert messages(slave, Fmi2Status.error) == [
        "q[1] cannot be read as Real before initialisation; the call is ignored"
    ]


@pytest.mark.parametrize(("start", "stop"), [(math.nan, None), (math.inf, None), (0.0, math.nan), (1.0, 0.0)])
def test_a_start_or_a_stop_without_meaning_is_an_error(start, stop):
    slave = Quotient()
    slave.setup_experiment(start, stop, None)
    assert messages(slave, Fmi2Status.error)[0].endswith("allowed: numbers, the stop not before it")


def test_no_exception_of_the_model_escapes():
    slave = Quotient()
    slave.set_integer([MODE], [2])
    slave.enter_initialization_mode()
    assert slave.exit_initialization_mode() is False
    assert messages(slave, Fmi2Status.error) == ["exit_initialization_mode: ZeroDivisionError: as asked"]


def test_a_variable_that_cannot_be_set_is_refused_by_name(slave):
    slave.set_integer([MODE], [2])
    slave.set_real([Q1, 99], [7.0, 7.0])
    slave.set_boolean([X1], [True])
    assert messages(slave, Fmi2Status.error) == [
        "mode cannot be set as Integer or Enumeration after initialisation; the call is ignored",
        "q[1] cannot be set as Real after initialisation; the call is ignored",
        "value reference 99 cannot be set as Real after initialisation; the call is ignored",
        "x[1] cannot be set as Boolean or String after initialisation; the call is ignored",
    ]
    assert slave.get_integer([MODE]) == [1]


def test_a_variable_that_cannot_be_read_is_refused_by_name(slave):
    assert slave.get_real([STEPS, Q1, -1]) == [0, 0.25, 0]
    assert slave.get_string([X1]) == [""]
    assert [m.split(";")[0] for m in messages(slave, Fmi2Status.error)] == [
        "steps cannot be read as Real after initialisation",
        "value reference -1 cannot be read as Real after initialisation",
        "x[1] cannot be read as Boolean or String after initialisation",
    ]


def test_a_state_can_be_set_before_initialisation():
    slave = Quotient()
    slave.set_integer([STEPS], [5])
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    slave.do_step(0.0, 0.1)
    assert slave.get_integer([STEPS]) == [6]


def test_a_lazy_row_is_computed_once_when_read_and_belongs_to_the_last_step(slave):
    slave.do_step(0.0, 0.1)
    assert slave._model.calls == 0
    slave.set_real([X1], [40.0])  # for the next step
    assert slave.get_real([SLOW]) == slave.get_real([SLOW]) == [0.5]
    assert slave._model.calls == 1


def test_a_lazy_row_ignores_a_bad_input_for_the_next_step(slave):
    slave.set_real([X1], [2.0])
    slave.do_step(0.0, 0.1)
    slave.set_real([X1], [math.nan])
    assert slave.get_real([SLOW]) == [1.0]
    assert not slave.log_queue


def test_a_lazy_row_that_was_not_read_yet_belongs_to_the_saved_step(slave):
    slave.do_step(0.0, 0.1)
    slave.set_real([X1], [40.0])  # for the next step
    other = Quotient()
    other._set_fmu_state(slave._get_fmu_state())
    assert other.get_real([SLOW]) == [0.5]


@pytest.mark.parametrize("state", [b"", b"nonsense", b"{}", b"[]", b'{"guid": "another"}'])
def test_a_foreign_state_is_refused(slave, state):
    """No step can be done after it. A good state heals the instance."""
    before = slave._get_fmu_state()
    slave._set_fmu_state(Quotient._fmu_state_from_bytes(state))
    assert "not a state of the FMU Quotient" in messages(slave, Fmi2Status.error)[0]
    assert slave.do_step(0.0, 0.1) is False
    assert "doStep is not allowed after a state" in messages(slave, Fmi2Status.error)[0]
    slave._set_fmu_state(before)
    assert slave.do_step(0.0, 0.1) is True


def test_instances_leave_the_module_path_as_it_was_and_release_their_library_at_the_end(monkeypatch):
    released: list[str] = []
    monkeypatch.setattr("contact_fmu.python.slave.release_once", released.append)
    monkeypatch.setattr(sys, "path", ["/nowhere", *sys.path])  # as pythonfmu does before it instantiates
    Quotient()
    assert "/nowhere" not in sys.path
    assert released == ["/nowhere"]
