/* wheelrail.h on top of the compiled entries of contact/kernels/entries: check arguments, then call.
 *
 * The entries get valid input only.  Nothing here has state, allocates or prints. */
#define WR_BUILD
#include "wheelrail.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "wheelrail_entries.h"

/* ---------------------------------------------------------------- processors */

/* Numbers of `sizes`, the first argument of every entry. The last one says which kernels this processor runs, since asking the
 * processor takes microseconds in a virtual machine. */
enum { WIDE = 9, N_SIZES };

#if defined(WR_SEVERAL) /* kernels for two kinds of x86-64 processors */
const char *wr_processor(void);

static double is_wide(void) { return wr_processor()[1] == '3'; }
#define FIRST(sizes, ...) (sizes)
#define CALL(entry, ...) \
    (FIRST(__VA_ARGS__, 0)[WIDE] != 0.0 ? wrk_##entry##_v3(__VA_ARGS__) : wrk_##entry##_v2(__VA_ARGS__))
#else
static double is_wide(void) { return 0.0; }
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
    X(ORDER, "the values do not increase")                                                                       \
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

typedef struct {
    int number;
    const char *name;
    int family, interacting, fields;
} Method;

#define X(number, name, family, interacting, fields) {number, name, family, interacting, fields},
static const Method NORMAL[] = {WR_NORMAL_METHODS(X)};
static const Method TANGENTIAL[] = {WR_TANGENTIAL_METHODS(X)};
#undef X
#define COUNT(array) (sizeof(array) / sizeof *(array))

#include "wheelrail_arguments.h"

int wr_abi(void) { return WR_ABI; }

#ifndef WR_VERSION
#define WR_VERSION "0"
#endif
const char *wr_version(void) { return WR_VERSION; }

/* The constant arrays of the kernels, by number. Python reads them instead of computing them again. */
#ifdef _WIN32
#define OF_KERNELS extern
#else
#define OF_KERNELS extern __attribute__((visibility("hidden")))
#endif
OF_KERNELS const char wr_data0[], wr_data1[], wr_data2[], wr_data3[];

WR_API const void *wr_constants(int k) {
    const char *all[] = {wr_data0, wr_data1, wr_data2, wr_data3};
    return k >= 0 && k < 4 ? all[k] : NULL;
}

const char *wr_message(int code) {
    switch (code) {
    case 0:
    case WR_STATUS_OK: return "solved";
    case WR_STATUS_NO_CONTACT: return "the bodies do not touch: all forces are zero";
    case WR_STATUS_SATURATED: return "solved; the whole patch slips";
    case WR_STATUS_OUT_OF_RANGE: return "the contact patch reaches the end of the given separation; extend y";
    case WR_STATUS_NOT_CONVERGED: return "the iteration stopped at its cap; the last iterate is returned";
    case WR_STATUS_UNREACHABLE: return "no creepage makes the given force";
    default: break;
    }
    if (code < 0 && code > -100 * A_end) switch (-code % 100) {
#define X(name, text) case R_##name: return text;
        REASONS(X)
#undef X
        default: break;
        }
    return "unknown code";
}

const char *wr_argument(int code) { return code < 0 && code > -100 * A_end ? ARGUMENT[-code / 100].name : ""; }

/* ---------------------------------------------------------------- methods */

static const Method *find(int tangential, int64_t number) {
    const Method *known = tangential ? TANGENTIAL : NORMAL;
    size_t n = tangential ? COUNT(TANGENTIAL) : COUNT(NORMAL);
    for (size_t i = 0; i < n; i++)
        if (known[i].number == number) return &known[i];
    return NULL;
}

/* 0 normal, 1 tangential, -1 neither */
static int kind_of(const char *kind) {
    if (kind == NULL) return -1;
    return strcmp(kind, "normal") == 0 ? 0 : strcmp(kind, "tangential") == 0 ? 1 : -1;
}

const char *wr_method_name(const char *kind, int number) {
    int of = kind_of(kind);
    const Method *found = of < 0 ? NULL : find(of, number);
    return found == NULL ? NULL : found->name;
}

int wr_method_number(const char *kind, const char *name) {
    int of = kind_of(kind);
    if (of < 0 || name == NULL) return -1;
    const Method *known = of ? TANGENTIAL : NORMAL;
    size_t n = of ? COUNT(TANGENTIAL) : COUNT(NORMAL);
    for (size_t i = 0; i < n; i++)
        if (strcmp(known[i].name, name) == 0) return known[i].number;
    return -1;
}

/* ---------------------------------------------------------------- checks */

static int need(const void *pointer, int argument) { return pointer == NULL ? bad(argument, R_IS_NULL) : 0; }

static int among(int64_t value, int64_t low, int64_t high, int argument) {
    return value < low || value > high ? bad(argument, R_RANGE) : 0;
}

static int finite_all(const double *values, int64_t n, int argument) {
    for (int64_t i = 0; i < n; i++)
        if (!isfinite(values[i])) return bad(argument, R_NOT_FINITE);
    return 0;
}

static int aligned(const void *pointer, int argument) {
    TRY(need(pointer, argument));
    return (uintptr_t)pointer % 8 ? bad(argument, R_ALIGNED) : 0;
}

static int check_contact_options(const wr_contact_options *o) {
    TRY(aligned(o, A_options));
    if (o->size != (int64_t)sizeof *o) return bad(A_options, R_STRUCT);
    return check_members(o, A_options_normal, A_options_pressure_limit);
}

static int check_separation(const wr_separation *s, int64_t most) {
    TRY(aligned(s, A_separation));
    TRY(among(s->n, 3, most, A_sep_n));
    TRY(aligned(s->y, A_sep_y));
    TRY(aligned(s->g, A_sep_g));
    TRY(aligned(s->A, A_sep_A));
    TRY(finite_all(s->y, s->n, A_sep_y));
    TRY(finite_all(s->g, s->n, A_sep_g));
    for (int64_t i = 1; i < s->n; i++)
        if (!(s->y[i] > s->y[i - 1])) return bad(A_sep_y, R_ORDER);
    for (int64_t i = 0; i < s->n; i++) TRY(check_number(s->A[i], A_sep_A));
    if (s->x_c != NULL) {
        TRY(aligned(s->x_c, A_sep_x_c));
        TRY(finite_all(s->x_c, s->n, A_sep_x_c));
    }
    if (s->tilt != NULL) {
        TRY(aligned(s->tilt, A_sep_tilt));
        for (int64_t i = 0; i < s->n; i++) TRY(check_number(s->tilt[i], A_sep_tilt));
    }
    return 0;
}

/* Methods, material and friction of a case.  `of` is the struct that has it, and `first` the argument of its first member. */
static int check_surface(const wr_case *c, const wr_contact_options *o, const void *of, int first) {
#define ARGUMENT_OF(member) (first + A_case_##member - A_case_normal)
    if (c->normal != o->normal) return bad(ARGUMENT_OF(normal), R_DIFFERS);
    if (c->normal_family != find(0, o->normal)->family) return bad(ARGUMENT_OF(normal_family), R_FAMILY);
    TRY(check_members(of, first, ARGUMENT_OF(conformal)));
    if (c->tangential_family != find(1, c->tangential)->family) return bad(ARGUMENT_OF(tangential_family), R_FAMILY);
    return c->nu != o->poisson_ratio ? bad(ARGUMENT_OF(nu), R_DIFFERS) : 0;
#undef ARGUMENT_OF
}

static int check_case(const wr_case *c, const wr_contact_options *o) {
    TRY(aligned(c, A_problem));
    TRY(check_surface(c, o, c, A_case_normal));
    if (c->conformal && !find(1, c->tangential)->fields) return bad(A_case_tangential, R_PLANE);
    TRY(check_members(c, A_case_load_kind, A_case_rolling));
    return c->load_kind == WR_BY_LOAD && c->amount < 0.0 ? bad(A_case_amount, R_NEGATIVE) : 0;
}

/* `of` is the struct that has the parameters. */
static int check_damage(const wr_damage_parameters *p, const void *of, int first) {
    TRY(check_members(of, first, first + A_parameters_wear_law - A_parameters_speed));
    const double *all[] = {p->pearce_sherratt, p->burstow, p->usfd, p->archard};
    const size_t n[] = {COUNT(p->pearce_sherratt), COUNT(p->burstow), COUNT(p->usfd), COUNT(p->archard)};
    for (size_t j = 0; j < 4; j++)
        for (size_t i = 0; i < n[j]; i++)
            if (isnan(all[j][i])) return bad(A_p_constants, R_NOT_FINITE);
    return 0;
}

/* ---------------------------------------------------------------- the caller's memory */

#define MAGIC 0x7765656c7261696cu
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

static int64_t head_numbers(void) { return ((int64_t)sizeof(Head) / 8 + 7) / 8 * 8; }
static double *numbers(void *memory, int64_t at) { return (double *)memory + at; }
static const double *read_numbers(const void *memory, int64_t at) { return (const double *)memory + at; }
static double *work_of(void *memory) { return numbers(memory, ((Head *)memory)->at_work); }

static uint64_t sum_of(const Head *head) {
    const unsigned char *bytes = (const unsigned char *)&head->abi, *end = (const unsigned char *)&head->answered;
    uint64_t sum = 1469598103934665603u, word;
    for (; bytes < end; bytes += sizeof word) {
        memcpy(&word, bytes, sizeof word);
        sum = (sum ^ word) * 1099511628211u;
        sum ^= sum >> 29;
    }
    return sum;
}

static int check_memory(const void *memory, int64_t kind) {
    const Head *head = memory;
    TRY(aligned(memory, A_memory));
    if (head->magic != MAGIC || head->abi != WR_ABI || head->kind != kind || head->sum != sum_of(head))
        return bad(A_memory, R_NO_SOLVER);
    return 0;
}

static int check_answer(const Head *head) {
    if (head->answered != 1) return bad(A_memory, R_NO_ANSWER);
    int64_t most = WR_MAX_PATCHES * head->patch.n_strips;
    int sane = head->n_strips >= 0 && head->n_strips <= most && head->n_patches >= 0 && head->n_patches <= WR_MAX_PATCHES;
    return sane ? 0 : bad(A_memory, R_NO_SOLVER);
}

static void set_sizes(double sizes[N_SIZES], const wr_contact_options *o) {
    memset(sizes, 0, N_SIZES * sizeof *sizes);
    sizes[WIDE] = is_wide();
    sizes[0] = find(0, o->normal)->interacting;
    sizes[1] = (double)o->n_strips;
    sizes[2] = (double)o->n_elements;
    sizes[3] = (double)o->n_samples;
}

static int room(const void *memory, size_t bytes, size_t needed) {
    TRY(aligned(memory, A_memory));
    return bytes < needed ? bad(A_bytes, R_SMALL) : 0;
}

static int copy_fields(const Head *head, const double *strips, int64_t n, wr_fields *f) {
    int64_t m = head->patch.n_elements, capacity = WR_MAX_PATCHES * head->patch.n_strips;
    const double *fields = strips + WR_STRIP_ROWS * capacity;
    if (n > f->n_strips_most) return bad(A_n_strips_most, R_SMALL);
    double *to[] = {f->x, f->p, f->qx, f->qy, f->sx, f->sy, f->stick};
    const int row[] = {WR_FIELD_X, WR_FIELD_P, WR_FIELD_QX, WR_FIELD_QY, WR_FIELD_SX, WR_FIELD_SY, WR_FIELD_STICK};
    for (size_t j = 0; j < COUNT(row); j++)
        if (to[j] != NULL) memcpy(to[j], fields + row[j] * capacity * m, (size_t)(n * m) * sizeof(double));
    for (int64_t i = 0; f->y != NULL && i < n; i++)
        for (int64_t k = 0; k < m; k++) f->y[i * m + k] = strips[WR_STRIP_Y * capacity + i];
    f->n_strips = n;
    return 0;
}

static int check_fields(const wr_fields *f) {
    TRY(aligned(f, A_fields));
    if (f->size != (int64_t)sizeof *f) return bad(A_fields, R_STRUCT);
    double *to[] = {f->x, f->y, f->p, f->qx, f->qy, f->sx, f->sy, f->stick};
    for (size_t j = 0; j < COUNT(to); j++)
        if ((uintptr_t)to[j] % 8) return bad(A_fields, R_ALIGNED);
    return among(f->n_strips_most, 0, INT64_MAX, A_n_strips_most);
}

/* ---------------------------------------------------------------- one patch */

int wr_contact_default(wr_contact_options *o) {
    TRY(aligned(o, A_options));
    *o = (wr_contact_options){.size = sizeof *o,
                              .normal = WR_DEFAULT_NORMAL,
                              .tangential = WR_DEFAULT_TANGENTIAL,
                              .n_strips = 20,
                              .n_elements = 20,
                              .n_samples = 101,
                              .max_iterations = WR_DEFAULT_ITERATIONS,
                              .shear_modulus = WR_STEEL_SHEAR_MODULUS,
                              .poisson_ratio = WR_STEEL_POISSON_RATIO,
                              .pressure_limit = INFINITY};
    return 0;
}

int wr_contact_size(const wr_contact_options *o, size_t *bytes) {
    double sizes[N_SIZES];
    TRY(check_contact_options(o));
    TRY(aligned(bytes, A_bytes));
    if (o->conformal && !find(1, o->tangential)->fields) return bad(A_options_tangential, R_PLANE);
    set_sizes(sizes, o);
    *bytes = 8 * (size_t)(head_numbers() + (o->n_samples + 7) / 8 * 8 + CALL(contact_size, sizes));
    return 0;
}

int wr_contact_init(const wr_contact_options *o, void *memory, size_t bytes) {
    size_t needed;
    TRY(wr_contact_size(o, &needed));
    TRY(room(memory, bytes, needed));
    wr_contact_options kept = *o; /* it may lie in the memory */
    memset(memory, 0, needed);
    Head *head = memory;
    head->magic = MAGIC, head->abi = WR_ABI, head->kind = CONTACT, head->bytes = (int64_t)needed;
    head->patch = kept;
    set_sizes(head->sizes, &kept);
    head->at_zeros = head_numbers();
    head->at_work = head->at_zeros + (kept.n_samples + 7) / 8 * 8;
    head->at_strips = CALL(contact_strips, head->sizes);
    CALL(contact_init, head->sizes, kept.poisson_ratio, work_of(memory));
    head->sum = sum_of(head);
    return 0;
}

int wr_contact_case(const wr_contact_options *o, double mu, double speed, wr_case *c) {
    TRY(check_contact_options(o));
    TRY(check_number(mu, A_mu));
    TRY(check_number(speed, A_speed));
    TRY(aligned(c, A_problem));
    memset(c, 0, sizeof *c);
    c->normal = o->normal, c->normal_family = find(0, o->normal)->family;
    c->tangential = o->tangential, c->tangential_family = find(1, o->tangential)->family;
    c->G = o->shear_modulus, c->nu = o->poisson_ratio, c->pressure_limit = o->pressure_limit;
    c->max_iterations = o->max_iterations, c->conformal = o->conformal;
    c->mu = c->kinetic = mu, c->speed = speed;
#define X(member, value) c->member = value;
    WR_SURFACE_DEFAULTS(X)
#undef X
    return 0;
}

static int code_of(int64_t status) { return status == WR_STATUS_OK ? 0 : (int)status; }

/* Find the samples that a separation may leave out: zeros. */
static void optional_samples(void *memory, const wr_separation *s, const double **x_c, const double **tilt) {
    double *zeros = numbers(memory, ((Head *)memory)->at_zeros);
    memset(zeros, 0, (size_t)s->n * sizeof *zeros);
    *x_c = s->x_c != NULL ? s->x_c : zeros, *tilt = s->tilt != NULL ? s->tilt : zeros;
}

/* Solve a checked case.  Return the number of strips. */
static int64_t solve_contact(void *memory, int cold, const wr_separation *s, const wr_case *c, wr_result *result) {
    Head *head = memory;
    const double *x_c, *tilt;
    optional_samples(memory, s, &x_c, &tilt);
    head->answered = 0;
    return CALL(contact_solve, head->sizes, work_of(memory), cold, s->n, (void *)s->y, (void *)s->g, (void *)s->A,
                (void *)x_c, (void *)tilt, (void *)c, result);
}

int wr_contact_solve(void *memory, const wr_separation *s, const wr_case *c, wr_result *result) {
    TRY(check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(check_separation(s, head->patch.n_samples));
    TRY(check_case(c, &head->patch));
    TRY(aligned(result, A_result));
    head->problem = *c;
    head->n_strips = solve_contact(memory, 0, s, &head->problem, &head->result);
    head->answered = 1;
    *result = head->result;
    return code_of(result->status);
}

int wr_contact_solve_force(void *memory, const wr_separation *s, int64_t which, double Fx, double Fy, wr_case *c,
                           wr_result *result) {
    TRY(check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(check_separation(s, head->patch.n_samples));
    TRY(check_whole(which, A_which_forces));
    if (which & WR_FORCE_X) TRY(check_number(Fx, A_force_x));
    if (which & WR_FORCE_Y) TRY(check_number(Fy, A_force_y));
    TRY(check_case(c, &head->patch));
    TRY(aligned(result, A_result));
    wr_result results[2];
    const double *x_c, *tilt;
    optional_samples(memory, s, &x_c, &tilt);
    head->problem = *c;
    head->n_strips = CALL(contact_force, head->sizes, work_of(memory), which, Fx, Fy, s->n, (void *)s->y, (void *)s->g,
                          (void *)s->A, (void *)x_c, (void *)tilt, &head->problem, results);
    head->result = results[0], head->answered = 1;
    *c = head->problem, *result = head->result;
    return code_of(result->status);
}

int wr_contact_accept(void *memory) {
    TRY(check_memory(memory, CONTACT));
    TRY(check_answer(memory));
    CALL(contact_accept, ((Head *)memory)->sizes, work_of(memory));
    return 0;
}

int wr_contact_forget(void *memory) {
    TRY(check_memory(memory, CONTACT));
    CALL(contact_forget, ((Head *)memory)->sizes, work_of(memory));
    ((Head *)memory)->answered = 0;
    return 0;
}

int wr_contact_derivatives(void *memory, const wr_separation *s, const wr_case *c, double *jacobian) {
    TRY(check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(check_separation(s, head->patch.n_samples));
    TRY(check_case(c, &head->patch));
    TRY(aligned(jacobian, A_jacobian));
    wr_case problems[2] = {*c, *c};
    wr_result results[2];
    const double *x_c, *tilt;
    optional_samples(memory, s, &x_c, &tilt);
    head->n_strips = CALL(contact_derivatives, head->sizes, work_of(memory), s->n, (void *)s->y, (void *)s->g,
                          (void *)s->A, (void *)x_c, (void *)tilt, problems, results, jacobian);
    head->problem = *c, head->result = results[0], head->answered = 1;
    return code_of(head->result.status);
}

int wr_contact_fields(const void *memory, wr_fields *fields) {
    TRY(check_memory(memory, CONTACT));
    const Head *head = memory;
    TRY(check_answer(head));
    TRY(check_fields(fields));
    return copy_fields(head, read_numbers(memory, head->at_work + head->at_strips), head->n_strips, fields);
}

int wr_damage_default(wr_damage_parameters *parameters) {
    TRY(aligned(parameters, A_parameters));
    *parameters = (wr_damage_parameters)WR_DAMAGE_DEFAULTS;
    return 0;
}

int wr_contact_damage(void *memory, const wr_damage_parameters *parameters, wr_damage *damage) {
    TRY(check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(check_answer(head));
    TRY(aligned(parameters, A_parameters));
    TRY(check_damage(parameters, parameters, A_parameters_speed));
    TRY(aligned(damage, A_damage));
    CALL(contact_damage, head->sizes, work_of(memory), head->n_strips, &head->problem, &head->result, (void *)parameters,
         damage);
    return 0;
}

static int check_load(const wr_surface_load *l) {
    TRY(aligned(l, A_surface_load));
    if (l->size != (int64_t)sizeof *l) return bad(A_surface_load, R_STRUCT);
    TRY(check_members(l, A_load_nx, A_load_ny));
    TRY(aligned(l->x, A_load_x));
    TRY(aligned(l->y, A_load_y));
    TRY(aligned(l->p, A_load_p));
    TRY(aligned(l->qx, A_load_qx));
    return aligned(l->qy, A_load_qy);
}

static int check_even(const double *values, int64_t n, int argument) {
    TRY(finite_all(values, n, argument));
    double step = (values[n - 1] - values[0]) / (double)(n - 1);
    for (int64_t i = 1; i < n; i++) {
        double here = values[i] - values[i - 1];
        if (!(here > 0.0)) return bad(argument, R_ORDER);
        if (!(fabs(here - step) <= 1e-6 * step)) return bad(argument, R_UNEVEN);
    }
    return 0;
}

/* Fill a checked load from `n` strips, which were solved with the methods and the pressure limit of head->problem. */
static int fill_load(const Head *head, int64_t n, const wr_result *result, wr_surface_load *l) {
    const Method *rolling = find(1, head->problem.tangential);
    if (n <= 0) return bad(A_memory, R_NO_CONTACT);
    if (rolling == NULL || !rolling->fields) return bad(A_memory, R_NO_FIELDS);
    int64_t made = CALL(load_fill, (double *)head->sizes, (double *)read_numbers(head, head->at_work + head->at_strips), n,
                        head->problem.pressure_limit, (void *)result, l->nx, l->ny, l->x, l->y, l->p, l->qx, l->qy);
    return made ? 0 : bad(A_surface_load, R_COARSE);
}

int wr_contact_surface_load(const void *memory, wr_surface_load *l) {
    TRY(check_memory(memory, CONTACT));
    const Head *head = memory;
    TRY(check_answer(head));
    TRY(check_load(l));
    return fill_load(head, head->n_strips, &head->result, l);
}

int wr_stress(const wr_surface_load *l, int64_t body, double poisson_ratio, int64_t n, const double *x, const double *y,
              const double *z, double *stress) {
    TRY(check_load(l));
    TRY(check_even(l->x, l->nx, A_load_x));
    TRY(check_even(l->y, l->ny, A_load_y));
    TRY(finite_all(l->p, l->nx * l->ny, A_load_p));
    TRY(finite_all(l->qx, l->nx * l->ny, A_load_qx));
    TRY(finite_all(l->qy, l->nx * l->ny, A_load_qy));
    TRY(check_whole(body, A_body));
    TRY(check_number(poisson_ratio, A_poisson));
    TRY(among(n, 0, INT64_MAX / 64, A_n));
    TRY(aligned(x, A_x));
    TRY(aligned(y, A_y));
    TRY(aligned(z, A_z));
    TRY(aligned(stress, A_stress));
    TRY(finite_all(x, n, A_x));
    TRY(finite_all(y, n, A_y));
    for (int64_t i = 0; i < n; i++) TRY(check_number(z[i], A_z));
    double sizes[N_SIZES] = {0}, one[18];
    int wheel = body == WR_BODY_WHEEL;
    sizes[WIDE] = is_wide();
    CALL(stress_at, sizes, l->nx, l->ny, l->x, l->y, l->p, l->qx, l->qy, wheel ? 1.0 : -1.0, poisson_ratio, n, (void *)x,
         (void *)y, (void *)z, one, stress);
    for (int64_t i = 0; wheel && i < n; i++) /* its half space lies on the other side */
        for (int k = 4; k < 6; k++) stress[6 * i + k] = -stress[6 * i + k];
    return 0;
}

int wr_contact_batch(void *memory, int64_t n_separations, const wr_separation *separations, int64_t n,
                     const int64_t *which, const wr_case *cases, wr_result *results, int64_t *failed) {
    TRY(check_memory(memory, CONTACT));
    Head *head = memory;
    TRY(among(n_separations, 1, INT64_MAX / (int64_t)sizeof *separations, A_n_separations));
    TRY(among(n, 0, INT64_MAX / (int64_t)sizeof *cases, A_n));
    TRY(aligned(separations, A_separation));
    TRY(aligned(cases, A_cases));
    TRY(aligned(results, A_results));
    if ((uintptr_t)which % 8) return bad(A_which, R_ALIGNED);
    for (int64_t i = 0; i < n; i++) {
        int64_t of = which != NULL ? which[i] : 0;
        int code = among(of, 0, n_separations - 1, A_which);
        if (!code) code = check_separation(&separations[of], head->patch.n_samples);
        if (!code) code = check_case(&cases[i], &head->patch);
        if (code) {
            if (failed != NULL) *failed = i;
            return code;
        }
        solve_contact(memory, 1, &separations[of], &cases[i], &results[i]);
    }
    return 0;
}

#include "wheelrail_pair.h"
#include "wheelrail_doubts.h"
