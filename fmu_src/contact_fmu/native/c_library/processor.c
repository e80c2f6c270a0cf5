/* Which version of the kernels this processor runs. */
#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

#if !defined(WR_ANY) && (defined(__x86_64__) || defined(_M_X64))
#include "../c/processor.h"

EXPORTED const char *wr_processor(void) { return has_x86_64_v3() ? "v3" : "v2"; }
#else
EXPORTED const char *wr_processor(void) { return "any"; }
#endif

#ifdef _WIN32
/* Threads of a vehicle give way to others by a function that Windows has under another name. */
int __stdcall SwitchToThread(void);
int sched_yield(void) { return SwitchToThread(); }
#endif
