"""The file of the native `WheelRailContact`: its content, and the symbols that its libraries need and export."""

import re
import subprocess
from pathlib import Path
from zipfile import ZipFile

import fmpy
import lief
import pytest
from contact_case import NAME
from fmpy.validation import validate_fmu
from fmu_instance import Instance
from pair_case import NAME as PAIR

import contact
from contact_fmu import lint
from contact_fmu.native import kinds


def test_neither_fmpy_nor_our_own_rules_find_a_problem(native, fmus, native_vehicles):
    files = [*native.parent.rglob("*.fmu"), *fmus.glob("*.fmu"), *native_vehicles.rglob("*.fmu")]
    assert len(files) > 12
    found = {str(path): [*validate_fmu(str(path)), *lint.check_file(path)] for path in files}
    assert {path: problems for path, problems in found.items() if problems} == {}


def test_what_is_linked_in_is_listed_with_its_licence(native_folder):
    folder = native_folder / "documentation" / "licenses"
    texts = {path.name: path.read_text() for path in folder.iterdir()}
    overview = texts.pop("license.txt")
    assert set(re.findall(r"^[\w-]+\.txt", overview, re.MULTILINE)) == set(texts)
    for name, words in {
        "wheelrail-contact.txt": "MIT License",
        "fmi.txt": "Redistributions in binary form must reproduce",
        "zig.txt": "Copyright (c) Zig contributors",
        "musl.txt": "Arm Limited",
    }.items():
        assert words in texts[name], name


#: Functions of libc and libm that a library may ask its system for.
C_LIBRARY = {
    *(
        "bcmp", "calloc", "fclose", "fopen", "fread", "free", "malloc", "memchr", "memcmp", "memcpy", "memmove",
        "memset",
    ),
    *("realloc", "sched_yield", "snprintf", "strchr", "strcmp", "strcpy", "strlen", "strtod", "strncmp", "strncpy"),
    *("acos", "asin", "asinh", "atan", "atan2", "atanh", "cos", "exp", "expm1", "hypot", "log", "pow", "sin", "sincos"),
    *("sqrt", "tan", "vsnprintf"),
}  # fmt: skip


@pytest.mark.parametrize("name", [NAME, PAIR, "Wheelset"])
def test_the_windows_library_needs_only_windows(native, name):
    """It imports from kernel32 and the universal C library. It has no data of threads and none that it could write to."""
    with ZipFile(native.with_name(f"{name}.fmu")) as fmu:
        library = lief.parse(fmu.read(f"binaries/win64/{name}.dll"))
    needed = {each.name.lower() for each in library.imports}
    assert needed
    assert all(each == "kernel32.dll" or each.startswith("api-ms-win-crt-") for each in needed)
    imported = {function.name for each in library.imports for function in each.entries}
    assert not imported & {"exp", "log", "pow", "sin", "cos", "tan"}  # its own give the same bits everywhere
    assert not library.has_tls
    writable = lief.PE.Section.CHARACTERISTICS.MEM_WRITE
    assert [section.name for section in library.sections if section.has_characteristic(writable)] == []


def functions(native_folder) -> set[str]:
    """Return the symbols that the library for Linux exports."""
    library = native_folder / "binaries" / "linux64" / f"{NAME}.so"
    symbols = subprocess.run(["nm", "-D", library], check=True, capture_output=True, text=True).stdout
    return set(re.findall(r" [A-TV-Z] (\w+)", symbols))


def test_the_library_needs_only_the_c_library(native_folder):
    """Apart from the C library it needs libm. It exports FMI, wheelrail.h, the entries of Python and the kinds of models."""
    library = native_folder / "binaries" / "linux64" / f"{NAME}.so"
    symbols = subprocess.run(["nm", "-D", library], check=True, capture_output=True, text=True).stdout
    needed = set(re.findall(r" [Uw] (\w+)", symbols))
    weak = {"_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable", "__cxa_finalize", "__gmon_start__"}
    assert needed - weak <= C_LIBRARY
    offered = functions(native_folder)
    versions = {v: {name for name in offered if name.startswith(v)} for v in ("fmi2", "fmi3")}
    kernels = {name for name in offered if name.endswith(("_v2", "_v3"))}
    interface = {name for name in offered if name.startswith("wr_")}
    assert offered == versions["fmi2"] | versions["fmi3"] | kernels | interface
    of_models = {f"{name}_{cpu}" for kind in kinds.KINDS for name in kinds.names(kind) for cpu in ("v2", "v3")}
    assert kernels >= of_models
    assert all(name.startswith(("contact_", "models_")) for name in kernels - of_models)
    assert {v: len(names) for v, names in versions.items()} == {
        "fmi2": 44,
        "fmi3": 75,
    }  # all functions of the standards
    dynamic = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    assert set(re.findall(r"NEEDED.*\[(.+)\]", dynamic)) <= {"libc.so.6", "libm.so.6"}


def test_the_library_for_macos_needs_only_its_c_library(native_folder):
    """Its symbols are inspected, since it cannot run here."""
    library = lief.parse(native_folder / "binaries" / "darwin64" / f"{NAME}.dylib")
    own, system = "@rpath/libwheelrail.dylib", "/usr/lib/libSystem.B.dylib"
    assert [needed.name for needed in library.libraries] == [own, system]
    memory = {"___bzero", "___sincos_stret", "dyld_stub_binder"} | {f"_{name}" for name in C_LIBRARY}
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
    libraries = [*(native_folder / "binaries").glob("*/*")]
    assert len(libraries) > 2
    for library in libraries:
        content = library.read_bytes()
        assert str(Path(contact.__file__).parent).encode() not in content
        assert b"numba" not in content


def test_importers_find_pages_pictures_and_terminals(native):
    """Tools show documentation/index.html and model.png, in FMI 3.0 the icon. `test_terminals.py` has the terminals."""
    for path in native.parent.rglob("*.fmu"):
        with ZipFile(path) as archive:
            page = archive.read("documentation/index.html").decode()
            assert page.count("<tr>") > 30
            assert "<code>" not in page
            icon = "terminalsAndIcons/icon.png" if path.parent.name == "fmi3" else "model.png"
            assert archive.read(icon).startswith(b"\x89PNG")
            if path.parent.name == "fmi3":
                assert "<Terminal " in archive.read("terminalsAndIcons/terminalsAndIcons.xml").decode()


def test_handy_units_are_offered(native):
    description = fmpy.read_model_description(str(native))
    shown = {v.name: v.displayUnit for v in description.modelVariables}
    assert (shown["pressure.max"], shown["force.x"], shown["approach"]) == ("MPa", "kN", "mm")
    assert shown["wheel.radius"] is None
    units = {d.name: d.factor for u in description.unitDefinitions for d in u.displayUnits}
    assert (units["mm"], units["MPa"], units["kN"]) == (1e3, 1e-6, 1e-3)


def test_the_small_variant_is_the_contact_with_curvatures(native, open_native, unzipped):
    """It shows few inputs; its code is that of WheelRailContact."""
    small = Instance(unzipped(native.with_name("EllipticContact.fmu")))
    large = open_native()
    large.update({"geometry.kind": 2})
    inputs = [name for name, v in small.variables.items() if v.causality == "input"]
    assert len(inputs) == 9
    assert len(small.variables) < 100
    for instance in (small, large):
        instance.update({"creepage.longitudinal": 1e-3, "geometry.A0": 1.2, "geometry.B0": 0.7})
        instance.initialize().step()
    outputs = small.all("output")
    assert outputs == {name: value for name, value in large.all("output").items() if name in outputs}
    assert outputs["force.x"] < -1e4
    small.free()
