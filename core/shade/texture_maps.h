/* texture_maps.h - shade: the textures of a scene, ready for sampling: images with their mipmap levels.
 *
 * Levels: level n + 1 has half the width and height of level n, rounded down, and at least 1. Its texels are the means
 *         of the texels that they cover, weighted by area and rounded half up to the image's bits. sRGB-encoded values
 *         are averaged in linear light if `decode`.
 */
#ifndef ZR_TEXTURE_MAPS_H
#define ZR_TEXTURE_MAPS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/run.h"
#include "base/status.h"
#include "base/team.h"
#include "scene/scene.h"

enum { ZR_TEXTURE_LEVELS_MAX = 17 }; /* levels of ZR_TEXTURE_SIDE_MAX */

struct zr_texture_level {
    uint32_t width, height;
    const void *texels; /* as in struct zr_image */
};

/* One texture. */
struct zr_texture_map {
    const struct zr_texture *texture;
    uint32_t bits;
    uint32_t place;       /* maps of one number sample the same texels of images of one size, at the same levels */
    const float *decoded; /* linear value of each code of `bits` bits; NULL: code / largest code */
    uint32_t level_count;
    struct zr_texture_level levels[ZR_TEXTURE_LEVELS_MAX];
};

struct zr_texture_maps {
    const struct zr_texture_map *of; /* one per texture of the scene; NULL: none, and no anisotropy */
    /* One per texture, with the image's alpha in all colour components, for base colours of masked and blended
     * materials. For others, level_count is 0. */
    const struct zr_texture_map *opacity;
    bool of_finishes; /* a material has a texture of its finish, or anisotropy */
};

/* Makes the maps of the textures that a material has. They point to the scene, and to kept levels of its images.
 * decode: colours are converted to linear light; else values stay as they are. Returns ZR_OK, ZR_CANCELLED or
 * ZR_NO_MEMORY. */
enum zr_status zr_texture_maps_make(const struct zr_run *run, const struct zr_scene *scene, bool decode,
                                    struct zr_texture_maps *maps);

/* Upper bounds of its cost: texels made, and bytes of texels and tables. */
struct zr_texture_maps_size {
    double texels, bytes;
};
struct zr_texture_maps_size zr_texture_maps_measure(const struct zr_scene *scene, bool decode);

/* Returns the texture of a material's slot; NULL: none, or of a base colour its alpha alone. */
static inline const struct zr_texture_map *
zr_texture_map_of(const struct zr_texture_maps *maps, const struct zr_material *material, enum zr_texture_slot slot)
{
    const uint32_t number = material->textures[slot];
    if (slot == ZR_TEXTURE_BASE_COLOR && material->is_alpha_only) return NULL;
    return number && maps->of ? &maps->of[number - 1] : NULL;
}

/* Returns the opacity map of a material's base colour; NULL: opaque. */
static inline const struct zr_texture_map *zr_opacity_map_of(const struct zr_texture_maps *maps,
                                                             const struct zr_material *material)
{
    const uint32_t number = material->textures[ZR_TEXTURE_BASE_COLOR];
    return number && maps->opacity && maps->opacity[number - 1].level_count > 0 ? &maps->opacity[number - 1] : NULL;
}

#endif
