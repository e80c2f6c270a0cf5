#include "fmi3.h"

#define DEFINE(f) fmi3##f##TYPE *f;
FUNCTIONS(DEFINE)

static fmi3FMUState saved;
static double number, field[ELEMENTS];
static fmi3UInt64 natural;
static fmi3Boolean flag[5];

void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment, (void)status, (void)category;
    messages++;
    snprintf(last_message, sizeof last_message, "%s", message);
}

static void quiet(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment, (void)status, (void)category, (void)message;
}

fmi3Instance make(Type type, fmi3LogMessageCallback log)
{
    if (type == ME) return InstantiateModelExchange("instance", guid, resources, fmi3False, fmi3True, NULL, log);
    return InstantiateCoSimulation("instance", guid, resources, fmi3False, fmi3True, fmi3False, fmi3False, NULL, 0, NULL, log, NULL);
}

fmi3Status set(fmi3Instance c, fmi3ValueReference r, double value) { return SetFloat64(c, &r, 1, &value, 1); }

static double get(fmi3Instance c, fmi3ValueReference r)
{
    double value = NAN;
    GetFloat64(c, &r, 1, &value, 1);
    return value;
}

fmi3Status step(fmi3Instance c, double time, double h)
{
    fmi3Status status = DoStep(c, time, h, fmi3True, flag, flag + 1, flag + 2, &number);
    check(!flag[0] && !flag[1] && !flag[2], "flags", "of a step");
    return status;
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

/* ---------------------------------------------------------------- random calls */

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
    else if (!strcmp(command, "threads")) threads();
    else if (!strcmp(command, "random_calls")) random_calls(argument);
    else return printf("%s is not a command\n", command), 2;
    return failures != 0;
}
