/* gbuffer.h - shade: the G-buffer of deferred shading: values of the visible surface at each sample, as planar arrays.
 *
 * Space:  eye space; row 0 is the lowest, sample x, y is at [y * stride + x]. `stride` is a multiple of 16 and at least
 *         the width rounded up to 16, so that vectors fit at the end of a row.
 * Uncovered samples have owner 0, the point ZR_FAR_POINT in all three coordinates, and 0 elsewhere.
 */
#ifndef ZR_GBUFFER_H
#define ZR_GBUFFER_H

#include <stddef.h>
#include <stdint.h>

/* Coordinate of uncovered samples: far, and its square still fits a float. */
#define ZR_FAR_POINT 1e18f

/* Values from textures, per sample. Without a texture of a kind: 1, and the surface's own normal. */
struct zr_gbuffer_textures {
    float *base[3];              /* factors of the base colour, in linear light */
    float *roughness, *metallic; /* factors */
    float *occlusion;            /* share of the ambient light that arrives */
    float *emissive[3];          /* factors, linear */
    float *normal[3];            /* unit, of the visible side */
    /* All NULL: no material has a texture of its finish, or anisotropy. */
    float *coat, *coat_roughness;    /* factors */
    float *coat_normal[3];           /* unit */
    float *sheen[3];                 /* factors, linear */
    float *film, *film_thickness;    /* factor; share of the way from the least to the largest thickness */
    float *transmission, *thickness; /* factors */
    float *along[3], *anisotropy;    /* unit vector along which highlights are long, 0: none; factor */
};
enum { ZR_TEXTURE_VALUES = 12, ZR_TEXTURE_VALUES_FINISHED = 28 }; /* values per sample, in this order */

struct zr_gbuffer {
    int32_t width, height;
    ptrdiff_t stride;
    uint32_t *owner;    /* 1 + number of the primitive; lines have the normal 0, 0, 0 */
    uint32_t *material; /* number in the scene; or NULL */
    float *base[3];     /* base colour, sRGB-encoded as in the scene; or all three NULL */
    float *normal[3];   /* unit, of the visible side */
    float *point[3];    /* visible point, from the eye (zr_camera_eye); with parallel rays, from the origin of eye
                         * space */
    float *opacity;     /* or NULL */
    const struct zr_gbuffer_textures *textures; /* valid for samples of materials with textures; NULL: unused */
};

#endif
