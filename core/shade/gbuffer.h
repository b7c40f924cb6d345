/* gbuffer.h - shade: what is seen at each sample, as plain arrays: the G-buffer of deferred shading.
 *
 * Space:  eye space; rows run upwards, row 0 is the lowest, sample x, y is at [y * stride + x]. A row has room for
 *         vectors behind its end: `stride` is a multiple of 16 and at least the width rounded up to 16.
 * Where nobody is seen, owner is 0, the point is ZR_FAR_POINT in all three coordinates, and the rest is 0.
 */
#ifndef ZR_GBUFFER_H
#define ZR_GBUFFER_H

#include <stddef.h>
#include <stdint.h>

/* So far that its distance squared is still a float. */
#define ZR_FAR_POINT 1e18f

/* What textures make of surfaces, at the same places; where the material has none of a kind: 1, and the surface's own
 * normal. */
struct zr_gbuffer_textures {
    float *base[3];              /* factors of the surface's own colour, in linear light */
    float *roughness, *metallic; /* factors */
    float *occlusion;            /* the share of the light from all around that arrives */
    float *emissive[3];          /* factors, linear */
    float *normal[3];            /* unit, of the side that is seen */
};
enum { ZR_TEXTURE_VALUES = 12 }; /* of a sample, in this order */

struct zr_gbuffer {
    int32_t width, height;
    ptrdiff_t stride;
    uint32_t *owner;    /* 1 + number of the primitive; lines have no normals: 0, 0, 0 */
    uint32_t *material; /* of the scene; or NULL */
    float *base[3];     /* the surface's own colour, sRGB-encoded as the scene has it; or NULL, all three */
    float *normal[3];   /* unit, of the side that is seen */
    float *point[3];    /* the point that is seen, counted from the eye (zr_camera_eye); of parallel rays, from the
                           origin of eye space */
    const struct zr_gbuffer_textures
        *textures; /* NULL: of no interest. Else of samples whose materials have textures */
};

#endif
