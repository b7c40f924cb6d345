/* view.h - scene: a view as requested: window, outputs, pose and projection (resolved by scene/camera/resolved_view.h). */
#ifndef ZR_VIEW_H
#define ZR_VIEW_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "scene/annotate.h"

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

/* Coordinate space of positions and normals. */
enum zr_space { ZR_SPACE_CAMERA, ZR_SPACE_WORLD, ZR_SPACE_OBJECT, ZR_SPACE_NOCS /* shade/nocs.h */, ZR_SPACE_COUNT };

struct zr_output; /* scene/output.h */

/* Channels that arrays by enum zr_channel have room for. */
enum { ZR_CHANNELS_MAX = 32 };

/* Bounds of the channel trace: sides of the window, primitives, and steps. */
enum { ZR_TRACE_SIDE_MAX = 64, ZR_TRACE_PRIMITIVES_MAX = 64, ZR_TRACE_STEPS_MAX = 20000 };

/* Pixels of a view whose surfaces the output info describes (render/picks.h). */
enum { ZR_PICKS_MAX = 64 };

struct zr_pick_pixels {
    uint32_t count;
    const uint32_t (*at)[2]; /* column from the left, row from the top */
};

struct zr_view {
    uint32_t width, height; /* of the window, pixels */
    uint32_t output_count;
    const struct zr_output *outputs;
    bool has_visibility; /* info lists the masks of instances */
    struct zr_annotate annotate;
    struct zr_pick_pixels picks; /* described by info */

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

#endif
