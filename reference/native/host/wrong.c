/* Every function of FMI 2.0 and 3.0, called wrongly: wrong LIBRARY GUID URI PATH RANDOM_TRIALS (URI and PATH of the resources).
 * Each trial is a process of its own, so a call that kills its host is one failure. Every pointer of every function is NULL once
 * in every state: the answer is an Error and one message. Then random functions are called in sequence with random pointers and
 * counts, and forged states are set. POSIX only. */
#include <stdint.h>
#include <sys/wait.h>
#include <unistd.h>

#include "counting.h"
#include "model.h"
#include "roles.h"

enum { STATE_CHECKSUM = 40, STATE_CONTENT = 48 }; /* places in the bytes of a state */
enum { ANSWER_OK, ANSWER_ERROR = 3, CRASHED = 99, ROOM = 64 };
static void *library, *instance;
static const void *replaced; /* the pointer that was NULL instead */
static int turn, null_one = -1, is_random, version;

/* Return the pointer, or NULL if it is this one's turn. In random trials it is NULL one time in five. */
static void *pointer(const void *given)
{
    if (turn++ != null_one && !(is_random && draw(5) == 0)) return (void *)given;
    replaced = given;
    return NULL;
}
static size_t count(size_t n) { return is_random ? draw((unsigned)n + 3) : n; } /* the arrays have ROOM for more */
#define P(x) pointer(x)
#define N(n) count(n)
#define C P(instance)

/* ---- what the calls read and write; large enough for any array of the FMU */
static const unsigned input[ROOM] = {VARIED}, result[ROOM] = {RESULT}, choice[ROOM] = {CHOICE};
static double reals[4096], seed[4096];
static int integers[ROOM];
static int64_t longs[ROOM];
static uint64_t naturals[ROOM];
static bool bools[ROOM];
static const char *strings[ROOM] = {"logStatusError"};
static size_t sizes[ROOM];
static void *state;
static unsigned char bytes[1 << 20];
static fmi2EventInfo info;
static fmi2Status status2;
static double number;

#define F2(name) ((fmi2##name##TYPE *)find(library, "fmi2" #name))
#define F3(name) ((fmi3##name##TYPE *)find(library, "fmi3" #name))

#define CALLS_2(X) \
    X(F2(SetDebugLogging)(C, 1, N(1), P(strings))) \
    X(F2(SetupExperiment)(C, 0, 0.0, 0.0, 0, 0.0)) \
    X(F2(EnterInitializationMode)(C)) \
    X(F2(ExitInitializationMode)(C)) \
    X(F2(Terminate)(C)) \
    X(F2(Reset)(C)) \
    X(F2(GetReal)(C, P(result), N(1), P(reals))) \
    X(F2(GetInteger)(C, P(choice), N(1), P(integers))) \
    X(F2(GetBoolean)(C, P(choice), N(1), P(integers))) \
    X(F2(GetString)(C, P(choice), N(1), P(strings))) \
    X(F2(SetReal)(C, P(input), N(1), P(seed))) \
    X(F2(SetInteger)(C, P(choice), N(1), P(integers))) \
    X(F2(SetBoolean)(C, P(choice), N(1), P(integers))) \
    X(F2(SetString)(C, P(choice), N(1), P(strings))) \
    X(F2(GetFMUstate)(C, P(&state))) \
    X(F2(SetFMUstate)(C, P(state))) \
    X(F2(SerializedFMUstateSize)(C, P(state), P(sizes))) \
    X(F2(SerializeFMUstate)(C, P(state), P(bytes), sizeof bytes)) \
    X(F2(DeSerializeFMUstate)(C, P(bytes), sizes[0], P(&state))) \
    X(F2(GetDirectionalDerivative)(C, P(result), N(1), P(input), N(1), P(seed), P(reals))) \
    X(F2(SetRealInputDerivatives)(C, P(input), N(1), P(integers), P(seed))) \
    X(F2(GetRealOutputDerivatives)(C, P(result), N(1), P(integers), P(reals))) \
    X(F2(DoStep)(C, 0.0, 1e-3, 1)) \
    X(F2(CancelStep)(C)) \
    X(F2(GetStatus)(C, fmi2DoStepStatus, P(&status2))) \
    X(F2(GetRealStatus)(C, fmi2LastSuccessfulTime, P(&number))) \
    X(F2(GetIntegerStatus)(C, fmi2DoStepStatus, P(integers))) \
    X(F2(GetBooleanStatus)(C, fmi2Terminated, P(integers))) \
    X(F2(GetStringStatus)(C, fmi2PendingStatus, P(strings))) \
    X(F2(EnterEventMode)(C)) \
    X(F2(NewDiscreteStates)(C, P(&info))) \
    X(F2(EnterContinuousTimeMode)(C)) \
    X(F2(CompletedIntegratorStep)(C, 1, P(integers), P(integers + 1))) \
    X(F2(SetTime)(C, 0.1)) \
    X(F2(SetContinuousStates)(C, seed, N(0))) \
    X(F2(GetDerivatives)(C, reals, N(0))) \
    X(F2(GetEventIndicators)(C, reals, N(0))) \
    X(F2(GetContinuousStates)(C, reals, N(0))) \
    X(F2(GetNominalsOfContinuousStates)(C, reals, N(0)))

#define PAIR_3(X, type, array) \
    X(F3(Get##type)(C, P(choice), N(1), P(array), N(1))) \
    X(F3(Set##type)(C, P(choice), N(1), P(array), N(1)))
#define CALLS_3(X) \
    X(F3(SetDebugLogging)(C, 1, N(1), P(strings))) \
    X(F3(EnterInitializationMode)(C, 0, 0.0, 0.0, 0, 0.0)) \
    X(F3(ExitInitializationMode)(C)) \
    X(F3(EnterConfigurationMode)(C)) \
    X(F3(ExitConfigurationMode)(C)) \
    X(F3(Terminate)(C)) \
    X(F3(Reset)(C)) \
    X(F3(GetFloat64)(C, P(result), N(1), P(reals), N(1))) \
    X(F3(SetFloat64)(C, P(input), N(1), P(seed), N(1))) \
    PAIR_3(X, Float32, reals) PAIR_3(X, Int8, integers) PAIR_3(X, UInt8, integers) PAIR_3(X, Int16, integers) \
    PAIR_3(X, UInt16, integers) PAIR_3(X, Int32, integers) PAIR_3(X, UInt32, integers) PAIR_3(X, Int64, longs) \
    PAIR_3(X, UInt64, naturals) PAIR_3(X, Boolean, bools) PAIR_3(X, String, strings) \
    X(F3(GetBinary)(C, P(choice), N(1), P(sizes), P(strings), N(1))) \
    X(F3(SetBinary)(C, P(choice), N(1), P(sizes), P(strings), N(1))) \
    X(F3(GetClock)(C, P(choice), N(1), P(bools))) \
    X(F3(SetClock)(C, P(choice), N(1), P(bools))) \
    X(F3(GetNumberOfVariableDependencies)(C, RESULT, P(sizes))) \
    X(F3(GetVariableDependencies)(C, RESULT, P(sizes), P(integers), P(sizes), P(integers), N(1))) \
    X(F3(GetFMUState)(C, P(&state))) \
    X(F3(SetFMUState)(C, P(state))) \
    X(F3(SerializedFMUStateSize)(C, P(state), P(sizes))) \
    X(F3(SerializeFMUState)(C, P(state), P(bytes), sizeof bytes)) \
    X(F3(DeserializeFMUState)(C, P(bytes), sizes[0], P(&state))) \
    X(F3(GetDirectionalDerivative)(C, P(result), N(1), P(input), N(1), P(seed), N(1), P(reals), N(1))) \
    X(F3(GetAdjointDerivative)(C, P(result), N(1), P(input), N(1), P(seed), N(1), P(reals), N(1))) \
    X(F3(GetIntervalDecimal)(C, P(choice), N(1), P(reals), P(integers))) \
    X(F3(GetIntervalFraction)(C, P(choice), N(1), P(naturals), P(naturals), P(integers))) \
    X(F3(GetShiftDecimal)(C, P(choice), N(1), P(reals))) \
    X(F3(GetShiftFraction)(C, P(choice), N(1), P(naturals), P(naturals))) \
    X(F3(SetIntervalDecimal)(C, P(choice), N(1), P(reals))) \
    X(F3(SetIntervalFraction)(C, P(choice), N(1), P(naturals), P(naturals))) \
    X(F3(SetShiftDecimal)(C, P(choice), N(1), P(reals))) \
    X(F3(SetShiftFraction)(C, P(choice), N(1), P(naturals), P(naturals))) \
    X(F3(EvaluateDiscreteStates)(C)) \
    X(F3(UpdateDiscreteStates)(C, P(bools), P(bools), P(bools), P(bools), P(bools), P(&number))) \
    X(F3(EnterEventMode)(C)) \
    X(F3(EnterContinuousTimeMode)(C)) \
    X(F3(CompletedIntegratorStep)(C, 1, P(bools), P(bools))) \
    X(F3(SetTime)(C, 0.1)) \
    X(F3(SetContinuousStates)(C, seed, N(0))) \
    X(F3(GetContinuousStateDerivatives)(C, reals, N(0))) \
    X(F3(GetEventIndicators)(C, reals, N(0))) \
    X(F3(GetContinuousStates)(C, reals, N(0))) \
    X(F3(GetNominalsOfContinuousStates)(C, reals, N(0))) \
    X(F3(GetNumberOfEventIndicators)(C, P(sizes))) \
    X(F3(GetNumberOfContinuousStates)(C, P(sizes))) \
    X(F3(EnterStepMode)(C)) \
    X(F3(GetOutputDerivatives)(C, P(result), N(1), P(integers), P(reals), N(1))) \
    X(F3(DoStep)(C, 0.0, 1e-3, 1, P(bools), P(bools), P(bools), P(&number))) \
    X(F3(ActivateModelPartition)(C, RESULT, 0.0))

enum { FIRST_2 = __COUNTER__ + 1 };
static int call_2(int row)
{
    switch (row) {
#define DO_2(call) case __COUNTER__ - FIRST_2: return (int)call;
        CALLS_2(DO_2)
    }
    return CRASHED;
}
enum { FIRST_3 = __COUNTER__ + 1 };
static int call_3(int row)
{
    switch (row) {
#define DO_3(call) case __COUNTER__ - FIRST_3: return (int)call;
        CALLS_3(DO_3)
    }
    return CRASHED;
}
#define NAME(call) #call,
static const char *const names[2][256] = {{CALLS_2(NAME)}, {CALLS_3(NAME)}};
static int n_calls(void)
{
    int n = 0;
    while (names[version - 2][n]) n++;
    return n;
}
static int call(int row) { return version == 2 ? call_2(row) : call_3(row); }

/* ---- states of an instance */
enum { INST, INIT, RUN, CONT, TERM, N_SITUATIONS };
static const char *const situations[] = {"instantiated", "initialization", "running", "continuous", "terminated"};

static void reach(int situation, int is_cs)
{
    if (version == 2) {
        fmi2CallbackFunctions callbacks = {log_2, NULL, NULL, NULL, NULL};
        instance = F2(Instantiate)("i", is_cs ? fmi2CoSimulation : fmi2ModelExchange, guid, resources, &callbacks, 0, 1);
    } else if (is_cs) {
        instance = F3(InstantiateCoSimulation)("i", guid, resources, 0, 1, 0, 0, NULL, 0, NULL, log_3, NULL);
    } else {
        instance = F3(InstantiateModelExchange)("i", guid, resources, 0, 1, NULL, log_3);
    }
    if (!instance) _exit(CRASHED);
    if (version == 2) {
        if (situation >= INIT) F2(EnterInitializationMode)(instance);
        if (situation >= RUN) F2(ExitInitializationMode)(instance);
        if (situation == CONT && !is_cs) F2(EnterContinuousTimeMode)(instance);
        if (situation == TERM) F2(Terminate)(instance);
    } else {
        if (situation >= INIT) F3(EnterInitializationMode)(instance, 0, 0.0, 0.0, 0, 0.0);
        if (situation >= RUN) F3(ExitInitializationMode)(instance);
        if (situation == CONT && !is_cs) F3(EnterContinuousTimeMode)(instance);
        if (situation == TERM) F3(Terminate)(instance);
    }
    for (int i = 0; i < ROOM; i++) integers[i] = 1, longs[i] = 1, naturals[i] = 12, bools[i] = true;
    if (version == 2) {
        F2(GetFMUstate)(instance, &state);
        F2(SerializedFMUstateSize)(instance, state, sizes);
        F2(SerializeFMUstate)(instance, state, (char *)bytes, sizeof bytes);
    } else {
        F3(GetFMUState)(instance, &state);
        F3(SerializedFMUStateSize)(instance, state, sizes);
        F3(SerializeFMUState)(instance, state, bytes, sizeof bytes);
    }
    if (sizes[0] > sizeof bytes) _exit(CRASHED);
    messages = turn = 0;
}

static int end_of(pid_t child)
{
    int how;
    if (waitpid(child, &how, 0) != child || !WIFEXITED(how)) return CRASHED;
    return WEXITSTATUS(how);
}

static void leave(void)
{
    if (version == 2) F2(FreeFMUstate)(instance, &state), F2(FreeInstance)(instance);
    else F3(FreeFMUState)(instance, &state), F3(FreeInstance)(instance);
}

/* The number of pointers of a call of an instance, a NULL for each of which must be refused with one message (the first one is
 * the instance). */
static int pointers_of(int row)
{
    int in_pipe[2], n = 0;
    if (pipe(in_pipe)) exit(2);
    pid_t child = fork();
    if (!child) {
        call(row);
        if (write(in_pipe[1], &turn, sizeof turn) != sizeof turn) _exit(2);
        _exit(0);
    }
    end_of(child);
    close(in_pipe[1]);
    if (read(in_pipe[0], &n, sizeof n) != sizeof n) n = 0;
    close(in_pipe[0]);
    return n;
}

/* Every NULL in one situation. Each trial is a process that begins with a copy of the instance. */
static void in_situation(int situation, const int *pointers)
{
    for (int row = 0; row < n_calls(); row++)
        for (int k = 0; k < pointers[row]; k++) {
            pid_t child = fork();
            if (!child) {
                null_one = k;
                int answer = call(row);
                _exit(answer != ANSWER_ERROR || messages != (replaced != instance)); /* no instance, no message */
            }
            check(end_of(child) == ANSWER_OK, names[version - 2][row], situations[situation]);
        }
}

static int systematic(void)
{
    int pointers[256], done = 0;
    reach(INST, 1);
    for (int row = 0; row < n_calls(); row++) {
        pointers[row] = pointers_of(row);
        check(pointers[row] > 0, names[version - 2][row], "does not return");
    }
    leave();
    for (int situation = 0; situation < N_SITUATIONS; situation++)
        for (int is_cs = !HAS_EXCHANGE; is_cs < 2; is_cs++) {
            fflush(stdout);
            pid_t child = fork();
            if (!child) {
                failures = 0;
                reach(situation, is_cs);
                in_situation(situation, pointers);
                fflush(stdout);
                _exit(failures != 0);
            }
            check(end_of(child) == ANSWER_OK, "wrong calls", situations[situation]);
            for (int row = 0; row < n_calls(); row++) done += pointers[row];
        }
    return done;
}

/* Sequences of random calls: none may end the process. */
static void random_trials(int n)
{
    for (int i = 0; i < n; i++) {
        unsigned own = draw(1u << 30);
        pid_t child = fork();
        if (!child) {
            reach((int)draw(N_SITUATIONS), HAS_EXCHANGE ? (int)draw(2) : 1);
            is_random = 1;
            for (unsigned k = 0; k < own % 997; k++) draw(2);
            for (int k = 0; k < 40; k++) {
                reals[0] = seed[0] = draw(3) ? 1e-3 : draw(2) ? NAN : -1e300;
                integers[0] = (int)draw(9) - 1, longs[0] = (int)draw(9) - 1, naturals[0] = draw(4) ? 12 : ~0ull;
                sizes[0] = sizes[0] > sizeof bytes ? sizeof bytes : sizes[0];
                call((int)draw((unsigned)n_calls()));
            }
            if (version == 2) F2(FreeInstance)(instance);
            else F3(FreeInstance)(instance);
            _exit(ANSWER_OK);
        }
        check(end_of(child) == ANSWER_OK, "a sequence of random calls ends the host,", version == 2 ? "FMI 2.0" : "FMI 3.0");
    }
}

static uint64_t checksum(size_t n)
{
    uint64_t value = 14695981039346656037u; /* FNV-1a, as in state.c */
    for (size_t i = STATE_CONTENT; i < n; i++) value = (value ^ bytes[i]) * 1099511628211u;
    return value;
}

/* States in which some numbers are replaced, with the right checksum: refused, or the instance goes on. */
static void forged_states(int n)
{
    int taken_states = 0;
    static const double odd[] = {0.0, -1.0, 0.5, 3.0, 1e-300, 1e9, 1e18, 1e300, -1e300, NAN, INFINITY};
    version = 2;
    for (int i = 0; i < n; i++) {
        int is_cs = HAS_EXCHANGE ? (int)draw(2) : 1, own = (int)draw(1000);
        pid_t child = fork();
        if (!child) {
            reach(INST, is_cs);
            integers[0] = 1 + (int)draw(15);
            F2(SetInteger)(instance, choice, 1, integers);
            F2(EnterInitializationMode)(instance);
            F2(ExitInitializationMode)(instance);
            for (int k = 0; is_cs && k < 3; k++) F2(DoStep)(instance, 1e-3 * k, 1e-3, 1);
            F2(GetFMUstate)(instance, &state);
            F2(SerializedFMUstateSize)(instance, state, sizes);
            F2(SerializeFMUstate)(instance, state, (char *)bytes, sizeof bytes);
            for (int k = 0; k < own; k++) draw(2);
            for (unsigned k = 1 + draw(6); k > 0; k--) {
                size_t at = STATE_CONTENT + 8 * draw((unsigned)(sizes[0] - STATE_CONTENT) / 8);
                if (draw(4)) at = STATE_CONTENT + 8 * draw(6 + 2 * N_VALUES + 16); /* the content rather than the warm start */
                int64_t whole = (int64_t)draw(400) - 3;
                if (at + 8 <= sizes[0]) memcpy(bytes + at, draw(3) ? (const void *)&odd[draw(11)] : (const void *)&whole, 8);
            }
            uint64_t sum = checksum(sizes[0]);
            memcpy(bytes + STATE_CHECKSUM, &sum, sizeof sum);
            int taken = F2(DeSerializeFMUstate)(instance, (char *)bytes, sizes[0], &state) == fmi2OK;
            if (taken) {
                F2(SetFMUstate)(instance, state);
                for (int k = 0; k < 3; k++) {
                    double time = 0.0;
                    F2(GetRealStatus)(instance, fmi2LastSuccessfulTime, &time);
                    F2(DoStep)(instance, time, 1e-3, 1);
                    for (unsigned r = 0; r < N_VALUES; r++) F2(GetReal)(instance, &r, 1, reals);
                }
            }
            F2(FreeInstance)(instance);
            _exit(taken ? ANSWER_OK : ANSWER_ERROR);
        }
        int answer = end_of(child);
        taken_states += answer == ANSWER_OK;
        check(answer == ANSWER_OK || answer == ANSWER_ERROR, "a forged state", "ends the host");
    }
    printf("%d of %d forged states taken\n", taken_states, n);
}

/* A guid and a name without an end lie before a page that may not be read, or are long: nothing of them is copied whole. */
static void long_names(void)
{
    static char endless[100000];
    fmi2CallbackFunctions callbacks = {log_2, NULL, NULL, NULL, NULL};
    memset(endless, 'x', sizeof endless - 1);
    pid_t child = fork();
    if (!child) {
        F2(Instantiate)("i", fmi2CoSimulation, endless, resources, &callbacks, 0, 1);
        instance = F2(Instantiate)(endless, fmi2CoSimulation, guid, resources, &callbacks, 0, 1);
        _exit(instance ? F2(Reset)(instance) != fmi2OK : 1);
    }
    check(end_of(child) == ANSWER_OK, "a long guid", "or name");
}

int main(int n_arguments, char **arguments)
{
    if (n_arguments != 6 || !(library = open_library(arguments[1]))) return puts("wrong LIBRARY GUID URI PATH TRIALS"), 2;
    guid = arguments[2];
    for (version = 2; version <= 3; version++) {
        resources = arguments[version == 2 ? 3 : 4];
        printf("FMI %d.0: %d functions, %d wrong calls\n", version, n_calls(), systematic());
        random_trials(atoi(arguments[5]));
    }
    resources = arguments[3];
    long_names();
    forged_states(atoi(arguments[5]));
    return failures != 0;
}
