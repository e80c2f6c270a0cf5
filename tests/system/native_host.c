/* A host in C for the native FMU: native_host LIBRARY GUID COMMAND [ARGUMENT]. What fails is printed; the exit code says so.
 *
 * Loads the library for itself alone (RTLD_LOCAL), takes every function from it by name, and zeroes the callbacks as soon as
 * fmi2Instantiate has returned, as a host may that has them on its stack. */
#include "fmi2FunctionTypes.h"
#include "host.h"
#include "model.h"

#define FUNCTIONS(X) \
    X(GetTypesPlatform) X(GetVersion) X(SetDebugLogging) X(Instantiate) X(FreeInstance) X(SetupExperiment) \
    X(EnterInitializationMode) X(ExitInitializationMode) X(Terminate) X(Reset) X(GetReal) X(GetInteger) X(GetBoolean) \
    X(GetString) X(SetReal) X(SetInteger) X(SetBoolean) X(SetString) X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate) \
    X(SerializedFMUstateSize) X(SerializeFMUstate) X(DeSerializeFMUstate) X(GetDirectionalDerivative) \
    X(SetRealInputDerivatives) X(GetRealOutputDerivatives) X(DoStep) X(CancelStep) X(GetStatus) X(GetRealStatus) \
    X(GetIntegerStatus) X(GetBooleanStatus) X(GetStringStatus) X(EnterEventMode) X(NewDiscreteStates) \
    X(EnterContinuousTimeMode) X(CompletedIntegratorStep) X(SetTime) X(SetContinuousStates) X(GetDerivatives) \
    X(GetEventIndicators) X(GetContinuousStates) X(GetNominalsOfContinuousStates)
#define DECLARE(f) static fmi2##f##TYPE *f;
FUNCTIONS(DECLARE)

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    (void)environment, (void)instance, (void)status, (void)category;
    messages++;
    snprintf(last_message, sizeof last_message, "%s", message);
}

static void quiet(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                  fmi2String message, ...)
{
    (void)environment, (void)instance, (void)status, (void)category, (void)message;
}

static fmi2Component make(fmi2Type type, fmi2CallbackLogger log)
{
    fmi2CallbackFunctions callbacks = {log, NULL, NULL, NULL, NULL};
    fmi2Component c = Instantiate("instance", type, guid, "file:///nowhere%20at/all", &callbacks, fmi2False, fmi2True);
    memset((void *)&callbacks, 0, sizeof callbacks);
    return c;
}

static fmi2Status set_real(fmi2Component c, fmi2ValueReference r, double value) { return SetReal(c, &r, 1, &value); }
static fmi2Status set_integer(fmi2Component c, fmi2ValueReference r, int value) { return SetInteger(c, &r, 1, &value); }

static double real(fmi2Component c, fmi2ValueReference r)
{
    double value = NAN;
    GetReal(c, &r, 1, &value);
    return value;
}

static int whole(fmi2Component c, fmi2ValueReference r)
{
    fmi2Integer value = -1;
    GetInteger(c, &r, 1, &value);
    return value;
}

static fmi2Component running(fmi2CallbackLogger log)
{
    fmi2Component c = make(fmi2CoSimulation, log);
    SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    EnterInitializationMode(c);
    ExitInitializationMode(c);
    return c;
}

/* ---------------------------------------------------------------- instantiate */

static void instantiate(void)
{
    static const char *const odd[] = {NULL, "", "nonsense", "file:///with%20some%20spaces/%C3%A4%C3%B6", "file:relative"};
    fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, NULL};
    check(!strcmp(GetVersion(), "2.0"), "version", GetVersion());
    check(!strcmp(GetTypesPlatform(), "default"), "platform", GetTypesPlatform());
    check(!Instantiate("i", fmi2CoSimulation, "{wrong}", "", &callbacks, 0, 0) && messages == 1, "wrong guid", last_message);
    check(strstr(last_message, "{wrong}") != NULL, "the message names the guid:", last_message);
    check(!Instantiate("i", fmi2CoSimulation, NULL, "", &callbacks, 0, 0) && messages == 2, "no guid", last_message);
    check(!Instantiate("", fmi2CoSimulation, guid, "", &callbacks, 0, 0) && messages == 3, "no name", last_message);
    check(!Instantiate(NULL, fmi2CoSimulation, guid, "", &callbacks, 0, 0) && messages == 4, "NULL name", last_message);
    check(!Instantiate("i", (fmi2Type)7, guid, "", &callbacks, 0, 0) && messages == 5, "type", last_message);
    check(!Instantiate("i", fmi2CoSimulation, guid, "", NULL, 0, 0), "no callbacks", "");
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        fmi2Component c = Instantiate("i", fmi2CoSimulation, guid, odd[i], &callbacks, 0, 0);
        check(c != NULL, "resource location", odd[i] ? odd[i] : "NULL");
        FreeInstance(c);
    }
    callbacks.logger = NULL;
    check(!Instantiate("i", fmi2CoSimulation, "{wrong}", "", &callbacks, 0, 0), "wrong guid", "without a logger");
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

static fmi2Component in_state(int state, fmi2Type type)
{
    fmi2Component c = make(type, logger);
    SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2True, 10.0);
    if (state == INST) return c;
    EnterInitializationMode(c);
    if (state == INIT) return c;
    ExitInitializationMode(c);
    if (state == FAIL) {
        set_real(c, V_speed, NAN);
        check(DoStep(c, 0.0, 1e-3, fmi2True) == fmi2Discard, "a step with NaN", "");
        set_real(c, V_speed, 20.0);
    }
    if (state == CONT) EnterContinuousTimeMode(c);
    if (state == TERM) Terminate(c);
    return c;
}

static const fmi2ValueReference load = V_load_normal_force, force = V_force_x, kind = V_method_normal;
static fmi2FMUstate saved;
static fmi2Byte bytes[1 << 16];
static size_t size;
static const double one = 1.0, newton = 5e4;
static double number;
static fmi2Integer integer;
static const fmi2Integer first = 1;
static fmi2Boolean flag, other;
static fmi2String text;
static fmi2Status status;
static fmi2EventInfo info;

#define CALLS(X) \
    X(SetDebugLogging(c, fmi2True, 0, NULL), ALL, ALL) \
    X(SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0), INST, INST) \
    X(EnterInitializationMode(c), INST, INST) \
    X(ExitInitializationMode(c), INIT, INIT) \
    X(Terminate(c), STEP | FAIL, EVENT | CONT) \
    X(Reset(c), ALL, ALL) \
    X(GetReal(c, &force, 1, &number), ALL & ~INST, ALL & ~INST) \
    X(GetReal(c, &load, 1, &number), ALL & ~INST, ALL & ~INST) \
    X(GetInteger(c, &kind, 1, &integer), ALL & ~INST, ALL & ~INST) \
    X(GetBoolean(c, NULL, 0, &flag), ALL & ~INST, ALL & ~INST) \
    X(GetString(c, NULL, 0, &text), ALL & ~INST, ALL & ~INST) \
    X(SetReal(c, &load, 1, &newton), ALL & ~TERM, ALL & ~TERM) \
    X(SetReal(c, &force, 1, &newton), 0, 0) \
    X(SetInteger(c, &kind, 1, &first), INST | INIT, INST | INIT) \
    X(SetBoolean(c, NULL, 0, &flag), ALL & ~TERM, ALL & ~TERM) \
    X(SetString(c, NULL, 0, &text), ALL & ~TERM, ALL & ~TERM) \
    X(GetFMUstate(c, &saved), ALL, ALL) \
    X(SetFMUstate(c, saved), ALL, ALL) \
    X(SetFMUstate(c, NULL), 0, 0) \
    X(SerializedFMUstateSize(c, saved, &size), ALL, ALL) \
    X(SerializeFMUstate(c, saved, bytes, size), ALL, ALL) \
    X(SerializeFMUstate(c, saved, bytes, size - 1), 0, 0) \
    X(DeSerializeFMUstate(c, bytes, size, &saved), ALL, ALL) \
    X(FreeFMUstate(c, &saved), ALL, ALL) \
    X(GetDirectionalDerivative(c, &force, 1, &load, 1, &one, &number), ALL & ~INST, ALL & ~INST) \
    X(GetDirectionalDerivative(c, &load, 1, &load, 1, &one, &number), 0, 0) \
    X(SetRealInputDerivatives(c, NULL, 0, NULL, NULL), ALL & ~TERM, 0) \
    X(SetRealInputDerivatives(c, &load, 1, &first, &one), 0, 0) \
    X(GetRealOutputDerivatives(c, NULL, 0, NULL, NULL), STEP | FAIL | TERM, 0) \
    X(GetRealOutputDerivatives(c, &force, 1, &first, &number), 0, 0) \
    X(DoStep(c, 0.0, 1e-3, fmi2True), STEP | FAIL, 0) \
    X(DoStep(c, 0.0, 0.0, fmi2True), 0, 0) \
    X(DoStep(c, 0.0, 11.0, fmi2True), 0, 0) \
    X(DoStep(c, NAN, 1e-3, fmi2True), 0, 0) \
    X(CancelStep(c), 0, 0) \
    X(GetStatus(c, fmi2DoStepStatus, &status), STEP | FAIL | TERM, 0) \
    X(GetRealStatus(c, fmi2LastSuccessfulTime, &number), STEP | FAIL | TERM, 0) \
    X(GetBooleanStatus(c, fmi2Terminated, &flag), STEP | FAIL | TERM, 0) \
    X(GetStringStatus(c, fmi2PendingStatus, &text), STEP | FAIL | TERM, 0) \
    X(EnterEventMode(c), 0, EVENT | CONT) \
    X(NewDiscreteStates(c, &info), 0, EVENT) \
    X(EnterContinuousTimeMode(c), 0, EVENT) \
    X(CompletedIntegratorStep(c, fmi2True, &flag, &other), 0, CONT) \
    X(SetTime(c, 0.1), 0, EVENT | CONT) \
    X(SetTime(c, INFINITY), 0, 0) \
    X(SetContinuousStates(c, NULL, 0), 0, CONT) \
    X(SetContinuousStates(c, &one, 1), 0, 0) \
    X(GetDerivatives(c, NULL, 0), 0, INIT | EVENT | CONT | TERM) \
    X(GetEventIndicators(c, NULL, 0), 0, INIT | EVENT | CONT | TERM) \
    X(GetContinuousStates(c, NULL, 0), 0, INIT | EVENT | CONT | TERM) \
    X(GetNominalsOfContinuousStates(c, NULL, 0), 0, INIT | EVENT | CONT | TERM)

static void every_call(void)
{
    int done = 0;
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        fmi2Component c;
        int before;
#define TRY(call, in_cs, in_me) \
    c = in_state(states[i].state, states[i].type); \
    GetFMUstate(c, &saved); \
    SerializedFMUstateSize(c, saved, &size); \
    SerializeFMUstate(c, saved, bytes, size); \
    before = messages; \
    if ((states[i].type == fmi2CoSimulation ? (in_cs) : (in_me)) & states[i].state) { \
        check(call == fmi2OK && messages == before, #call, states[i].name); \
    } else { \
        check(call == fmi2Error && messages == before + 1, #call, states[i].name); \
    } \
    FreeFMUstate(c, &saved); \
    FreeInstance(c); \
    done++;
        CALLS(TRY)
    }
    printf("%d calls\n", done);
}

static void status_functions(void)
{
    fmi2Component c = running(logger);
    DoStep(c, 0.0, 0.25, fmi2True);
    check(GetStatus(c, fmi2DoStepStatus, &status) == fmi2OK && status == fmi2OK, "status", "after a step");
    set_real(c, V_creepage_spin, NAN);
    DoStep(c, 0.25, 0.25, fmi2True);
    check(strstr(last_message, "creepage.spin = ") != NULL, "the message names the variable:", last_message);
    check(GetStatus(c, fmi2DoStepStatus, &status) == fmi2OK && status == fmi2Discard, "status", "after NaN");
    check(GetRealStatus(c, fmi2LastSuccessfulTime, &number) == fmi2OK && number == 0.25, "last successful time", "");
    check(GetBooleanStatus(c, fmi2Terminated, &flag) == fmi2OK && !flag, "terminated", "");
    check(GetRealStatus(c, fmi2DoStepStatus, &number) == fmi2Discard, "an unknown status", "");
    check(GetIntegerStatus(c, fmi2DoStepStatus, &integer) == fmi2Discard, "an unknown status", "");
    FreeInstance(c);
}

static void log_categories(void)
{
    static const fmi2String errors[] = {"logStatusError"}, unknown[] = {"100% unknown"};
    fmi2Component c = running(logger);
    messages = 0;
    CancelStep(c);
    check(messages == 1, "an error is logged", last_message);
    SetDebugLogging(c, fmi2True, 1, errors);
    set_real(c, V_speed, NAN);
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

/* ---------------------------------------------------------------- threads */

#define N_INSTANCES 64
#define N_THREADS 8
#define N_STEPS 20
static fmi2Component crowd[N_INSTANCES];
static double serial[N_INSTANCES][2], parallel[N_INSTANCES][2];

static void advance(int i, double result[2])
{
    fmi2Component c = crowd[i];
    for (int k = 0; k < N_STEPS; k++) {
        set_real(c, V_creepage_longitudinal, 1e-5 * (i + 1) * (k + 1));
        set_real(c, V_load_normal_force, 5e4 + 1e3 * i);
        DoStep(c, 1e-3 * k, 1e-3, fmi2True);
    }
    result[0] = real(c, V_total_energy);
    result[1] = real(c, V_creep_stiffness);
}

static THREAD_RESULT worker(void *first_instance)
{
    for (int i = (int)(size_t)first_instance; i < N_INSTANCES; i += N_THREADS) advance(i, parallel[i]);
    return 0;
}

static void crowd_starts(void)
{
    for (int i = 0; i < N_INSTANCES; i++) {
        crowd[i] = make(fmi2CoSimulation, quiet);
        set_integer(crowd[i], V_method_normal, 1 + i % 3);
        set_integer(crowd[i], V_method_tangential, 1 + i / 3 % 3);
        EnterInitializationMode(crowd[i]);
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
    check(serial[0][0] > 0.0 && serial[0][0] != serial[1][0], "instances differ", "");
    for (int i = 0; i < N_INSTANCES; i++) FreeInstance(crowd[i]);
}

/* ---------------------------------------------------------------- random calls, long runs, cases from outside, speed */

static void random_calls(int n)
{
    static const double odd[] = {0.0, -1.0, 1e-300, 1e300, NAN, INFINITY, 1e-3, 8e4};
    fmi2Component c = make(fmi2CoSimulation, quiet);
    fmi2ValueReference r;
    for (int i = 0; i < n; i++) {
        switch (draw(16)) {
        case 0: FreeFMUstate(c, &saved), FreeInstance(c), c = make(draw(2) ? fmi2CoSimulation : fmi2ModelExchange, quiet); break;
        case 1: EnterInitializationMode(c); break;
        case 2: ExitInitializationMode(c); break;
        case 3: EnterContinuousTimeMode(c); break;
        case 4: EnterEventMode(c); break;
        case 5: set_real(c, draw(N_VALUES + 3), odd[draw(8)]); break;
        case 6: set_integer(c, draw(N_VALUES + 3), (int)draw(40) - 2); break;
        case 7: GetFMUstate(c, &saved); break;
        case 8: SetFMUstate(c, saved); break;
        case 9: if (!draw(10)) Terminate(c); break;
        case 10: if (!draw(4)) Reset(c); break;
        case 11: r = draw(N_VALUES), GetDirectionalDerivative(c, &force, 1, &r, 1, &one, &number); break;
        case 12: SetTime(c, odd[draw(8)]), CompletedIntegratorStep(c, 1, &flag, &other); break;
        default: {
            fmi2ValueReference out = V_force_x + draw(N_VALUES - V_force_x);
            double value = 0.0;
            DoStep(c, 0.0, 1e-3, fmi2True);
            if (GetReal(c, &out, 1, &value) == fmi2OK) check(isfinite(value), "finite output", "");
        }
        }
    }
    FreeFMUstate(c, &saved);
    FreeInstance(c);
}

#ifndef _WIN32
static long resident(void)
{
    long pages = 0, total = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (!f || fscanf(f, "%ld %ld", &total, &pages) != 2) pages = -1;
    if (f) fclose(f);
    return pages * sysconf(_SC_PAGESIZE);
}

static void soak(int cycles)
{
    long before = 0;
    for (int i = 0; i < cycles + 100; i++) {
        fmi2Component c = running(quiet);
        DoStep(c, 0.0, 1e-3, fmi2True);
        GetFMUstate(c, &saved);
        SetFMUstate(c, saved);
        FreeFMUstate(c, &saved);
        FreeInstance(c);
        if (i == 100) before = resident();
    }
    printf("%ld bytes grown in %d cycles\n", resident() - before, cycles);
    check(resident() - before < 1 << 20, "memory", "of cycles grows");
    fmi2Component c = running(quiet);
    before = resident();
    for (int i = 0; i < cycles; i++) DoStep(c, 1e-3 * i, 1e-3, fmi2True);
    check(resident() - before < 1 << 16, "memory", "of steps grows");
    FreeInstance(c);
}
#endif

/* Cases from standard input: the number of values, then reference, kind (r or i) and value of each. Answers all outputs. */
static void cases(void)
{
    int n;
    fmi2Component c = make(fmi2CoSimulation, logger);
    while (scanf("%d", &n) == 1) {
        Reset(c);
        for (int i = 0; i < n; i++) {
            unsigned r;
            char type;
            double value;
            if (scanf("%u %c %lf", &r, &type, &value) != 3) exit(2);
            check((type == 'r' ? set_real(c, r, value) : set_integer(c, r, (int)value)) == fmi2OK, "set", last_message);
        }
        EnterInitializationMode(c);
        ExitInitializationMode(c);
        check(DoStep(c, 0.0, 1e-3, fmi2True) <= fmi2Warning, "step", last_message);
        for (fmi2ValueReference r = V_force_x; r < N_VALUES; r++)
            printf("%.17g ", r == V_patch_count || r == V_status ? (double)whole(c, r) : real(c, r));
        printf("\n");
    }
    FreeInstance(c);
}

static void speed(int n)
{
    static fmi2ValueReference inputs[90];
    static double values[90];
    double begin = now();
    fmi2Component c = running(quiet);
    DoStep(c, 0.0, 1e-3, fmi2True);
    printf("instantiate to first step %.0f us\n", now() - begin);
    for (int i = 0; i < 90; i++) inputs[i] = V_geometry_g + i % 82;
    GetReal(c, inputs, 90, values);
    set_real(c, V_creepage_longitudinal, 1e-3);
    set_real(c, V_creepage_lateral, -5e-4);
    set_real(c, V_creepage_spin, 0.2);
    begin = now();
    for (int i = 0; i < n; i++) DoStep(c, 0.0, 1e-3, fmi2True);
    printf("step %.2f us\n", (now() - begin) / n);
    begin = now();
    for (int i = 0; i < n; i++) SetReal(c, inputs, 90, values);
    printf("set 90 inputs %.2f us\n", (now() - begin) / n);
    begin = now();
    for (int i = 0; i < n; i++) {
        SetReal(c, inputs, 90, values);
        DoStep(c, 0.0, 1e-3, fmi2True);
        number += real(c, V_force_x);
    }
    printf("set, step, get %.2f us\n", (now() - begin) / n);
    FreeInstance(c);
}

int main(int n_arguments, char **arguments)
{
    void *library = n_arguments > 3 ? open_library(arguments[1]) : NULL;
    const char *command = n_arguments > 3 ? arguments[3] : "";
    int argument = n_arguments > 4 ? atoi(arguments[4]) : 0;
    if (!library) return puts("the library cannot be loaded"), 2;
    guid = arguments[2];
#define FIND(f) if (!(f = (fmi2##f##TYPE *)find(library, "fmi2" #f))) return puts("fmi2" #f " is missing"), 2;
    FUNCTIONS(FIND)
    if (!strcmp(command, "instantiate")) instantiate();
    else if (!strcmp(command, "every_call")) every_call();
    else if (!strcmp(command, "status_functions")) status_functions();
    else if (!strcmp(command, "log_categories")) log_categories();
    else if (!strcmp(command, "threads")) threads();
    else if (!strcmp(command, "random_calls")) random_calls(argument);
    else if (!strcmp(command, "cases")) cases();
    else if (!strcmp(command, "speed")) speed(argument);
#ifndef _WIN32
    else if (!strcmp(command, "soak")) soak(argument);
#endif
    else return printf("%s is no command\n", command), 2;
    return failures != 0;
}
