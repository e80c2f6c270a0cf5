/* What the files of this folder share: wheelrail.h on top of the compiled entries of contact/kernels/entries.
 *
 * The functions of wheelrail.h check their arguments, then call.  The entries get valid input only.  Nothing here has state,
 * allocates or prints.  Functions that several files use begin with wri_, which no host has, and are not exported. */
#ifndef WRI_INTERNAL_H
#define WRI_INTERNAL_H

#define WR_BUILD
#include "wheelrail.h"

#include "wheelrail_entries.h"

#ifdef _WIN32
#define WRI_SHARED extern
#else
#define WRI_SHARED extern __attribute__((visibility("hidden")))
#endif

/* ---------------------------------------------------------------- processors */

/* Numbers of `sizes`, the first argument of every entry. The last one says which kernels this processor runs, since asking the
 * processor takes microseconds in a virtual machine. */
enum { WIDE = 9, N_SIZES };

#if defined(WR_SEVERAL) /* kernels for two kinds of x86-64 processors */
const char *wr_processor(void);

static inline double is_wide(void) { return wr_processor()[1] == '3'; }
#define FIRST(sizes, ...) (sizes)
#define CALL(entry, ...) \
    (FIRST(__VA_ARGS__, 0)[WIDE] != 0.0 ? wrk_##entry##_v3(__VA_ARGS__) : wrk_##entry##_v2(__VA_ARGS__))
#else
static inline double is_wide(void) { return 0.0; }
#if defined(WR_ANY) /* kernels in C */
#define CALL(entry, ...) wrk_##entry##_any(__VA_ARGS__)
#else /* kernels for this machine */
#define CALL(entry, ...) wrk_##entry(__VA_ARGS__)
#endif
#endif

/* ---------------------------------------------------------------- codes: -(100 * argument + reason) */

#define LARGEST_PENETRATION 0.002 /* [m] */
#define TEXT_(number) #number
#define TEXT(number) TEXT_(number)

#define REASONS(X)                                                                                               \
    X(IS_NULL, "the pointer is NULL")                                                                            \
    X(NOT_FINITE, "a number is NaN or infinite")                                                                 \
    X(RANGE, "a number is outside its allowed range")                                                            \
    X(STRUCT, "the first member is not the size of the struct; call its ..._default function, or compile with "  \
              "the header of this library")                                                                      \
    X(NO_SOLVER, "the memory holds no such solver: it was not initialised, or it was overwritten")               \
    X(SMALL, "the memory or the array is smaller than needed")                                                   \
    X(ALIGNED, "the address is not a multiple of 8")                                                             \
    X(NO_ANSWER, "there is no answer yet: call solve first")                                                     \
    X(ORDER, "the values do not increase enough")                                                                  \
    X(DIFFERS, "the value differs from that of the options with which the memory was initialised")               \
    X(COINCIDE, "two neighbouring points coincide")                                                              \
    X(STEEP, "the profile is too steep at the tape circle or at its top: too few points can touch")              \
    X(GAUGE, "the rail does not reach as deep as the gauge point")                                               \
    X(NO_OVERLAP, "wheel and rail do not lie above each other")                                                  \
    X(NOT_SETTLED, "no height was found at which the wheel carries this force")                                  \
    X(TOO_DEEP, "the wheel lies far inside the rail")                                                            \
    X(TURNED, "wheelset and offset together turn the wheel too far")                                             \
    X(ENDLESS, "the damage has no finite value")                                                                 \
    X(PLANE, "this tangential method is only for a plane contact")                                               \
    X(NO_SURFACE, "the numbers are no surface as contact.geometry.surfaces.compiled.numbers writes it")          \
    X(NO_BINS, "surfaces have no bins")                                                                          \
    X(NO_CONTACT, "there is no contact, so no stress")                                                           \
    X(NO_FIELDS, "the tangential method gives forces only")                                                      \
    X(COARSE, "no element lies inside a patch")                                                                  \
    X(UNEVEN, "the steps are not equal")                                                                         \
    X(UPSIDE_DOWN, "the profile is upside down: z points down, so give -z")                                      \
    X(MIRRORED, "the profile is mirrored: the flange lies at negative y, so give -y and z in reverse order")      \
    X(FAMILY, "the family is not that of the method; wr_contact_case fills it")                                  \
    X(NEGATIVE, "a load is not negative")                                                                        \
    X(PENETRATION, "a penetration is at most " TEXT(LARGEST_PENETRATION) " m")                                   \
    X(BACKWARDS, "on surfaces a wheel rolls forward only")

enum { R_NONE,
#define X(name, text) R_##name,
       REASONS(X)
#undef X
       R_END };

#define TRY(call)              \
    do {                       \
        int code_ = (call);    \
        if (code_) return code_; \
    } while (0)

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* ---------------------------------------------------------------- methods */

typedef struct {
    int number;
    const char *name;
    int family, interacting, fields;
} Method;

#define X(number, name, family, interacting, fields) +1
enum { N_NORMAL = 0 WR_NORMAL_METHODS(X), N_TANGENTIAL = 0 WR_TANGENTIAL_METHODS(X) };
#undef X

/* The method with this number; NULL if there is none. */
WRI_SHARED const Method *wri_normal_method(int64_t number);
WRI_SHARED const Method *wri_tangential_method(int64_t number);

/* ---------------------------------------------------------------- checks: 0 or a code */

#include "arguments.h"

static inline int bad(int argument, int reason) { return -(100 * argument + reason); }

static inline int need(const void *pointer, int argument) { return pointer == NULL ? bad(argument, R_IS_NULL) : 0; }

static inline int among(int64_t value, int64_t low, int64_t high, int argument) {
    return value < low || value > high ? bad(argument, R_RANGE) : 0;
}

static inline int aligned(const void *pointer, int argument) {
    TRY(need(pointer, argument));
    return (uintptr_t)pointer % 8 ? bad(argument, R_ALIGNED) : 0;
}

WRI_SHARED int wri_check_number(double value, int argument);
WRI_SHARED int wri_check_whole(int64_t value, int argument);
/* Check members of a struct that follow each other in MEMBERS.  `of` is the struct of the caller. */
WRI_SHARED int wri_check_members(const void *of, int first, int last);
WRI_SHARED int wri_finite_all(const double *values, int64_t n, int argument);

WRI_SHARED int wri_check_contact_options(const wr_contact_options *o);
WRI_SHARED int wri_check_pair_options(const wr_pair_options *o);
WRI_SHARED int wri_check_surface(const wr_case *c, const wr_contact_options *o, const void *of, int first);
WRI_SHARED int wri_check_damage(const wr_damage_parameters *p, const void *of, int first);
WRI_SHARED int wri_check_fields(const wr_fields *f);
WRI_SHARED int wri_check_load(const wr_surface_load *l);
WRI_SHARED int wri_check_answer_struct(const wr_pair_answer *answer);
/* `arguments`: the profile, and its y, z and angle. */
WRI_SHARED int wri_check_profile(const wr_profile *p, const int arguments[4]);
WRI_SHARED int wri_check_place(const wr_profile *p, int is_wheel, const int arguments[4]);

/* ---------------------------------------------------------------- the caller's memory */

enum { CONTACT = 1, PAIR = 2, SURFACES = 3 }; /* PAIR: on profiles */

/* Head of every block.  `sum` covers what follows it up to `answered`, so that a forged or overwritten size is noticed. */
typedef struct {
    uint64_t magic, sum;
    int64_t abi, kind, bytes;
    int64_t at_zeros, at_work; /* in float64 from the head */
    int64_t at_strips, at_bins; /* from `work` */
    double sizes[N_SIZES];
    wr_contact_options patch;
    int64_t n_bins;
    int64_t answered; /* 1 after a solution: what follows belongs to it */
    int64_t n_strips, n_patches;
    wr_case problem;
    wr_result result;
} Head;

static inline int64_t head_numbers(void) { return ((int64_t)sizeof(Head) / 8 + 7) / 8 * 8; }
static inline double *numbers(void *memory, int64_t at) { return (double *)memory + at; }
static inline const double *read_numbers(const void *memory, int64_t at) { return (const double *)memory + at; }
static inline double *work_of(void *memory) { return numbers(memory, ((Head *)memory)->at_work); }

WRI_SHARED int wri_room(const void *memory, size_t bytes, size_t needed);
WRI_SHARED void wri_set_sizes(double sizes[N_SIZES], const wr_contact_options *o);
WRI_SHARED Head *wri_begin(const wr_contact_options *patch, int64_t kind, void *memory, size_t needed);
WRI_SHARED void wri_finish(Head *head);
WRI_SHARED int wri_check_memory(const void *memory, int64_t kind);
WRI_SHARED int wri_check_answer(const Head *head);

/* ---------------------------------------------------------------- results */

static inline int code_of(int64_t status) { return status == WR_STATUS_OK ? 0 : (int)status; }

WRI_SHARED int wri_copy_fields(const Head *head, const double *strips, int64_t n, wr_fields *f);
WRI_SHARED int wri_fill_load(const Head *head, int64_t n, const wr_result *result, wr_surface_load *l);
WRI_SHARED void wri_place_profile(const wr_profile *p, double *rows, double *scratch);

#endif
