/* The caller's memory: its head, what of it is checked, and the fields that are copied out of it. */
#include <string.h>

#include "internal.h"

#define MAGIC 0x7765656c7261696cu

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

int wri_check_memory(const void *memory, int64_t kind) {
    const Head *head = memory;
    TRY(aligned(memory, A_memory));
    if (head->magic != MAGIC || head->abi != WR_ABI || head->kind != kind || head->sum != sum_of(head))
        return bad(A_memory, R_NO_SOLVER);
    return 0;
}

int wri_check_answer(const Head *head) {
    if (head->answered != 1) return bad(A_memory, R_NO_ANSWER);
    int64_t most = WR_MAX_PATCHES * head->patch.n_strips;
    int sane = head->n_strips >= 0 && head->n_strips <= most && head->n_patches >= 0 && head->n_patches <= WR_MAX_PATCHES;
    return sane ? 0 : bad(A_memory, R_NO_SOLVER);
}

void wri_set_sizes(double sizes[N_SIZES], const wr_contact_options *o) {
    memset(sizes, 0, N_SIZES * sizeof *sizes);
    sizes[WIDE] = is_wide();
    sizes[0] = wri_normal_method(o->normal)->interacting;
    sizes[1] = (double)o->n_strips;
    sizes[2] = (double)o->n_elements;
    sizes[3] = (double)o->n_samples;
}

int wri_room(const void *memory, size_t bytes, size_t needed) {
    TRY(aligned(memory, A_memory));
    return bytes < needed ? bad(A_bytes, R_SMALL) : 0;
}

/* Empty the memory and begin its head.  The options may lie in the memory. */
Head *wri_begin(const wr_contact_options *patch, int64_t kind, void *memory, size_t needed) {
    const wr_contact_options kept = *patch;
    Head *head = memory;
    memset(memory, 0, needed);
    head->abi = WR_ABI, head->kind = kind, head->bytes = (int64_t)needed;
    head->patch = kept, head->at_work = head_numbers();
    wri_set_sizes(head->sizes, &kept);
    return head;
}

/* From here on the memory holds a solver. */
void wri_finish(Head *head) {
    head->magic = MAGIC;
    head->sum = sum_of(head);
}

int wri_copy_fields(const Head *head, const double *strips, int64_t n, wr_fields *f) {
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
