/* picture.h - scene: settings of the channel color: samples, linear light, tone mapping, effects.
 *
 * A look (scene/looks.h) is a row of these values; keys of a scene or a query override it. Effects change the channel
 * color only, no data channel.
 */
#ifndef ZR_PICTURE_H
#define ZR_PICTURE_H

#include <stdint.h>

#include "scene/effects.h"

/* Largest side of the sample grid of a pixel, and most samples along the larger side of a window. */
enum { ZR_SAMPLE_SIDE_MAX = 8, ZR_WINDOW_SAMPLES_MAX = 16384 };

struct zr_picture {
    bool is_linear;    /* lit in linear light and encoded as sRGB; else values are stored unchanged, without effects */
    uint32_t side;     /* side x side samples per pixel: 1, 2, 4 or 8 */
    float line_width;  /* of lines and outlines, pixels */
    bool has_gradient; /* background from top to bottom, mixed in linear light; else the scene's background */
    zr_vec3 top, bottom; /* of the gradient, sRGB-encoded */
    struct zr_environment environment;
    enum zr_tone tone;
    float exposure; /* factor on light before tone mapping */
    struct zr_occlusion occlusion;
    bool has_ground;     /* shadow on the plane under the scene, if the camera is above it */
    bool has_ground_sun; /* the first directional lamp with shadows casts one on that plane, too */
    struct zr_edges edges;
    struct zr_gooch gooch;
    float crease_degrees; /* normals are averaged over faces up to this angle apart; 180: over all faces of a vertex */
    bool z_is_up;         /* up axis of environment and ground: z, else y */
};

#endif
