/* texture_maps.h - shade: the textures of a scene, ready to be sampled: images with the levels that they need.
 *
 * Levels: level n + 1 has half the width and height of level n, rounded down, and at least 1; its texels are the means
 *         of those that they cover, by the area covered, rounded half up to the image's own bits. What is sRGB-encoded
 *         is averaged in linear light where `decode`.
 */
#ifndef ZR_TEXTURE_MAPS_H
#define ZR_TEXTURE_MAPS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/status.h"
#include "base/team.h"
#include "scene/scene.h"

enum { ZR_TEXTURE_LEVELS_MAX = 17 }; /* of ZR_TEXTURE_SIDE_MAX */

struct zr_texture_level {
    uint32_t width, height;
    const void *texels; /* as in struct zr_image */
};

/* One texture. */
struct zr_texture_map {
    const struct zr_texture *texture;
    uint32_t bits;
    const float *decoded; /* what each value of `bits` bits means; NULL: its share of the largest one */
    uint32_t level_count;
    struct zr_texture_level levels[ZR_TEXTURE_LEVELS_MAX];
};

struct zr_texture_maps {
    const struct zr_texture_map *of; /* one a texture of the scene; NULL: there are none */
    /* Likewise, with the alpha of their images as all of their colours: of base colours of what is see-through; of
     * others nothing is filled in, and level_count is 0. */
    const struct zr_texture_map *opacity;
};

/* decode: colours are to be had in linear light; else all values are as they are. Points to the scene. ZR_OK,
 * ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_texture_maps_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                    bool decode, const struct zr_cancel *cancel, struct zr_texture_maps *maps);

/* What that takes at most: texels that are made, and bytes of them and of tables. */
struct zr_texture_maps_size {
    double texels, bytes;
};
struct zr_texture_maps_size zr_texture_maps_measure(const struct zr_scene *scene, bool decode);

/* The texture of a material, by its place; NULL: it has none. */
static inline const struct zr_texture_map *
zr_texture_map_of(const struct zr_texture_maps *maps, const struct zr_material *material, enum zr_texture_slot slot)
{
    const uint32_t number = material->textures[slot];
    return number && maps->of ? &maps->of[number - 1] : NULL;
}

/* How opaque the base colour of a material is; NULL: all over. */
static inline const struct zr_texture_map *zr_opacity_map_of(const struct zr_texture_maps *maps,
                                                             const struct zr_material *material)
{
    const uint32_t number = material->textures[ZR_TEXTURE_BASE_COLOR];
    return number && maps->opacity && maps->opacity[number - 1].level_count > 0 ? &maps->opacity[number - 1] : NULL;
}

#endif
