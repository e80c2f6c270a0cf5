"""Every compiler lays out the records of wheelrail.h as the kernels do."""

import pytest

pytest.importorskip("ziglang")

from contact.compile.linking import compiler, run
from contact.core.library import get_include

HEADER = get_include() / "wheelrail_records.h"
STRICT = ("-std=c11", "-Wall", "-Wextra", "-Werror", "-c")


@pytest.mark.parametrize("system", ["linux64", "win64", "darwin64", "aarch64-linux", "aarch64-darwin"])
def test_compilers_lay_records_as_numpy_does(tmp_path, system):
    """The header itself asserts sizes. All members are of 8 bytes."""
    unit = tmp_path / "unit.c"
    unit.write_text(f'#include "{HEADER}"\n')
    run(*compiler(system), *STRICT, unit, "-o", tmp_path / "unit.o")


def test_another_layout_is_refused(tmp_path):
    """The assertions in the header refuse it."""
    unit, text = tmp_path / "unit.c", HEADER.read_text()
    assert text.count("double mu;") == 1
    unit.write_text(text.replace("double mu;", "double mu, more;"))
    with pytest.raises(RuntimeError, match="wr_case"):
        run(*compiler("linux64"), *STRICT, unit, "-o", tmp_path / "unit.o")


def test_a_command_that_fails_is_shown_with_its_output():
    with pytest.raises(RuntimeError, match="no-such-file"):
        run(*compiler("linux64"), "no-such-file.c")
