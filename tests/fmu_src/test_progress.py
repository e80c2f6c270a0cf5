"""A long build shows that it is alive, and a command that fails is shown with its output."""

import sys

import pytest

pytest.importorskip("ziglang")

from fmu_src.catalogue import models
from fmu_src.native import linking, packaging


def test_a_long_command_gives_signs_of_life(monkeypatch):
    monkeypatch.setattr(linking, "_BEAT", 0.2)
    signs = []
    linking.run(sys.executable, "-c", "import time; time.sleep(1.0)", waiting=lambda: signs.append("alive"))
    assert len(signs) >= 2


def test_compiling_says_once_what_is_done_of_how_many(tmp_path, monkeypatch):
    """The files come one after the other, as from the compiler, and the build looks in between."""
    said, model = [], next(model for model in models(81) if model.table.name == "EllipticContact")

    def compiler(*command, waiting):
        waiting()
        for platform in packaging.TRIPLES:
            for path in packaging.objects(command[-1], platform):
                path.touch()
            if platform != "darwin64":
                waiting()

    monkeypatch.setattr(packaging, "run", compiler)
    packaging.compile_kernels([model], tmp_path, said.append)
    assert said[1:] == [
        f"kernels of EllipticContact for {platform}: compiled, {k} of 3"
        for k, platform in enumerate(packaging.TRIPLES, 1)
    ]


def test_a_command_that_fails_is_shown_with_its_output():
    with pytest.raises(RuntimeError, match="exit\\(3\\)\\nwhat it said"):
        linking.run(sys.executable, "-c", "print('what it said'); exit(3)")
