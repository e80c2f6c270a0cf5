/* Check in which states calls are legal: a table of calls, each tried in every state, in order and at random. */
#include "fmi2.h"

void instantiate(void)
{
    static const char *const odd[] = {NULL, "", "nonsense", "file:///with%20some%20spaces/%C3%A4%C3%B6", "file:relative"};
    fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, NULL};
    check(!strcmp(GetVersion(), "2.0"), "version", GetVersion());
    check(!strcmp(GetTypesPlatform(), "default"), "platform", GetTypesPlatform());
    check(!Instantiate("i", fmi2CoSimulation, "{wrong}", resources, &callbacks, 0, 0) && messages == 1, "wrong guid", last_message);
    check(strstr(last_message, "{wrong}") != NULL, "the message names the guid:", last_message);
    check(!Instantiate("i", fmi2CoSimulation, NULL, resources, &callbacks, 0, 0) && messages == 2, "no guid", last_message);
    check(!Instantiate("", fmi2CoSimulation, guid, "", &callbacks, 0, 0) && messages == 3, "no name", last_message);
    check(!Instantiate(NULL, fmi2CoSimulation, guid, "", &callbacks, 0, 0) && messages == 4, "NULL name", last_message);
    check(!Instantiate("i", (fmi2Type)7, guid, "", &callbacks, 0, 0) && messages == 5, "type", last_message);
    check(!Instantiate("i", fmi2CoSimulation, guid, "", NULL, 0, 0), "no callbacks", "");
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        fmi2Component c = Instantiate("i", fmi2CoSimulation, guid, odd[i], &callbacks, 0, 0);
        check(!c == (N_RESOURCES > 0), "resource location", odd[i] ? odd[i] : "NULL");
        check(messages == 5 + (N_RESOURCES > 0) * ((int)i + 1), "the message names the resource:", last_message);
        FreeInstance(c);
    }
    callbacks.logger = NULL;
    check(!Instantiate("i", fmi2CoSimulation, "{wrong}", resources, &callbacks, 0, 0), "wrong guid", "without a logger");
    FreeInstance(NULL);
    check(DoStep(NULL, 0.0, 1.0, fmi2True) == fmi2Error, "fmi2DoStep", "of no instance");
    check(Reset(NULL) == fmi2Error, "fmi2Reset", "of no instance");
    double x;
    check(GetDerivatives(NULL, &x, 0) == fmi2Error, "fmi2GetDerivatives", "of no instance");
}

/* ---------------------------------------------------------------- every function in every state */

enum { INST = 1, INIT = 2, STEP = 4, FAIL = 8, EVENT = 16, CONT = 32, TERM = 64, ALL = 127 };
static const struct { int state; fmi2Type type; const char *name; } states[] = {
    {INST, fmi2CoSimulation, "instantiated, CS"}, {INIT, fmi2CoSimulation, "initialization mode, CS"},
    {STEP, fmi2CoSimulation, "step complete"},    {FAIL, fmi2CoSimulation, "step failed"},
    {TERM, fmi2CoSimulation, "terminated, CS"},   {INST, fmi2ModelExchange, "instantiated, ME"},
    {INIT, fmi2ModelExchange, "initialization mode, ME"}, {EVENT, fmi2ModelExchange, "event mode"},
    {CONT, fmi2ModelExchange, "continuous-time mode"},    {TERM, fmi2ModelExchange, "terminated, ME"},
};

static fmi2Component set_up(fmi2Component c)
{
    coarsen(c); /* else most of the time is for the tables of interacting strips, and under valgrind minutes */
    SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2True, 10.0);
    return c;
}

static fmi2Component in_state(int state, fmi2Type type)
{
    fmi2Component c = set_up(make(type, logger));
    if (state == INST) return c;
    EnterInitializationMode(c);
    if (state == INIT) return c;
    ExitInitializationMode(c);
    if (state == FAIL) {
        set_real(c, REFUSED, NAN);
        check(DoStep(c, 0.0, 1e-3, fmi2True) == fmi2Discard, "a step with NaN", "");
        set_real(c, REFUSED, TAKEN);
    }
    if (state == CONT) EnterContinuousTimeMode(c);
    if (state == TERM) Terminate(c);
    return c;
}

static const fmi2ValueReference load = LOAD, force = RESULT, kind = CHOICE;
static double of_states[1];
static const double zeros[1];
static fmi2FMUstate saved;
static fmi2Byte bytes[1 << 16];
static size_t size;
static const double one = 1.0, newton = 5e4;
static double number, at; /* the time of the instance */
static fmi2Integer integer;
static const fmi2Integer first = 1;
static fmi2Boolean flag, other;
static fmi2String text;
static fmi2Status status;
static fmi2EventInfo info;

/* Call; states of co-simulation and of model exchange in which it is legal; state after the call. */
#define CALLS(X) \
    X(SetDebugLogging(c, fmi2True, 0, NULL), ALL, ALL, SAME) \
    X(SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2True, 10.0), INST, INST, SAME) \
    X(EnterInitializationMode(c), INST, INST, INIT) \
    X(ExitInitializationMode(c), INIT, INIT, STARTED) \
    X(Terminate(c), STEP | FAIL, EVENT | CONT, TERM) \
    X(Reset(c), ALL, ALL, INST) \
    X(GetReal(c, &force, 1, &number), ALL & ~INST, ALL & ~INST, SAME) \
    X(GetReal(c, &load, 1, &number), ALL & ~INST, ALL & ~INST, SAME) \
    X(GetInteger(c, &kind, 1, &integer), ALL & ~INST, ALL & ~INST, SAME) \
    X(GetBoolean(c, NULL, 0, &flag), ALL & ~INST, ALL & ~INST, SAME) \
    X(GetString(c, NULL, 0, &text), ALL & ~INST, ALL & ~INST, SAME) \
    X(SetReal(c, &load, 1, &newton), ALL & ~TERM, ALL & ~TERM, SAME) \
    X(SetReal(c, &force, 1, &newton), 0, 0, SAME) \
    X(SetInteger(c, &kind, 1, &first), INST | INIT, INST | INIT, SAME) \
    X(SetBoolean(c, NULL, 0, &flag), ALL & ~TERM, ALL & ~TERM, SAME) \
    X(SetString(c, NULL, 0, &text), ALL & ~TERM, ALL & ~TERM, SAME) \
    X(GetFMUstate(c, &saved), ALL, ALL, SAME) \
    X(SetFMUstate(c, saved), ALL, ALL, SAVED) \
    X(SetFMUstate(c, NULL), 0, 0, SAME) \
    X(SerializedFMUstateSize(c, saved, &size), ALL, ALL, SAME) \
    X(SerializeFMUstate(c, saved, bytes, size), ALL, ALL, SAME) \
    X(SerializeFMUstate(c, saved, bytes, size - 1), 0, 0, SAME) \
    X(DeSerializeFMUstate(c, bytes, size, &saved), ALL, ALL, SAME) \
    X(FreeFMUstate(c, &saved), ALL, ALL, SAME) \
    X(GetDirectionalDerivative(c, &force, 1, &load, 1, &one, &number), ALL & ~INST, ALL & ~INST, SAME) \
    X(GetDirectionalDerivative(c, &load, 1, &load, 1, &one, &number), 0, 0, SAME) \
    X(SetRealInputDerivatives(c, NULL, 0, NULL, NULL), ALL & ~TERM, 0, SAME) \
    X(SetRealInputDerivatives(c, &load, 1, &first, &one), 0, 0, SAME) \
    X(GetRealOutputDerivatives(c, NULL, 0, NULL, NULL), STEP | FAIL | TERM, 0, SAME) \
    X(GetRealOutputDerivatives(c, &force, 1, &first, &number), 0, 0, SAME) \
    X(DoStep(c, at, 1e-3, fmi2True), STEP | FAIL, 0, STEP) \
    X(DoStep(c, at, 0.0, fmi2True), 0, 0, SAME) \
    X(DoStep(c, at + 1e-3, 1e-3, fmi2True), 0, 0, SAME) \
    X(DoStep(c, at - 1e-3, 1e-3, fmi2True), 0, 0, SAME) \
    X(DoStep(c, at, 11.0, fmi2True), 0, 0, SAME) \
    X(DoStep(c, NAN, 1e-3, fmi2True), 0, 0, SAME) \
    X(CancelStep(c), 0, 0, SAME) \
    X(GetStatus(c, fmi2DoStepStatus, &status), STEP | FAIL | TERM, 0, SAME) \
    X(GetRealStatus(c, fmi2LastSuccessfulTime, &number), STEP | FAIL | TERM, 0, SAME) \
    X(GetBooleanStatus(c, fmi2Terminated, &flag), STEP | FAIL | TERM, 0, SAME) \
    X(GetStringStatus(c, fmi2PendingStatus, &text), STEP | FAIL | TERM, 0, SAME) \
    X(EnterEventMode(c), 0, EVENT | CONT, EVENT) \
    X(NewDiscreteStates(c, &info), 0, EVENT, SAME) \
    X(EnterContinuousTimeMode(c), 0, EVENT, CONT) \
    X(CompletedIntegratorStep(c, fmi2True, &flag, &other), 0, CONT, SAME) \
    X(SetTime(c, 0.1), 0, EVENT | CONT, SAME) \
    X(SetTime(c, INFINITY), 0, 0, SAME) \
    X(SetContinuousStates(c, zeros, 0), 0, CONT, SAME) \
    X(SetContinuousStates(c, zeros, 1), 0, 0, SAME) \
    X(GetDerivatives(c, of_states, 0), 0, INIT | EVENT | CONT | TERM, SAME) \
    X(GetEventIndicators(c, NULL, 0), 0, INIT | EVENT | CONT | TERM, SAME) \
    X(GetContinuousStates(c, of_states, 0), 0, INIT | EVENT | CONT | TERM, SAME) \
    X(GetNominalsOfContinuousStates(c, of_states, 0), 0, INIT | EVENT | CONT | TERM, SAME)

enum { SAME = 0, STARTED = 128, SAVED = 256 }; /* after initialisation (by type); state of the saved FMU state */
enum { FIRST_ROW = __COUNTER__ + 1 };
static fmi2Status perform(int row, fmi2Component c)
{
    switch (row) {
#define PERFORM(call, in_cs, in_me, after) case __COUNTER__ - FIRST_ROW: return call;
        CALLS(PERFORM)
    }
    return fmi2Fatal;
}

static const struct { const char *name; int legal[2]; int after; } rows[] = {
#define ROW(call, in_cs, in_me, after) {#call, {in_me, in_cs}, after},
    CALLS(ROW)
};
enum { N_ROWS = sizeof rows / sizeof *rows, N_SITUATIONS = sizeof states / sizeof *states };

static void keep(fmi2Component c)
{
    GetFMUstate(c, &saved);
    SerializedFMUstateSize(c, saved, &size);
    SerializeFMUstate(c, saved, bytes, size);
}

void every_call(void)
{
    for (int i = 0; i < N_SITUATIONS; i++) {
        for (int row = 0; row < N_ROWS; row++) {
            fmi2Component c = in_state(states[i].state, states[i].type);
            keep(c);
            int before = messages;
            at = 0.0;
            fmi2Status answer = perform(row, c);
            if (rows[row].legal[states[i].type] & states[i].state)
                check(answer == fmi2OK && messages == before, rows[row].name, states[i].name);
            else
                check(answer == fmi2Error && messages == before + 1, rows[row].name, states[i].name);
            FreeFMUstate(c, &saved);
            FreeInstance(c);
        }
    }
    printf("%d calls\n", N_ROWS * N_SITUATIONS);
}

/* Bytes that are not a valid state: one bit flipped, truncated, or random. */
static void bad_bytes(fmi2Component c)
{
    static fmi2Byte damaged[sizeof bytes];
    fmi2FMUstate none = NULL;
    size_t n = size;
    memcpy(damaged, bytes, size);
    switch (draw(3)) {
    case 0: damaged[draw((unsigned)size)] ^= (fmi2Byte)(1 << draw(8)); break;
    case 1: n = draw((unsigned)size); break;
    default: for (n = 0; n < size; n++) damaged[n] = (fmi2Byte)draw(256);
    }
    check(DeSerializeFMUstate(c, damaged, n, &none) == fmi2Error && !none, "fmi2DeSerializeFMUstate", "of bad bytes");
}

/* Random functions in random order, with random values set in between. A legal call succeeds or is discarded, any other call is
 * an error and changes nothing, and no output is ever NaN. The expected state of the instance is tracked from call to call. */
void fuzz(int n)
{
    static const double odd[] = {0.0, -1.0, 1e-300, 1e300, NAN, INFINITY, 1e-3, 8e4};
    static int done[N_ROWS][2][2 * TERM];
    fmi2Type type = fmi2CoSimulation;
    fmi2Component c = set_up(make(type, quiet));
    int state = INST, kept = INST, missing = 0;
    keep(c);
    for (int i = 0; i < n; i++) {
        switch (draw(8)) {
        case 0: set_real(c, draw(N_VALUES + 3), odd[draw(8)]); continue;
        case 1: set_integer(c, draw(N_VALUES + 3), (int)draw(40) - 2); continue;
        case 2: bad_bytes(c); continue;
        case 3:
            if (draw(30)) break;
            FreeFMUstate(c, &saved), FreeInstance(c);
            type = draw(2) ? fmi2CoSimulation : fmi2ModelExchange;
            c = set_up(make(type, quiet)), state = kept = INST;
            keep(c);
        }
        int row = (int)draw(N_ROWS), legal = rows[row].legal[type] & state, after = rows[row].after;
        if ((after == TERM || after == INST) && draw(8)) continue; /* rarely, otherwise no other state would be reached */
        at = reached(c);
        fmi2Status answer = perform(row, c);
        check(legal ? answer <= fmi2Discard : answer == fmi2Error, rows[row].name, "at random");
        done[row][type][state]++;
        if (legal && answer <= fmi2Warning && after) {
            int started = type == fmi2CoSimulation ? STEP : EVENT;
            state = after == STARTED ? started : after == SAVED ? kept : after;
        }
        if (after == STEP && answer == fmi2Discard) state = FAIL;
        if (after == INST) set_up(c);
        fmi2ValueReference out = RESULT + draw(N_VALUES - RESULT);
        double value = 0.0;
        if (GetReal(c, &out, 1, &value) == fmi2OK) check(isfinite(value), "finite output", "at random");
        if (!saved || !strncmp(rows[row].name, "GetFMUstate", 11)) kept = state, keep(c);
    }
    for (int i = 0; i < N_SITUATIONS; i++)
        for (int row = 0; row < N_ROWS; row++) missing += !done[row][states[i].type][states[i].state];
    printf("%d calls in a state missing\n", missing);
    FreeFMUstate(c, &saved);
    FreeInstance(c);
}

void status_functions(void)
{
    fmi2Component c = running(logger);
    DoStep(c, 0.0, 1e-3, fmi2True);
    check(GetStatus(c, fmi2DoStepStatus, &status) == fmi2OK && status == fmi2OK, "status", "after a step");
    set_real(c, VARIED, NAN);
    DoStep(c, 1e-3, 1e-3, fmi2True);
    check(strstr(last_message, VARIED_NAME " = ") != NULL, "the message names the variable:", last_message);
    check(GetStatus(c, fmi2DoStepStatus, &status) == fmi2OK && status == fmi2Discard, "status", "after NaN");
    check(GetRealStatus(c, fmi2LastSuccessfulTime, &number) == fmi2OK && number == 1e-3, "last successful time", "");
    check(GetBooleanStatus(c, fmi2Terminated, &flag) == fmi2OK && flag, "terminated", "after a discarded step");
    check(GetRealStatus(c, fmi2DoStepStatus, &number) == fmi2Discard, "an unknown status", "");
    check(GetIntegerStatus(c, fmi2DoStepStatus, &integer) == fmi2Discard, "an unknown status", "");
    FreeInstance(c);
}

void log_categories(void)
{
    static const fmi2String errors[] = {"logStatusError"}, unknown[] = {"100% unknown"};
    fmi2Component c = running(logger);
    messages = 0;
    CancelStep(c);
    check(messages == 1, "an error is logged", last_message);
    SetDebugLogging(c, fmi2True, 1, errors);
    set_real(c, REFUSED, NAN);
    DoStep(c, 0.0, 1e-3, fmi2True);
    check(messages == 1, "only errors are logged", last_message);
    CancelStep(c);
    check(messages == 2, "errors are logged", last_message);
    check(SetDebugLogging(c, fmi2True, 1, unknown) == fmi2Error && messages == 3, "an unknown category", last_message);
    check(!strchr(last_message, '%'), "no conversion is left in the format", last_message);
    SetDebugLogging(c, fmi2False, 0, NULL);
    CancelStep(c);
    check(messages == 3, "nothing is logged", last_message);
    FreeInstance(c);
}
