/* What the page calls: the kernels on memory of this module. Results are int, so that JavaScript needs no BigInt. */
#include <stddef.h>
#include <stdint.h>

#define EXPORT(name) __attribute__((export_name(#name)))

extern int64_t page_memory(double *values, double *resources, double *own);
extern int64_t page_size(double *values, double *resources, double *own);
extern int64_t page_prepare(double *values, double *work, double *resources, double *own);
extern int64_t page_outputs(double *values, double *work, double h, double *resources, double *own);
extern int64_t page_field(double *values, double *work, int64_t k, double *resources, double *own);

extern unsigned char __heap_base;

static double *values, *resources, *work;
static size_t warm; /* numbers of the warm start at the beginning of `work` */

/* Return room for `count` numbers from the address `from` on, at a cache line; NULL if there is no memory. */
static double *take(size_t from, size_t count)
{
    from = (from + 63) / 64 * 64;
    size_t need = from + 8 * count, have = __builtin_wasm_memory_size(0) * 65536u;
    if (need > have && __builtin_wasm_memory_grow(0, (need - have + 65535) / 65536) == (size_t)-1)
        return NULL;
    return (double *)from;
}

/* Lay out the values (with room for the fields of a patch) and the profiles. Return where the values begin, 0 on failure. */
EXPORT(allocate) double *allocate(int n_values, int n_resources)
{
    values = take((size_t)&__heap_base, n_values);
    resources = values ? take((size_t)(values + n_values), n_resources) : NULL;
    work = resources ? resources + n_resources : NULL;
    return resources ? values : NULL;
}

EXPORT(resources_at) double *resources_at(void) { return resources; }

EXPORT(forget) void forget(void)
{
    for (size_t i = 0; i < warm; i++)
        work[i] = 0.0;
}

/* Fill what depends on parameters and profiles. Return 0, the number of a failure, or -1 if there is no memory. */
EXPORT(prepare) int prepare(void)
{
    work = take((size_t)work, (size_t)page_size(values, resources, NULL));
    if (!work)
        return -1;
    warm = (size_t)page_memory(values, resources, NULL);
    forget();
    return (int)page_prepare(values, work, resources, NULL);
}

/* Solve with the inputs among the values. Return a status or the number of a failure. */
EXPORT(solve) int solve(void) { return (int)page_outputs(values, work, 0.0, resources, NULL); }

/* Write strips and fields of patch k of the last solution behind the values. Return the number of strips. */
EXPORT(patch) int patch(int k) { return (int)page_field(values, work, k, resources, NULL); }
