/* The ranges of arguments, the checks of numbers, and what codes say. */
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

typedef struct {
    const char *name;
    int kind;
    double low, high;
    size_t at, size; /* of a member: its place in the struct of the caller, and the size with which this begins, or 0 */
    int is_member;
} Argument;

static const Argument ARGUMENT[] = {
    {"", ANY, 0.0, 0.0, 0, 0, 0},
#define X(name, text) {text, ANY, 0.0, 0.0, 0, 0, 0},
    ARGUMENTS(X)
#undef X
#define N(name, text, kind, low, high) {text, kind, low, high, 0, 0, 0},
    NUMBERS(N)
#undef N
#define M(member, kind, low, high, usual, group, text, type, sized, place) \
    {text #member, kind, low, high, offsetof(type, place member), sized ? sizeof(type) : 0, 1},
    MEMBERS(M)
#undef M
};

int wri_check_number(double value, int argument) {
    const Argument *a = &ARGUMENT[argument];
    if (isnan(value) || (isinf(value) && a->kind != LIMIT)) return bad(argument, R_NOT_FINITE);
    return value < a->low || value > a->high || (a->kind == POSITIVE && value == 0.0) ? bad(argument, R_RANGE) : 0;
}

int wri_check_whole(int64_t value, int argument) {
    const Argument *a = &ARGUMENT[argument];
    if (value < (int64_t)a->low || value > (int64_t)a->high) return bad(argument, R_RANGE);
    return a->kind == SIGN && value == 0 ? bad(argument, R_RANGE) : 0;
}

static int is_whole(int argument) { return ARGUMENT[argument].kind >= WHOLE; }

/* Check one member of a struct.  `of` is the struct of the caller. */
static int check_member(const void *of, int argument) {
    const char *at = (const char *)of + ARGUMENT[argument].at;
    if (ARGUMENT[argument].kind == ANY) return 0;
    if (is_whole(argument)) return wri_check_whole(*(const int64_t *)at, argument);
    return wri_check_number(*(const double *)at, argument);
}

int wri_check_members(const void *of, int first, int last) {
    for (int argument = first; argument <= last; argument++) TRY(check_member(of, argument));
    return 0;
}

int wri_finite_all(const double *values, int64_t n, int argument) {
    for (int64_t i = 0; i < n; i++)
        if (!isfinite(values[i])) return bad(argument, R_NOT_FINITE);
    return 0;
}

/* ---------------------------------------------------------------- text */

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

#define WORDS 40

/* Few digits where they are the number, all of them otherwise. */
static void put_number(char text[WORDS], double value) {
    snprintf(text, WORDS, "%.6g", value);
    if (isfinite(value) && strtod(text, NULL) != value) snprintf(text, WORDS, "%.17g", value);
}

static void put_range(char text[3 * WORDS], const Argument *a) {
    char low[WORDS], high[WORDS];
    put_number(low, a->low), put_number(high, a->high);
    snprintf(text, 3 * WORDS, "%s%s, %s%s", a->kind == POSITIVE || isinf(a->low) ? "]" : "[", low, high,
             isinf(a->high) && a->kind != LIMIT ? "[" : "]");
}

/* Whether `of` has the member, and for a range whether this is what was refused.  If not, another struct was given. */
static int has_value(int argument, int reason, const void *of) {
    const Argument *a = &ARGUMENT[argument];
    if (of == NULL || !a->is_member || (a->size && *(const int64_t *)of != (int64_t)a->size)) return 0;
    return (reason != R_RANGE && reason != R_NOT_FINITE) || check_member(of, argument) || a->kind == ANY;
}

static void put_value(char text[WORDS], int argument, const void *of) {
    const char *at = (const char *)of + ARGUMENT[argument].at;
    const int whole = is_whole(argument) || ARGUMENT[argument].kind == ANY; /* those not checked are methods */
    if (whole) snprintf(text, WORDS, "%" PRId64, *(const int64_t *)at);
    else put_number(text, *(const double *)at);
}

int wr_explain(int code, const void *given, char *text, size_t bytes) {
    if (text == NULL) return bad(A_text, R_IS_NULL);
    if ((uintptr_t)given % 8) return bad(A_given, R_ALIGNED);
    const int known = code < 0 && code > -100 * A_end, argument = known ? -code / 100 : A_none, reason = known ? -code % 100 : 0;
    const Argument *a = &ARGUMENT[argument];
    const int of_range = reason == R_RANGE || reason == R_NOT_FINITE, finite = isinf(a->low) && isinf(a->high);
    char value[WORDS + 3] = "", range[3 * WORDS], line[400];
    if (has_value(argument, reason, given)) {
        memcpy(value, " = ", 4);
        put_value(value + 3, argument, given);
    }
    put_range(range, a);
    if (argument == A_none) snprintf(line, sizeof line, "%s", wr_message(code));
    else if (of_range && a->kind == SIGN) snprintf(line, sizeof line, "%s%s is neither 1 nor -1", a->name, value);
    else if (of_range && a->kind != ANY && finite) snprintf(line, sizeof line, "%s%s is not finite", a->name, value);
    else if (of_range && a->kind != ANY)
        snprintf(line, sizeof line, "%s%s is outside its allowed range %s", a->name, value, range);
    else snprintf(line, sizeof line, "%s%s: %s", a->name, value, wr_message(code));
    const size_t length = strlen(line);
    if (bytes == 0) return bad(A_bytes, R_SMALL);
    memcpy(text, line, length < bytes ? length : bytes - 1);
    text[length < bytes ? length : bytes - 1] = '\0';
    return length < bytes ? 0 : bad(A_bytes, R_SMALL);
}
