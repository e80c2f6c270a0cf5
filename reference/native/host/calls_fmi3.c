#include "fmi3.h"

static fmi3FMUState saved;
static fmi3Byte bytes[1 << 16];
static size_t size, count;
static const double newton = 5e4;
static double number, field[ELEMENTS], gaps[SAMPLES];
static const fmi3Int64 first = 1;
static const fmi3UInt64 twelve = 12;
static const fmi3Int32 order = 1;
static fmi3Int64 integer;
static fmi3UInt64 natural;
static fmi3Boolean flag[5], sticks[ELEMENTS];

/* ---------------------------------------------------------------- instantiate */

void instantiate(void)
{
    check(!strcmp(GetVersion(), "3.0"), "version", GetVersion());
    check(!InstantiateModelExchange("i", "{wrong}", resources, 0, 0, NULL, logger) && messages == 1, "wrong token", last_message);
    check(!InstantiateModelExchange("i", NULL, resources, 0, 0, NULL, logger) && messages == 2, "no token", last_message);
    check(!InstantiateModelExchange("", guid, resources, 0, 0, NULL, logger) && messages == 3, "no name", last_message);
    check(!InstantiateCoSimulation("i", guid, resources, 0, 0, 1, 0, NULL, 0, NULL, logger, NULL) && messages == 4, "event mode",
          last_message);
    check(!InstantiateCoSimulation("i", guid, resources, 0, 0, 0, 0, &load, 1, NULL, logger, NULL) && messages == 5,
          "intermediate update", last_message);
    check(!InstantiateScheduledExecution("i", guid, resources, 0, 0, NULL, logger, NULL, NULL, NULL) && messages == 6,
          "scheduled execution", last_message);
    check(!InstantiateModelExchange("i", "{wrong}", resources, 0, 0, NULL, NULL), "wrong token", "without a logger");
    FreeInstance(NULL);
    check(Reset(NULL) == fmi3Error, "fmi3Reset", "of no instance");
    check(step(NULL, 0.0, 1e-3) == fmi3Error, "fmi3DoStep", "of no instance");
    check(GetClock(NULL, NULL, 0, NULL) == fmi3Error, "fmi3GetClock", "of no instance");
}

/* ---------------------------------------------------------------- every function in every state */

enum { INST = 1, CONF = 2, INIT = 4, STEP = 8, FAIL = 16, EVENT = 32, CONT = 64, TERM = 128, ALL = 255, AFTER = ALL & ~INST & ~CONF };
static const struct { int state; Type type; const char *name; } states[] = {
    {INST, CS, "instantiated, CS"},        {CONF, CS, "configuration mode, CS"}, {INIT, CS, "initialization mode, CS"},
    {STEP, CS, "step mode"},               {FAIL, CS, "after a discarded step"}, {TERM, CS, "terminated, CS"},
    {INST, ME, "instantiated, ME"},        {CONF, ME, "configuration mode, ME"}, {INIT, ME, "initialization mode, ME"},
    {EVENT, ME, "event mode"},             {CONT, ME, "continuous-time mode"},   {TERM, ME, "terminated, ME"},
};

/* By ANALYN: the tables of interacting strips, for every instance, would take most of the time, and under valgrind minutes. */
static fmi3Instance in_state(int state, Type type)
{
    static const fmi3ValueReference method = V_method_normal;
    static const fmi3Int64 analyn = 1;
    fmi3Instance c = make(type, logger);
    SetInt64(c, &method, 1, &analyn, 1);
    if (state == CONF) EnterConfigurationMode(c);
    if (state & (INST | CONF)) return c;
    EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3True, 10.0);
    if (state == INIT) return c;
    ExitInitializationMode(c);
    if (state == FAIL) {
        set(c, V_speed, NAN);
        check(step(c, 0.0, 1e-3) == fmi3Discard, "a step with NaN", "");
        set(c, V_speed, 20.0);
    }
    if (state == CONT) EnterContinuousTimeMode(c);
    if (state == TERM) Terminate(c);
    return c;
}

#define NO_TYPE(type) \
    X(Get##type(c, NULL, 0, NULL, 0), ALL, ALL) \
    X(Get##type(c, &load, 1, NULL, 1), 0, 0) \
    X(Set##type(c, NULL, 0, NULL, 0), ALL & ~TERM, ALL & ~TERM) \
    X(Set##type(c, &load, 1, NULL, 1), 0, 0)
#define CALLS \
    X(SetDebugLogging(c, fmi3True, 0, NULL), ALL, ALL) \
    X(EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3False, 0.0), INST, INST) \
    X(EnterInitializationMode(c, fmi3False, 0.0, 1.0, fmi3True, 0.0), 0, 0) \
    X(ExitInitializationMode(c), INIT, INIT) \
    X(EnterConfigurationMode(c), INST, INST) \
    X(ExitConfigurationMode(c), CONF, CONF) \
    X(Terminate(c), STEP | FAIL, EVENT | CONT) \
    X(Reset(c), ALL, ALL) \
    X(GetFloat64(c, &seconds, 1, &number, 1), ALL, ALL) \
    X(GetFloat64(c, &load, 1, &number, 1), ALL, ALL) \
    X(GetFloat64(c, &force, 1, &number, 1), AFTER, AFTER) \
    X(GetFloat64(c, &gap, 1, gaps, SAMPLES), ALL, ALL) \
    X(GetFloat64(c, &gap, 1, gaps, SAMPLES - 1), 0, 0) \
    X(GetFloat64(c, &pressure, 1, field, ELEMENTS), AFTER, AFTER) \
    X(GetFloat64(c, &pressure, 1, field, ELEMENTS + 1), 0, 0) \
    X(GetBoolean(c, &stick, 1, sticks, ELEMENTS), AFTER, AFTER) \
    X(GetInt64(c, &method, 1, &integer, 1), ALL, ALL) \
    X(GetUInt64(c, &strips, 1, &natural, 1), ALL, ALL) \
    X(GetInt64(c, &strips, 1, &integer, 1), 0, 0) \
    X(SetFloat64(c, &load, 1, &newton, 1), ALL & ~CONF & ~TERM, ALL & ~CONF & ~TERM) \
    X(SetFloat64(c, &gap, 1, gaps, SAMPLES), ALL & ~CONF & ~TERM, ALL & ~CONF & ~TERM) \
    X(SetFloat64(c, &gap, 1, gaps, 1), 0, 0) \
    X(SetFloat64(c, &force, 1, &newton, 1), 0, 0) \
    X(SetFloat64(c, &pressure, 1, field, ELEMENTS), 0, 0) \
    X(SetFloat64(c, &seconds, 1, &newton, 1), 0, 0) \
    X(SetInt64(c, &method, 1, &first, 1), INST | INIT, INST | INIT) \
    X(SetUInt64(c, &strips, 1, &twelve, 1), CONF, CONF) \
    X(SetBoolean(c, &stick, 1, sticks, ELEMENTS), 0, 0) \
    NO_TYPE(Float32) NO_TYPE(Int8) NO_TYPE(UInt8) NO_TYPE(Int16) NO_TYPE(UInt16) NO_TYPE(Int32) NO_TYPE(UInt32) \
    NO_TYPE(String) \
    X(GetBinary(c, &load, 1, NULL, NULL, 1), 0, 0) \
    X(SetBinary(c, &load, 1, NULL, NULL, 1), 0, 0) \
    X(GetFMUState(c, &saved), ALL, ALL) \
    X(SetFMUState(c, saved), ALL, ALL) \
    X(SetFMUState(c, NULL), 0, 0) \
    X(SerializedFMUStateSize(c, saved, &size), ALL, ALL) \
    X(SerializeFMUState(c, saved, bytes, size), ALL, ALL) \
    X(SerializeFMUState(c, saved, bytes, size - 1), 0, 0) \
    X(DeserializeFMUState(c, bytes, size, &saved), ALL, ALL) \
    X(DeserializeFMUState(c, bytes, size - 1, &saved), 0, 0) \
    X(FreeFMUState(c, &saved), ALL, ALL) \
    X(GetDirectionalDerivative(c, &force, 1, &load, 1, &one, 1, &number, 1), AFTER, AFTER) \
    X(GetDirectionalDerivative(c, &pressure, 1, &load, 1, &one, 1, field, ELEMENTS), AFTER, AFTER) \
    X(GetDirectionalDerivative(c, &force, 1, &gap, 1, gaps, SAMPLES, &number, 1), AFTER, AFTER) \
    X(GetDirectionalDerivative(c, &force, 1, &gap, 1, &one, 1, &number, 1), 0, 0) \
    X(GetDirectionalDerivative(c, &load, 1, &load, 1, &one, 1, &number, 1), 0, 0) \
    X(GetAdjointDerivative(c, &force, 1, &load, 1, &one, 1, &number, 1), AFTER, AFTER) \
    X(GetAdjointDerivative(c, &force, 1, &gap, 1, &one, 1, gaps, SAMPLES), AFTER, AFTER) \
    X(GetAdjointDerivative(c, &force, 1, &gap, 1, &one, 1, gaps, 1), 0, 0) \
    X(GetAdjointDerivative(c, &load, 1, &load, 1, &one, 1, &number, 1), 0, 0) \
    X(GetNumberOfVariableDependencies(c, force, &count), 0, 0) \
    X(GetVariableDependencies(c, force, NULL, NULL, NULL, NULL, 0), 0, 0) \
    X(GetOutputDerivatives(c, &force, 1, &order, &number, 1), 0, 0) \
    X(GetClock(c, &load, 1, NULL), 0, 0) \
    X(SetClock(c, &load, 1, NULL), 0, 0) \
    X(GetIntervalDecimal(c, &load, 1, NULL, NULL), 0, 0) \
    X(GetIntervalFraction(c, &load, 1, NULL, NULL, NULL), 0, 0) \
    X(GetShiftDecimal(c, &load, 1, NULL), 0, 0) \
    X(GetShiftFraction(c, &load, 1, NULL, NULL), 0, 0) \
    X(SetIntervalDecimal(c, &load, 1, NULL), 0, 0) \
    X(SetIntervalFraction(c, &load, 1, NULL, NULL), 0, 0) \
    X(SetShiftDecimal(c, &load, 1, NULL), 0, 0) \
    X(SetShiftFraction(c, &load, 1, NULL, NULL), 0, 0) \
    X(ActivateModelPartition(c, load, 0.0), 0, 0) \
    X(EvaluateDiscreteStates(c), 0, 0) \
    X(EnterStepMode(c), 0, 0) \
    X(step(c, 0.0, 1e-3), STEP | FAIL, 0) \
    X(step(c, 0.0, 0.0), 0, 0) \
    X(step(c, 0.0, 11.0), 0, 0) \
    X(step(c, 1e-3, 1e-3), 0, 0) \
    X(step(c, -1e-3, 1e-3), 0, 0) \
    X(step(c, NAN, 1e-3), 0, 0) \
    X(EnterEventMode(c), 0, EVENT | CONT) \
    X(UpdateDiscreteStates(c, flag, flag + 1, flag + 2, flag + 3, flag + 4, &number), 0, EVENT) \
    X(EnterContinuousTimeMode(c), 0, EVENT) \
    X(CompletedIntegratorStep(c, fmi3True, flag, flag + 1), 0, CONT) \
    X(SetTime(c, 0.1), 0, EVENT | CONT) \
    X(SetTime(c, INFINITY), 0, 0) \
    X(SetContinuousStates(c, NULL, 0), 0, CONT) \
    X(SetContinuousStates(c, &one, 1), 0, 0) \
    X(GetContinuousStateDerivatives(c, NULL, 0), 0, INIT | EVENT | CONT | TERM) \
    X(GetEventIndicators(c, NULL, 0), 0, INIT | EVENT | CONT | TERM) \
    X(GetContinuousStates(c, NULL, 0), 0, INIT | EVENT | CONT | TERM) \
    X(GetNominalsOfContinuousStates(c, NULL, 0), 0, INIT | EVENT | CONT | TERM) \
    X(GetNumberOfEventIndicators(c, &count), 0, ALL) \
    X(GetNumberOfContinuousStates(c, &count), 0, ALL)

void every_call(void)
{
    int done = 0;
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        fmi3Instance c;
        int before;
#define X(call, in_cs, in_me) \
    c = in_state(states[i].state, states[i].type); \
    for (int k = 0; k < SAMPLES; k++) gaps[k] = 1e-6 * (k - SAMPLES / 2) * (k - SAMPLES / 2); \
    GetFMUState(c, &saved); \
    SerializedFMUStateSize(c, saved, &size); \
    SerializeFMUState(c, saved, bytes, size); \
    before = messages; \
    if ((states[i].type == CS ? (in_cs) : (in_me)) & states[i].state) { \
        check(call == fmi3OK && messages == before, #call, states[i].name); \
    } else { \
        check(call == fmi3Error && messages == before + 1, #call, states[i].name); \
    } \
    FreeFMUState(c, &saved); \
    FreeInstance(c); \
    done++;
        CALLS
#undef X
    }
    printf("%d calls\n", done);
}
