/* scene.h - the types that a scene is made of: the vocabulary of every floor.
 *
 * Made by input/, checked by scene/, read by all others and never changed
 * afterwards. Everything points into the request's arena. Units are the
 * scene's own; angles are radians, unless a name says degrees; colours are 0..1, as they go to pixels.
 * Once a scene is made, these hold: every coordinate is finite and at most
 * zr_limits.coordinate_max in magnitude, every index is in range, every face has
 * 3..polygon_vertices_max corners, the window is within its limits.
 */
#ifndef ZR_SCENE_H
#define ZR_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "scene/channels.h"
#include "scene/colormap.h"
#include "scene/image.h"
#include "scene/picture.h"
#include "scene/shadings.h"
#include "scene/texture.h"

/* How the edges of faces are drawn, as lines one pixel wide. */
enum zr_outline {
    ZR_OUTLINE_NONE,
    ZR_OUTLINE_OWN,    /* in the colours of the face */
    ZR_OUTLINE_COLORED /* all in outline_color */
};

/* What a surface's opacity is for, as in glTF. */
enum zr_alpha_mode {
    ZR_ALPHA_OPAQUE, /* nothing */
    ZR_ALPHA_MASK,   /* where it is below the cutoff, nothing is there; else the surface is opaque */
    ZR_ALPHA_BLEND,  /* what is behind shows through */
    ZR_ALPHA_COUNT
};

struct zr_material {
    zr_vec4 base_color; /* multiplies the colours of faces and vertices */
    enum zr_alpha_mode alpha_mode;
    float alpha_cutoff; /* of ZR_ALPHA_MASK */
    zr_vec3 specular;   /* of ZR_SHADING_PHONG */
    float shininess;
    float metallic, roughness; /* of ZR_SHADING_PBR, 0..1 */
    zr_vec3 emissive;          /* likewise: light of its own, linear */
    zr_vec3 cool;              /* of ZR_SHADING_GOOCH */
    enum zr_shading shading;
    bool double_sided;  /* false: polygons that turn away are not drawn */
    bool uniform_color; /* unlit: its faces have one colour each, though others of their mesh have one a vertex */
    bool unfilled;      /* faces are not filled: a wireframe, where there is an outline */
    enum zr_outline outline;
    zr_vec4 outline_color;
    uint32_t textures[ZR_TEXTURE_SLOTS]; /* 1 + their numbers in the scene; 0: none. Faces alone have textures */
    float normal_scale;                  /* of ZR_TEXTURE_NORMAL, */
    float occlusion_strength;            /* of ZR_TEXTURE_OCCLUSION, 0..1 */
};

static inline bool zr_material_has_textures(const struct zr_material *material)
{
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        if (material->textures[slot]) return true;
    return false;
}

/* Indexed polygons, lines and points. Face f has the corners indices[face_offsets[f]] to
 * indices[face_offsets[f + 1] - 1], counter-clockwise seen from its front; what is
 * inside is decided by the odd-even rule over all of its rings. */
struct zr_mesh {
    const char *name; /* UTF-8, "" where it has none */

    uint32_t position_count;
    const zr_vec4 *positions; /* object space; w = 1 where three were given */

    uint32_t face_count;
    const uint32_t *face_offsets; /* face_count + 1, never NULL */
    const uint32_t *indices;      /* into positions, one a corner */
    bool faces_are_fans;          /* cut as fans whatever their shape: cells of a grid have no dents */

    /* Faces with holes. NULL: every face is one ring. Face f has the rings face_rings[f] to
     * face_rings[f + 1] - 1, the outer one first; ring r has the corners indices[ring_offsets[r]] to
     * indices[ring_offsets[r + 1] - 1], three or more. */
    const uint32_t *face_rings;   /* face_count + 1 */
    const uint32_t *ring_offsets; /* face_rings[face_count] + 1 */

    uint32_t line_count;
    const uint32_t *lines; /* into positions, two a line */

    uint32_t point_count;
    const uint32_t *points; /* into positions */
    float point_size;       /* pixels; below 1 it is 1 */

    uint32_t normal_count;          /* 0: normals are computed */
    const zr_vec3 *normals;         /* any length; a zero normal is computed instead */
    const uint32_t *normal_indices; /* one a corner; NULL: the corner's position index */

    const zr_vec4 *texcoords; /* position_count, or NULL: u, v of texcoord 0 and of 1, which is 0 where not given */
    const zr_vec4 *tangents;  /* position_count, or NULL: xyz along u, of any length, and the sign of the bitangent */

    const zr_vec4 *colors;              /* position_count, or NULL */
    const zr_vec4 *face_colors;         /* face_count, or NULL */
    const struct zr_color_scale *scale; /* by which these stand for numbers; NULL: they are just colours */

    const uint32_t *face_materials; /* face_count, or NULL: all have `material` */
    uint32_t material;
};

/* Then it is computed instead. */
static inline bool zr_normal_is_zero(zr_vec3 normal)
{
    return normal.x == 0.0f && normal.y == 0.0f && normal.z == 0.0f;
}

/* The rings of a face: ring r of `count` has the corners offsets[r] .. offsets[r + 1] - 1. */
struct zr_rings {
    uint32_t count;
    const uint32_t *offsets; /* count + 1 */
};

static inline struct zr_rings zr_mesh_rings(const struct zr_mesh *mesh, uint32_t face)
{
    if (!mesh->face_rings) return (struct zr_rings){1, mesh->face_offsets + face};
    uint32_t first = mesh->face_rings[face];
    return (struct zr_rings){mesh->face_rings[face + 1] - first, mesh->ring_offsets + first};
}

/* What pixels are owned by: faces, after them lines, and after these points, one id each. */
static inline uint64_t zr_mesh_ids(const struct zr_mesh *mesh)
{
    return (uint64_t)mesh->face_count + mesh->line_count + mesh->point_count;
}

/* What drawing looks up, one by one: corners of faces, ends of lines, points. */
static inline uint64_t zr_mesh_corners(const struct zr_mesh *mesh)
{
    return mesh->face_offsets[mesh->face_count] + 2 * (uint64_t)mesh->line_count + mesh->point_count;
}

/* A mesh, placed. */
struct zr_instance {
    uint32_t mesh;
    zr_mat4 object_to_world;
    const char *node; /* the name of the node that placed it, UTF-8; NULL where there is none */
};

enum { ZR_LIGHTS_MAX = 1024 };

/* Entries of matrices, given or resolved, stay below this in magnitude, so that two of
 * them and a coordinate multiply to a float. Three may not: geometry drops what infinities
 * and NaN come of that. */
#define ZR_MATRIX_MAX 1e15f

enum zr_light_type {
    ZR_LIGHT_DIRECTIONAL, /* from one direction, as from the sun */
    ZR_LIGHT_HEMISPHERE,  /* from all around: from the sky above to the ground below */
    ZR_LIGHT_POINT,       /* from a place, in all directions */
    ZR_LIGHT_SPOT         /* from a place, within a cone */
};

/* Which shadings a lamp lights. A look's lamps stand in for its environment where that is not seen. */
enum zr_lit { ZR_LIT_ALL, ZR_LIT_CLASSIC /* flat, gouraud, phong */, ZR_LIT_PBR };

struct zr_light {
    zr_vec3 direction; /* the way the light travels, of a spot along its axis; of a hemisphere, to the sky; unit */
    zr_vec3 color;     /* times intensity; of a hemisphere, of the sky */
    bool camera_frame; /* direction and position are in eye space (it goes with the camera), else in world space */
    enum zr_light_type type;
    zr_vec3 ground; /* times intensity, of a hemisphere */
    bool has_shadows;
    enum zr_lit lit;
    bool environment_frame; /* direction is in the frame of picture.environment, named or not, and turns with it */

    /* Of point and spot lamps. `color` is what arrives at a distance of 1, in scene units; it falls off by the square
     * of the distance. */
    zr_vec3 position;
    float range;                         /* at this distance nothing arrives any more; 0: there is no such distance */
    double inner_degrees, outer_degrees; /* of a spot: from its axis, 0 <= inner < outer <= 90 */
};

/* Has a map for it. */
static inline bool zr_light_casts_shadows(const struct zr_light *light)
{
    return light->has_shadows && (light->type == ZR_LIGHT_DIRECTIONAL || light->type == ZR_LIGHT_SPOT);
}

static inline bool zr_light_has_place(const struct zr_light *light)
{
    return light->type == ZR_LIGHT_POINT || light->type == ZR_LIGHT_SPOT;
}

/* Depth cueing: what is seen up to `near` has its own colour, from `far` on that of the fog, and in between more and
 * more of it; both are depths along the view axis. What is behind all geometry is not in the fog. */
struct zr_fog {
    bool is_on;
    zr_vec3 color;
    float near, far; /* 0 <= near < far */
};

enum zr_pose {
    ZR_POSE_PRESET,    /* fitted to the geometry */
    ZR_POSE_LOOK_AT,   /* eye, target, up */
    ZR_POSE_DIRECTION, /* direction, up; fitted */
    ZR_POSE_ORBIT,     /* azimuth and elevation around a target */
    ZR_POSE_MATRIX
};

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

enum zr_projection {
    ZR_PROJECTION_PERSPECTIVE,
    ZR_PROJECTION_ORTHOGRAPHIC,
    ZR_PROJECTION_INTRINSICS,
    ZR_PROJECTION_MATRIX
};

/* A pinhole camera in pixels of the window; (0, 0) is the top left corner of the picture. A point
 * x to the right, y down and z in front is seen at ((fx x + skew y) / z + cx, fy y / z + cy). */
struct zr_intrinsics {
    double fx, fy, skew;
    bool has_cx, has_cy; /* else the middle of the window */
    double cx, cy;
};

/* Hidden-surface algorithms (raster/): all give the same pixels. */
enum zr_algorithm {
    ZR_ALGORITHM_HALFSPACE, /* production: edge functions, tile by tile */
    ZR_ALGORITHM_EDGELIST,
    ZR_ALGORITHM_TRAPEZOID,
    ZR_ALGORITHM_SCANLINE,
    ZR_ALGORITHM_PAINTER,
    ZR_ALGORITHM_COUNT
};

/* How PNGs are compressed: fast, or into fewer bytes for much more time (output/png.h). */
enum zr_compress { ZR_COMPRESS_FAST, ZR_COMPRESS_SMALL, ZR_COMPRESS_COUNT };

struct zr_output {
    enum zr_channel channel;
    enum zr_encoding encoding;
    float scale;         /* png16: scene units a step; 0: the far plane is 65535 */
    enum zr_space space; /* of channels that have some; all outputs of one channel have the same */
    uint32_t x, y;       /* fragments: the pixel, counted from the top left corner */
};

/* A picture of the scene: one window, pose and projection, as asked for (resolved by scene/camera.h), and what is to be
 * had of it. */
struct zr_view {
    uint32_t width, height; /* of the window, pixels */
    uint32_t output_count;
    const struct zr_output *outputs;

    enum zr_pose pose;
    enum zr_preset preset;
    zr_vec3 eye, target, up;
    zr_vec3 direction;                         /* the way the camera looks; any length */
    double azimuth_degrees, elevation_degrees; /* of the camera, seen from the target: 0, 0 is the preset front */
    bool has_target;                           /* orbit: else the centre of what is fitted to */
    float distance;                            /* orbit: from the target; 0: fitted */
    zr_mat4 world_to_camera;                   /* eye space: the camera looks along -z, y is up */

    enum zr_projection projection;
    float yfov_radians, xfov_radians; /* full angles; the one that is not given is 0 */
    float xmag, ymag;                 /* half sizes; both 0: fitted to the geometry */
    struct zr_intrinsics intrinsics;
    zr_mat4 projection_matrix;

    bool has_znear, has_zfar; /* else taken from the bounds */
    float znear, zfar;        /* distances in front of the camera */
    float fit_padding;        /* share of the window left free on each side */
    bool fit_to_mesh;         /* what is fitted is to hold only the instances of the mesh fit_mesh */
    uint32_t fit_mesh;
};

/* What was drawn before, here or elsewhere, and new geometry is drawn into: arrays of
 * width * height, row 0 on top. What is NULL is as if nothing were there; readers see to
 * it that no channel that the outputs ask for is. */
struct zr_base {
    const uint8_t *color;      /* RGBA, 4 bytes a pixel */
    const float *window_depth; /* the z-buffer, 0..1, 1 where nothing is; NULL: made from depth */
    const float *depth;        /* eye space, +inf where nothing is */
    const uint32_t *face_id;   /* 0 where nothing is */
    bool scene_wins_ties;      /* at equal depth the new geometry is seen, else the base is */
    uint32_t first_face_id;    /* of the new geometry; at least 1 */
    uint64_t
        clamped_depths; /* of window_depth, where it was made from depth: before the near plane, or behind the far */
};

enum { ZR_VIEWS_MOST = 1 };

/* A scale of colours, drawn over the output color with numbers beside it (overlay/color_bar.h). */
struct zr_color_bar {
    bool is_on;
    bool is_left;      /* at the left edge, else at the right one */
    bool has_mesh;     /* it shows the scale of `mesh`, else of the first mesh drawn that has one */
    uint32_t mesh;     /* number of it */
    const char *title; /* above the bar, UTF-8; NULL: none */
};

struct zr_look; /* scene/looks.h */

/* What readers left out or replaced. */
struct zr_read_counts {
    uint64_t normals, zero_normals; /* given, and of these: computed instead */
    uint32_t zero_normals_mesh;     /* the first that has some */
    uint64_t left_out_cells;        /* of grids of heights, for their holes */
};

struct zr_scene {
    const struct zr_look *look; /* which one it has; what else is here is that of the scene, over the look's */
    zr_vec4 background;
    zr_vec3 ambient;
    struct zr_fog fog;
    struct zr_picture picture;
    struct zr_color_bar color_bar;
    enum zr_algorithm algorithm;
    uint32_t material_count, mesh_count, instance_count, light_count, warning_count;
    const struct zr_material *materials;
    const struct zr_mesh *meshes;
    const struct zr_instance *instances;
    const struct zr_light *lights;
    enum zr_compress compress;   /* of all outputs that are PNGs */
    const char *const *warnings; /* what input/ and scene/ found odd but drawable */
    bool is_strict;              /* what is warned of is refused instead */
    struct zr_read_counts counts;
    struct zr_view views[ZR_VIEWS_MOST];
    const struct zr_base *base; /* NULL: the geometry is all there is */
    uint32_t image_count;
    const struct zr_image *images; /* no two of the same bytes */
    uint32_t texture_count;
    const struct zr_texture *textures;
};

static inline const struct zr_material *zr_material_of_face(const struct zr_scene *scene, const struct zr_mesh *mesh,
                                                            uint32_t face)
{
    return &scene->materials[mesh->face_materials ? mesh->face_materials[face] : mesh->material];
}

/* Whether pictures show what is behind it. */
static inline bool zr_material_is_layered(const struct zr_material *material)
{
    return material->alpha_mode != ZR_ALPHA_OPAQUE || zr_shading_is_layered(material->shading);
}

static inline bool zr_any_is_xray(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (zr_shading_is_layered(materials[i].shading)) return true;
    return false;
}

static inline bool zr_any_is_see_through(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (materials[i].alpha_mode != ZR_ALPHA_OPAQUE) return true;
    return false;
}

/* What of these is seen, their opacity tells. */
static inline bool zr_any_is_masked(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (materials[i].alpha_mode == ZR_ALPHA_MASK) return true;
    return false;
}

/* The first of the outputs that shows the channel; NULL: none does. */
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

/* True where it is wanted, or what reports in words is made from it. */
static inline bool zr_view_needs(const struct zr_view *view, enum zr_channel channel)
{
    const bool lists = zr_view_wants(view, ZR_CHANNEL_FRAGMENTS);
    return zr_view_wants(view, channel) || (lists && channel == ZR_CHANNEL_WINDOW_DEPTH) ||
           (channel == ZR_CHANNEL_FACE_ID && (lists || zr_view_wants(view, ZR_CHANNEL_INFO)));
}

/* The space of a channel that is wanted. */
static inline enum zr_space zr_view_space(const struct zr_view *view, enum zr_channel channel)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel == channel) return view->outputs[i].space;
    return ZR_SPACE_CAMERA;
}

#endif
