/* FMI 2.0: its functions and types, mapped to those that both versions share. */
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "instance.h"
#include "location.h"

#ifdef FMI2_FUNCTION_PREFIX /* for an FMU that is linked into a program; the header above adds no prefix */
#define JOIN(a, b) a##b
#define JOINED(a, b) JOIN(a, b)
#undef fmi2FullName
#define fmi2FullName(name) JOINED(FMI2_FUNCTION_PREFIX, name)
#endif

#define SHARED(call) ((fmi2Status)(call))
#define NO_NULL(c, ...) REFUSE_NULL(c, fmi2Error, __VA_ARGS__)
/* A function that is a call, at once or after a look at its pointers. */
#define PASS(name, parameters, call) \
    fmi2Status fmi2##name parameters { return SHARED(call); }
#define PASS_IF(name, parameters, call, ...) \
    fmi2Status fmi2##name parameters \
    { \
        NO_NULL(c, __VA_ARGS__); \
        return SHARED(call); \
    }
typedef const fmi2ValueReference *References;

static void write_log(const Log *log, const char *name, Status status, const char *category, char *message)
{
    /* The text is the format itself, since loggers of Python hosts get no further arguments. Text of the host may contain %. */
    for (char *p = message; *p; p++)
        if (*p == '%') *p = '?';
    ((fmi2CallbackLogger)log->logger)(log->environment, name, (fmi2Status)status, category, message);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

PASS(SetDebugLogging, (fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]),
     choose_log(c, __func__, on, n, names))

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)visible;
    if (!functions) return NULL;
    const Log log = {write_log, (void (*)(void))functions->logger, functions->componentEnvironment};
    char *folder = path_of(resources);
    Instance *instance = instantiate((Type)type, false, name, guid, folder, &log, logging);
    free(folder);
    return instance;
}

void fmi2FreeInstance(fmi2Component c) { release(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    (void)has_tolerance; /* nothing is integrated here */
    (void)tolerance;
    return SHARED(set_up(c, __func__, start, has_stop, stop));
}

PASS(EnterInitializationMode, (fmi2Component c), enter_initialization(c, __func__))
PASS(ExitInitializationMode, (fmi2Component c), exit_initialization(c, __func__))
PASS(Terminate, (fmi2Component c), terminate(c, __func__))
PASS(Reset, (fmi2Component c), reset(c, __func__))

/* ---------------------------------------------------------------- variables (no table has Strings) */

#define GET(function, type, kinds) \
    fmi2Status function(fmi2Component c, const fmi2ValueReference refs[], size_t n, type values[]) \
    { \
        const Instance *instance = c; \
        NO_NULL(c, IF(n, refs), IF(n, values)); \
        Status status = before_get(c, __func__, refs, n, kinds, n); \
        if (status > WARNING) return SHARED(status); \
        for (size_t k = 0; k < n; k++) values[k] = (type)*numbers(instance, refs[k]); \
        return SHARED(status); \
    }
GET(fmi2GetReal, fmi2Real, REAL)
GET(fmi2GetInteger, fmi2Integer, INTEGER | ENUMERATION | COUNT)

#define SET(function, type, kinds) \
    fmi2Status function(fmi2Component c, const fmi2ValueReference refs[], size_t n, const type values[]) \
    { \
        Instance *instance = c; \
        NO_NULL(c, IF(n, refs), IF(n, values)); \
        Status status = before_set(c, __func__, refs, n, kinds, n); \
        if (status != OK) return SHARED(status); \
        for (size_t k = 0; k < n; k++) instance->values[refs[k]] = values[k]; \
        return fmi2OK; \
    }
SET(fmi2SetReal, fmi2Real, REAL)
SET(fmi2SetInteger, fmi2Integer, INTEGER | ENUMERATION | COUNT)

/* No table has variables of these types. */
#define ABSENT(type) \
    fmi2Status fmi2Get##type(fmi2Component c, References refs, size_t n, fmi2##type values[]) \
    { \
        (void)values; \
        return SHARED(before_get(c, __func__, refs, n, 0, n)); \
    } \
    fmi2Status fmi2Set##type(fmi2Component c, References refs, size_t n, const fmi2##type values[]) \
    { \
        (void)values; \
        return SHARED(before_set(c, __func__, refs, n, 0, n)); \
    }
ABSENT(Boolean)
ABSENT(String)

PASS_IF(GetDirectionalDerivative,
        (fmi2Component c, References unknowns, size_t n_unknowns, References knowns, size_t n_knowns, const fmi2Real seed[],
         fmi2Real result[]),
        derivative(c, __func__, unknowns, n_unknowns, knowns, n_knowns, seed, n_knowns, result, n_unknowns),
        IF(n_unknowns, unknowns), IF(n_knowns, knowns), IF(n_knowns, seed), IF(n_unknowns, result))

/* ---------------------------------------------------------------- states */

PASS(GetFMUstate, (fmi2Component c, fmi2FMUstate *state), get_state(c, __func__, state))
PASS(SetFMUstate, (fmi2Component c, fmi2FMUstate state), set_state(c, __func__, state))
PASS(FreeFMUstate, (fmi2Component c, fmi2FMUstate *state), free_state(c, __func__, state))
PASS(SerializedFMUstateSize, (fmi2Component c, fmi2FMUstate state, size_t *size), state_size(c, __func__, state, size))
PASS(SerializeFMUstate, (fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size),
     serialize(c, __func__, state, bytes, size))
PASS(DeSerializeFMUstate, (fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state),
     deserialize(c, __func__, bytes, size, state))

/* ---------------------------------------------------------------- co-simulation */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real h, fmi2Boolean no_set_state_before)
{
    (void)no_set_state_before;
    return SHARED(do_step(c, __func__, time, h));
}

/* The functions below are for co-simulation only. */
static Status require_slave(const Instance *instance, const char *function, int phases)
{
    REQUIRE(instance, function, instance->type == CO_SIMULATION ? phases : 0);
    return OK;
}
#define REQUIRE_SLAVE(phases) \
    do { \
        Status legal = require_slave(c, __func__, phases); \
        if (legal != OK) return SHARED(legal); \
    } while (0)
#define STEPPED (STEP_COMPLETE | STEP_FAILED | TERMINATED)

fmi2Status fmi2CancelStep(fmi2Component c)
{
    REQUIRE_SLAVE(0); /* a step is never in progress between calls */
    return fmi2OK;
}

/* One value after a step, of the kind that its function has. */
#define GET_STATUS(name, type, known, given) \
    fmi2Status fmi2Get##name(fmi2Component c, const fmi2StatusKind kind, type *value) \
    { \
        const Instance *instance = c; \
        (void)kind; \
        NO_NULL(c, value); \
        REQUIRE_SLAVE(STEPPED); \
        if (!(known)) return SHARED(report(instance, LOG_DISCARD, "%s: unknown status kind", __func__)); \
        *value = given; \
        return fmi2OK; \
    }
GET_STATUS(Status, fmi2Status, kind == fmi2DoStepStatus, (fmi2Status)instance->is.last_step)
GET_STATUS(RealStatus, fmi2Real, kind == fmi2LastSuccessfulTime, instance->is.time)
GET_STATUS(IntegerStatus, fmi2Integer, false, 0)
/* A host may ask for another step after one that failed, but without other inputs it fails too. */
GET_STATUS(BooleanStatus, fmi2Boolean, kind == fmi2Terminated, instance->is.phase == STEP_FAILED)
GET_STATUS(StringStatus, fmi2String, kind == fmi2PendingStatus, "")

/* Inputs are constant over a step and outputs have no derivatives, as the capability flags state. */
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference refs[], size_t n,
                                       const fmi2Integer order[], const fmi2Real values[])
{
    (void)refs, (void)order, (void)values;
    REQUIRE_SLAVE(INSTANTIATED | INITIALIZATION | STEP_COMPLETE | STEP_FAILED);
    if (n == 0) return fmi2OK;
    return SHARED(report(c, LOG_ERROR, "inputs are not interpolated (canInterpolateInputs is false)"));
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference refs[], size_t n,
                                        const fmi2Integer order[], fmi2Real values[])
{
    (void)refs, (void)order, (void)values;
    REQUIRE_SLAVE(STEPPED);
    if (n == 0) return fmi2OK;
    return SHARED(report(c, LOG_ERROR, "outputs have no derivatives (maxOutputDerivativeOrder is 0)"));
}

/* ---------------------------------------------------------------- model exchange */

PASS(EnterEventMode, (fmi2Component c), enter_event(c, __func__))
PASS(EnterContinuousTimeMode, (fmi2Component c), enter_continuous(c, __func__))
PASS(SetTime, (fmi2Component c, fmi2Real time), set_time(c, __func__, time))

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    NO_NULL(c, info);
    Status status = update_discrete(c, __func__);
    if (status == OK) memset(info, 0, sizeof *info);
    return SHARED(status);
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_set_state_before, fmi2Boolean *enter_event_mode,
                                       fmi2Boolean *terminate_simulation)
{
    (void)no_set_state_before;
    NO_NULL(c, enter_event_mode, terminate_simulation);
    *enter_event_mode = *terminate_simulation = fmi2False;
    return SHARED(completed_step(c, __func__));
}

PASS_IF(SetContinuousStates, (fmi2Component c, const fmi2Real x[], size_t n), set_none(c, __func__, n), IF(n, x))
PASS_IF(GetContinuousStates, (fmi2Component c, fmi2Real x[], size_t n), get_none(c, __func__, n), IF(n, x))
PASS_IF(GetDerivatives, (fmi2Component c, fmi2Real x[], size_t n), get_none(c, __func__, n), IF(n, x))
PASS_IF(GetNominalsOfContinuousStates, (fmi2Component c, fmi2Real x[], size_t n), get_none(c, __func__, n), IF(n, x))

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t n)
{
    (void)indicators;
    return SHARED(get_none(c, __func__, n));
}
