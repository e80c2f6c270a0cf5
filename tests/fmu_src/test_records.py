"""The records in C equal those of the kernels on every platform."""

import subprocess

import pytest

pytest.importorskip("ziglang")

from contact import Status
from contact.kernels import records as defined
from contact.kernels.enumerations import LoadKind
from fmu_src.native import records
from fmu_src.native.linking import compiler, run

STRICT = ("-std=c11", "-Wall", "-Wextra", "-Werror", "-c")


@pytest.mark.parametrize("platform", ["linux64", "win64", "darwin64"])
def test_compilers_lay_records_as_numpy_does(tmp_path, platform):
    """The header itself asserts sizes and offsets."""
    unit = tmp_path / "unit.c"
    unit.write_text(records.header())
    run(*compiler(platform), *STRICT, unit, "-o", tmp_path / "unit.o")


def test_another_layout_is_refused(tmp_path):
    """The assertions in the header refuse it."""
    unit, text = tmp_path / "unit.c", records.header()
    assert text.count("double mu;") == 1
    unit.write_text(text.replace("double mu;", "double mu, more;"))
    with pytest.raises(RuntimeError, match=r"contact_case\.law"):
        run(*compiler("linux64"), *STRICT, unit, "-o", tmp_path / "unit.o")


def test_a_program_finds_members_where_numpy_does(tmp_path):
    """Compare offset and size of every member, the size of every record and the value of every enumerator in C."""
    lines, wanted = [], []
    for name, dtype in records.RECORDS.items():
        of = records.c_name(name)
        lines.append(f'printf("{of} %zu\\n", sizeof({of}));')
        wanted.append(f"{of} {dtype.itemsize}")
        for member in dtype.names:
            kind, offset = dtype.fields[member][:2]
            what = f"{of}.{member}"
            lines.append(f'printf("{what} %zu %zu\\n", offsetof({of}, {member}), sizeof(({of} *)0)->{member});')
            wanted.append(f"{what} {offset} {kind.itemsize}")
    for value in (value for kind in records.ENUMERATIONS for value in kind):
        lines.append(f'printf("{records.enumerator(value)} %d\\n", {records.enumerator(value)});')
        wanted.append(f"{records.enumerator(value)} {int(value)}")
    program = tmp_path / "program"
    (tmp_path / "records.h").write_text(records.header())
    (tmp_path / "program.c").write_text(
        "\n".join(('#include <stdio.h>\n#include "records.h"', "int main(void) {", *lines, "return 0; }"))
    )
    run(*compiler("linux64"), "-std=c11", tmp_path / "program.c", "-o", program)
    assert subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines() == wanted


def test_all_members_are_there_with_their_meaning():
    text = records.header()
    assert set(records.RECORDS) == set(defined.MEANING)
    assert "double edges[8]; /* lateral edges of the patches, two each [m] */" in text
    assert "int64_t law; /* FrictionLaw */" in text
    assert "#define CONTACT_MAX_PATCHES 4\n" in text


def test_enumerators_are_prefixed():
    assert records.enumerator(Status.NOT_CONVERGED) == "CONTACT_STATUS_NOT_CONVERGED"
    assert records.enumerator(LoadKind.LOAD) == "CONTACT_LOAD_KIND_LOAD"
    assert records.enumerator(7) == "7"
