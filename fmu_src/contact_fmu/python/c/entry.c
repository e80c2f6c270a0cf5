/* The library that a host loads of an FMU for hosts with Python. The package wheelrail-contact in that Python says which library
 * has the functions of the native FMUs (`runtime.py`). All calls go there. */
#ifndef _WIN32
#define _GNU_SOURCE /* RTLD_DEFAULT */
#include <dlfcn.h>
#endif
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "fmi2Functions.h"
#include "location.h"

/* What is used of Python, all of its stable interface. */
typedef struct {
    int (*Py_IsInitialized)(void);
    void (*Py_InitializeEx)(int signals);
    void *(*PyEval_SaveThread)(void);
    int (*PyGILState_Ensure)(void);
    void (*PyGILState_Release)(int state);
    void *(*PyImport_ImportModule)(const char *name);
    void *(*PyObject_CallMethod)(void *object, const char *name, const char *format, ...);
    void *(*PyObject_Str)(void *object);
    void *(*PyUnicode_AsUTF8String)(void *object);
    char *(*PyBytes_AsString)(void *object);
    void (*PyErr_Fetch)(void **kind, void **value, void **trace);
    void (*Py_DecRef)(void *object);
} Python;
#define OF_PYTHON(DO) \
    DO(Py_IsInitialized) DO(Py_InitializeEx) DO(PyEval_SaveThread) DO(PyGILState_Ensure) DO(PyGILState_Release) \
    DO(PyImport_ImportModule) DO(PyObject_CallMethod) DO(PyObject_Str) DO(PyUnicode_AsUTF8String) DO(PyBytes_AsString) \
    DO(PyErr_Fetch) DO(Py_DecRef)

/* The functions of FMI 2.0 for co-simulation, in the library that Python names. They are found once, under Python's lock. */
#define FUNCTIONS(DO) \
    DO(SetDebugLogging) DO(Instantiate) DO(FreeInstance) DO(SetupExperiment) DO(EnterInitializationMode) \
    DO(ExitInitializationMode) DO(Terminate) DO(Reset) DO(GetReal) DO(GetInteger) DO(GetBoolean) DO(GetString) DO(SetReal) \
    DO(SetInteger) DO(SetBoolean) DO(SetString) DO(GetFMUstate) DO(SetFMUstate) DO(FreeFMUstate) \
    DO(SerializedFMUstateSize) DO(SerializeFMUstate) DO(DeSerializeFMUstate) DO(GetDirectionalDerivative) \
    DO(SetRealInputDerivatives) DO(GetRealOutputDerivatives) DO(DoStep) DO(CancelStep) DO(GetStatus) DO(GetRealStatus) \
    DO(GetIntegerStatus) DO(GetBooleanStatus) DO(GetStringStatus)
#define MEMBER(name) fmi2##name##TYPE *name;
static struct { FUNCTIONS(MEMBER) } native;

/* ---------------------------------------------------------------- what differs between systems */

#ifdef _WIN32
enum { LONGEST = 4096 };
__declspec(dllimport) void *__stdcall LoadLibraryExW(const wchar_t *path, void *file, unsigned long flags);
__declspec(dllimport) void *__stdcall GetProcAddress(void *module, const char *name);

static void *open_library(const char *path)
{
    wchar_t wide[LONGEST];
    return MultiByteToWideChar(UTF_8, 0, path, -1, wide, LONGEST) > 0 ? LoadLibraryExW(wide, NULL, 0) : NULL;
}
static void *open_python(void) { return open_library("python3.dll"); }
static void *find(void *library, const char *name) { return library ? GetProcAddress(library, name) : NULL; }
static const char needed[] = "and python3.dll on PATH";
#else
static void *open_library(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void *open_python(void) { return RTLD_DEFAULT; }
static void *find(void *library, const char *name) { return dlsym(library, name); }
static const char needed[] =
    "in the process of its host; a host that is no Python must preload it (LD_PRELOAD=libpython3.so)";
#endif

/* ---------------------------------------------------------------- to the native functions */

/* Find the functions in a library. Return whether all are there. */
static bool take(const char *path)
{
    void *library = open_library(path);
    bool all = library != NULL;
#define TAKE(name) all = all && (native.name = (fmi2##name##TYPE *)find(library, "fmi2" #name)) != NULL;
    FUNCTIONS(TAKE)
    return all;
}

/* Let Python answer for an FMU with these resources. Return the name of a library, or ! and what is wrong, for `answer`. */
static void ask(const Python *python, const char *folder, char *answer, size_t room)
{
    void *module = python->PyImport_ImportModule("contact_fmu.python.runtime");
    void *found = module ? python->PyObject_CallMethod(module, "library", "y", folder) : NULL, *kind, *value = NULL, *trace, *text;
    const char *bytes = found ? python->PyBytes_AsString(found) : NULL;
    if (bytes) {
        snprintf(answer, room, "%s", bytes);
    } else {
        python->PyErr_Fetch(&kind, &value, &trace); /* the exception is cleared; that one is not freed is no matter */
        text = value ? python->PyObject_Str(value) : NULL;
        text = text ? python->PyUnicode_AsUTF8String(text) : NULL;
        bytes = text ? python->PyBytes_AsString(text) : NULL;
        snprintf(answer, room, "!this FMU needs the package wheelrail-contact in the host's Python: %s", bytes ? bytes : "no reason");
    }
    if (found) python->Py_DecRef(found);
    if (module) python->Py_DecRef(module);
}

/* Find the native functions. If that fails, `answer` begins with ! and says why. */
static bool find_native(const char *folder, char *answer, size_t room)
{
    void *library = open_python();
    Python python;
    bool is_there = true, done;
#define FIND(name) is_there = is_there && (*(void **)&python.name = find(library, #name)) != NULL;
    OF_PYTHON(FIND)
    if (!is_there) {
        snprintf(answer, room, "!this FMU needs Python with the package wheelrail-contact %s", needed);
        return false;
    }
    if (!python.Py_IsInitialized()) {
        python.Py_InitializeEx(0);
        python.PyEval_SaveThread();
    }
    const int state = python.PyGILState_Ensure();
    ask(&python, folder, answer, room);
    done = *answer != '!' && (native.Instantiate || take(answer));
    if (*answer != '!' && !done) {
        native.Instantiate = NULL;
        snprintf(answer, room, "!the library of wheelrail-contact cannot be loaded, or has no FMI functions");
    }
    python.PyGILState_Release(state);
    return done;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    char said[4096] = "!";
    char *folder = path_of(resources);
    bool found = false;
    if (!functions) return free(folder), NULL;
    if (type != fmi2CoSimulation)
        snprintf(said, sizeof said, "!fmuType %d is not co-simulation", (int)type);
    else if (!folder)
        snprintf(said, sizeof said, "!the resource location is NULL");
    else
        found = find_native(folder, said, sizeof said);
    free(folder);
    if (found) return native.Instantiate(name, type, guid, resources, functions, visible, logging);
    for (char *p = said; *p; p++) /* the text is the format itself, since loggers of Python hosts get no further arguments */
        if (*p == '%') *p = '?';
    if (functions->logger)
        functions->logger(functions->componentEnvironment, name ? name : "", fmi2Error, "logStatusError", said + 1);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c)
{
    if (c && native.FreeInstance) native.FreeInstance(c);
}

#define PASS(name, parameters, arguments) \
    fmi2Status fmi2##name parameters { return native.name ? native.name arguments : fmi2Error; }
#define PASS_ALONE(name) PASS(name, (fmi2Component c), (c))
#define PASS_VALUES(name, type) \
    PASS(name, (fmi2Component c, const fmi2ValueReference refs[], size_t n, type values[]), (c, refs, n, values))
#define PASS_STATUS(name, type) PASS(Get##name, (fmi2Component c, const fmi2StatusKind kind, type *value), (c, kind, value))
typedef const fmi2ValueReference *References;

PASS(SetDebugLogging, (fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]), (c, on, n, names))
PASS(SetupExperiment,
     (fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start, fmi2Boolean has_stop, fmi2Real stop),
     (c, has_tolerance, tolerance, start, has_stop, stop))
PASS_ALONE(EnterInitializationMode)
PASS_ALONE(ExitInitializationMode)
PASS_ALONE(Terminate)
PASS_ALONE(Reset)
PASS_ALONE(CancelStep)
PASS_VALUES(GetReal, fmi2Real)
PASS_VALUES(GetInteger, fmi2Integer)
PASS_VALUES(GetBoolean, fmi2Boolean)
PASS_VALUES(GetString, fmi2String)
PASS_VALUES(SetReal, const fmi2Real)
PASS_VALUES(SetInteger, const fmi2Integer)
PASS_VALUES(SetBoolean, const fmi2Boolean)
PASS_VALUES(SetString, const fmi2String)
PASS(GetFMUstate, (fmi2Component c, fmi2FMUstate *state), (c, state))
PASS(SetFMUstate, (fmi2Component c, fmi2FMUstate state), (c, state))
PASS(FreeFMUstate, (fmi2Component c, fmi2FMUstate *state), (c, state))
PASS(SerializedFMUstateSize, (fmi2Component c, fmi2FMUstate state, size_t *size), (c, state, size))
PASS(SerializeFMUstate, (fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size), (c, state, bytes, size))
PASS(DeSerializeFMUstate, (fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state), (c, bytes, size, state))
PASS(GetDirectionalDerivative,
     (fmi2Component c, References unknowns, size_t n, References knowns, size_t m, const fmi2Real seed[], fmi2Real result[]),
     (c, unknowns, n, knowns, m, seed, result))
PASS(SetRealInputDerivatives,
     (fmi2Component c, References refs, size_t n, const fmi2Integer orders[], const fmi2Real values[]), (c, refs, n, orders, values))
PASS(GetRealOutputDerivatives,
     (fmi2Component c, References refs, size_t n, const fmi2Integer orders[], fmi2Real values[]), (c, refs, n, orders, values))
PASS(DoStep, (fmi2Component c, fmi2Real time, fmi2Real h, fmi2Boolean no_state_before), (c, time, h, no_state_before))
PASS_STATUS(Status, fmi2Status)
PASS_STATUS(RealStatus, fmi2Real)
PASS_STATUS(IntegerStatus, fmi2Integer)
PASS_STATUS(BooleanStatus, fmi2Boolean)
PASS_STATUS(StringStatus, fmi2String)
