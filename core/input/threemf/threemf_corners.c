/* Properties of the triangles of 3MF: colours and texture coordinates of their corners. */
#include <string.h>

#include "input/threemf/threemf_file.h"

enum { EXPANDED_AT_ONCE = 1 << 14 };

#define WHITE 0xFFFFFFFFu

/* ---- arrays ---- */

void zr_threemf_corners_grow(struct zr_threemf_corners *corners, uint32_t count, uint32_t room)
{
    struct zr_arena *arena = corners->file->arena;
    corners->room = room;
    if (corners->colors)
        corners->colors = zr_arena_grow(arena, corners->colors, count, room, 3 * sizeof *corners->colors);
    if (corners->textures)
        corners->textures = zr_arena_grow(arena, corners->textures, count, room, sizeof *corners->textures);
    if (corners->paints) corners->paints = zr_arena_grow(arena, corners->paints, count, room, sizeof *corners->paints);
    if (corners->coords)
        corners->coords = zr_arena_grow(arena, corners->coords, count, room, 3 * sizeof *corners->coords);
}

/* Allocates colours at the first triangle with a colour; earlier triangles are white. */
static bool begin_colors(struct zr_threemf_corners *corners, uint32_t count)
{
    if (corners->colors) return true;
    corners->colors = zr_arena_alloc(corners->file->arena, corners->room, 3 * sizeof *corners->colors);
    if (corners->colors) memset(corners->colors, 0xFF, (size_t)count * 3 * sizeof *corners->colors);
    return corners->colors != NULL;
}

/* Allocates textures at the first triangle with one. */
static bool begin_textures(struct zr_threemf_corners *corners, uint32_t count)
{
    struct zr_arena *arena = corners->file->arena;
    if (corners->textures) return corners->coords != NULL;
    corners->textures = zr_arena_alloc(arena, corners->room, sizeof *corners->textures);
    corners->coords = zr_arena_alloc(arena, corners->room, 3 * sizeof *corners->coords);
    if (!zr_arena_ok(arena)) return false;
    memset(corners->textures, 0xFF, count * sizeof *corners->textures);
    memset(corners->coords, 0, (size_t)count * 3 * sizeof *corners->coords);
    return true;
}

/* ---- triangles ---- */

/* Finds the group of a property. NULL after a fault. */
static const struct zr_threemf_resource *find_group(struct zr_threemf_corners *corners, uint32_t triangle, uint32_t pid)
{
    struct zr_threemf *file = corners->file;
    if (corners->last && pid == corners->last_pid) return corners->last;
    const struct zr_threemf_resource *group = zr_threemf_find(file, file->part, pid);
    const bool is_group = group && group->kind != ZR_THREEMF_OBJECT && group->kind != ZR_THREEMF_TEXTURE;
    corners->last_pid = pid;
    corners->last = is_group ? group : NULL;
    if (!is_group)
        zr_threemf_fault(file, file->tag.at, "triangle %u: pid %u names no preceding property group", triangle, pid);
    return corners->last;
}

static bool check_index(struct zr_threemf_corners *corners, uint32_t triangle, const struct zr_threemf_resource *group,
                        uint32_t index)
{
    const bool has_colors = group->kind == ZR_THREEMF_COLORS;
    const uint32_t count = has_colors ? group->color_count : group->value_count;
    return index < count || zr_threemf_fault(corners->file, corners->file->tag.at,
                                             "triangle %u names %s %u of group %u, but there are %u", triangle,
                                             has_colors ? "colour" : "property", index, group->id, count);
}

/* Sets the colours and the texture of a triangle from its values. The first corner decides the texture. */
static void set_values(struct zr_threemf_corners *corners, uint32_t triangle, const struct zr_threemf_resource *group,
                       const uint32_t p[3])
{
    struct zr_threemf *file = corners->file;
    struct zr_threemf_value values[3];
    bool is_white = true;
    for (int i = 0; i < 3; i++) {
        const uint32_t index = p[i] == ZR_THREEMF_NONE || group->is_base ? p[0] : p[i];
        if (!check_index(corners, triangle, group, index)) return;
        values[i] = group->values[index];
        is_white = is_white && values[i].color == WHITE;
    }
    const uint32_t texture = values[0].texture;
    if (texture != ZR_THREEMF_NONE && !begin_textures(corners, triangle)) return;
    if ((!is_white || (texture == ZR_THREEMF_NONE && !corners->textures)) && !begin_colors(corners, triangle)) return;
    for (int i = 0; i < 3; i++) {
        if (corners->textures) {
            float *at = corners->coords[3 * (size_t)triangle + (size_t)i];
            at[0] = values[i].u;
            at[1] = values[i].v;
        }
        if (corners->colors) corners->colors[3 * (size_t)triangle + (size_t)i] = values[i].color;
        corners->has_clear[1] |= values[i].color >> 24 == 0;
        corners->has_solid[1] |= values[i].color >> 24 != 0;
        corners->has_gradients |= values[i].color != values[0].color;
    }
    if (corners->textures) corners->textures[triangle] = texture;
    corners->given++;
    if (texture != ZR_THREEMF_NONE && group->is_outside && zr_threemf_resources(file)[texture].ends)
        zr_threemf_note(file, ZR_THREEMF_NOTE_TILES, file->tag.at, file->tag.name);
}

static void set_colors(struct zr_threemf_corners *corners, uint32_t triangle, const struct zr_threemf_resource *group,
                       const uint32_t p[3])
{
    if (!begin_colors(corners, triangle)) return;
    uint32_t *colors = corners->colors + (size_t)triangle * 3;
    for (int i = 0; i < 3; i++) {
        const uint32_t index = p[i] == ZR_THREEMF_NONE || group->is_base ? p[0] : p[i];
        if (!check_index(corners, triangle, group, index)) return;
        colors[i] = group->colors[index];
        corners->has_clear[!group->is_base] |= colors[i] >> 24 == 0;
        corners->has_solid[!group->is_base] |= colors[i] >> 24 != 0;
    }
    corners->has_gradients |= colors[0] != colors[1] || colors[0] != colors[2];
    corners->given++;
}

void zr_threemf_corners_set(struct zr_threemf_corners *corners, uint32_t triangle, uint32_t pid, const uint32_t p[3])
{
    const struct zr_threemf_resource *group = pid == ZR_THREEMF_NONE ? NULL : find_group(corners, triangle, pid);
    const size_t first = (size_t)triangle * 3;
    if (corners->textures && (!group || group->kind == ZR_THREEMF_COLORS)) {
        corners->textures[triangle] = ZR_THREEMF_NONE;
        memset(corners->coords + first, 0, 3 * sizeof *corners->coords);
    }
    if (!group) {
        if (corners->colors) memset(corners->colors + first, 0xFF, 3 * sizeof *corners->colors);
        return;
    }
    if (group->kind == ZR_THREEMF_COLORS)
        set_colors(corners, triangle, group, p);
    else
        set_values(corners, triangle, group, p);
}

/* ---- the mesh ---- */

/* Sets one colour per face. */
static void color_faces(const struct zr_threemf_corners *corners, struct zr_mesh *mesh)
{
    zr_vec4 *colors = zr_arena_alloc(corners->file->arena, mesh->face_count, sizeof *colors);
    for (size_t i = 0; colors && i < mesh->face_count; i++) {
        if (i % EXPANDED_AT_ONCE == 0 && zr_is_cancelled(corners->file->cancel)) return;
        colors[i] = zr_threemf_color_of(corners->colors[3 * i]);
    }
    mesh->face_colors = colors;
}

/* Makes one position per corner, with its colour and its texture coordinates. */
static void expand(const struct zr_threemf_corners *corners, struct zr_mesh *mesh)
{
    struct zr_arena *arena = corners->file->arena;
    const size_t count = (size_t)mesh->face_count * 3;
    if (count > ZR_THREEMF_NONE / 2) {
        zr_arena_charge(arena, SIZE_MAX); /* fails */
        return;
    }
    zr_vec4 *positions = zr_arena_alloc(arena, count, sizeof *positions);
    zr_vec4 *colors = corners->colors ? zr_arena_alloc(arena, count, sizeof *colors) : NULL;
    zr_vec4 *texcoords = corners->textures ? zr_arena_alloc(arena, count, sizeof *texcoords) : NULL;
    if (!zr_arena_ok(arena)) return;
    for (size_t i = 0; i < count; i++) {
        if (i % EXPANDED_AT_ONCE == 0 && zr_is_cancelled(corners->file->cancel)) return;
        positions[i] = mesh->positions[mesh->indices[i]];
        if (colors) colors[i] = zr_threemf_color_of(corners->colors[i]);
        if (texcoords) texcoords[i] = (zr_vec4){corners->coords[i][0], corners->coords[i][1], 0, 0};
    }
    mesh->colors = colors;
    mesh->texcoords = texcoords;
    mesh->positions = positions;
    mesh->position_count = (uint32_t)count;
    mesh->indices = NULL;
}

/* Makes colours opaque if all base materials of the mesh, or all its other colours, have alpha 0, as slicers write
 * them. */
static void show_clear(struct zr_threemf_corners *corners, uint32_t triangles)
{
    const size_t count = (size_t)triangles * 3;
    for (int k = 0; k < 2; k++)
        if (corners->has_clear[k] && corners->has_solid[k]) return;
    if (!corners->colors || !(corners->has_clear[0] || corners->has_clear[1])) return;
    for (size_t i = 0; i < count; i++) {
        if (i % EXPANDED_AT_ONCE == 0 && zr_is_cancelled(corners->file->cancel)) return;
        if (corners->colors[i] >> 24 == 0) corners->colors[i] |= 0xFF000000u;
    }
    zr_threemf_note(corners->file, ZR_THREEMF_NOTE_CLEAR, corners->file->xml.at, corners->file->tag.name);
}

bool zr_threemf_corners_finish(struct zr_threemf_corners *corners, struct zr_mesh *mesh)
{
    struct zr_threemf *file = corners->file;
    uint32_t **textures = zr_threemf_list_add(file->arena, &file->textures, sizeof *textures);
    if (!textures) return false;
    *textures = corners->textures;
    show_clear(corners, mesh->face_count);
    if (!zr_threemf_paint_mesh(corners, mesh)) return false;
    if (corners->textures || (corners->colors && corners->has_gradients))
        expand(corners, mesh);
    else if (corners->colors && corners->given > 0)
        color_faces(corners, mesh);
    if (corners->colors && corners->given > 0 && corners->given < mesh->face_count)
        zr_threemf_note(file, ZR_THREEMF_NOTE_PLAIN, file->xml.at, file->tag.name);
    return true;
}
