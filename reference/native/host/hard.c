/* A host in hard circumstances: hard LIBRARY GUID URI PATH (URI and PATH of the resources). Every allocation fails once, the
 * stack is small, the process forks between two steps, and the library is unloaded and loaded again. POSIX only. */
#include <errno.h>
#include <stdint.h>
#include <sys/wait.h>
#include <unistd.h>

#include "counting.h"
#include "model.h"
#include "roles.h"
#include <dlfcn.h>

enum { SMALL_STACK = 128 * 1024, RELOADS = 50, CRASHED = 99 };

/* ---- allocations: these functions replace those of the C library in the whole process (-rdynamic) */
extern void *__libc_malloc(size_t size), *__libc_calloc(size_t n, size_t size);
static long until_failure = -1; /* the next allocations that succeed; none fails if negative */

static bool fails(void) { return until_failure >= 0 && until_failure-- == 0; }
void *malloc(size_t size) { return fails() ? (errno = ENOMEM, NULL) : __libc_malloc(size); }
void *calloc(size_t n, size_t size) { return fails() ? (errno = ENOMEM, NULL) : __libc_calloc(n, size); }

static void *library;
static const char *uri, *path;
#define F2(name) ((fmi2##name##TYPE *)find(library, "fmi2" #name))
#define F3(name) ((fmi3##name##TYPE *)find(library, "fmi3" #name))
static const unsigned varied = VARIED, result = RESULT;

/* The life of an instance of FMI 2.0: steps, a state, its bytes, a derivative. Return the result, or NaN if a call failed. */
static double life_2(void)
{
    fmi2CallbackFunctions callbacks = {log_2, NULL, NULL, NULL, NULL};
    void *c = F2(Instantiate)("i", fmi2CoSimulation, guid, uri, &callbacks, 0, 0), *state = NULL;
    double value = TAKEN == 0.0 ? 1e-3 : 1e-3 * TAKEN, one = 1.0, slope, found = NAN;
    static char bytes[1 << 20];
    size_t size = 0;
    int status = 0;
    if (!c) return NAN;
    status |= F2(SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0) | F2(EnterInitializationMode)(c);
    if (strcmp(VARIED_NAME, "speed")) status |= F2(SetReal)(c, &varied, 1, &value);
    status |= F2(ExitInitializationMode)(c) | F2(DoStep)(c, 0.0, 1e-3, 1) | F2(GetFMUstate)(c, &state);
    status |= F2(SerializedFMUstateSize)(c, state, &size);
    if (size <= sizeof bytes) status |= F2(SerializeFMUstate)(c, state, bytes, size);
    status |= F2(FreeFMUstate)(c, &state) | F2(DeSerializeFMUstate)(c, bytes, size, &state) | F2(SetFMUstate)(c, state);
    status |= F2(FreeFMUstate)(c, &state);
    if (HAS_EXCHANGE) status |= F2(GetDirectionalDerivative)(c, &result, 1, &varied, 1, &one, &slope);
    status |= F2(DoStep)(c, 1e-3, 1e-3, 1) | F2(GetReal)(c, &result, 1, &found);
    F2(FreeInstance)(c);
    return status > fmi2Warning ? NAN : found;
}

static double life_3(void)
{
    void *c = F3(InstantiateCoSimulation)("i", guid, path, 0, 0, 0, 0, NULL, 0, NULL, log_3, NULL), *state = NULL;
    double value = TAKEN == 0.0 ? 1e-3 : 1e-3 * TAKEN, one = 1.0, slope, end, found = NAN;
    bool flag[3];
    int status = 0;
    if (!c) return NAN;
    status |= F3(EnterInitializationMode)(c, 0, 0.0, 0.0, 0, 0.0);
    if (strcmp(VARIED_NAME, "speed")) status |= F3(SetFloat64)(c, &varied, 1, &value, 1);
    status |= F3(ExitInitializationMode)(c) | F3(DoStep)(c, 0.0, 1e-3, 1, flag, flag + 1, flag + 2, &end);
    status |= F3(GetFMUState)(c, &state) | F3(SetFMUState)(c, state) | F3(FreeFMUState)(c, &state);
    if (HAS_EXCHANGE) status |= F3(GetAdjointDerivative)(c, &result, 1, &varied, 1, &one, 1, &slope, 1);
    status |= F3(DoStep)(c, 1e-3, 1e-3, 1, flag, flag + 1, flag + 2, &end) | F3(GetFloat64)(c, &result, 1, &found, 1);
    F3(FreeInstance)(c);
    return status > fmi3Warning ? NAN : found;
}

static double life(int version) { return version == 2 ? life_2() : life_3(); }

/* Let allocation 0, 1, … fail, each in a process of its own, until a life needs no more. Return how many there are. */
static int allocations(int version, double wanted)
{
    for (int k = 0; k < 1000; k++) {
        int how;
        pid_t child = fork();
        if (!child) {
            until_failure = k;
            double found = life(version);
            bool failed = until_failure < 0;
            until_failure = -1;
            if (failed) _exit(isnan(found) && messages == 0 ? 3 : life(version) != wanted); /* told, and the next life is whole */
            _exit(found == wanted ? 2 : 3);
        }
        if (waitpid(child, &how, 0) != child || !WIFEXITED(how)) how = CRASHED << 8;
        if (WEXITSTATUS(how) == 2) return k;
        check(WEXITSTATUS(how) == 0, "a failed allocation", version == 2 ? "FMI 2.0" : "FMI 3.0");
        if (WEXITSTATUS(how) != 0) printf("allocation %d: %d\n", k, WEXITSTATUS(how));
    }
    return 0;
}

static double on_small_stack_found;
static int on_small_stack_version;
static void *on_small_stack(void *nothing)
{
    (void)nothing;
    on_small_stack_found = life(on_small_stack_version);
    return NULL;
}

static void small_stack(int version, double wanted)
{
    pthread_t thread;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, SMALL_STACK);
    on_small_stack_version = version;
    check(!pthread_create(&thread, &attributes, on_small_stack, NULL) && !pthread_join(thread, NULL), "a thread", "small stack");
    check(on_small_stack_found == wanted, "the result", "on a small stack");
    pthread_attr_destroy(&attributes);
}

/* Fork between two steps: both processes go on, with the same result. */
static void forked(void)
{
    fmi2CallbackFunctions callbacks = {log_2, NULL, NULL, NULL, NULL};
    void *c = F2(Instantiate)("i", fmi2CoSimulation, guid, uri, &callbacks, 0, 0);
    double here = NAN, there = NAN;
    int in_pipe[2], how;
    F2(SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0);
    F2(EnterInitializationMode)(c);
    F2(ExitInitializationMode)(c);
    F2(DoStep)(c, 0.0, 1e-3, 1);
    if (pipe(in_pipe)) exit(2);
    pid_t child = fork();
    F2(DoStep)(c, 1e-3, 1e-3, 1);
    F2(GetReal)(c, &result, 1, &here);
    F2(FreeInstance)(c);
    if (!child) _exit(write(in_pipe[1], &here, sizeof here) != sizeof here);
    check(waitpid(child, &how, 0) == child && WIFEXITED(how) && !WEXITSTATUS(how), "the child", "of a fork");
    check(read(in_pipe[0], &there, sizeof there) == sizeof there && here == there, "both processes", "after a fork");
}

int main(int n_arguments, char **arguments)
{
    double wanted[4];
    if (n_arguments != 5 || !(library = open_library(arguments[1]))) return puts("hard LIBRARY GUID URI PATH"), 2;
    guid = arguments[2], uri = arguments[3], path = arguments[4];
    for (int version = 2; version <= 3; version++) {
        wanted[version] = life(version);
        check(isfinite(wanted[version]), "a life", "without hardship");
        printf("FMI %d.0: %d allocations\n", version, allocations(version, wanted[version]));
        small_stack(version, wanted[version]);
    }
    forked();
    for (int k = 0; k < RELOADS; k++) {
        dlclose(library);
        library = open_library(arguments[1]);
        check(library && life(2 + k % 2) == wanted[2 + k % 2], "the library", "loaded again");
    }
    return failures != 0;
}
