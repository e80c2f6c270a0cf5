/* What hosts in C share: to load a library for itself alone, threads, and checks of which the failed ones are printed. */
#ifndef HOST_H
#define HOST_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef _WIN32
#include <windows.h>
#define GetVersion fmu_version /* Windows has its own */
static void *open_library(const char *path) { return (void *)LoadLibraryA(path); }
static void *find(void *library, const char *name) { return (void *)GetProcAddress(library, name); }
typedef HANDLE Thread;
#define THREAD_RESULT DWORD WINAPI
static void start(Thread *t, LPTHREAD_START_ROUTINE f, void *p) { *t = CreateThread(NULL, 0, f, p, 0, NULL); }
static void join(Thread t) { WaitForSingleObject(t, INFINITE); }
#else
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>
static void *open_library(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void *find(void *library, const char *name) { return dlsym(library, name); }
typedef pthread_t Thread;
#define THREAD_RESULT void *
static void start(Thread *t, void *(*f)(void *), void *p) { pthread_create(t, NULL, f, p); }
static void join(Thread t) { pthread_join(t, NULL); }
#endif

static const char *guid;
static int failures, messages;
static char last_message[1024];

static void check(int good, const char *what, const char *where)
{
    if (good) return;
    failures++;
    printf("FAILED %s %s\n", what, where);
}

/* In microseconds. */
static double now(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

static unsigned draw(unsigned n)
{
    static unsigned long long x = 88172645463325252ull;
    x ^= x << 13, x ^= x >> 7, x ^= x << 17;
    return (unsigned)(x % n);
}

#endif
