/* Memory and refusals of the decoder of Draco meshes. */
#include "input/codecs/draco_mesh.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { FACES_MOST = 1 << 26 };

bool zr_draco_refuse(struct zr_draco *draco, const char *format, ...)
{
    char text[sizeof draco->reason->text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    zr_reason_give(draco->reason, "%s", text);
    return false;
}

uint32_t *zr_draco_numbers(struct zr_draco *draco, size_t count)
{
    return zr_arena_alloc(&draco->scratch, count, sizeof(uint32_t));
}

bool zr_draco_clear(struct zr_draco *draco, uint32_t *numbers, size_t count)
{
    enum { RUN = 1 << 18 };
    for (size_t at = 0; at < count; at += RUN) {
        memset(numbers + at, 0xFF, (count - at < RUN ? count - at : RUN) * sizeof *numbers);
        if (zr_is_cancelled(draco->cancel)) return false;
    }
    return true;
}

uint32_t *zr_draco_nones(struct zr_draco *draco, size_t count)
{
    uint32_t *numbers = zr_draco_numbers(draco, count);
    return numbers && zr_draco_clear(draco, numbers, count) ? numbers : NULL;
}

static bool check_count(struct zr_draco *draco, const char *what, uint64_t count)
{
    return (count <= FACES_MOST && count / ZR_DRACO_PER_BYTE <= draco->size) ||
           zr_draco_refuse(draco, "%llu %s are too many for %zu bytes", (unsigned long long)count, what, draco->size);
}

bool zr_draco_set_faces(struct zr_draco *draco, uint64_t faces)
{
    if (!check_count(draco, "faces", faces)) return false;
    draco->mesh->face_count = (uint32_t)faces;
    draco->points = zr_arena_alloc_beside(draco->arena, &draco->scratch, 3 * (size_t)faces, sizeof *draco->points);
    draco->mesh->corners = draco->points;
    return draco->points;
}

bool zr_draco_set_points(struct zr_draco *draco, uint64_t points)
{
    if (!check_count(draco, "points", points)) return false;
    draco->mesh->point_count = (uint32_t)points;
    return true;
}
