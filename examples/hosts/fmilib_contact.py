"""FMI Library in C: one step of an FMU. Usage: fmilib_contact.py FMU [INPUT VALUE OUTPUT].

The wheel of libcosim contains the FMI Library and exports its functions. Only these are called, nothing of libcosim.
"""

import ctypes
import importlib.util
import sys
import tempfile
from pathlib import Path

FMI_2, CO_SIMULATION_KIND, CO_SIMULATION = 2, 2, 1  # fmi_version_2_0_enu, fmi2_fmu_kind_cs, fmi2_cosimulation
place = Path(importlib.util.find_spec("libcosimpy").origin).parent
library = ctypes.CDLL(str(next(place.rglob("libcosimc.so"))))


def function(name, result, *arguments):
    """Return a function of the library."""
    found = library[name]
    found.restype, found.argtypes = result, arguments
    return found


pointer, text, integer, real = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_double
references, reals = ctypes.POINTER(ctypes.c_uint), ctypes.POINTER(real)
callbacks = function("jm_get_default_callbacks", pointer)
allocate = function("fmi_import_allocate_context", pointer, pointer)
unzip = function("fmi_import_get_fmi_version", integer, pointer, text, text)
free_context = function("fmi_import_free_context", None, pointer)
parse = function("fmi2_import_parse_xml", pointer, pointer, text, pointer)
load = function("fmi2_import_create_dllfmu", integer, pointer, integer, pointer)
instantiate = function("fmi2_import_instantiate", integer, pointer, text, integer, text, integer)
setup = function("fmi2_import_setup_experiment", integer, pointer, integer, real, real, integer, real)
enter = function("fmi2_import_enter_initialization_mode", integer, pointer)
leave = function("fmi2_import_exit_initialization_mode", integer, pointer)
set_real = function("fmi2_import_set_real", integer, pointer, references, ctypes.c_size_t, reals)
get_real = function("fmi2_import_get_real", integer, pointer, references, ctypes.c_size_t, reals)
do_step = function("fmi2_import_do_step", integer, pointer, real, real, integer)
terminate = function("fmi2_import_terminate", integer, pointer)
free_instance = function("fmi2_import_free_instance", None, pointer)
unload = function("fmi2_import_destroy_dllfmu", None, pointer)
free_fmu = function("fmi2_import_free", None, pointer)
by_name = function("fmi2_import_get_variable_by_name", pointer, pointer, text)
reference_of = function("fmi2_import_get_variable_vr", ctypes.c_uint, pointer)

given, value, wanted = sys.argv[2:] or ("creepage.longitudinal", "1e-3", "force.x")
with tempfile.TemporaryDirectory() as folder:
    context = allocate(callbacks())
    assert unzip(context, sys.argv[1].encode(), folder.encode()) == FMI_2
    fmu = parse(context, folder.encode(), None)
    assert fmu, "the FMI Library cannot read modelDescription.xml"
    assert load(fmu, CO_SIMULATION_KIND, None) == 0
    assert instantiate(fmu, b"contact", CO_SIMULATION, None, 0) == 0
    number = real(float(value))
    status = [setup(fmu, 0, 0.0, 0.0, 0, 0.0), enter(fmu)]
    status.append(set_real(fmu, ctypes.c_uint(reference_of(by_name(fmu, given.encode()))), 1, number))
    status += [leave(fmu), do_step(fmu, 0.0, 1e-3, 1)]
    status.append(get_real(fmu, ctypes.c_uint(reference_of(by_name(fmu, wanted.encode()))), 1, number))
    assert status == [0] * len(status), status
    print(wanted, repr(number.value))
    terminate(fmu)
    free_instance(fmu)
    unload(fmu)
    free_fmu(fmu)
    free_context(context)
