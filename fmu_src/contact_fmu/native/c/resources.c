/* Files that an instance reads when it is made: profiles and tracks, written by fmu_src/contact_fmu/resources.py. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"
#include "location.h"

/* Append the content of a file to the instance's resources, which hold `size` numbers. Return the new size, or 0 if the file is
 * not a valid resource. */
static size_t append(Instance *instance, FILE *file, const Resource *resource, size_t size)
{
    struct {
        char magic[8];
        uint64_t checksum; /* of all bytes after it */
        int64_t n;
    } head;
    size_t length;
    double *grown, *points;
    uint64_t checksum;
    if (fread(&head, 1, sizeof head, file) != sizeof head || memcmp(head.magic, resource->magic, 8)) return 0;
    if (head.n < 4 || head.n > resource->most) return 0;
    length = 1 + (size_t)resource->rows * (size_t)head.n;
    grown = realloc(instance->resources, (size + length) * sizeof(double));
    if (!grown) return 0;
    instance->resources = grown;
    points = grown + size;
    memcpy(points, &head.n, sizeof head.n); /* the bytes of the file, for the checksum */
    if (fread(points + 1, sizeof(double), length - 1, file) != length - 1) return 0;
    checksum = hash(points, length * sizeof(double));
    if (checksum != head.checksum) return 0;
    for (size_t i = 1; i < length; i++)
        if (!isfinite(points[i])) return 0;
    points[0] = (double)head.n;
    instance->resources_hash = 31 * instance->resources_hash + checksum;
    return size + length;
}

/* Open a file of the folder with the resources. If it cannot be opened, log a message and return NULL. */
FILE *open_resource(const Instance *instance, const char *folder, const char *name)
{
    size_t room = (folder ? strlen(folder) : 0) + strlen(name) + 2;
    char *path = malloc(room);
    FILE *file = NULL;
    if (path && folder) {
        snprintf(path, room, "%s/%s", folder, name);
        file = open_to_read(path);
    }
    free(path);
    if (!file)
        report(instance, LOG_ERROR, "resource %s cannot be read from %s", name,
               folder ? folder : "no folder: the resource location is NULL");
    return file;
}

/* Read all files of the model. If one cannot be read, log a message and return false. */
bool load_resources(Instance *instance, const char *folder)
{
    size_t size = 0;
    for (size_t i = 0; i < N(resources); i++) {
        const Resource *resource = &instance->table.resources[i];
        FILE *file = open_resource(instance, folder, TEXT(resource->name));
        if (!file) return false;
        size = append(instance, file, resource, size);
        fclose(file);
        if (size == 0) {
            report(instance, LOG_ERROR, "resource %s is not valid: it is damaged, of another kind or not made by contact_fmu.resources",
                   TEXT(resource->name));
            return false;
        }
    }
    return true;
}
