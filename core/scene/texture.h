/* texture.h - scene: textures: an image with filters, wrap modes and a transform of coordinates.
 *
 * Space:  texture coordinates u, v are glTF's: (0, 0) is the top left corner of the image, (1, 1) the bottom right one.
 * Source: glTF 2.0, 3.8 and 3.9.3; KHR_texture_transform.
 */
#ifndef ZR_TEXTURE_H
#define ZR_TEXTURE_H

#include <stdbool.h>
#include <stdint.h>

/* Wrap mode: texels outside the image. */
enum zr_wrap {
    ZR_WRAP_REPEAT,
    ZR_WRAP_MIRROR, /* every other repetition is mirrored */
    ZR_WRAP_CLAMP,  /* the texel at the edge */
    ZR_WRAP_COUNT
};

enum zr_filter {
    ZR_FILTER_NEAREST,
    ZR_FILTER_LINEAR,
    ZR_FILTER_NEAREST_MIPMAP_NEAREST, /* within a level, then between levels; from here on for minification only */
    ZR_FILTER_LINEAR_MIPMAP_NEAREST,
    ZR_FILTER_NEAREST_MIPMAP_LINEAR,
    ZR_FILTER_LINEAR_MIPMAP_LINEAR,
    ZR_FILTER_COUNT
};

/* Property of a material that a texture changes. */
enum zr_texture_slot {
    ZR_TEXTURE_BASE_COLOR,         /* RGBA; RGB is sRGB-encoded if the picture is in linear light */
    ZR_TEXTURE_METALLIC_ROUGHNESS, /* G: roughness, B: metallic */
    ZR_TEXTURE_NORMAL,             /* RGB: -1 .. 1 along tangent, bitangent and normal */
    ZR_TEXTURE_OCCLUSION,          /* R: unoccluded share of the light from all around */
    ZR_TEXTURE_EMISSIVE,           /* RGB, sRGB-encoded */
    ZR_TEXTURE_COAT,               /* R: share of the surface with a clear coat */
    ZR_TEXTURE_COAT_ROUGHNESS,     /* G: roughness of the clear coat */
    ZR_TEXTURE_COAT_NORMAL,        /* as ZR_TEXTURE_NORMAL, of the clear coat */
    ZR_TEXTURE_SHEEN,              /* RGB, sRGB-encoded: colour of sheen */
    ZR_TEXTURE_FILM,               /* R: share of the surface with a thin film */
    ZR_TEXTURE_FILM_THICKNESS,     /* G: its thickness, from the least to the largest */
    ZR_TEXTURE_TRANSMISSION,       /* R: share of the light that passes through */
    ZR_TEXTURE_THICKNESS,          /* G: length of rays in glass */
    ZR_TEXTURE_ANISOTROPY,         /* RG: -1 .. 1 along tangent and bitangent; B: strength */
    ZR_TEXTURE_SLOTS
};

/* True if a slot's colours are sRGB-encoded. */
static inline bool zr_slot_is_color(enum zr_texture_slot slot)
{
    return slot == ZR_TEXTURE_BASE_COLOR || slot == ZR_TEXTURE_EMISSIVE || slot == ZR_TEXTURE_SHEEN;
}

/* Most textures of a scene. */
enum { ZR_TEXTURES_MAX = 4096 };

/* Largest width and height of an image: floats must hold texel coordinates. */
enum { ZR_TEXTURE_SIDE_MAX = 1 << 16 };

/* Largest magnitude of a texture coordinate and of a number of its transform: that of any finite float. */
#define ZR_TEXCOORD_MAX 0x1.fffffep127f

struct zr_texture {
    uint32_t image;    /* number in the scene */
    uint32_t texcoord; /* set of the mesh's coordinates: 0 or 1 */
    enum zr_wrap wrap_s, wrap_t;
    enum zr_filter magnify, minify; /* magnify: NEAREST or LINEAR */
    bool is_color;                  /* sRGB-encoded if the picture is in linear light; false: plain numbers */
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

/* Transforms u, v of the mesh to coordinates in the image. */
static inline void zr_texture_transform(const struct zr_texture *texture, float u, float v, float out[2])
{
    for (int k = 0; k < 2; k++)
        out[k] = (texture->rows[k][0] * u + texture->rows[k][1] * v) + texture->rows[k][2];
}

#endif
