/* texture.h - scene: how an image lies on a surface.
 *
 * Space:  texture coordinates u, v are glTF's: (0, 0) is the top left corner of the image, (1, 1) the bottom right one.
 * Source: glTF 2.0, 3.8 and 3.9.3; KHR_texture_transform.
 */
#ifndef ZR_TEXTURE_H
#define ZR_TEXTURE_H

#include <stdbool.h>
#include <stdint.h>

/* What is beyond the image. */
enum zr_wrap {
    ZR_WRAP_REPEAT,
    ZR_WRAP_MIRROR, /* every other one is turned around */
    ZR_WRAP_CLAMP,  /* its last texels */
    ZR_WRAP_COUNT
};

enum zr_filter {
    ZR_FILTER_NEAREST,
    ZR_FILTER_LINEAR,
    ZR_FILTER_NEAREST_MIPMAP_NEAREST, /* within a level, and which level; from here on where it is made smaller only */
    ZR_FILTER_LINEAR_MIPMAP_NEAREST,
    ZR_FILTER_NEAREST_MIPMAP_LINEAR,
    ZR_FILTER_LINEAR_MIPMAP_LINEAR,
    ZR_FILTER_COUNT
};

/* What a material has textures for. */
enum zr_texture_slot {
    ZR_TEXTURE_BASE_COLOR,         /* RGB; in linear light sRGB-encoded */
    ZR_TEXTURE_METALLIC_ROUGHNESS, /* G: roughness, B: metallic */
    ZR_TEXTURE_NORMAL,             /* RGB: -1 .. 1 along tangent, bitangent and normal */
    ZR_TEXTURE_OCCLUSION,          /* R: the share of the light from all around that arrives */
    ZR_TEXTURE_EMISSIVE,           /* RGB, sRGB-encoded */
    ZR_TEXTURE_SLOTS
};

/* Of a scene. */
enum { ZR_TEXTURES_MAX = 4096 };

/* Images are at most so wide and high: texels have numbers in floats. */
enum { ZR_TEXTURE_SIDE_MAX = 1 << 16 };

/* Of texture coordinates, in magnitude, given and transformed: so that a texel of the largest image can be told. */
#define ZR_TEXCOORD_MAX 1e4f

struct zr_texture {
    uint32_t image;    /* of the scene */
    uint32_t texcoord; /* 0 or 1: which coordinates of the mesh */
    enum zr_wrap wrap_s, wrap_t;
    enum zr_filter magnify, minify; /* magnify: NEAREST or LINEAR */
    bool is_color;                  /* sRGB-encoded, where colours are managed; else numbers */
    float rows[2][3];               /* u' = rows[0] . (u, v, 1), v' likewise */
};

static inline bool zr_filter_is_linear(enum zr_filter filter)
{
    return filter == ZR_FILTER_LINEAR || filter == ZR_FILTER_LINEAR_MIPMAP_NEAREST ||
           filter == ZR_FILTER_LINEAR_MIPMAP_LINEAR;
}

static inline bool zr_filter_has_levels(enum zr_filter filter)
{
    return filter >= ZR_FILTER_NEAREST_MIPMAP_NEAREST;
}

/* Coordinates in the image. */
static inline void zr_texture_transform(const struct zr_texture *texture, float u, float v, float out[2])
{
    for (int k = 0; k < 2; k++)
        out[k] = (texture->rows[k][0] * u + texture->rows[k][1] * v) + texture->rows[k][2];
}

#endif
