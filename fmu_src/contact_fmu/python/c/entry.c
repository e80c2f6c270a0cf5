/* The library that a host loads of an FMU for hosts with Python. It passes all calls on to pythonfmu's library, which lies
 * beside it, and does what that one (0.7.0) does not:
 *
 * - It finds the resources at any location. pythonfmu's decodes no byte of a URI but %20, and ends the host by a wrong access
 *   to memory if the folder is not there.
 * - It refuses what would end the host: a NULL, a library that does not find Python, a folder that is no FMU's.
 * - It tells the host what Python said: a call returns the worst status that was logged in it, and the messages go to the
 *   host's logger by the rules of the native FMUs. An instance that logged an error while it was made is not returned. */
#ifndef _WIN32
#include <unistd.h>
#endif
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "entry.h"
#include "location.h"

enum { LOG_WARNING = 1, LOG_DISCARD = 2, LOG_ERROR = 4 };

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

fmi2Status report(Instance *instance, fmi2Status status, const char *format, ...)
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
