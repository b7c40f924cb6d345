#include <math.h>
#include <string.h>

#include "input/obj/obj_file.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 14 };

static bool looks_cancelled(const struct zr_obj_file *file, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel);
}

static bool has_hole(const struct zr_obj_file *file, const uint32_t *indices, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (isnan(file->positions[indices[i]].x)) return true;
    return false;
}

/* Moves corners of a per-corner array to the front; the array may be NULL. */
static void move(uint32_t *array, size_t to, size_t from, size_t count)
{
    if (array) memmove(array + to, array + from, count * sizeof *array);
}

/* Leaves out faces. Names that apply from a face on then apply from the next one that is kept. */
static uint32_t drop_faces(struct zr_obj_file *file, uint32_t faces)
{
    uint32_t kept = 0, corners = 0;
    size_t name = 0;
    for (uint32_t i = 0; i < faces && !looks_cancelled(file, i); i++) {
        const uint32_t first = file->face_offsets[i], count = file->face_offsets[i + 1] - first;
        for (; name < file->total.names && file->names[name].face <= i; name++)
            file->names[name].face = kept;
        if (has_hole(file, file->indices + first, count)) continue;
        move(file->indices, corners, first, count);
        move(file->normal_indices, corners, first, count);
        move(file->texcoord_indices, corners, first, count);
        if (file->groups) file->groups[kept] = file->groups[i];
        file->face_offsets[kept++] = corners;
        corners += count;
    }
    for (; name < file->total.names; name++)
        file->names[name].face = kept;
    file->face_offsets[kept] = corners;
    return kept;
}

/* Leaves out lines (`per` is 2) or points (1). Returns the number of those that are kept. */
static uint32_t drop_items(const struct zr_obj_file *file, uint32_t *list, uint32_t count, uint32_t per)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count && !looks_cancelled(file, i); i++)
        if (!has_hole(file, list + (size_t)i * per, per)) move(list, (size_t)kept++ * per, (size_t)i * per, per);
    return kept;
}

/* Places holes, which nothing uses, at a vertex that is finite: they would enlarge bounds. */
static void fill_holes(struct zr_obj_file *file)
{
    const size_t count = file->total.positions;
    size_t good = 0;
    while (good < count && isnan(file->positions[good].x))
        good++;
    for (size_t i = 0; i < count && !looks_cancelled(file, i); i++)
        if (isnan(file->positions[i].x))
            file->positions[i] = good < count ? file->positions[good] : (zr_vec4){0, 0, 0, 1};
}

void zr_obj_drop_holes(struct zr_obj_file *file, struct zr_mesh *mesh)
{
    mesh->face_count = drop_faces(file, mesh->face_count);
    mesh->line_count = drop_items(file, file->lines, mesh->line_count, 2);
    mesh->point_count = drop_items(file, file->points, mesh->point_count, 1);
    fill_holes(file);
}
