/* scene.h - the types that a scene is made of: the vocabulary of every floor.
 *
 * Made by input/, checked by scene/, read by all others and never changed
 * afterwards. Everything points into the request's arena. Units are the
 * scene's own; angles are radians; colours are 0..1, as they go to pixels.
 * Once a scene is made, these hold: every coordinate is finite and at most
 * zr_limits.coordinate_max in magnitude, every index is in range, every face has
 * 3..polygon_vertices_max corners, the window is within its limits.
 */
#ifndef ZR_SCENE_H
#define ZR_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum zr_shading {
    ZR_SHADING_UNLIT,  /* colours as given, interpolated where given per vertex */
    ZR_SHADING_FLAT,   /* one lit colour a polygon; its first vertex gives the colour */
    ZR_SHADING_GOURAUD /* lit at each vertex, interpolated */
};

struct zr_material {
    zr_vec4 base_color; /* multiplies the colours of faces and vertices */
    enum zr_shading shading;
    bool double_sided; /* false: polygons that turn away are not drawn */
};

/* Indexed polygons. Face f has the corners indices[face_offsets[f]] to
 * indices[face_offsets[f + 1] - 1], counter-clockwise seen from its front. */
struct zr_mesh {
    const char *name; /* UTF-8, "" where it has none */

    uint32_t position_count;
    const zr_vec4 *positions; /* object space; w = 1 where three were given */

    uint32_t face_count;
    const uint32_t *face_offsets; /* face_count + 1 */
    const uint32_t *indices;      /* into positions, one a corner */
    bool faces_are_fans;          /* cut as fans whatever their shape: cells of a grid have no dents */

    uint32_t normal_count;          /* 0: normals are computed */
    const zr_vec3 *normals;         /* any length; a zero normal is computed instead */
    const uint32_t *normal_indices; /* one a corner; NULL: the corner's position index */

    const zr_vec4 *colors;      /* position_count, or NULL */
    const zr_vec4 *face_colors; /* face_count, or NULL */

    const uint32_t *face_materials; /* face_count, or NULL: all have `material` */
    uint32_t material;
};

/* A mesh, placed. */
struct zr_instance {
    uint32_t mesh;
    zr_mat4 object_to_world;
};

enum { ZR_LIGHTS_MAX = 1024 };

/* Entries of matrices, given or resolved, stay below this in magnitude, so that two of
 * them and a coordinate multiply to a float. Three may not: geometry drops what infinities
 * and NaN come of that. */
#define ZR_MATRIX_MAX 1e15f

/* Light from one direction, as from the sun. */
struct zr_light {
    zr_vec3 direction; /* the way the light travels; unit length */
    zr_vec3 color;     /* times intensity */
    bool camera_frame; /* direction is in eye space (a headlight), else in world space */
};

enum zr_pose { ZR_POSE_PRESET, ZR_POSE_LOOK_AT, ZR_POSE_MATRIX };

enum zr_preset {
    ZR_PRESET_FRONT, /* the camera on +z, looks along -z; y is up */
    ZR_PRESET_BACK,
    ZR_PRESET_LEFT, /* the camera on -x */
    ZR_PRESET_RIGHT,
    ZR_PRESET_TOP, /* the camera on +y; -z is up in the picture */
    ZR_PRESET_BOTTOM,
    ZR_PRESET_ISOMETRIC, /* the camera on (1, 1, 1) */
    ZR_PRESET_COUNT
};

enum zr_projection { ZR_PROJECTION_PERSPECTIVE, ZR_PROJECTION_ORTHOGRAPHIC, ZR_PROJECTION_MATRIX };

/* One pose and one projection, as asked for; resolved by scene/camera.h. */
struct zr_view {
    enum zr_pose pose;
    enum zr_preset preset; /* fitted to the geometry */
    zr_vec3 eye, target, up;
    zr_mat4 world_to_camera; /* eye space: the camera looks along -z, y is up */

    enum zr_projection projection;
    float yfov_radians; /* full angle */
    float xmag, ymag;   /* half sizes; both 0: fitted to the geometry */
    zr_mat4 projection_matrix;

    bool has_znear, has_zfar; /* else taken from the bounds */
    float znear, zfar;        /* distances in front of the camera */
    float fit_padding;        /* share of the window left free on each side */
};

enum zr_channel {
    ZR_CHANNEL_COLOR,        /* RGB, or RGBA where the background is not opaque */
    ZR_CHANNEL_DEPTH,        /* eye-space depth along the view axis, scene units */
    ZR_CHANNEL_WINDOW_DEPTH, /* the z-buffer, 0..1 */
    ZR_CHANNEL_FACE_ID,      /* 1 + number of the polygon, counted over all instances in order */
    ZR_CHANNEL_INFO,         /* JSON: what was drawn and how */
    ZR_CHANNEL_COUNT
};

enum zr_encoding { ZR_ENCODING_PNG, ZR_ENCODING_PNG16, ZR_ENCODING_NPY, ZR_ENCODING_JSON, ZR_ENCODING_COUNT };

struct zr_output {
    enum zr_channel channel;
    enum zr_encoding encoding;
    float scale; /* png16: scene units a step; 0: the far plane is 65535 */
};

struct zr_scene {
    uint32_t width, height; /* pixels */
    zr_vec4 background;
    zr_vec3 ambient;
    uint32_t material_count, mesh_count, instance_count, light_count, output_count, warning_count;
    const struct zr_material *materials;
    const struct zr_mesh *meshes;
    const struct zr_instance *instances;
    const struct zr_light *lights;
    const struct zr_output *outputs;
    const char *const *warnings; /* what input/ and scene/ found odd but drawable */
    struct zr_view view;
};

#endif
