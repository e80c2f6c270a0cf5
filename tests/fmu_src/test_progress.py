"""A long build shows that it is alive, and a command that fails is shown with its output."""

import sys

import pytest

pytest.importorskip("ziglang")

from fmu_src.native import linking


def test_a_long_command_gives_signs_of_life(monkeypatch):
    monkeypatch.setattr(linking, "_BEAT", 0.2)
    signs = []
    linking.run(sys.executable, "-c", "import time; time.sleep(1.0)", waiting=lambda: signs.append("alive"))
    assert len(signs) >= 2


def test_a_command_that_fails_is_shown_with_its_output():
    with pytest.raises(RuntimeError, match="exit\\(3\\)\\nwhat it said"):
        linking.run(sys.executable, "-c", "print('what it said'); exit(3)")
