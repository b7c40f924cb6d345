/* picture.h - scene: what the channel color is beyond the textbook's way: samples, linear light, effects.
 *
 * A look (scene/looks.h) is a row of these values; what a scene or a query says wins over its look.
 * Effects are of the picture only: no data channel knows of them.
 */
#ifndef ZR_PICTURE_H
#define ZR_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum zr_environment_name { ZR_ENVIRONMENT_NONE, ZR_ENVIRONMENT_STUDIO, ZR_ENVIRONMENT_OUTDOOR, ZR_ENVIRONMENT_COUNT };

/* Light from all around; it lights ZR_SHADING_PBR. */
struct zr_environment {
    enum zr_environment_name name;
    float intensity;
    double rotation_degrees; /* around its up, counter-clockwise seen from above */
    bool camera_frame; /* it goes with the camera; else its up is the scene's, and its z leads towards the camera */
};

/* How what is brighter than white is brought into 0..1. */
enum zr_tone {
    ZR_TONE_NONE,    /* clamped */
    ZR_TONE_KHRONOS, /* Khronos PBR neutral */
    ZR_TONE_NEUTRAL, /* the same with half the toe: dark colours keep more of their light */
    ZR_TONE_COUNT
};

/* What lies in creases and holes gets less of the light from all around. */
struct zr_occlusion {
    bool is_on;
    float radius;   /* how far what occludes may be, as a share of the diagonal of the bounds */
    float strength; /* of the darkening: 2 is a look's usual one, 0 none */
};

/* Silhouettes and creases, drawn over the picture. */
struct zr_edges {
    bool is_on;
    zr_vec3 color; /* as in the scene: sRGB-encoded */
    float width;   /* pixels */
    float crease_degrees;
};

/* Of samples, those of a window's larger side at most. */
enum { ZR_SAMPLE_SIDE_MAX = 8, ZR_WINDOW_SAMPLES_MAX = 16384 };

struct zr_picture {
    bool is_linear;      /* lit in linear light and encoded as sRGB; else values go to pixels as they are, and there are
                            no effects */
    uint32_t side;       /* samples a pixel are side x side: 1, 2, 4 or 8 */
    float line_width;    /* of lines and outlines, pixels */
    bool has_gradient;   /* the background runs from top to bottom in linear light; else it is the scene's */
    zr_vec3 top, bottom; /* sRGB-encoded */
    struct zr_environment environment;
    enum zr_tone tone;
    float exposure; /* factor on light, before the tone mapping */
    struct zr_occlusion occlusion;
    bool has_ground; /* a shadow on the plane under the scene, where the camera is above it */
    struct zr_edges edges;
    float crease_degrees; /* between faces that normals are averaged over; 180: all of a vertex */
    bool z_is_up;         /* else y: of environment and ground */
};

#endif
