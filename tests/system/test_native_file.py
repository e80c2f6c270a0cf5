"""The file of the native `WheelRailContact`: its content, and the symbols that its libraries need and export."""

import re
import subprocess
from pathlib import Path

import lief
from contact_case import NAME
from fmpy.validation import validate_fmu

import contact
from fmu_src import lint


def test_fmpy_finds_no_problem(native):
    assert validate_fmu(str(native)) == []


def test_our_own_rules_find_no_problem(native, fmus):
    files = [*native.parent.rglob("*.fmu"), *fmus.glob("*.fmu")]
    assert len(files) > 3
    assert {path.name: lint.check_file(path) for path in files if lint.check_file(path)} == {}


def test_what_is_linked_in_is_listed_with_its_licence(native_folder):
    folder = native_folder / "documentation" / "licenses"
    texts = {path.name: path.read_text() for path in folder.iterdir()}
    overview = texts.pop("license.txt")
    assert set(re.findall(r"^[\w-]+\.txt", overview, re.MULTILINE)) == set(texts)
    for name, words in {
        "wheelrail-contact.txt": "MIT License",
        "fmi.txt": "Redistributions in binary form must reproduce",
        "mingw-w64.txt": "Zope Public License",
        "zig.txt": "Copyright (c) Zig contributors",
        "musl.txt": "Arm Limited",
    }.items():
        assert words in texts[name], name


def test_the_windows_library_needs_only_windows(native_folder):
    content = (native_folder / "binaries" / "win64" / f"{NAME}.dll").read_bytes()
    needed = {name.decode().lower() for name in re.findall(rb"[\w-]+\.dll", content, re.IGNORECASE)} - {
        f"{NAME}.dll".lower()
    }
    assert "kernel32.dll" in needed
    assert all(name == "kernel32.dll" or name.startswith("api-ms-win-crt-") for name in needed)


#: Functions of libc and libm that a library may ask its system for.
C_LIBRARY = {
    *("bcmp", "calloc", "free", "malloc", "memcmp", "memcpy", "memmove", "memset", "strcmp", "strcpy", "strlen"),
    *("vsnprintf", "acos", "asin", "asinh", "atan", "atan2", "atanh", "cos", "exp", "log", "pow", "sin", "sincos"),
}


def functions(native_folder) -> set[str]:
    """Return the symbols that the library for Linux exports."""
    library = native_folder / "binaries" / "linux64" / f"{NAME}.so"
    symbols = subprocess.run(["nm", "-D", library], check=True, capture_output=True, text=True).stdout
    return set(re.findall(r" [A-TV-Z] (\w+)", symbols))


def test_the_library_needs_only_the_c_library(native_folder):
    """Apart from the C library it needs libm. It exports the functions of FMI."""
    library = native_folder / "binaries" / "linux64" / f"{NAME}.so"
    symbols = subprocess.run(["nm", "-D", library], check=True, capture_output=True, text=True).stdout
    needed = set(re.findall(r" [Uw] (\w+)", symbols))
    weak = {"_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable", "__cxa_finalize", "__gmon_start__"}
    assert needed - weak <= C_LIBRARY
    offered = functions(native_folder)
    versions = {v: {name for name in offered if name.startswith(v)} for v in ("fmi2", "fmi3")}
    assert offered == versions["fmi2"] | versions["fmi3"]
    assert {v: len(names) for v, names in versions.items()} == {
        "fmi2": 44,
        "fmi3": 75,
    }  # all functions of the standards
    dynamic = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    assert set(re.findall(r"NEEDED.*\[(.+)\]", dynamic)) <= {"libc.so.6", "libm.so.6"}


def test_the_library_for_macos_needs_only_its_c_library(native_folder):
    """Its symbols are inspected, since it cannot run here."""
    library = lief.parse(native_folder / "binaries" / "darwin64" / f"{NAME}.dylib")
    own, system = f"@rpath/{NAME}.dylib", "/usr/lib/libSystem.B.dylib"
    assert [needed.name for needed in library.libraries] == [own, system]
    memory = {"___bzero", "dyld_stub_binder"} | {f"_{name}" for name in C_LIBRARY}
    assert {symbol.name for symbol in library.imported_symbols} <= memory
    offered = {symbol.name for symbol in library.exported_symbols}
    assert offered - {"__mh_dylib_header", "___dso_handle"} == {f"_{name}" for name in functions(native_folder)}


def test_nothing_of_the_library_can_be_written(native_folder):
    """The sections .data and .bss contain only what the C start-up code needs, and no variable of ours."""
    library = native_folder / "binaries" / "linux64" / f"{NAME}.so"
    sections = subprocess.run(["readelf", "-SW", library], check=True, capture_output=True, text=True).stdout
    sizes = {name: int(size, 16) for name, size in re.findall(r"(\.data|\.bss)\s+\w+\s+\w+ \w+ (\w+)", sections)}
    assert all(size <= 16 for size in sizes.values()), sizes


def test_no_path_of_the_build_machine_is_in_the_file(native_folder):
    for library in (native_folder / "binaries").glob("*/*"):
        content = library.read_bytes()
        assert str(Path(contact.__file__).parent).encode() not in content
        assert b"numba" not in content
