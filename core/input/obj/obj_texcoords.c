/* Texture coordinates. OBJ has one index per corner; a mesh of a scene has one texture coordinate per position. A
 * position with several texture coordinates is copied. */
#include <string.h>

#include "base/cancel.h"
#include "input/obj/mtl.h"
#include "input/obj/obj_file.h"

enum {
    COPIES_MAX = 64, /* compared copies per position; further corners make one copy each */
    FACES_PER_CANCEL_CHECK = 1 << 14
};

struct placing {
    struct zr_obj_file *file;
    const struct zr_parsed_material *all;
    const uint32_t *materials; /* per face, or NULL */
    uint32_t material, positions, most;
    uint32_t *texcoord; /* per position: an index, or NONE: not known yet */
    uint32_t *next;     /* per position: its next copy, or 0 */
    uint32_t *from;     /* per copy: the position that it repeats */
};

#define NONE UINT32_MAX /* no texture coordinate yet */

static bool is_textured(const struct placing *placing, uint32_t face)
{
    const uint32_t material = placing->materials ? placing->materials[face] : placing->material;
    if (material == ZR_MODEL_MATERIAL_NONE) return false;
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        if (placing->all[material].textures[slot].number > 0) return true;
    return false;
}

/* Returns the copy of a position with this texture coordinate. */
static uint32_t find_copy(struct placing *placing, uint32_t position, uint32_t texcoord)
{
    uint32_t at = position;
    if (placing->texcoord[at] == NONE) placing->texcoord[at] = texcoord;
    for (int i = 0; placing->texcoord[at] != texcoord && placing->next[at] != 0 && i < COPIES_MAX; i++)
        at = placing->next[at];
    if (placing->texcoord[at] == texcoord) return at;
    const uint32_t copy = placing->positions++;
    placing->texcoord[copy] = texcoord;
    placing->from[copy - placing->file->total.positions] = position;
    placing->next[copy] = placing->next[position];
    placing->next[position] = copy;
    return copy;
}

static bool place_corners(struct placing *placing)
{
    struct zr_obj_file *file = placing->file;
    for (uint32_t face = 0; face < file->total.faces; face++) {
        bool is_missing = false;
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel)) return false;
        if (!is_textured(placing, face)) continue;
        for (uint32_t slot = file->face_offsets[face]; slot < file->face_offsets[face + 1]; slot++) {
            const uint32_t texcoord = file->texcoord_indices ? file->texcoord_indices[slot] : ZR_OBJ_NO_TEXCOORD;
            is_missing = is_missing || texcoord == ZR_OBJ_NO_TEXCOORD;
            file->indices[slot] =
                find_copy(placing, file->indices[slot],
                          texcoord == ZR_OBJ_NO_TEXCOORD ? (uint32_t)file->total.texcoords : texcoord);
        }
        file->untextured.count += is_missing;
    }
    return true;
}

/* Returns a new array: the `count` vectors, then the vectors of the copies. `old` may be NULL. */
static zr_vec4 *repeat(const struct placing *placing, struct zr_arena *arena, const zr_vec4 *old)
{
    const size_t count = placing->file->total.positions;
    if (!old || placing->positions == count) return (zr_vec4 *)old;
    zr_vec4 *out = zr_arena_alloc(arena, placing->positions, sizeof *out);
    if (!out) return NULL;
    memcpy(out, old, count * sizeof *out);
    for (size_t i = count; i < placing->positions; i++)
        out[i] = old[placing->from[i - count]];
    return out;
}

static bool put(const struct placing *placing, struct zr_arena *arena, struct zr_mesh *mesh)
{
    const struct zr_obj_file *file = placing->file;
    zr_vec4 *texcoords = zr_arena_alloc(arena, placing->positions, sizeof *texcoords);
    if (!texcoords) return false;
    for (uint32_t i = 0; i < placing->positions; i++)
        texcoords[i] = placing->texcoord[i] < file->total.texcoords && file->texcoords
                           ? file->texcoords[placing->texcoord[i]]
                           : (zr_vec4){0, 1, 0, 0};
    mesh->positions = repeat(placing, arena, file->positions);
    mesh->colors = repeat(placing, arena, file->colors);
    mesh->texcoords = texcoords;
    mesh->position_count = placing->positions;
    return zr_arena_ok(arena);
}

/* Counts the corners of faces with a texture, which bound the number of copies. */
static size_t count_corners(const struct placing *placing)
{
    const struct zr_obj_file *file = placing->file;
    size_t count = 0;
    for (uint32_t face = 0; face < file->total.faces; face++)
        if (is_textured(placing, face)) count += file->face_offsets[face + 1] - file->face_offsets[face];
    return count;
}

enum zr_status zr_obj_put_texcoords(struct zr_obj_file *file, struct zr_arena *arena, struct zr_mesh *mesh,
                                    const uint32_t *materials, uint32_t material)
{
    struct placing placing = {.file = file,
                              .all = zr_mtl_made(file->mtl)->materials,
                              .materials = materials,
                              .material = material,
                              .positions = (uint32_t)file->total.positions};
    const size_t most = count_corners(&placing), all = file->total.positions + most;
    if (most == 0) return ZR_OK;
    placing.texcoord = zr_arena_alloc(arena, all, sizeof *placing.texcoord);
    placing.next = zr_arena_zero(arena, all, sizeof *placing.next);
    placing.from = zr_arena_alloc(arena, most, sizeof *placing.from);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    memset(placing.texcoord, 0xFF, file->total.positions * sizeof *placing.texcoord);
    if (!place_corners(&placing)) return ZR_CANCELLED;
    return put(&placing, arena, mesh) ? ZR_OK : ZR_NO_MEMORY;
}
