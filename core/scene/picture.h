/* picture.h - scene: settings of the channel color: samples, linear light, tone mapping, effects.
 *
 * A look (scene/looks.h) is a row of these values; keys of a scene or a query override it. Effects change the channel
 * color only, no data channel.
 */
#ifndef ZR_PICTURE_H
#define ZR_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum zr_environment_name {
    ZR_ENVIRONMENT_NONE,
    ZR_ENVIRONMENT_STUDIO,
    ZR_ENVIRONMENT_OUTDOOR,
    ZR_ENVIRONMENT_STUDIO_2,
    ZR_ENVIRONMENT_METAL_2,
    ZR_ENVIRONMENT_OUTDOOR_2,
    ZR_ENVIRONMENT_COUNT
};

/* Environment light for ZR_SHADING_PBR. */
struct zr_environment {
    enum zr_environment_name name;
    float intensity;
    double rotation_degrees; /* around its up axis, counter-clockwise seen from above */
    bool camera_frame; /* it moves with the camera; else its up is the scene's, and its z points towards the camera */
};

/* Tone mapping: brings linear light brighter than white into 0..1. */
enum zr_tone {
    ZR_TONE_NONE,    /* clamped */
    ZR_TONE_KHRONOS, /* Khronos PBR neutral */
    ZR_TONE_NEUTRAL, /* the same with half the toe: dark colours keep more of their light */
    ZR_TONE_COUNT
};

/* Ambient occlusion: creases and holes get less of the light from all around. */
struct zr_occlusion {
    bool is_on;
    float radius;   /* largest distance of an occluder, as a share of the diagonal of the bounds */
    float strength; /* of the darkening: 0 is none, 2 the usual one of looks */
};

/* Silhouettes and creases, drawn over the picture. */
struct zr_edges {
    bool is_on;
    zr_vec3 color; /* sRGB-encoded */
    float width;   /* pixels; 0, from the mesh only: it grows with the window (lines/strokes.h) */
    float crease_degrees;
    float silhouette_opacity, crease_opacity; /* 0..1 */
    bool scales_width, scales_specks;         /* width, and size of dropped creases, grow with the window */
    bool is_from_mesh; /* lines of the mesh (lines/drawing.h), else of samples (effects/edges.h) */
    /* from the mesh only */
    bool ignores_normals; /* normals of a file do not make creases smooth */
    bool has_hidden;      /* hidden lines are dashed */
};

/* Constants of the shading gooch. */
struct zr_gooch {
    bool tints_cool;   /* the cool colour is multiplied by that of the surface */
    float least, rise; /* share of light in creases, and what an open surface has beyond it */
};

/* Constants of the shading xray: a layer has the opacity least + rise (1 - |c|)^2, or ^3, times 1 - lean x. x is that
 * of the normal once turned towards the eye: walls that face left are denser, so that sides of a part differ. */
struct zr_xray_opacity {
    float least, rise;
    bool is_square;
    float lean; /* 0 .. 1 */
};

/* Largest side of the sample grid of a pixel, and most samples along the larger side of a window. */
enum { ZR_SAMPLE_SIDE_MAX = 8, ZR_WINDOW_SAMPLES_MAX = 16384 };

struct zr_picture {
    bool is_linear;    /* lit in linear light and encoded as sRGB; else values are stored unchanged, without effects */
    uint32_t side;     /* side x side samples per pixel: 1, 2, 4 or 8 */
    float line_width;  /* of lines and outlines, pixels */
    bool has_gradient; /* background from top to bottom, mixed in linear light; else the scene's background */
    zr_vec3 top, bottom; /* of the gradient, sRGB-encoded */
    bool dithers;        /* the gradient, where nothing is in front of it */
    struct zr_environment environment;
    enum zr_tone tone;
    float exposure; /* factor on light before tone mapping */
    struct zr_occlusion occlusion;
    bool has_ground;     /* shadow on the plane under the scene, if the camera is above it */
    bool softens_ground; /* that shadow is narrower and weaker under low scenes */
    bool has_ground_sun; /* the first directional lamp with shadows casts one on that plane, too */
    struct zr_edges edges;
    struct zr_gooch gooch;
    struct zr_xray_opacity xray;
    float crease_degrees; /* normals are averaged over faces up to this angle apart; 180: over all faces of a vertex */
    bool z_is_up;         /* up axis of environment and ground: z, else y */
};

#endif
