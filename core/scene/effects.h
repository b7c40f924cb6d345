/* effects.h - scene: settings of environment light, tone mapping and effects, parts of a picture (scene/picture.h). */
#ifndef ZR_SCENE_EFFECTS_H
#define ZR_SCENE_EFFECTS_H

#include <stdbool.h>

#include "base/vec.h"

enum zr_environment_name {
    ZR_ENVIRONMENT_NONE,
    ZR_ENVIRONMENT_STUDIO,
    ZR_ENVIRONMENT_METAL,
    ZR_ENVIRONMENT_OUTDOOR,
    ZR_ENVIRONMENT_COUNT,
    ZR_ENVIRONMENT_IMAGE = ZR_ENVIRONMENT_COUNT /* no name: `map` of struct zr_environment */
};

/* Environment light for ZR_SHADING_PBR. */
struct zr_environment {
    enum zr_environment_name name;
    float intensity;
    double rotation_degrees; /* around its up axis, counter-clockwise seen from above */
    bool camera_frame; /* it moves with the camera; else its up is the scene's, and its z points towards the camera;
                        * that of an image is fixed to the scene */
    const struct zr_environment_map *map; /* of ZR_ENVIRONMENT_IMAGE, scene/environment_map.h */
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
    float strength; /* of the darkening: 0 is none; at 1.7, light is closest to that of rays */
};

/* Silhouettes and creases, drawn over the picture. */
struct zr_edges {
    bool is_on;
    zr_vec3 color;    /* sRGB-encoded */
    float width;      /* pixels; from the mesh: 0 grows with the window (lines/strokes.h) */
    bool keeps_width; /* from samples: else `width` is that in a window of 600 pixels (zr_edges_width_in) */
    float crease_degrees;
    float silhouette_opacity, crease_opacity; /* 0..1 */
    bool is_from_mesh; /* lines of the mesh (lines/drawing.h), else of samples (effects/edges.h) */
    /* from the mesh only */
    bool ignores_normals; /* normals of a file do not make creases smooth */
    bool has_hidden;      /* hidden lines are dashed */
};

/* Constants of the shading gooch. */
struct zr_gooch {
    float least, rise; /* share of light in creases, and what an open surface has beyond it */
};

#endif
