/* Measure the time of calls. The least of many batches counts, since other work on the machine only adds time. The batches are
 * short, so that some run undisturbed. */
#include <stdint.h>

#include "fmi2.h"

#define N_INPUTS 90
#define BATCHES 1000

/* Time since before the library was loaded. */
void first_step(double begin)
{
    fmi2Component c = running(quiet);
    DoStep(c, 0.0, 1e-3, fmi2True);
    printf("load to first step: %.0f us\n", now() - begin);
    FreeInstance(c);
}

#ifdef CONTACT

static double values[N_VALUES], inputs[N_INPUTS];
static fmi2ValueReference references[N_INPUTS];
static fmi2Component c;
static double *work;
static int64_t (*kernel)(double *, double *);

static void outputs(void) { kernel(values, work); }
static double reached_by_c;
static void step(void) { DoStep(c, reached_by_c, 1e-3, fmi2True), reached_by_c += 1e-3; }
static void set_inputs(void) { SetReal(c, references, N_INPUTS, inputs); }

/* Derivatives of the forces by creepages, load and friction, each after a new value of an input. */
enum { N_KNOWNS = 5 };
static const fmi2ValueReference forces[] = {V_force_x, V_force_y, V_moment_z};
static const fmi2ValueReference knowns[N_KNOWNS] = {V_creepage_longitudinal, V_creepage_lateral, V_creepage_spin,
                                                    V_load_normal_force, V_friction_coefficient};
static void read_stiffness(void) { step(), real(c, V_creep_stiffness); }
static void columns(int n)
{
    static double creepage = 1e-3;
    double slopes[3], one = 1.0;
    set_real(c, V_creepage_longitudinal, creepage = creepage > 1.0005e-3 ? 1e-3 : creepage + 1e-9);
    for (int k = 0; k < n; k++) GetDirectionalDerivative(c, forces, 3, &knowns[k], 1, &one, slopes);
}
static void one_column(void) { columns(1); }
static void every_column(void) { columns(N_KNOWNS); }

/* Least time of one call of each of two functions, which alternate. */
static void pair(void (*one)(void), void (*other)(void), int n, double least[2])
{
    void (*calls[2])(void) = {one, other};
    least[0] = least[1] = INFINITY;
    for (int batch = 0; batch < BATCHES; batch++) {
        for (int k = 0; k < 2; k++) {
            double begin = now();
            for (int i = 0; i < n; i++) calls[k]();
            least[k] = fmin(least[k], (now() - begin) / n);
        }
    }
}

/* An instance in partial slip, as contacts of a vehicle are. Without creepage a step takes less time. */
static fmi2Component in_slip(void)
{
    fmi2Component instance = running(quiet);
    set_real(instance, V_creepage_longitudinal, 1e-3);
    set_real(instance, V_creepage_lateral, 5e-4);
    set_real(instance, V_creepage_spin, 0.1);
    return instance;
}

/* Compare the bare kernel, from a library without the FMU, with fmi2DoStep. Then measure inputs and a vehicle's contacts. */
void speed(int n, const char *kernels)
{
    enum { N_CONTACTS = 8, CACHE_LINE = 64 };
    void *block;
    fmi2Component contacts[N_CONTACTS];
    double least[2], vehicle = INFINITY;
    void *library = open_library(kernels);
    if (!library) puts("the kernels cannot be loaded"), exit(2);
    kernel = (int64_t (*)(double *, double *))find(library, "outputs");
    c = in_slip();
    step();
    for (fmi2ValueReference r = 0; r < N_VALUES; r++) values[r] = any(c, r);
    block = calloc((size_t)((int64_t (*)(double *))find(library, "size"))(values) + CACHE_LINE, sizeof *work);
    work = (double *)(((uintptr_t)block + CACHE_LINE - 1) / CACHE_LINE * CACHE_LINE); /* aligned as in the FMU */
    ((int64_t (*)(double *, double *))find(library, "prepare"))(values, work);
    for (int i = 0; i < N_INPUTS; i++) references[i] = V_geometry_g + (fmi2ValueReference)i;
    GetReal(c, references, N_INPUTS, inputs);
    pair(outputs, step, n, least);
    printf("kernel: %.2f us\nfmi2DoStep: %.2f us\n", least[0], least[1]);
    pair(step, read_stiffness, n, least);
    printf("creep_stiffness: %.2f steps\n", least[1] / least[0] - 1.0);
    pair(step, one_column, n, least);
    printf("derivatives by one input: %.2f steps\n", least[1] / least[0]);
    pair(step, every_column, n, least);
    printf("derivatives by %d inputs: %.2f steps\n", N_KNOWNS, least[1] / least[0]);
    set_real(c, V_creepage_longitudinal, 1e-3);
    pair(set_inputs, set_inputs, 100 * n, least);
    printf("set %d inputs: %.3f us\n", N_INPUTS, fmin(least[0], least[1]));
    for (int i = 0; i < N_CONTACTS; i++) contacts[i] = in_slip();
    for (int batch = 0; batch < BATCHES; batch++) {
        double begin = now();
        for (int i = 0; i < N_CONTACTS; i++) {
            SetReal(contacts[i], references, N_INPUTS, inputs);
            DoStep(contacts[i], 1e-3 * batch, 1e-3, fmi2True);
            real(contacts[i], V_force_x), real(contacts[i], V_force_y), real(contacts[i], V_moment_z);
        }
        vehicle = fmin(vehicle, now() - begin);
    }
    printf("%d contacts at 1 kHz: %.1f times real time\n", N_CONTACTS, 1e3 / vehicle);
    for (int i = 0; i < N_CONTACTS; i++) FreeInstance(contacts[i]);
    FreeInstance(c);
    free(block);
}

#else
void speed(int n, const char *kernels)
{
    (void)n, (void)kernels;
    puts("speed is measured only for WheelRailContact"), exit(2);
}
#endif
