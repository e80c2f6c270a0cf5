/* The library that a host loads of an FMU for hosts with Python. It passes all calls on to pythonfmu's library, which lies
 * beside it, and does what that one (0.7.0) does not:
 *
 * - It finds the resources at any location. pythonfmu's decodes no byte of a URI but %20, and ends the host by a wrong access
 *   to memory if the folder is not there.
 * - It refuses what would end the host: a NULL, a library that does not find Python, a folder that is no FMU's.
 * - It tells the host what Python said: a call returns the worst status that was logged in it, and the messages go to the
 *   host's logger by the rules of the native FMUs. An instance that logged an error while it was made is not returned. */
#ifndef _WIN32
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>
#endif
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "location.h"

enum { LOG_WARNING = 1, LOG_DISCARD = 2, LOG_ERROR = 4 };

/* The functions of pythonfmu's library. */
#define FUNCTIONS(DO) \
    DO(Instantiate) DO(FreeInstance) DO(SetupExperiment) DO(EnterInitializationMode) DO(ExitInitializationMode) \
    DO(Terminate) DO(Reset) DO(GetReal) DO(GetInteger) DO(GetBoolean) DO(GetString) DO(SetReal) DO(SetInteger) \
    DO(SetBoolean) DO(SetString) DO(GetFMUstate) DO(SetFMUstate) DO(FreeFMUstate) DO(SerializedFMUstateSize) \
    DO(SerializeFMUstate) DO(DeSerializeFMUstate) DO(DoStep) DO(GetRealStatus)
#define MEMBER(name) fmi2##name##TYPE *name;

typedef struct {
    FUNCTIONS(MEMBER)
    fmi2Component slave;
    fmi2CallbackFunctions callbacks; /* of pythonfmu, which keeps a pointer to them */
    fmi2CallbackLogger logger;       /* of the host, which may free its structure */
    fmi2ComponentEnvironment environment;
    int categories;
    fmi2Status worst; /* that was logged in the present call */
    int folder;       /* descriptor of the resources, or -1 */
    char name[256];   /* a longer name is cut */
} Instance;

static const struct {
    int category;
    const char *name;
} categories[] = {{LOG_WARNING, "logStatusWarning"}, {LOG_DISCARD, "logStatusDiscard"}, {LOG_ERROR, "logStatusError"}};
enum { N_CATEGORIES = sizeof categories / sizeof *categories };

/* Pass a message to the host's logger, unless its category is switched off. */
static fmi2Status tell(Instance *instance, fmi2Status status, const char *text)
{
    const int k = status <= fmi2Warning ? 0 : status == fmi2Discard ? 1 : 2;
    char *message;
    if (status > instance->worst) instance->worst = status;
    if (!instance->logger || !(instance->categories & categories[k].category)) return status;
    message = malloc(strlen(text) + 1);
    if (!message) return status;
    strcpy(message, text);
    /* the text is the format itself, since loggers of Python hosts get no further arguments */
    for (char *p = message; *p; p++)
        if (*p == '%') *p = '?';
    instance->logger(instance->environment, instance->name, status, categories[k].name, message);
    free(message);
    return status;
}

static fmi2Status report(Instance *instance, fmi2Status status, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return tell(instance, status, text);
}

/* Logger of pythonfmu: its message is a whole text. */
static void take(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String text, ...)
{
    (void)name, (void)category;
    tell(environment, status, text ? text : "");
}

/* ---------------------------------------------------------------- the system */

#ifdef _WIN32
enum { LONGEST = 4096, OF_ADDRESS = 4 | 2 /* without a new reference */, BESIDE_IT = 8 };
__declspec(dllimport) int __stdcall GetModuleHandleExW(unsigned long flags, const wchar_t *address, void **module);
__declspec(dllimport) unsigned long __stdcall GetModuleFileNameW(void *module, wchar_t *path, unsigned long room);
__declspec(dllimport) void *__stdcall LoadLibraryExW(const wchar_t *path, void *file, unsigned long flags);
__declspec(dllimport) void *__stdcall GetProcAddress(void *module, const char *name);
__declspec(dllimport) int __stdcall FreeLibrary(void *module);
__declspec(dllimport) unsigned long __stdcall GetLastError(void);
__declspec(dllimport) unsigned long __stdcall GetShortPathNameW(const wchar_t *path, wchar_t *shorter, unsigned long room);

static void *loaded; /* pythonfmu's library */

/* Release pythonfmu's library with this one, so that the host can delete the file. At the end of a process there is no need. */
int __stdcall _DllMainCRTStartup(void *library, unsigned long reason, void *at_the_end)
{
    (void)library;
    if (reason == 0 && !at_the_end && loaded) FreeLibrary(loaded);
    return 1;
}

static void *open_library(Instance *instance)
{
    static const wchar_t name[] = L"pythonfmu-export.dll";
    wchar_t path[LONGEST];
    void *own = NULL, *found = NULL;
    unsigned long n = 0;
    if (GetModuleHandleExW(OF_ADDRESS, (const wchar_t *)(void *)&open_library, &own)) n = GetModuleFileNameW(own, path, LONGEST);
    while (n > 0 && path[n - 1] != L'\\' && path[n - 1] != L'/') n--;
    if (n > 0 && n + sizeof name / sizeof *name < LONGEST) {
        wmemcpy(path + n, name, sizeof name / sizeof *name);
        found = LoadLibraryExW(path, NULL, BESIDE_IT);
    }
    if (!found)
        report(instance, fmi2Error,
               "pythonfmu-export.dll, beside this FMU's library, cannot be loaded (error %lu of Windows): this FMU needs Python with "
               "the package wheelrail-contact, and python3.dll on PATH", GetLastError());
    else if (!loaded)
        loaded = found;
    else
        FreeLibrary(found); /* there is one reference for all instances */
    return found;
}

static void *find(void *library, const char *name) { return GetProcAddress(library, name); }
#else
static void *open_library(Instance *instance)
{
    static const char name[] = "pythonfmu-export.so";
    Dl_info own;
    void *found = NULL;
    const char *end = dladdr((void *)&fmi2Instantiate, &own) && own.dli_fname ? strrchr(own.dli_fname, '/') : NULL;
    const size_t n = end ? (size_t)(end - own.dli_fname) + 1 : 0;
    char *path = malloc(n + sizeof name);
    if (path) {
        if (n) memcpy(path, own.dli_fname, n);
        memcpy(path + n, name, sizeof name);
        found = dlopen(path, RTLD_NOW | RTLD_LOCAL); /* now: a function that is missing later would end the process */
    }
    free(path);
    if (!found) {
        const char *why = dlerror();
        report(instance, fmi2Error,
               "this FMU needs Python with the package wheelrail-contact in the process of its host; a host that is no Python must "
               "preload it (LD_PRELOAD=libpython3.so): %s", why ? why : "out of memory");
    }
    return found;
}

static void *find(void *library, const char *name) { return dlsym(library, name); }
#endif

/* Whether pythonfmu takes the path as it is. It decodes %20, and Python decodes names by the locale of the host. */
static bool is_plain(const char *path)
{
    for (; *path; path++)
        if (*path < ' ' || *path > '~' || *path == '%') return false;
    return true;
}

/* Return a URI of the folder that pythonfmu understands, or report why there is none and return NULL. */
static char *location_for_python(Instance *instance, const char *folder)
{
#ifdef _WIN32
    static const char prefix[] = "file:///";
#else
    static const char prefix[] = "file://";
#endif
    const size_t length = strlen(folder);
    char *made = malloc(sizeof prefix + length + 64); /* 64: of the other name on Linux; on Windows the other one is shorter */
    if (!made) {
        report(instance, fmi2Error, "out of memory");
        return NULL;
    }
    strcpy(made, prefix);
    if (is_plain(folder)) return strcat(made, folder);
#ifdef _WIN32
    wchar_t path[LONGEST], other[LONGEST];
    if (MultiByteToWideChar(UTF_8, 0, folder, -1, path, LONGEST) > 0) {
        const unsigned long n = GetShortPathNameW(path, other, LONGEST);
        bool plain = n > 0 && n < LONGEST && n <= length;
        for (unsigned long k = 0; plain && k < n; k++) {
            plain = other[k] >= L' ' && other[k] <= L'~' && other[k] != L'%';
            made[sizeof prefix - 1 + k] = (char)other[k];
        }
        made[sizeof prefix - 1 + (plain ? n : 0)] = '\0';
        if (plain) return made;
    }
    report(instance, fmi2Error,
           "the FMU lies in %s, whose name Python cannot get here: Windows has no short name for it. Unzip it in a folder whose "
           "path has only letters A to Z, digits and blanks", folder);
#else
    instance->folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (instance->folder >= 0) {
        char test[64];
        snprintf(test, sizeof test, "/proc/self/fd/%d", instance->folder);
        if (access(test, R_OK) == 0) return strcat(made, test);
    }
    report(instance, fmi2Error, "the FMU lies in %s, whose name Python cannot get here: /proc is not there", folder);
#endif
    free(made);
    return NULL;
}

/* ---------------------------------------------------------------- from instantiate to free */

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

/* Return whether the instance has all that pythonfmu's library needs to make its slave, which is then made. */
static bool made(Instance *instance, fmi2String name, fmi2Type type, fmi2String guid, const char *folder, fmi2Boolean visible)
{
    const size_t room = folder ? strlen(folder) + 20 : 0;
    char *script = malloc(room + 1), *location;
    FILE *file = NULL;
    void *library;
    if (!name || !*name) return report(instance, fmi2Error, "the instance has no name"), free(script), false;
    if (type != fmi2CoSimulation)
        return report(instance, fmi2Error, "fmuType %d is not co-simulation", (int)type), free(script), false;
    if (folder && script) {
        snprintf(script, room, "%s/slavemodule.txt", folder);
        file = open_to_read(script);
    }
    free(script);
    if (!file)
        return report(instance, fmi2Error, "resource slavemodule.txt cannot be read from %s",
                      folder ? folder : "no folder: the resource location is NULL"), false;
    fclose(file);
    library = open_library(instance);
    if (!library) return false;
#define FIND(function) \
    instance->function = (fmi2##function##TYPE *)find(library, "fmi2" #function); \
    if (!instance->function) return report(instance, fmi2Error, "pythonfmu's library has no fmi2" #function), false;
    FUNCTIONS(FIND)
    location = location_for_python(instance, folder);
    if (!location) return false;
    instance->slave = instance->Instantiate(name, type, guid ? guid : "", location, &instance->callbacks, visible, fmi2True);
    free(location);
    /* reads nothing, but pythonfmu passes on only then what was logged while the instance was made */
    if (instance->slave) (void)instance->GetReal(instance->slave, NULL, 0, NULL);
    return instance->slave != NULL && instance->worst <= fmi2Warning;
}

static void release(Instance *instance)
{
    if (instance->slave) instance->FreeInstance(instance->slave);
#ifndef _WIN32
    if (instance->folder >= 0) close(instance->folder);
#endif
    free(instance);
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    Instance *instance = functions ? calloc(1, sizeof *instance) : NULL;
    char *folder;
    bool ready;
    if (!instance) return NULL;
    instance->logger = functions->logger;
    instance->environment = functions->componentEnvironment;
    instance->callbacks = (fmi2CallbackFunctions){take, calloc, free, NULL, instance};
    instance->categories = logging ? LOG_WARNING | LOG_DISCARD | LOG_ERROR : LOG_DISCARD | LOG_ERROR;
    instance->folder = -1;
    snprintf(instance->name, sizeof instance->name, "%s", name ? name : "");
    folder = path_of(resources);
    ready = made(instance, name, type, guid, folder, visible);
    free(folder);
    if (ready) return instance;
    if (instance->worst < fmi2Error) report(instance, fmi2Error, "Python made no instance, and gave no reason");
    release(instance);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c)
{
    if (c) release(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[])
{
    Instance *instance = c;
    int chosen = n == 0 ? LOG_WARNING | LOG_DISCARD | LOG_ERROR : 0;
    if (!instance) return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        size_t k = 0;
        while (k < N_CATEGORIES && (!names || !names[i] || strcmp(names[i], categories[k].name))) k++;
        if (k == N_CATEGORIES)
            return report(instance, fmi2Error, "log category %.60s is unknown", names && names[i] ? names[i] : "NULL");
        chosen |= categories[k].category;
    }
    instance->categories = on ? chosen : 0;
    return fmi2OK;
}

/* ---------------------------------------------------------------- calls that are passed on */

/* Refuse a call with a NULL among its instance and its pointers. An array of no elements may be NULL. */
#define CHECK(c, ...) \
    Instance *const instance = c; \
    const void *const pointers[] = {__VA_ARGS__}; \
    if (!instance) return fmi2Error; \
    instance->worst = fmi2OK; \
    for (size_t k = 0; k < sizeof pointers / sizeof *pointers; k++) \
        if (!pointers[k]) \
            return report(instance, fmi2Error, "%s: pointer %zu after the instance is NULL; the call is ignored", __func__, k + 1);
#define IF(n, array) ((n) ? (const void *)(array) : (const void *)"")

/* Return the status of a call, or that of a worse message that was logged in it. */
static fmi2Status worse(const Instance *instance, fmi2Status status)
{
    return status > instance->worst ? status : instance->worst;
}
#define PASS(name, ...) return worse(instance, instance->name(instance->slave, __VA_ARGS__))

#define CALL(name) \
    fmi2Status fmi2##name(fmi2Component c) \
    { \
        CHECK(c, "") \
        return worse(instance, instance->name(instance->slave)); \
    }
CALL(EnterInitializationMode)
CALL(ExitInitializationMode)
CALL(Terminate)
CALL(Reset)

#define VALUES(name, type) \
    fmi2Status fmi2##name(fmi2Component c, const fmi2ValueReference refs[], size_t n, type values[]) \
    { \
        CHECK(c, IF(n, refs), IF(n, values)) \
        PASS(name, refs, n, values); \
    }
VALUES(GetReal, fmi2Real)
VALUES(GetInteger, fmi2Integer)
VALUES(GetBoolean, fmi2Boolean)
VALUES(GetString, fmi2String)
VALUES(SetReal, const fmi2Real)
VALUES(SetInteger, const fmi2Integer)
VALUES(SetBoolean, const fmi2Boolean)
VALUES(SetString, const fmi2String)

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    CHECK(c, "")
    PASS(SetupExperiment, has_tolerance, tolerance, start, has_stop, stop);
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real h, fmi2Boolean no_state_before)
{
    CHECK(c, "")
    PASS(DoStep, time, h, no_state_before);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    CHECK(c, state)
    PASS(GetFMUstate, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    CHECK(c, state)
    PASS(SetFMUstate, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    CHECK(c, "")
    if (!state || !*state) return fmi2OK;
    const fmi2Status status = instance->FreeFMUstate(instance->slave, state);
    *state = NULL; /* a second call frees nothing */
    return worse(instance, status);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    CHECK(c, state, size)
    PASS(SerializedFMUstateSize, state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    size_t needed = 0;
    CHECK(c, state, bytes)
    if (instance->SerializedFMUstateSize(instance->slave, state, &needed) > fmi2Warning || size != needed)
        return report(instance, fmi2Error, "%s: the state has %zu bytes, not %zu", __func__, needed, size);
    PASS(SerializeFMUstate, state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    CHECK(c, bytes, state)
    PASS(DeSerializeFMUstate, bytes, size, state);
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    CHECK(c, value)
    PASS(GetRealStatus, kind, value);
}

/* ---------------------------------------------------------------- what this FMU has not */

static fmi2Status lacks(fmi2Component c, const char *function)
{
    return c ? report(c, fmi2Error, "%s is not supported; the call is ignored", function) : fmi2Error;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                        const fmi2ValueReference knowns[], size_t n_knowns, const fmi2Real seed[],
                                        fmi2Real result[])
{
    (void)unknowns, (void)n_unknowns, (void)knowns, (void)n_knowns, (void)seed, (void)result;
    return lacks(c, __func__);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference refs[], size_t n, const fmi2Integer orders[],
                                       const fmi2Real values[])
{
    (void)refs, (void)n, (void)orders, (void)values;
    return lacks(c, __func__);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference refs[], size_t n, const fmi2Integer orders[],
                                        fmi2Real values[])
{
    (void)refs, (void)n, (void)orders, (void)values;
    return lacks(c, __func__);
}

fmi2Status fmi2CancelStep(fmi2Component c) { return lacks(c, __func__); }

#define STATUS(name, type) \
    fmi2Status fmi2Get##name(fmi2Component c, const fmi2StatusKind kind, type *value) \
    { \
        (void)kind, (void)value; \
        return lacks(c, __func__); \
    }
STATUS(Status, fmi2Status)
STATUS(IntegerStatus, fmi2Integer)
STATUS(BooleanStatus, fmi2Boolean)
STATUS(StringStatus, fmi2String)
