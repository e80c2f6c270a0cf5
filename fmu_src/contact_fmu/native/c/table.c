/* resources/model.bin: the table of the model, written by fmu_src/contact_fmu/native/table.py. Every place and size in it is checked. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"
#include "wheelrail_records.h" /* asserts that this compiler lays out records as the kernels do */

static const char file_name[] = "model.bin";
enum { LARGEST = 1 << 28, MOST_DERIVED = 1000 }; /* bytes of a file; rows or columns of its derivatives */

/* Read the file into one block. Return it without the first 16 bytes, or log a message and return NULL. */
static double *read_all(const Instance *instance, FILE *file)
{
    struct {
        char magic[8];
        uint64_t checksum, bytes;
    } begin;
    double *block;
    if (fread(&begin, 1, sizeof begin, file) != sizeof begin || memcmp(begin.magic, "WRMODEL1", 8)) {
        report(instance, LOG_ERROR, "resource %s is not valid: it does not begin with WRMODEL1", file_name);
        return NULL;
    }
    if (begin.bytes < sizeof(Head) || begin.bytes > LARGEST || begin.bytes % 8) {
        report(instance, LOG_ERROR, "resource %s is not valid: byte 16 says that it has %llu bytes", file_name,
               (unsigned long long)begin.bytes);
        return NULL;
    }
    block = malloc((size_t)begin.bytes);
    if (!block) {
        report(instance, LOG_ERROR, "out of memory");
        return NULL;
    }
    memcpy(block, &begin.bytes, sizeof begin.bytes);
    if (fread(block + 1, 1, (size_t)begin.bytes - 8, file) == begin.bytes - 8 &&
        hash(block, (size_t)begin.bytes) == begin.checksum)
        return block;
    free(block);
    report(instance, LOG_ERROR, "resource %s is not valid: it is cut off, or its checksum differs", file_name);
    return NULL;
}

/* Point to the parts of the block. Return whether they fill it. */
static bool lay(Table *t)
{
    const Head *h = (const Head *)t->block;
    const char *at = (const char *)t->block + sizeof *h;
    const uint64_t counts[] = {h->n_values, h->n_accumulated, h->n_fields, h->n_messages, h->n_totals,
                               h->n_choices, h->n_mirrors, h->n_resources, h->n_derived, h->n_derived_by, h->n_doubts,
                               h->n_own, h->n_text};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (counts[i] > LARGEST / 8) return false; /* the sums below do not overflow */
    t->head = h;
#define PART(member, n) (t->member = (const void *)at, at += (n) * sizeof *t->member)
    PART(variables, h->n_values + h->n_accumulated + h->n_fields + 1);
    PART(messages, h->n_messages + 1);
    PART(totals, h->n_totals);
    PART(choices, h->n_choices);
    PART(mirrors, h->n_mirrors);
    PART(resources, h->n_resources);
    PART(derived, h->n_derived);
    PART(derived_by, h->n_derived_by);
    PART(doubts, h->n_doubts);
    PART(own, h->n_own);
    PART(text, h->n_text);
    return at == (const char *)t->block + h->bytes;
}

/* Return the name of a part that says something impossible, or NULL. All places are below the sizes, and texts end. */
static const char *fault(const Table *t)
{
    const Head *h = t->head;
    const uint64_t n = h->n_values, every = n + h->n_accumulated + h->n_fields + 1;
#define IS_TEXT(place) ((place) < h->n_text)
#define IS_VALUE(place) ((uint64_t)(place) < n)
#define IS_VALUE_OR_NONE(place) ((place) == NONE || IS_VALUE(place))
    if (!h->n_text || t->text[h->n_text - 1]) return "texts";
    if (!IS_TEXT(h->guid) || !IS_TEXT(h->name) || !IS_TEXT(h->kind)) return "the head";
    if (!n || h->n_parameters > n || every > UINT32_MAX) return "the sizes";
    if (h->accumulates != NONE && !IS_VALUE(h->accumulates)) return "what accumulates";
    if (h->field_factor < 0 || h->field_factor > 1000) return "the fields";
    for (int k = 0; k < 2; k++)
        if (h->field_by[k] != NONE &&
            !(IS_VALUE(h->field_by[k]) && t->variables[h->field_by[k]].kind == COUNT)) return "the fields";
    for (uint64_t i = 0; i < every; i++) {
        const Variable *v = &t->variables[i];
        const uint64_t end = i < n ? n : n + h->n_accumulated; /* arrays lie within their part */
        bool is_field = i >= n + h->n_accumulated && i < every - 1;
        if (!IS_TEXT(v->name) || v->kind < REAL || v->kind > COUNT || isnan(v->minimum) || isnan(v->maximum)) return "variables";
        if ((v->role == FIELD) != is_field || (v->role == TIME) != (i == every - 1)) return "variables";
        if ((v->role == ACCUMULATED) != (i >= n && !is_field && i < every - 1)) return "variables";
        if (i < end && v->size > end - i) return "variables";
        if (i < n && !isfinite(v->start)) return "variables";
        for (int k = 0; k < MOST_USES; k++)
            if (v->used[k].items && !(IS_VALUE(v->used[k].enumeration) && t->variables[v->used[k].enumeration].maximum < 32 &&
                                      t->variables[v->used[k].enumeration].minimum >= 0)) return "variables";
    }
    for (uint64_t i = 0; i <= h->n_messages; i++)
        if (!IS_TEXT(t->messages[i].text) || t->messages[i].category < 0 || t->messages[i].category > LOG_DISCARD ||
            t->messages[i].category == 3 || !IS_VALUE_OR_NONE(t->messages[i].value)) return "messages";
    for (uint64_t i = 0; i < h->n_totals; i++)
        if (!IS_VALUE(t->totals[i].total) || !IS_VALUE_OR_NONE(t->totals[i].rate) || !IS_VALUE_OR_NONE(t->totals[i].speed))
            return "totals";
    for (uint64_t i = 0; i < h->n_choices; i++)
        if (!IS_VALUE(t->choices[i].twin) || !IS_VALUE(t->choices[i].of)) return "choices";
    for (uint64_t i = 0; i < h->n_mirrors; i++)
        if (!IS_VALUE(t->mirrors[i].twin) || !IS_VALUE(t->mirrors[i].of)) return "mirrors";
    for (uint64_t i = 0; i < h->n_resources; i++)
        if (!IS_TEXT(t->resources[i].name) || t->resources[i].rows < 1 || t->resources[i].rows > 1000 ||
            t->resources[i].most < 4 || t->resources[i].most > LARGEST) return "resources";
    if (h->n_derived > MOST_DERIVED || h->n_derived_by > MOST_DERIVED) return "derivatives";
    for (uint64_t i = 0; i < h->n_derived; i++)
        if (!IS_VALUE(t->derived[i])) return "derivatives";
    for (uint64_t i = 0; i < h->n_derived_by; i++)
        if (!IS_VALUE(t->derived_by[i])) return "derivatives";
    if (h->n_doubts > MOST_DOUBTS) return "doubts";
    for (uint64_t i = 0; i < h->n_doubts; i++) {
        const Doubt *d = &t->doubts[i];
        if (!IS_VALUE(d->value) || d->n < 1 || (uint64_t)d->n > n - (uint64_t)d->value || !IS_TEXT(d->text)) return "doubts";
        if (d->other != NONE && !(IS_VALUE(d->other) && IS_VALUE(d->factor))) return "doubts";
    }
    return NULL;
}

static bool damaged(const Instance *instance, const char *part)
{
    report(instance, LOG_ERROR, "resource %s is not valid: %s do not fit", file_name, part);
    return false;
}

/* Read the table, find its kernels and allocate the arrays that it sizes. If this fails, log a message and return false. */
bool load_table(Instance *instance, const char *folder)
{
    Table *t = &instance->table;
    FILE *file = open_resource(instance, folder, file_name);
    const char *wrong;
    size_t n;
    if (!file) return false;
    t->block = read_all(instance, file);
    fclose(file);
    if (!t->block) return false;
    if (!lay(t)) return damaged(instance, "the sizes of its parts");
    wrong = fault(t);
    if (wrong) return damaged(instance, wrong);
    instance->kernels = kernels_of(TEXT(t->head->kind));
    if (!instance->kernels) {
        report(instance, LOG_ERROR, "resource %s: this binary has no kernels of %.60s", file_name, TEXT(t->head->kind));
        return false;
    }
    n = (size_t)N(values);
    instance->starts = N(fields) > 0 ? 2 : 1;
    for (size_t i = 0; i < n; i++)
        if (t->variables[i].lazy) instance->starts = 2;
    instance->values = calloc(7 * n + N(totals) + N(accumulated) + 1 + N(derived) * N(derived_by), sizeof(double));
    if (!instance->values) {
        report(instance, LOG_ERROR, "out of memory");
        return false;
    }
    instance->solved = instance->values + n;
    instance->accepted = instance->solved + n;
    instance->prepared = instance->accepted + N(totals);
    instance->before = instance->prepared + n;
    instance->other = instance->before + n;
    instance->rest = instance->other + n;
    instance->slopes_at = instance->rest + n;
    instance->slopes = instance->slopes_at + n;
    instance->nothing = instance->slopes + N(derived) * N(derived_by);
    return true;
}

size_t kept_numbers(const Instance *instance) { return (size_t)(2 * N(values) + N(totals)); }

/* Return the number of elements of a field. */
size_t field_size(const Instance *instance, const double *values)
{
    size_t size = (size_t)instance->table.head->field_factor;
    for (int k = 0; k < 2; k++)
        if (instance->table.head->field_by[k] != NONE) size *= (size_t)values[instance->table.head->field_by[k]];
    return size;
}
