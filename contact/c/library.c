/* The library itself: its version, its constant arrays and the names of its methods. */
#include <stddef.h>
#include <string.h>

#include "internal.h"

int wr_abi(void) { return WR_ABI; }

#ifndef WR_VERSION
#define WR_VERSION "0"
#endif
const char *wr_version(void) { return WR_VERSION; }

/* The constant arrays of the kernels, by number. Python reads them instead of computing them again. */
WRI_SHARED const char wr_data0[], wr_data1[], wr_data2[], wr_data3[];

WR_API const void *wr_constants(int k) {
    const char *all[] = {wr_data0, wr_data1, wr_data2, wr_data3};
    return k >= 0 && k < 4 ? all[k] : NULL;
}

/* ---------------------------------------------------------------- methods */

#define X(number, name, family, interacting, fields) {number, name, family, interacting, fields},
static const Method NORMAL[N_NORMAL] = {WR_NORMAL_METHODS(X)};
static const Method TANGENTIAL[N_TANGENTIAL] = {WR_TANGENTIAL_METHODS(X)};
#undef X

static const Method *find(const Method *known, int n, int64_t number) {
    for (int i = 0; i < n; i++)
        if (known[i].number == number) return &known[i];
    return NULL;
}

const Method *wri_normal_method(int64_t number) { return find(NORMAL, N_NORMAL, number); }

const Method *wri_tangential_method(int64_t number) { return find(TANGENTIAL, N_TANGENTIAL, number); }

/* 0 normal, 1 tangential, -1 neither */
static int kind_of(const char *kind) {
    if (kind == NULL) return -1;
    return strcmp(kind, "normal") == 0 ? 0 : strcmp(kind, "tangential") == 0 ? 1 : -1;
}

const char *wr_method_name(const char *kind, int number) {
    int of = kind_of(kind);
    const Method *found = of < 0 ? NULL : of ? wri_tangential_method(number) : wri_normal_method(number);
    return found == NULL ? NULL : found->name;
}

int wr_method_number(const char *kind, const char *name) {
    int of = kind_of(kind);
    if (of < 0 || name == NULL) return -1;
    const Method *known = of ? TANGENTIAL : NORMAL;
    const int n = of ? N_TANGENTIAL : N_NORMAL;
    for (int i = 0; i < n; i++)
        if (strcmp(known[i].name, name) == 0) return known[i].number;
    return -1;
}
