/* The kernels of a native FMU for one processor, CPU, exported so that they can be called without the FMU. */
#include <stdint.h>

#define JOIN(a, b) a##_##b
#define OF_CPU(name, cpu) JOIN(name, cpu)
int64_t OF_CPU(model_size, CPU)(double *);
int64_t OF_CPU(model_prepare, CPU)(double *, double *);
int64_t OF_CPU(model_outputs, CPU)(double *, double *, double);

int64_t size(double *values) { return OF_CPU(model_size, CPU)(values); }
int64_t prepare(double *values, double *work) { return OF_CPU(model_prepare, CPU)(values, work); }
int64_t outputs(double *values, double *work) { return OF_CPU(model_outputs, CPU)(values, work, 0.0); }
