/* A C host for the native FMU of FMI 3.0: LIBRARY TOKEN COMMAND [ARGUMENT]. */
#include "common.h"
#include "fmi3FunctionTypes.h"
#include "model.h"

#define FUNCTIONS(X) \
    X(GetVersion) X(SetDebugLogging) X(InstantiateModelExchange) X(InstantiateCoSimulation) \
    X(InstantiateScheduledExecution) X(FreeInstance) X(EnterInitializationMode) X(ExitInitializationMode) \
    X(EnterEventMode) X(Terminate) X(Reset) X(GetFloat32) X(GetFloat64) X(GetInt8) X(GetUInt8) X(GetInt16) X(GetUInt16) \
    X(GetInt32) X(GetUInt32) X(GetInt64) X(GetUInt64) X(GetBoolean) X(GetString) X(GetBinary) X(GetClock) X(SetFloat32) \
    X(SetFloat64) X(SetInt8) X(SetUInt8) X(SetInt16) X(SetUInt16) X(SetInt32) X(SetUInt32) X(SetInt64) X(SetUInt64) \
    X(SetBoolean) X(SetString) X(SetBinary) X(SetClock) X(GetNumberOfVariableDependencies) X(GetVariableDependencies) \
    X(GetFMUState) X(SetFMUState) X(FreeFMUState) X(SerializedFMUStateSize) X(SerializeFMUState) X(DeserializeFMUState) \
    X(GetDirectionalDerivative) X(GetAdjointDerivative) X(EnterConfigurationMode) X(ExitConfigurationMode) \
    X(GetIntervalDecimal) X(GetIntervalFraction) X(GetShiftDecimal) X(GetShiftFraction) X(SetIntervalDecimal) \
    X(SetIntervalFraction) X(SetShiftDecimal) X(SetShiftFraction) X(EvaluateDiscreteStates) X(UpdateDiscreteStates) \
    X(EnterContinuousTimeMode) X(CompletedIntegratorStep) X(SetTime) X(SetContinuousStates) \
    X(GetContinuousStateDerivatives) X(GetEventIndicators) X(GetContinuousStates) X(GetNominalsOfContinuousStates) \
    X(GetNumberOfEventIndicators) X(GetNumberOfContinuousStates) X(EnterStepMode) X(GetOutputDerivatives) X(DoStep) \
    X(ActivateModelPartition)
#define DECLARE(f) static fmi3##f##TYPE *f;
FUNCTIONS(DECLARE)

enum { SAMPLES = V_geometry_A - V_geometry_g }; /* ELEMENTS of a field is defined by the compiler's command line */
static const fmi3ValueReference load = V_load_normal_force, force = V_force_x, method = V_method_normal,
                                strips = V_resolution_n_strips, gap = V_geometry_g, pressure = V_field_pressure,
                                stick = V_field_stick, seconds = V_time;
static fmi3FMUState saved;
static fmi3Byte bytes[1 << 16];
static size_t size, count;
static const double one = 1.0, newton = 5e4;
static double number, field[ELEMENTS], gaps[SAMPLES];
static const fmi3Int64 first = 1;
static const fmi3UInt64 twelve = 12;
static const fmi3Int32 order = 1;
static fmi3Int64 integer;
static fmi3UInt64 natural;
static fmi3Boolean flag[5], sticks[ELEMENTS];

static void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment, (void)status, (void)category;
    messages++;
    snprintf(last_message, sizeof last_message, "%s", message);
}

static void quiet(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment, (void)status, (void)category, (void)message;
}

typedef enum { ME, CS } Type;

static fmi3Instance make(Type type, fmi3LogMessageCallback log)
{
    if (type == ME) return InstantiateModelExchange("instance", guid, resources, fmi3False, fmi3True, NULL, log);
    return InstantiateCoSimulation("instance", guid, resources, fmi3False, fmi3True, fmi3False, fmi3False, NULL, 0, NULL, log, NULL);
}

static fmi3Status set(fmi3Instance c, fmi3ValueReference r, double value) { return SetFloat64(c, &r, 1, &value, 1); }

static double get(fmi3Instance c, fmi3ValueReference r)
{
    double value = NAN;
    GetFloat64(c, &r, 1, &value, 1);
    return value;
}

static fmi3Status step(fmi3Instance c, double time, double h)
{
    fmi3Status status = DoStep(c, time, h, fmi3True, flag, flag + 1, flag + 2, &number);
    check(!flag[0] && !flag[1] && !flag[2], "flags", "of a step");
    return status;
}

/* ---------------------------------------------------------------- instantiate */

static void instantiate(void)
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

static void every_call(void)
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

/* ---------------------------------------------------------------- threads */

enum { N_INSTANCES = 64, N_THREADS = 8, N_STEPS = 20, N_RESULTS = 3 };
static fmi3Instance crowd[N_INSTANCES];
static double serial[N_INSTANCES][N_RESULTS], parallel[N_INSTANCES][N_RESULTS];

static void advance(int i, double result[N_RESULTS])
{
    fmi3Instance c = crowd[i];
    double own[ELEMENTS], end;
    fmi3Boolean flags[3];
    for (int k = 0; k < N_STEPS; k++) {
        set(c, V_creepage_longitudinal, 1e-5 * (i + 1) * (k + 1));
        set(c, V_load_normal_force, 5e4 + 1e3 * i);
        DoStep(c, 1e-3 * k, 1e-3, fmi3True, flags, flags + 1, flags + 2, &end);
    }
    result[0] = get(c, V_total_energy);
    GetFloat64(c, &pressure, 1, own, ELEMENTS);
    result[1] = result[2] = 0.0;
    for (int k = 0; k < ELEMENTS; k++) result[1] += own[k] * (k + 1);
    const fmi3ValueReference stiffness = V_creep_stiffness;
    GetFloat64(c, &stiffness, 1, own, 9);
    for (int k = 0; k < 9; k++) result[2] += own[k] * (k + 1);
}

static THREAD_RESULT worker(void *first_instance)
{
    for (int i = (int)(size_t)first_instance; i < N_INSTANCES; i += N_THREADS) advance(i, parallel[i]);
    return 0;
}

static void crowd_starts(void)
{
    for (int i = 0; i < N_INSTANCES; i++) {
        const fmi3ValueReference methods[] = {V_method_normal, V_method_tangential};
        const fmi3Int64 chosen[] = {1 + i % 3, 1 + i / 3 % 3};
        crowd[i] = make(CS, quiet);
        SetInt64(crowd[i], methods, 2, chosen, 2);
        EnterInitializationMode(crowd[i], fmi3False, 0.0, 0.0, fmi3False, 0.0);
        ExitInitializationMode(crowd[i]);
    }
}

static void threads(void)
{
    Thread thread[N_THREADS];
    crowd_starts();
    for (int i = 0; i < N_INSTANCES; i++) advance(i, serial[i]);
    for (int i = 0; i < N_INSTANCES; i++) FreeInstance(crowd[i]);
    crowd_starts();
    for (int t = 0; t < N_THREADS; t++) start(&thread[t], worker, (void *)(size_t)t);
    for (int t = 0; t < N_THREADS; t++) join(thread[t]);
    check(!memcmp(serial, parallel, sizeof serial), "parallel equals serial", "");
    check(serial[0][1] > 0.0 && serial[0][0] != serial[1][0], "instances differ", "");
    for (int i = 0; i < N_INSTANCES; i++) FreeInstance(crowd[i]);
}

/* ---------------------------------------------------------------- random calls, speed */

static fmi3Instance with_few_strips(fmi3Instance c)
{
    static const fmi3UInt64 few = 4;
    EnterConfigurationMode(c);
    SetUInt64(c, &strips, 1, &few, 1);
    ExitConfigurationMode(c);
    return c;
}

static void random_calls(int n)
{
    static const double odd[] = {0.0, -1.0, 1e-300, 1e300, NAN, INFINITY, 1e-3, 8e4};
    fmi3Instance c = with_few_strips(make(CS, quiet));
    for (int i = 0; i < n; i++) {
        fmi3ValueReference r = draw(V_time + 3);
        fmi3UInt64 resolution = draw(12);
        fmi3Int64 item = (fmi3Int64)draw(8) - 2;
        switch (draw(19)) {
        case 0: FreeFMUState(c, &saved), FreeInstance(c), c = with_few_strips(make(draw(2) ? CS : ME, quiet)); break;
        case 1: EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3False, 0.0); break;
        case 2: ExitInitializationMode(c); break;
        case 3: EnterContinuousTimeMode(c); break;
        case 4: EnterEventMode(c); break;
        case 5: set(c, r, odd[draw(8)]); break;
        case 6: SetInt64(c, &r, 1, &item, 1); break;
        case 7: GetFMUState(c, &saved); break;
        case 8: SetFMUState(c, saved); break;
        case 9: if (!draw(10)) Terminate(c); break;
        case 10: if (!draw(4)) Reset(c); break;
        case 11: GetDirectionalDerivative(c, &force, 1, &r, 1, odd + draw(8), 1, &number, 1); break;
        case 18: GetAdjointDerivative(c, &force, 1, &r, 1, odd + draw(8), 1, &number, 1); break;
        case 12: SetTime(c, odd[draw(8)]), CompletedIntegratorStep(c, fmi3True, flag, flag + 1); break;
        case 13: EnterConfigurationMode(c), SetUInt64(c, &strips, 1, &resolution, 1), ExitConfigurationMode(c); break;
        case 14:
            natural = 0;
            GetUInt64(c, &strips, 1, &natural, 1);
            r = V_field_patch + draw(V_time - V_field_patch);
            if (natural <= 30 && GetFloat64(c, &r, 1, field, 4 * natural * 30) == fmi3OK)
                for (size_t k = 0; k < 4 * natural * 30; k++) check(isfinite(field[k]), "finite field", "");
            break;
        default:
            number = 0.0;
            step(c, get(c, seconds), 1e-3);
            if (GetFloat64(c, &r, 1, &number, 1) == fmi3OK && r >= V_force_x) check(isfinite(number), "finite output", "");
        }
    }
    FreeFMUState(c, &saved);
    FreeInstance(c);
}

/* v J u by directional derivatives and by adjoint ones, for inputs that the model derives by and for others, and columns that
 * a host asks one by one. */
static void adjoint(void)
{
    enum { UNKNOWNS = 6, KNOWNS = 6, NUMBERS = KNOWNS - 1 + SAMPLES };
    static const fmi3ValueReference unknowns[UNKNOWNS] = {V_force_x, V_force_y, V_moment_z, V_approach, V_power_friction, V_pressure_max};
    static const fmi3ValueReference knowns[KNOWNS] = {V_creepage_longitudinal, V_creepage_lateral, V_creepage_spin,
                                                      V_load_normal_force, V_friction_coefficient, V_geometry_g};
    static const double v[UNKNOWNS] = {1.0, -2.0, 300.0, 1e9, 0.5, 1e-5};
    double u[NUMBERS], row[NUMBERS], product[UNKNOWNS], column[UNKNOWNS], one_way = 0.0, other_way = 0.0, size_of = 0.0, by_columns = 0.0;
    fmi3Instance c = make(ME, logger);
    EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3False, 0.0);
    set(c, V_creepage_longitudinal, 1e-3), set(c, V_creepage_lateral, -5e-4), set(c, V_creepage_spin, 0.2);
    ExitInitializationMode(c);
    for (int i = 0; i < NUMBERS; i++) u[i] = 1e-7 * (1 + i % 3);
    u[2] = 1e-4, u[3] = 10.0, u[4] = 1e-4;
    for (int i = KNOWNS - 1; i < NUMBERS; i++) u[i] *= 1e-3;
    check(GetDirectionalDerivative(c, unknowns, UNKNOWNS, knowns, KNOWNS, u, NUMBERS, product, UNKNOWNS) == fmi3OK, "directional", last_message);
    check(GetAdjointDerivative(c, unknowns, UNKNOWNS, knowns, KNOWNS, v, UNKNOWNS, row, NUMBERS) == fmi3OK, "adjoint", last_message);
    for (int i = 0; i < UNKNOWNS; i++) one_way += v[i] * product[i], size_of += fabs(v[i] * product[i]);
    for (int i = 0; i < NUMBERS; i++) other_way += row[i] * u[i];
    check(fabs(one_way - other_way) < 2e-4 * size_of, "v J u", "two ways, all inputs");
    GetDirectionalDerivative(c, unknowns, UNKNOWNS - 1, knowns, KNOWNS - 1, u, KNOWNS - 1, product, UNKNOWNS - 1);
    GetAdjointDerivative(c, unknowns, UNKNOWNS - 1, knowns, KNOWNS - 1, v, UNKNOWNS - 1, row, KNOWNS - 1);
    one_way = other_way = size_of = 0.0;
    for (int i = 0; i < UNKNOWNS - 1; i++) one_way += v[i] * product[i], size_of += fabs(v[i] * product[i]);
    for (int j = 0; j < KNOWNS - 1; j++) {
        other_way += row[j] * u[j];
        GetDirectionalDerivative(c, unknowns, UNKNOWNS - 1, &knowns[j], 1, &one, 1, column, UNKNOWNS - 1);
        for (int i = 0; i < UNKNOWNS - 1; i++) by_columns += v[i] * column[i] * u[j];
    }
    check(fabs(one_way - other_way) < 1e-13 * size_of && size_of > 1.0, "v J u", "two ways, inputs of the matrix");
    check(fabs(one_way - by_columns) < 1e-13 * size_of, "v J u", "column by column");
    set(c, V_creepage_longitudinal, 2e-3);
    GetDirectionalDerivative(c, unknowns, UNKNOWNS - 1, knowns, KNOWNS - 1, u, KNOWNS - 1, column, UNKNOWNS - 1);
    check(column[0] != product[0], "derivatives", "of a new state");
    set(c, V_creepage_longitudinal, 1e-3);
    GetDirectionalDerivative(c, unknowns, UNKNOWNS - 1, knowns, KNOWNS - 1, u, KNOWNS - 1, column, UNKNOWNS - 1);
    check(!memcmp(column, product, sizeof(double) * (UNKNOWNS - 1)), "derivatives", "of the state before");
    FreeInstance(c);
}

static void speed(int n)
{
    const fmi3ValueReference geometry[] = {V_geometry_g, V_geometry_A}, tractions[] = {V_field_pressure, V_field_traction_x,
                                                                                      V_field_traction_y};
    static double values[2 * SAMPLES], fields[3 * ELEMENTS];
    double begin;
    fmi3Instance c = make(CS, logger);
    EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3True, 10.0);
    ExitInitializationMode(c);
    GetFloat64(c, geometry, 2, values, 2 * SAMPLES);
    set(c, V_creepage_longitudinal, 1e-3);
    set(c, V_creepage_lateral, -5e-4);
    set(c, V_creepage_spin, 0.2);
    begin = now();
    for (int i = 0; i < n; i++) SetFloat64(c, geometry, 2, values, 2 * SAMPLES);
    printf("set geometry %.2f us\n", (now() - begin) / n);
    begin = now();
    for (int i = 0; i < n; i++) step(c, 1e-3 * i, 1e-3);
    printf("step %.2f us\n", (now() - begin) / n);
    begin = now();
    for (int i = 0; i < n; i++) GetFloat64(c, tractions, 3, fields, 3 * ELEMENTS);
    printf("get pressure and tractions %.2f us\n", (now() - begin) / n);
    FreeInstance(c);
}

int main(int n_arguments, char **arguments)
{
    void *library = n_arguments > 4 ? open_library(arguments[1]) : NULL;
    const char *command = n_arguments > 4 ? arguments[4] : "";
    int argument = n_arguments > 5 ? atoi(arguments[5]) : 0;
    if (!library) return puts("the library cannot be loaded"), 2;
    guid = arguments[2];
    resources = arguments[3];
#define FIND(f) if (!(f = (fmi3##f##TYPE *)find(library, "fmi3" #f))) return puts("fmi3" #f " is missing"), 2;
    FUNCTIONS(FIND)
    if (!strcmp(command, "instantiate")) instantiate();
    else if (!strcmp(command, "every_call")) every_call();
    else if (!strcmp(command, "adjoint")) adjoint();
    else if (!strcmp(command, "threads")) threads();
    else if (!strcmp(command, "random_calls")) random_calls(argument);
    else if (!strcmp(command, "speed")) speed(argument);
    else return printf("%s is not a command\n", command), 2;
    return failures != 0;
}
