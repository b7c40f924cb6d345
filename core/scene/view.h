/* view.h - scene: a view as requested: window, outputs, pose and projection (resolved by scene/camera/resolved_view.h). */
#ifndef ZR_VIEW_H
#define ZR_VIEW_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "scene/channels.h"

enum zr_pose {
    ZR_POSE_PRESET,    /* fitted to the geometry */
    ZR_POSE_LOOK_AT,   /* eye, target, up */
    ZR_POSE_DIRECTION, /* direction, up; fitted */
    ZR_POSE_ORBIT,     /* azimuth and elevation around a target */
    ZR_POSE_MATRIX
};

enum zr_preset {
    ZR_PRESET_FRONT, /* the camera on +z looks along -z; y is up */
    ZR_PRESET_BACK,
    ZR_PRESET_LEFT, /* the camera on -x */
    ZR_PRESET_RIGHT,
    ZR_PRESET_TOP, /* the camera on +y; -z is up in the picture */
    ZR_PRESET_BOTTOM,
    ZR_PRESET_ISOMETRIC, /* the camera on (1, 1, 1) */
    ZR_PRESET_COUNT
};

enum zr_projection {
    ZR_PROJECTION_PERSPECTIVE,
    ZR_PROJECTION_ORTHOGRAPHIC,
    ZR_PROJECTION_INTRINSICS,
    ZR_PROJECTION_MATRIX
};

/* Pinhole camera in pixels of the window; (0, 0) is the top left corner of the picture. A point at x to the right, y
 * down and z in front projects to ((fx x + skew y) / z + cx, fy y / z + cy). */
struct zr_intrinsics {
    double fx, fy, skew;
    bool has_cx, has_cy; /* false: the middle of the window */
    double cx, cy;
};

/* Distortion of a lens (scene/camera/lens.h). */
enum zr_lens_model { ZR_LENS_NONE, ZR_LENS_OPENCV, ZR_LENS_FISHEYE };

struct zr_lens {
    enum zr_lens_model model;
    double k[6]; /* k1 to k6, or k1 to k4 of a fisheye */
    double p[2]; /* p1, p2; 0 of a fisheye */
};

struct zr_output {
    enum zr_channel channel;
    enum zr_encoding encoding;
    float scale;         /* png16: scene units per step; 0: the far plane is 65535 */
    enum zr_space space; /* of channels with a choice; the same for all outputs of one channel */
    uint32_t x, y;       /* fragments: the pixel, from the top left corner */
    bool has_range;      /* depth: nearer depths are 0, farther ones the greatest value of the encoding */
    float range[2];      /* nearest and farthest depth, scene units */
    uint32_t quality;    /* jpeg and webp: 1..100; 0: ZR_QUALITY_DEFAULT */
    uint32_t max_bytes;  /* most bytes of the file; 0: any */
    bool is_lossless;    /* webp */
};

#define ZR_QUALITY_DEFAULT 85

/* Bounds of the channel trace: sides of the window, primitives, and steps. */
enum { ZR_TRACE_SIDE_MAX = 64, ZR_TRACE_PRIMITIVES_MAX = 64, ZR_TRACE_STEPS_MAX = 20000 };

struct zr_view {
    uint32_t width, height; /* of the window, pixels */
    uint32_t output_count;
    const struct zr_output *outputs;
    bool has_visibility; /* info lists the masks of instances */

    enum zr_pose pose;
    enum zr_preset preset;
    zr_vec3 eye, target, up;
    zr_vec3 direction; /* viewing direction, of any length */
    double azimuth_degrees,
        elevation_degrees;   /* orbit: of the camera, seen from the target; 0, 0 is the preset front */
    bool has_target;         /* orbit; false: the centre of the fitted bounds */
    float distance;          /* orbit: from the target; 0: fitted */
    zr_mat4 world_to_camera; /* eye space: the camera looks along -z, y is up */

    enum zr_projection projection;
    float yfov_radians, xfov_radians; /* full angles; one of them is 0: not given */
    float xmag, ymag;                 /* half sizes; both 0: fitted to the geometry */
    struct zr_intrinsics intrinsics;
    zr_mat4 projection_matrix;
    struct zr_lens lens; /* perspective and intrinsics only */

    bool has_znear, has_zfar; /* false: taken from the bounds */
    float znear, zfar;        /* distances in front of the camera */
    float fit_padding;        /* share of the window left free on each side */
    bool fit_to_mesh;         /* the view is fitted only to instances of fit_mesh and of meshes that it owns */
    uint32_t fit_mesh;
    bool suits_extent; /* an orbit whose angles suit the extent of the bounds (scene/camera/extent_view.h) */
};

/* The target of the channel flow (scene/camera/flow.h). */
struct zr_flow {
    uint32_t output;         /* number of the output, for messages */
    bool has_view;           /* false: `view` is unused */
    struct zr_view view;     /* its window is that of the scene's view */
    const zr_mat4 *matrices; /* object to world, per instance; NULL: those of the scene */
};

/* Returns the view's first output of the channel; NULL: none. */
static inline const struct zr_output *zr_view_output(const struct zr_view *view, enum zr_channel channel)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel == channel) return &view->outputs[i];
    return NULL;
}

static inline bool zr_view_wants(const struct zr_view *view, enum zr_channel channel)
{
    return zr_view_output(view, channel) != NULL;
}

/* True if an output has the encoding. */
static inline bool zr_view_encodes(const struct zr_view *view, enum zr_encoding encoding)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].encoding == encoding) return true;
    return false;
}

/* True if an output has pixels of the channel. */
static inline bool zr_view_has_pixels(const struct zr_view *view, enum zr_channel channel)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel == channel && view->outputs[i].encoding != ZR_ENCODING_SVG) return true;
    return false;
}

/* True if masks of instances are made. */
static inline bool zr_view_has_masks(const struct zr_view *view)
{
    return view->has_visibility || zr_view_wants(view, ZR_CHANNEL_MASKS);
}

/* True if an output has pixels of the channel, or if `info`, `fragments` or the covered pixels of a `trace` are
 * computed from them. */
static inline bool zr_view_needs(const struct zr_view *view, enum zr_channel channel)
{
    const bool lists = zr_view_wants(view, ZR_CHANNEL_FRAGMENTS);
    return zr_view_has_pixels(view, channel) || (lists && channel == ZR_CHANNEL_WINDOW_DEPTH) ||
           (channel == ZR_CHANNEL_INSTANCE_ID && zr_view_has_masks(view)) ||
           (channel == ZR_CHANNEL_FACE_ID &&
            (lists || zr_view_wants(view, ZR_CHANNEL_INFO) || zr_view_wants(view, ZR_CHANNEL_TRACE)));
}

/* Returns the space of the view's outputs of a channel. */
static inline enum zr_space zr_view_space(const struct zr_view *view, enum zr_channel channel)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel == channel) return view->outputs[i].space;
    return ZR_SPACE_CAMERA;
}

#endif
