/* Whether this processor has AVX2 and what else x86-64-v3 requires. */
#ifndef PROCESSOR_H
#define PROCESSOR_H
#include <stdbool.h>

#include <cpuid.h>

/* x86-64-v3 requires AVX2, FMA, BMI, LZCNT, MOVBE and F16C of the processor, and a system that saves the wide registers.
 * __builtin_cpu_supports is not used, since it needs a variable that the library would have to write. */
static inline bool has_x86_64_v3(void)
{
    const unsigned leaf1 = bit_FMA | bit_MOVBE | bit_OSXSAVE | bit_AVX | bit_F16C, leaf7 = bit_AVX2 | bit_BMI | bit_BMI2;
    const unsigned lzcnt = 1u << 5, wide_registers = 6;
    unsigned a, b, c, d, saved, high;
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & leaf1) != leaf1) return false;
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d) || (b & leaf7) != leaf7) return false;
    if (!__get_cpuid(0x80000001, &a, &b, &c, &d) || !(c & lzcnt)) return false;
    __asm__("xgetbv" : "=a"(saved), "=d"(high) : "c"(0));
    return (saved & wide_registers) == wide_registers;
}
#endif
