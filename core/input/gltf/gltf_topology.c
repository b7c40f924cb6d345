/* Makes faces, lines and points of the modes of glTF. Source: glTF 2.0, section 3.7.2.1. */
#include "input/gltf/gltf_parts.h"

#include <math.h>
#include <string.h>

/* Returns corner `i`: an index, or vertex `i` if there are no indices. */
static inline uint32_t corner(const uint32_t *corners, uint32_t i)
{
    return corners ? corners[i] : i;
}

static uint32_t *allocate(struct zr_gltf *file, size_t count)
{
    return zr_arena_alloc(file->json.arena, count, sizeof(uint32_t));
}

/* Makes triangles of a strip or a fan. Leaves out those with two equal corners, which join strips. */
static bool make_triangles(struct zr_gltf *file, uint32_t mode, const uint32_t *corners, uint32_t count,
                           struct zr_mesh *mesh)
{
    uint32_t *indices = allocate(file, 3 * ((size_t)count - 2)), *next = indices;
    if (!indices) return false;
    for (uint32_t i = 0; i + 2 < count; i++) {
        const bool is_odd = i % 2 == 1, is_fan = mode == ZR_GLTF_TRIANGLE_FAN;
        const uint32_t a = corner(corners, is_fan ? i + 1 : i), b = corner(corners, i + 1 + (is_fan || is_odd)),
                       c = corner(corners, is_fan ? 0 : i + 2 - is_odd);
        if (a == b || b == c || c == a) continue;
        *next++ = a;
        *next++ = b;
        *next++ = c;
    }
    mesh->indices = indices;
    mesh->face_count = (uint32_t)((next - indices) / 3);
    return true;
}

/* Makes lines from each corner to the next; in a loop, also from the last to the first. */
static bool make_chain(struct zr_gltf *file, bool is_loop, const uint32_t *corners, uint32_t count,
                       struct zr_mesh *mesh)
{
    const uint32_t lines = is_loop ? count : count - 1;
    uint32_t *ends = allocate(file, 2 * (size_t)lines);
    if (!ends) return false;
    for (uint32_t i = 0; i < lines; i++) {
        ends[2 * (size_t)i] = corner(corners, i);
        ends[2 * (size_t)i + 1] = corner(corners, i + 1 < count ? i + 1 : 0);
    }
    mesh->lines = ends;
    mesh->line_count = lines;
    return true;
}

/* Returns all corners as a list. */
static const uint32_t *list(struct zr_gltf *file, const uint32_t *corners, uint32_t count)
{
    if (corners) return corners;
    uint32_t *numbers = allocate(file, count);
    for (uint32_t i = 0; numbers && i < count; i++)
        numbers[i] = i;
    return numbers;
}

bool zr_gltf_make_topology(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    uint32_t *corners = making->corners;
    const uint32_t mode = making->given->mode, count = making->corner_count;
    struct zr_mesh *mesh = making->mesh;
    static const uint32_t least[] = {1, 2, 2, 2, 3, 3, 3}, step[] = {1, 2, 1, 1, 3, 1, 1};
    if (count < least[mode]) {
        zr_gltf_note(&file->empty, making->path);
        return false;
    }
    if (count % step[mode] != 0) zr_gltf_note(&file->left_over, making->path);
    switch (mode) {
    case ZR_GLTF_POINTS:
        mesh->points = list(file, corners, count);
        mesh->point_count = count;
        return mesh->points;
    case ZR_GLTF_LINES:
        mesh->lines = list(file, corners, count);
        mesh->line_count = count / 2;
        return mesh->lines;
    case ZR_GLTF_LINE_LOOP:
    case ZR_GLTF_LINE_STRIP:
        return make_chain(file, mode == ZR_GLTF_LINE_LOOP, corners, count, mesh);
    case ZR_GLTF_TRIANGLES:
        mesh->indices = corners; /* NULL: consecutive vertices */
        mesh->face_count = count / 3;
        return true;
    default:
        return make_triangles(file, mode, corners, count, mesh);
    }
}

/* ---- holes ---- */

/* Keeps the groups of `per` vertices without a hole. Returns their number. */
static uint32_t keep(const zr_vec4 *positions, const uint32_t *from, uint32_t count, uint32_t per)
{
    uint32_t *numbers = (uint32_t *)from, kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *group = from + (size_t)i * per;
        bool has_hole = false;
        for (uint32_t k = 0; k < per; k++)
            has_hole = has_hole || isnan(positions[group[k]].x);
        if (!has_hole) memmove(numbers + (size_t)kept++ * per, group, per * sizeof *numbers);
    }
    return kept;
}

bool zr_gltf_drop_holes(struct zr_gltf *file, const struct zr_gltf_making *making, zr_vec4 *positions)
{
    struct zr_mesh *mesh = making->mesh;
    const uint32_t count = making->range.count;
    uint32_t good = 0;
    if (mesh->face_count > 0) mesh->indices = list(file, (uint32_t *)mesh->indices, 3 * mesh->face_count);
    if (mesh->face_count > 0 && !mesh->indices) return false;
    mesh->face_count = keep(positions, mesh->indices, mesh->face_count, 3);
    mesh->line_count = keep(positions, mesh->lines, mesh->line_count, 2);
    mesh->point_count = keep(positions, mesh->points, mesh->point_count, 1);
    if (mesh->face_count + mesh->line_count + mesh->point_count == 0) {
        zr_gltf_note(&file->empty, making->path);
        return false;
    }
    while (isnan(positions[good].x))
        good++;
    for (uint32_t i = 0; i < count; i++)
        if (isnan(positions[i].x)) positions[i] = positions[good];
    return true;
}
