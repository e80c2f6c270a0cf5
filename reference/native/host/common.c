#include <time.h>

#include "common.h"

#ifdef _WIN32
void *open_library(const char *path) { return (void *)LoadLibraryA(path); }
void *find(void *library, const char *name) { return (void *)GetProcAddress(library, name); }
void start(Thread *thread, Work *work, void *argument) { *thread = CreateThread(NULL, 0, work, argument, 0, NULL); }
void join(Thread thread) { WaitForSingleObject(thread, INFINITE); }
#else
#include <dlfcn.h>
void *open_library(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
void *find(void *library, const char *name) { return dlsym(library, name); }
void start(Thread *thread, Work *work, void *argument) { pthread_create(thread, NULL, work, argument); }
void join(Thread thread) { pthread_join(thread, NULL); }
#endif

const char *guid, *resources;
int failures, messages;
char last_message[1024];

void check(int good, const char *what, const char *where)
{
    if (good) return;
    failures++;
    printf("FAILED %s %s\n", what, where);
}

double now(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

unsigned draw(unsigned n)
{
    static unsigned long long x = 88172645463325252ull;
    x ^= x << 13, x ^= x >> 7, x ^= x << 17;
    return (unsigned)(x % n);
}
