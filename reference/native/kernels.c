/* The kernels of WheelRailContact for one processor, CPU, exported so that they can be called without the FMU. */
#include <stdint.h>

#include "own.h" /* its numbers, as resources/model.bin has them */

#define JOIN(a, b) a##_##b
#define OF_CPU(name, cpu) JOIN(name, cpu)
int64_t OF_CPU(contact_size, CPU)(double *, const double *, const int64_t *);
int64_t OF_CPU(contact_prepare, CPU)(double *, double *, const double *, const int64_t *);
int64_t OF_CPU(contact_outputs, CPU)(double *, double *, double, const double *, const int64_t *);

int64_t size(double *values) { return OF_CPU(contact_size, CPU)(values, 0, own); }
int64_t prepare(double *values, double *work) { return OF_CPU(contact_prepare, CPU)(values, work, 0, own); }
int64_t outputs(double *values, double *work) { return OF_CPU(contact_outputs, CPU)(values, work, 0.0, 0, own); }
