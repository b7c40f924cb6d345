/* Reads the materials of MTL files that faces use. Before that, several threads decode their images. */
#include <string.h>

#include "base/cancel.h"
#include "input/obj/mtl_file.h"

enum { MATERIALS_PER_CANCEL_CHECK = 64 };

/* Returns the entries of the used materials, in the order of their numbers, or NULL without memory. */
static const struct zr_mtl_entry **list_used(struct zr_mtl *mtl)
{
    const struct zr_mtl_entry **used = zr_arena_alloc(mtl->arena, mtl->made->material_count, sizeof *used);
    for (uint32_t i = 0; used && i < mtl->count; i++)
        if (mtl->entries[i].number != ZR_MODEL_MATERIAL_NONE) used[mtl->entries[i].number] = &mtl->entries[i];
    return used;
}

static bool goes_on(struct zr_mtl *mtl, uint32_t number)
{
    if (number % MATERIALS_PER_CANCEL_CHECK == 0 && mtl->status == ZR_OK && zr_is_cancelled(mtl->cancel))
        mtl->status = ZR_CANCELLED;
    return mtl->status == ZR_OK;
}

/* Lists the images that zr_mtl_convert decodes, in its order. In another order, fewer texels might be left for an
 * image, which would then be decoded again. */
static void list_images(struct zr_mtl *mtl, const struct zr_mtl_values *values)
{
    static const enum zr_mtl_map order[] = {ZR_MTL_MAP_COLOR,    ZR_MTL_MAP_ALPHA,  ZR_MTL_MAP_ROUGHNESS,
                                            ZR_MTL_MAP_METALLIC, ZR_MTL_MAP_NORMAL, ZR_MTL_MAP_BUMP,
                                            ZR_MTL_MAP_EMISSION};
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        const struct zr_mtl_given_map *given = &values->maps[order[i]];
        if (!given->is_given || (order[i] == ZR_MTL_MAP_BUMP && values->maps[ZR_MTL_MAP_NORMAL].is_given)) continue;
        const struct zr_asset *asset = zr_mtl_find_file(mtl, &given->name);
        if (asset) zr_image_list_expect(&mtl->decoded, &(const struct zr_parsed_bytes){asset->bytes, asset->size});
    }
}

/* Decodes the images of all used materials. Reads the materials to find them, and drops the notes of this reading. */
static void read_ahead(struct zr_mtl *mtl, const struct zr_mtl_entry *const *used)
{
    struct zr_mtl_noted *kept = zr_arena_copy(mtl->arena, mtl->notes, sizeof mtl->notes);
    struct zr_mtl_values values;
    for (uint32_t i = 0; kept && i < mtl->made->material_count && mtl->decoded.ahead_count < ZR_AHEAD_MAX; i++) {
        if (!goes_on(mtl, i)) return;
        zr_mtl_read_values(mtl, used[i], &values);
        list_images(mtl, &values);
    }
    if (!kept) return;
    memcpy(mtl->notes, kept, sizeof mtl->notes);
    zr_image_list_decode(&mtl->decoded);
}

void zr_mtl_make_used(struct zr_mtl *mtl)
{
    const struct zr_mtl_entry **used = list_used(mtl);
    struct zr_mtl_values values;
    if (used && mtl->has_maps) read_ahead(mtl, used);
    if (!zr_arena_ok(mtl->arena) && mtl->status == ZR_OK) mtl->status = ZR_NO_MEMORY;
    for (uint32_t i = 0; i < mtl->made->material_count && goes_on(mtl, i); i++) {
        zr_mtl_read_values(mtl, used[i], &values);
        zr_mtl_convert(mtl, &values, &mtl->made->materials[i]);
    }
}
