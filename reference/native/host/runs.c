/* Many instances, and many steps. */
#include "fmi2.h"

#ifndef _WIN32
#include <unistd.h>
#endif

#ifndef N_INSTANCES
#define N_INSTANCES 64
#endif
#define N_THREADS 8
#define N_STEPS 20
static fmi2Component crowd[N_INSTANCES];
static double serial[N_INSTANCES][2], parallel[N_INSTANCES][2];

static void advance(int i, double result[2])
{
    fmi2Component c = crowd[i];
    for (int k = 0; k < N_STEPS; k++) {
        set_real(c, VARIED, 1e-5 * (i + 1) * (k + 1));
        set_real(c, LOAD, 5e4 + 1e3 * i);
        DoStep(c, 1e-3 * k, 1e-3, fmi2True);
    }
    result[0] = real(c, SUM);
    result[1] = real(c, LATE);
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
        set_integer(crowd[i], CHOICE, 1 + i % 3);
        set_integer(crowd[i], OTHER_CHOICE, 1 + i / 3 % 3);
        EnterInitializationMode(crowd[i]);
        ExitInitializationMode(crowd[i]);
    }
}

void threads(void)
{
    Thread thread[N_THREADS];
    crowd_starts();
    for (int i = 0; i < N_INSTANCES; i++) advance(i, serial[i]);
    for (int i = 0; i < N_INSTANCES; i++) FreeInstance(crowd[i]);
    crowd_starts();
    for (int t = 0; t < N_THREADS; t++) start(&thread[t], worker, (void *)(size_t)t);
    for (int t = 0; t < N_THREADS; t++) join(thread[t]);
    check(!memcmp(serial, parallel, sizeof serial), "parallel equals serial", "");
    check(serial[0][0] != 0.0 && serial[0][0] != serial[1][0], "instances differ", "");
    for (int i = 0; i < N_INSTANCES; i++) FreeInstance(crowd[i]);
}

/* ---------------------------------------------------------------- two FMUs in one process */

#define N_READ 400
typedef double Trajectory[N_STEPS][N_READ];

/* Do a step and read all Reals; other variables stay zero. */
static void step_and_read(fmi2Component c, int k, double *values)
{
    DoStep(c, 1e-3 * k, 1e-3, fmi2True);
    for (fmi2ValueReference r = 0; r < N_READ; r++) GetReal(c, &r, 1, &values[r]);
}

void two_libraries(void *library, const char *path, const char *its_guid, const char *its_resources)
{
    static Trajectory alone[2], together[2];
    void *both[2] = {library, open_library(path)};
    const char *guids[2] = {guid, its_guid}, *folders[2] = {resources, its_resources};
    fmi2Component c[2];
    check(both[1] && both[1] != both[0], "two libraries", path);
    for (int i = 0; i < 2; i++) {
        use(both[i], guids[i], folders[i]);
        c[i] = running(quiet);
        for (int k = 0; k < N_STEPS; k++) step_and_read(c[i], k, alone[i][k]);
        FreeInstance(c[i]);
        check(!make(fmi2CoSimulation, quiet) == !c[i], "instantiate", path);
        guid = guids[1 - i];
        check(!make(fmi2CoSimulation, quiet), "each FMU refuses the guid of the other", path);
    }
    for (int i = 0; i < 2; i++) use(both[i], guids[i], folders[i]), c[i] = running(quiet);
    for (int k = 0; k < N_STEPS; k++)
        for (int i = 0; i < 2; i++) use(both[i], guids[i], folders[i]), step_and_read(c[i], k, together[i][k]);
    check(!memcmp(alone, together, sizeof alone), "together as alone", path);
    for (int i = 0; i < 2; i++) use(both[i], guids[i], folders[i]), FreeInstance(c[i]);
}

/* ---------------------------------------------------------------- memory over time */

#ifdef _WIN32
static long resident(void) { return 0; } /* measured only on Linux */
#else
static long resident(void)
{
    long pages = 0, total = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (!f || fscanf(f, "%ld %ld", &total, &pages) != 2) pages = -1;
    if (f) fclose(f);
    return pages * sysconf(_SC_PAGESIZE);
}
#endif

/* Make and free many instances, and do many steps of one, at the coarsest resolution. */
void soak(int cycles, int steps)
{
    fmi2FMUstate saved = NULL;
    long before = 0, grown;
    for (int i = 0; i < cycles + 100; i++) {
        fmi2Component c = make(fmi2CoSimulation, quiet);
        coarsen(c);
        EnterInitializationMode(c);
        ExitInitializationMode(c);
        DoStep(c, 0.0, 1e-3, fmi2True);
        GetFMUstate(c, &saved);
        SetFMUstate(c, saved);
        FreeFMUstate(c, &saved);
        FreeInstance(c);
        if (i == 100) before = resident();
    }
    grown = resident() - before;
    printf("%ld bytes in %d cycles\n", grown, cycles);
    check(grown < 1 << 20, "memory", "of cycles grows");
    fmi2Component c = make(fmi2CoSimulation, quiet);
    coarsen(c);
    EnterInitializationMode(c);
    ExitInitializationMode(c);
    for (int i = 0; i < steps; i++) {
        if (i == steps / 10) before = resident(); /* after each value was set once, so all pages are touched */
        set_real(c, VARIED, 1e-5 * (i % 1000));
        check(DoStep(c, 1e-3 * i, 1e-3, fmi2True) == fmi2OK, "step", "of many");
    }
    grown = resident() - before;
    printf("%ld bytes in %d steps\n", grown, steps);
    check(grown < 1 << 16, "memory", "of steps grows");
    FreeInstance(c);
}
