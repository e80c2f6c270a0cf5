/* FMI 3.0: its functions and types, mapped to those that both versions share. */
#include "fmi3Functions.h"
#include "instance.h"

#define SHARED(call) ((fmi3Status)(call))
#define NO_NULL(c, ...) REFUSE_NULL(c, fmi3Error, __VA_ARGS__)
/* A function that is a call, at once or after a look at its pointers. */
#define PASS(name, parameters, call) \
    fmi3Status fmi3##name parameters { return SHARED(call); }
#define PASS_IF(name, parameters, call, ...) \
    fmi3Status fmi3##name parameters \
    { \
        NO_NULL(c, __VA_ARGS__); \
        return SHARED(call); \
    }
typedef const fmi3ValueReference *References;

static void write_log(const Log *log, const char *name, Status status, const char *category, char *message)
{
    (void)name;
    for (char *p = message; *p; p++)
        if (*p == '#') *p = '?'; /* text of the host may contain #, which starts a value reference */
    ((fmi3LogMessageCallback)log->logger)(log->environment, (fmi3Status)status, category, message);
}

const char *fmi3GetVersion(void) { return fmi3Version; }

PASS(SetDebugLogging, (fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String names[]),
     choose_log(c, __func__, on, n, names))

/* ---------------------------------------------------------------- from instantiate to free */

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback logger)
{
    const Log log = {write_log, (void (*)(void))logger, environment};
    (void)visible;
    return instantiate(MODEL_EXCHANGE, true, name, token, resources, &log, logging);
}

static fmi3Instance cannot(const Log *log, const char *why)
{
    const Instance caller = {.categories = LOG_ERROR, .log = *log};
    report(&caller, LOG_ERROR, "%s", why);
    return NULL;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], size_t n_intermediate,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                         fmi3IntermediateUpdateCallback update)
{
    const Log log = {write_log, (void (*)(void))logger, environment};
    (void)visible, (void)intermediate, (void)update;
    (void)early_return; /* a step always runs to its end */
    if (event_mode) return cannot(&log, "there is no event mode in co-simulation (hasEventMode is false)");
    if (n_intermediate > 0)
        return cannot(&log, "there are no intermediate updates (providesIntermediateUpdate is false)");
    return instantiate(CO_SIMULATION, true, name, token, resources, &log, logging);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                               fmi3ClockUpdateCallback clock, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock)
{
    const Log log = {write_log, (void (*)(void))logger, environment};
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)clock, (void)lock, (void)unlock;
    return cannot(&log, "scheduled execution is not provided");
}

void fmi3FreeInstance(fmi3Instance c) { release(c); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop)
{
    Status status = set_up(c, __func__, start, has_stop, stop);
    (void)has_tolerance, (void)tolerance;
    return SHARED(status == OK ? enter_initialization(c, __func__) : status);
}

PASS(ExitInitializationMode, (fmi3Instance c), exit_initialization(c, __func__))
PASS(EnterConfigurationMode, (fmi3Instance c), enter_configuration(c, __func__))
PASS(ExitConfigurationMode, (fmi3Instance c), exit_configuration(c, __func__))
PASS(Terminate, (fmi3Instance c), terminate(c, __func__))
PASS(Reset, (fmi3Instance c), reset(c, __func__))

/* ---------------------------------------------------------------- variables */

#define GET(type, kinds) \
    fmi3Status fmi3Get##type(fmi3Instance c, const fmi3ValueReference refs[], size_t n, fmi3##type values[], size_t n_values) \
    { \
        NO_NULL(c, IF(n, refs), IF(n, values)); \
        Status status = before_get(c, __func__, refs, n, kinds, n_values); \
        if (status > WARNING) return SHARED(status); \
        for (size_t k = 0; k < n; k++) { \
            const double *from = numbers(c, refs[k]); \
            for (size_t i = extent(c, refs[k]); i > 0; i--) *values++ = (fmi3##type)*from++; \
        } \
        return SHARED(status); \
    }
GET(Float64, REAL)
GET(Int64, INTEGER | ENUMERATION)
GET(UInt64, COUNT)
GET(Boolean, BOOLEAN)

#define SET(type, kinds) \
    fmi3Status fmi3Set##type(fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3##type values[], \
                             size_t n_values) \
    { \
        Instance *instance = c; \
        NO_NULL(c, IF(n, refs), IF(n, values)); \
        Status status = before_set(c, __func__, refs, n, kinds, n_values); \
        if (status != OK) return SHARED(status); \
        for (size_t k = 0; k < n; k++) { \
            double *to = instance->values + refs[k]; \
            for (size_t i = extent(c, refs[k]); i > 0; i--) *to++ = (double)*values++; \
        } \
        return fmi3OK; \
    }
SET(Float64, REAL)
SET(Int64, INTEGER | ENUMERATION)
SET(UInt64, COUNT)
SET(Boolean, BOOLEAN)

/* No table has variables of other types. */
#define NONE(type) \
    fmi3Status fmi3Get##type(fmi3Instance c, const fmi3ValueReference refs[], size_t n, fmi3##type values[], size_t n_values) \
    { \
        (void)values; \
        return SHARED(before_get(c, __func__, refs, n, 0, n_values)); \
    } \
    fmi3Status fmi3Set##type(fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3##type values[], \
                             size_t n_values) \
    { \
        (void)values; \
        return SHARED(before_set(c, __func__, refs, n, 0, n_values)); \
    }
NONE(Float32)
NONE(Int8)
NONE(UInt8)
NONE(Int16)
NONE(UInt16)
NONE(Int32)
NONE(UInt32)
NONE(String)

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference refs[], size_t n, size_t sizes[], fmi3Binary values[],
                         size_t n_values)
{
    (void)sizes, (void)values;
    return SHARED(before_get(c, __func__, refs, n, 0, n_values));
}

fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference refs[], size_t n, const size_t sizes[],
                         const fmi3Binary values[], size_t n_values)
{
    (void)sizes, (void)values;
    return SHARED(before_set(c, __func__, refs, n, 0, n_values));
}

#define DERIVATIVE(name, function) \
    PASS_IF(name, \
            (fmi3Instance c, References unknowns, size_t n_unknowns, References knowns, size_t n_knowns, \
             const fmi3Float64 seed[], size_t n_seed, fmi3Float64 result[], size_t n_result), \
            function(c, __func__, unknowns, n_unknowns, knowns, n_knowns, seed, n_seed, result, n_result), \
            IF(n_unknowns, unknowns), IF(n_knowns, knowns), IF(n_seed, seed), IF(n_result, result))
DERIVATIVE(GetDirectionalDerivative, derivative)
DERIVATIVE(GetAdjointDerivative, adjoint)

/* ---------------------------------------------------------------- not provided, according to the capability flags */

static fmi3Status not_provided(const Instance *instance, const char *function)
{
    return SHARED(instance ? report(instance, LOG_ERROR, "%s is not provided", function) : ERROR);
}
#define NOT_PROVIDED(function, ...) \
    fmi3Status function(fmi3Instance c, __VA_ARGS__) { return not_provided(c, __func__); }
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
NOT_PROVIDED(fmi3GetNumberOfVariableDependencies, fmi3ValueReference reference, size_t *n)
NOT_PROVIDED(fmi3GetVariableDependencies, fmi3ValueReference dependent, size_t elements[],
             fmi3ValueReference independents[], size_t independent_elements[], fmi3DependencyKind kinds[], size_t n)
NOT_PROVIDED(fmi3GetOutputDerivatives, const fmi3ValueReference refs[], size_t n, const fmi3Int32 orders[],
             fmi3Float64 values[], size_t n_values)
NOT_PROVIDED(fmi3GetClock, const fmi3ValueReference refs[], size_t n, fmi3Clock values[])
NOT_PROVIDED(fmi3SetClock, const fmi3ValueReference refs[], size_t n, const fmi3Clock values[])
NOT_PROVIDED(fmi3GetIntervalDecimal, const fmi3ValueReference refs[], size_t n, fmi3Float64 intervals[],
             fmi3IntervalQualifier qualifiers[])
NOT_PROVIDED(fmi3GetIntervalFraction, const fmi3ValueReference refs[], size_t n, fmi3UInt64 counters[],
             fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
NOT_PROVIDED(fmi3GetShiftDecimal, const fmi3ValueReference refs[], size_t n, fmi3Float64 shifts[])
NOT_PROVIDED(fmi3GetShiftFraction, const fmi3ValueReference refs[], size_t n, fmi3UInt64 counters[],
             fmi3UInt64 resolutions[])
NOT_PROVIDED(fmi3SetIntervalDecimal, const fmi3ValueReference refs[], size_t n, const fmi3Float64 intervals[])
NOT_PROVIDED(fmi3SetIntervalFraction, const fmi3ValueReference refs[], size_t n, const fmi3UInt64 counters[],
             const fmi3UInt64 resolutions[])
NOT_PROVIDED(fmi3SetShiftDecimal, const fmi3ValueReference refs[], size_t n, const fmi3Float64 shifts[])
NOT_PROVIDED(fmi3SetShiftFraction, const fmi3ValueReference refs[], size_t n, const fmi3UInt64 counters[],
             const fmi3UInt64 resolutions[])
NOT_PROVIDED(fmi3ActivateModelPartition, fmi3ValueReference clock, fmi3Float64 time)
#pragma GCC diagnostic pop

PASS(EvaluateDiscreteStates, (fmi3Instance c), not_provided(c, __func__))
PASS(EnterStepMode, (fmi3Instance c), not_provided(c, __func__)) /* leaves the event mode of co-simulation */

/* ---------------------------------------------------------------- states */

PASS(GetFMUState, (fmi3Instance c, fmi3FMUState *state), get_state(c, __func__, state))
PASS(SetFMUState, (fmi3Instance c, fmi3FMUState state), set_state(c, __func__, state))
PASS(FreeFMUState, (fmi3Instance c, fmi3FMUState *state), free_state(c, __func__, state))
PASS(SerializedFMUStateSize, (fmi3Instance c, fmi3FMUState state, size_t *size), state_size(c, __func__, state, size))
PASS(SerializeFMUState, (fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size),
     serialize(c, __func__, state, bytes, size))
PASS(DeserializeFMUState, (fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state),
     deserialize(c, __func__, bytes, size, state))

/* ---------------------------------------------------------------- co-simulation */

/* A step runs to its end or not at all. A discarded step may be repeated with other inputs. */
fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 h, fmi3Boolean no_set_state_before,
                      fmi3Boolean *event_handling_needed, fmi3Boolean *terminate_simulation, fmi3Boolean *early_return,
                      fmi3Float64 *last_successful_time)
{
    (void)no_set_state_before;
    NO_NULL(c, event_handling_needed, terminate_simulation, early_return, last_successful_time);
    Status status = do_step(c, __func__, time, h);
    *event_handling_needed = *terminate_simulation = *early_return = fmi3False;
    *last_successful_time = ((Instance *)c)->is.time;
    return SHARED(status);
}

/* ---------------------------------------------------------------- model exchange */

PASS(EnterEventMode, (fmi3Instance c), enter_event(c, __func__))
PASS(EnterContinuousTimeMode, (fmi3Instance c), enter_continuous(c, __func__))
PASS(SetTime, (fmi3Instance c, fmi3Float64 time), set_time(c, __func__, time))

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *needs_update, fmi3Boolean *terminate_simulation,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *values_changed,
                                    fmi3Boolean *next_time_defined, fmi3Float64 *next_time)
{
    NO_NULL(c, needs_update, terminate_simulation, nominals_changed, values_changed, next_time_defined, next_time);
    *needs_update = *terminate_simulation = *nominals_changed = *values_changed = *next_time_defined = fmi3False;
    *next_time = 0.0;
    return SHARED(update_discrete(c, __func__));
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean no_set_state_before, fmi3Boolean *enter_event_mode,
                                       fmi3Boolean *terminate_simulation)
{
    (void)no_set_state_before;
    NO_NULL(c, enter_event_mode, terminate_simulation);
    *enter_event_mode = *terminate_simulation = fmi3False;
    return SHARED(completed_step(c, __func__));
}

PASS_IF(SetContinuousStates, (fmi3Instance c, const fmi3Float64 x[], size_t n), set_none(c, __func__, n), IF(n, x))
PASS_IF(GetContinuousStates, (fmi3Instance c, fmi3Float64 x[], size_t n), get_none(c, __func__, n), IF(n, x))
PASS_IF(GetContinuousStateDerivatives, (fmi3Instance c, fmi3Float64 x[], size_t n), get_none(c, __func__, n), IF(n, x))
PASS_IF(GetNominalsOfContinuousStates, (fmi3Instance c, fmi3Float64 x[], size_t n), get_none(c, __func__, n), IF(n, x))

fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 indicators[], size_t n)
{
    (void)indicators;
    return SHARED(get_none(c, __func__, n));
}

PASS_IF(GetNumberOfContinuousStates, (fmi3Instance c, size_t *n), count_none(c, __func__, n), n)
PASS_IF(GetNumberOfEventIndicators, (fmi3Instance c, size_t *n), count_none(c, __func__, n), n)
