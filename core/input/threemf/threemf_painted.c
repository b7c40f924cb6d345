/* Colours of slicers on meshes of 3MF: by paint, and by the extruders of parts. */
#include <string.h>

#include "input/threemf/threemf_file.h"

enum { TRIANGLES_AT_ONCE = 1 << 12 };

/* ---- triangles ---- */

static bool begin_paints(struct zr_threemf_corners *corners, uint32_t count)
{
    if (corners->paints) return true;
    corners->paints = zr_arena_alloc(corners->file->arena, corners->room, sizeof *corners->paints);
    if (corners->paints) memset(corners->paints, 0, count * sizeof *corners->paints);
    return corners->paints != NULL;
}

/* Returns the slicer's setting of a triangle, or NULL. Triangles ascend. The numbers of settings are those of the file. */
static const struct zr_threemf_setting *find_volume(struct zr_threemf_corners *corners, uint32_t triangle)
{
    triangle += corners->dropped;
    while (corners->volume < corners->volume_count && corners->volumes[corners->volume].last < triangle)
        corners->volume++;
    const struct zr_threemf_setting *at = corners->volumes + corners->volume;
    return corners->volume < corners->volume_count && at->first <= triangle && at->first <= at->last ? at : NULL;
}

void zr_threemf_corners_paint(struct zr_threemf_corners *corners, uint32_t triangle, struct zr_xml_text paint)
{
    const struct zr_threemf_setting *volume = corners->volume_count > 0 ? find_volume(corners, triangle) : NULL;
    const bool is_painted = paint.length > 0 && corners->file->filament_count > 0;
    struct zr_threemf_paint of = {.at = paint.at, .length = is_painted ? (uint32_t)paint.length : 0};
    if (volume) {
        of.extruder = volume->extruder < UINT8_MAX ? (uint8_t)volume->extruder : 0;
        of.is_left_out = volume->is_left_out;
    }
    if (!corners->paints && of.length == 0 && of.extruder == 0 && !of.is_left_out) return;
    if (!begin_paints(corners, triangle)) return;
    corners->paints[triangle] = of;
    if (of.is_left_out)
        zr_threemf_note(corners->file, ZR_THREEMF_NOTE_MODIFIER, corners->file->tag.at, corners->file->tag.name);
}

/* ---- meshes ---- */

static void find_corners(const struct zr_mesh *mesh, uint32_t triangle, zr_vec4 corners[3])
{
    for (size_t i = 0; i < 3; i++)
        corners[i] = mesh->positions[mesh->indices[3 * (size_t)triangle + i]];
}

/* Counts the pieces of all triangles. Removes invalid paint. */
static uint64_t count_pieces(struct zr_threemf_corners *corners, const struct zr_mesh *mesh)
{
    uint64_t sum = 0;
    zr_vec4 at[3] = {{0}};
    for (uint32_t i = 0; i < mesh->face_count; i++) {
        struct zr_threemf_paint *paint = &corners->paints[i];
        if (i % TRIANGLES_AT_ONCE == 0 && zr_is_cancelled(corners->file->cancel)) return 0;
        if (paint->is_left_out) continue;
        const uint32_t pieces =
            paint->length ? zr_threemf_paint_read((struct zr_xml_text){paint->at, paint->length}, at, NULL, NULL) : 0;
        if (pieces == 0 && paint->length > 0)
            zr_threemf_note(corners->file, ZR_THREEMF_NOTE_PAINT, paint->at, (struct zr_xml_text){"", 0});
        if (pieces == 0) paint->length = 0;
        sum += pieces ? pieces : 1;
    }
    return sum;
}

static uint32_t put_pieces(const struct zr_threemf_corners *corners, const struct zr_mesh *mesh, zr_vec4 *positions,
                           uint8_t *extruders)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->face_count; i++) {
        const struct zr_threemf_paint *paint = &corners->paints[i];
        zr_vec4 at[3];
        if (i % TRIANGLES_AT_ONCE == 0 && zr_is_cancelled(corners->file->cancel)) return count;
        if (paint->is_left_out) continue;
        find_corners(mesh, i, at);
        if (paint->length == 0) {
            memcpy(positions + 3 * (size_t)count, at, sizeof at);
            extruders[count++] = paint->extruder;
            continue;
        }
        const uint32_t first = count;
        count += zr_threemf_paint_read((struct zr_xml_text){paint->at, paint->length}, at,
                                       positions + 3 * (size_t)first, extruders + first);
        for (uint32_t k = first; k < count; k++)
            if (extruders[k] == 0) extruders[k] = paint->extruder;
    }
    return count;
}

bool zr_threemf_paint_mesh(struct zr_threemf_corners *corners, struct zr_mesh *mesh)
{
    struct zr_arena *arena = corners->file->arena;
    uint8_t **entry = zr_threemf_list_add(arena, &corners->file->extruders, sizeof *entry);
    if (!entry) return false;
    *entry = NULL;
    if (!corners->paints || corners->colors || corners->textures) return true;
    const uint64_t pieces = count_pieces(corners, mesh);
    if (3 * pieces > ZR_THREEMF_NONE / 2) {
        zr_arena_charge(arena, SIZE_MAX); /* fails */
        return false;
    }
    zr_vec4 *positions = zr_arena_alloc(arena, (size_t)pieces, 3 * sizeof *positions);
    uint8_t *extruders = zr_arena_alloc(arena, (size_t)pieces, sizeof *extruders);
    if (!zr_arena_ok(arena)) return false;
    mesh->face_count = pieces == 0 ? 0 : put_pieces(corners, mesh, positions, extruders);
    mesh->positions = positions;
    mesh->position_count = 3 * mesh->face_count;
    mesh->indices = NULL;
    *entry = extruders;
    return true;
}

static zr_vec4 color_of(const struct zr_threemf *file, uint32_t extruder)
{
    return zr_threemf_color_of(file->filaments[extruder > 0 && extruder <= file->filament_count ? extruder - 1 : 0]);
}

void zr_threemf_color_by_extruders(struct zr_threemf *file, struct zr_mesh *mesh, const uint8_t *extruders,
                                   const struct zr_threemf_resource *object)
{
    uint32_t most = 0;
    if (file->filament_count == 0 || mesh->colors || mesh->face_colors || mesh->texcoords) return;
    zr_vec4 *colors = zr_arena_alloc(file->arena, mesh->face_count, sizeof *colors);
    for (uint32_t i = 0; colors && i < mesh->face_count; i++) {
        const uint32_t extruder = extruders && extruders[i] ? extruders[i] : object->extruder;
        if (i % TRIANGLES_AT_ONCE == 0 && zr_is_cancelled(file->cancel)) return;
        if (extruder > most) most = extruder;
        colors[i] = color_of(file, extruder);
    }
    file->part = object->part;
    if (most > file->filament_count)
        zr_threemf_note(file, ZR_THREEMF_NOTE_EXTRUDER, object->at, (struct zr_xml_text){"", 0});
    mesh->face_colors = colors;
}
