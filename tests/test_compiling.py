"""The first solution says on a terminal that it compiles; nothing is said elsewhere."""

import io
import os
import subprocess
import sys

import pytest
from numba import njit
from numba.core import event

from contact import compiling

SCRIPT = """
import contact.compiling
{before}
from numba import njit
f = njit(lambda x: x + 1)
f.py_func.__module__ = "contact.kernels.example"
for listener in contact.compiling._LISTENERS:
    listener.delay = 0.0
f(1)
"""


def test_nested_compilations_are_counted_and_the_line_is_removed():
    stream = io.StringIO()
    listener = compiling.Announcement(stream, delay=0.0)
    inner = njit(lambda x: x + 1)
    inner.py_func.__module__ = "contact.kernels.inner"
    outer = njit(lambda x: inner(x) + 1)
    outer.py_func.__module__ = "contact.kernels.outer"
    with event.install_listener("numba:compile", listener):
        outer(1)
        said = stream.getvalue()
        njit(lambda x: x * 2)(1)  # of another package
        outer(2)
    assert (listener.done, listener.depth) == (2, 0)
    assert "compiling, once on this machine (about a minute): 0 functions" in said
    assert said.endswith("\r\033[K")
    assert stream.getvalue() == said


@pytest.mark.skipif(sys.platform == "win32", reason="there are no pseudo-terminals here")
@pytest.mark.parametrize(("before", "speaks"), [("", True), ("contact.compiling.keep_quiet()", False)])
def test_it_is_said_on_a_terminal_unless_kept_quiet(before, speaks):
    import pty

    ours, theirs = pty.openpty()
    subprocess.run([sys.executable, "-c", SCRIPT.format(before=before)], stderr=theirs, check=True)
    os.set_blocking(ours, False)
    os.close(theirs)
    try:
        said = os.read(ours, 4096).decode()
    except OSError:
        said = ""
    assert ("compiling" in said) == speaks


def test_nothing_is_said_into_a_pipe():
    result = subprocess.run([sys.executable, "-c", SCRIPT.format(before="")], capture_output=True, check=True)
    assert result.stderr == b""
