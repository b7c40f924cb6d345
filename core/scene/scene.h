/* scene.h - scene: types of a scene, used by all rooms of core/.
 *
 * Life:   input/ builds a scene, scene/ checks it, and all later stages only read it. All pointers lead into the
 *         request's arena.
 * Units:  the scene's own. Angles are in radians unless a name says degrees. Colours are 0..1, as stored in pixels.
 * Valid:  every coordinate is finite and at most zr_limits.coordinate_max in magnitude. Every index is in range. Every
 *         face has 3..polygon_vertices_max corners. The window is within its limits.
 */
#ifndef ZR_SCENE_H
#define ZR_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "scene/algorithm.h"
#include "scene/colormap.h"
#include "scene/image.h"
#include "scene/light_types.h"
#include "scene/part_keys.h"
#include "scene/section.h"
#include "scene/shadings.h"
#include "scene/sheet.h"
#include "scene/texture.h"
#include "scene/view.h"

/* Colour of the edges of faces, drawn as lines. */
enum zr_outline {
    ZR_OUTLINE_NONE,
    ZR_OUTLINE_OWN,    /* in the colours of the face */
    ZR_OUTLINE_COLORED /* in outline_color */
};

/* Use of a surface's alpha, as in glTF. */
enum zr_alpha_mode {
    ZR_ALPHA_OPAQUE, /* alpha is ignored */
    ZR_ALPHA_MASK,   /* samples with alpha below the cutoff are not covered, all others are opaque */
    ZR_ALPHA_BLEND,  /* the surface is blended over those behind it */
    ZR_ALPHA_NAMES,
    ZR_ALPHA_OPERAND = ZR_ALPHA_NAMES, /* of draws only: opaque faces of operands (zr_material.is_operand) */
    ZR_ALPHA_COUNT
};

/* Effects of ZR_SHADING_PBR that few surfaces have; all 0: none. Floats only, for comparison and hashes.
 * Source: the extensions of glTF 2.0 whose names begin with KHR_materials. */
struct zr_finish {
    float coat, coat_roughness; /* clearcoat: share of the surface that it covers, 0..1; roughness, 0..1 */
    zr_vec3 sheen;              /* sheen: linear colour */
    float sheen_roughness;      /* 0..1 */
    float film;                 /* iridescence: share of the surface with a thin film, 0..1 */
    float film_ior, film_nm;    /* its index of refraction, at least 1; its thickness, nanometres */
    float film_thinnest;        /* thickness where a texture of it is 0 */
    float transmission;         /* transmission: share of the light that enters and passes through, 0..1 */
    float ior;                  /* with transmission: index of refraction, at least 1 */
    float thickness;            /* volume: length of rays in it, object units; 0: thin walls, which bend no light */
    zr_vec3 attenuation;        /* volume: linear colour, 0..1, that white light has after `distance` */
    float distance;             /* world units; 0: no attenuation */
    float dispersion;           /* dispersion: 20 / Abbe number */
    float anisotropy,
        along[2]; /* anisotropy: strength, 0..1; cosine and sine of its direction's angle to the tangent */
};
enum { ZR_FINISH_FLOATS = sizeof(struct zr_finish) / sizeof(float) };

struct zr_material {
    zr_vec4 base_color; /* multiplies the colours of faces and vertices */
    enum zr_alpha_mode alpha_mode;
    float alpha_cutoff; /* ZR_ALPHA_MASK */
    zr_vec3 specular;   /* ZR_SHADING_PHONG */
    float shininess;
    float metallic, roughness; /* ZR_SHADING_PBR, 0..1 */
    zr_vec3 reflectance;       /* ZR_SHADING_PBR: reflectance of plastics at normal incidence, 0..1 */
    float grazing;             /* ZR_SHADING_PBR: reflectance of plastics at grazing incidence, 0..1 */
    zr_vec3 emissive;          /* ZR_SHADING_PBR: emitted light, linear */
    struct zr_finish finish;   /* ZR_SHADING_PBR */
    zr_vec3 cool;              /* ZR_SHADING_GOOCH: colour of the side away from the light */
    enum zr_shading shading;
    bool double_sided;  /* false: back faces are culled */
    bool uniform_color; /* unlit: one colour per face, even if the mesh has vertex colours */
    bool unfilled;      /* faces are not filled; with an outline, a wireframe */
    bool is_hidden;     /* elements are not drawn and keep their ids; also unfilled, without an outline */
    bool is_operand;    /* faces of a combined solid (scene/csg.h), opaque: a walk decides where they are visible */
    enum zr_outline outline;
    zr_vec4 outline_color;
    bool is_solid;                       /* ZR_ALPHA_BLEND: of glass whose alpha is ignored */
    bool is_alpha_only;                  /* RGB of the texture ZR_TEXTURE_BASE_COLOR counts as 1 */
    uint32_t textures[ZR_TEXTURE_SLOTS]; /* 1 + number in the scene, or 0: none; on faces only */
    float normal_scale;                  /* ZR_TEXTURE_NORMAL: factor on x and y */
    float coat_normal_scale;             /* ZR_TEXTURE_COAT_NORMAL: likewise */
    float occlusion_strength;            /* ZR_TEXTURE_OCCLUSION, 0..1 */
};

/* Initial values of a plastic with the index of refraction 1.5. */
#define ZR_MATERIAL_PLASTIC .reflectance = {0.04f, 0.04f, 0.04f}, .grazing = 1.0f

static inline bool zr_finish_has_sheen(const struct zr_finish *finish)
{
    return finish->sheen.x > 0.0f || finish->sheen.y > 0.0f || finish->sheen.z > 0.0f;
}

static inline bool zr_material_has_finish(const struct zr_material *material)
{
    const struct zr_finish *finish = &material->finish;
    return material->shading == ZR_SHADING_PBR &&
           (finish->coat > 0.0f || finish->film > 0.0f || finish->transmission > 0.0f || finish->anisotropy > 0.0f ||
            zr_finish_has_sheen(finish));
}

/* True if light passes through the surface. The channel color blends it, like surfaces with the shading xray. */
static inline bool zr_material_is_glass(const struct zr_material *material)
{
    return material->shading == ZR_SHADING_PBR && material->finish.transmission > 0.0f &&
           material->alpha_mode != ZR_ALPHA_MASK;
}

/* True if the surface refracts or blurs the picture behind it. */
static inline bool zr_material_refracts(const struct zr_material *material)
{
    return zr_material_is_glass(material) && (material->finish.thickness > 0.0f || material->roughness > 0.0f);
}

static inline bool zr_material_has_textures(const struct zr_material *material)
{
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
        if (material->textures[slot]) return true;
    return false;
}

/* True if shading needs texture coordinates. */
static inline bool zr_material_is_mapped(const struct zr_material *material)
{
    return zr_material_has_textures(material) ||
           (material->shading == ZR_SHADING_PBR && material->finish.anisotropy > 0.0f);
}

/* Indexed polygons, lines and points. Face f has the corners indices[face_offsets[f]] to indices[face_offsets[f + 1] -
 * 1], counter-clockwise seen from its front. The odd-even rule over all of its rings defines its interior. */
struct zr_mesh {
    const char *name; /* UTF-8, "" if unnamed */
    bool is_complete; /* scene_builder.h */

    uint32_t position_count;
    const zr_vec4 *positions; /* object space; w = 1 if three numbers were given */
    const double *move;       /* three numbers that the reader subtracted from them, for output; NULL: none */

    /* Positions of the elements that are drawn, for bounds and views, if others are hidden. NULL: all positions. */
    const zr_vec4 *shown;
    uint32_t shown_count;

    uint32_t face_count;
    const uint32_t *face_offsets; /* face_count + 1, never NULL */
    const uint32_t *indices;      /* into positions, one per corner */
    bool faces_are_fans;          /* all faces are cut as fans, without a test for convexity: cells of a grid */

    /* Faces with holes. NULL: every face is one ring. Face f has the rings face_rings[f] to
     * face_rings[f + 1] - 1, the outer one first; ring r has the corners indices[ring_offsets[r]] to
     * indices[ring_offsets[r + 1] - 1], three or more. */
    const uint32_t *face_rings;   /* face_count + 1 */
    const uint32_t *ring_offsets; /* face_rings[face_count] + 1 */

    uint32_t line_count;
    const uint32_t *lines; /* into positions, two per line */

    uint32_t point_count;
    const uint32_t *points; /* into positions; NULL: point i is position i (zr_mesh_point) */
    float point_size;       /* pixels; below 1 it is 1 */
    bool points_are_round;  /* regular octagons, else squares */

    uint32_t normal_count;          /* 0: normals are computed */
    const zr_vec3 *normals;         /* of any length; zero normals are replaced by computed ones */
    const uint32_t *normal_indices; /* one per corner; NULL: the corner's position index */

    /* face_count, or NULL: smoothing groups, for crease normals. Faces of one group are averaged, whatever their angle;
     * those of group 0 are flat. */
    const uint32_t *face_groups;

    const zr_vec4 *texcoords; /* position_count, or NULL: u, v of texcoord 0, then u, v of texcoord 1, or 0 */
    const zr_vec4 *tangents;  /* position_count, or NULL: xyz along u, of any length, and the sign of the bitangent */

    const zr_vec4 *colors;              /* position_count, or NULL */
    const zr_vec4 *face_colors;         /* face_count, or NULL */
    const struct zr_color_scale *scale; /* of colours made from scalars; NULL: colours were given */

    const uint32_t *face_materials; /* face_count, or NULL: all faces have `material` */
    uint32_t material;

    /* Named parts of the mesh: groups of an OBJ. face_parts: face_count, the part of each face, below part_count; NULL:
     * the mesh is one part, with its lines and points. If there are named parts, lines and points belong to no part. */
    const uint32_t *face_parts;
    uint32_t part_count;           /* 0 without face_parts; a part may be without faces */
    const char *const *part_names; /* part_count, UTF-8, never NULL, "" if unnamed, may repeat */

    /* The last faces of a sectioned mesh: planar, and filled by the non-zero rule over all of their rings. */
    uint32_t cap_count;
    const uint32_t *cap_planes;          /* per cap: number of its plane; NULL: caps share none */
    const struct zr_mesh_source *source; /* NULL: not sectioned */
};

/* A corner between two others, at `t` from a to b. In a cap, a is ZR_NO_CORNER. */
struct zr_mesh_blend {
    uint32_t a, b;
    double t;
};

#define ZR_NO_CORNER UINT32_MAX

/* The mesh of which a sectioned mesh is a part: normals are computed from the whole. Its corners, by slot, come first
 * in a common numbering; then come `blends`, each of earlier corners. */
struct zr_mesh_source {
    const struct zr_mesh *mesh;
    uint32_t blend_count;
    const struct zr_mesh_blend *blends;
    const uint32_t *corners; /* per slot of the sectioned mesh: number of its corner */
    uint32_t first_position; /* of the sectioned mesh: that of blend 0. Earlier ones are those of the whole */
};

static inline bool zr_mesh_face_is_cap(const struct zr_mesh *mesh, uint32_t face)
{
    return face >= mesh->face_count - mesh->cap_count;
}

/* True if a given normal is (0, 0, 0): a computed one replaces it. */
static inline bool zr_normal_is_zero(zr_vec3 normal)
{
    return normal.x == 0.0f && normal.y == 0.0f && normal.z == 0.0f;
}

/* Rings of a face: ring r of `count` has the corners offsets[r] .. offsets[r + 1] - 1. */
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

/* Returns the position of a point. */
static inline uint32_t zr_mesh_point(const struct zr_mesh *mesh, uint32_t point)
{
    return mesh->points ? mesh->points[point] : point;
}

/* Returns the number of owner ids of a mesh: one per face, then one per line, then one per point. */
static inline uint64_t zr_mesh_ids(const struct zr_mesh *mesh)
{
    return (uint64_t)mesh->face_count + mesh->line_count + mesh->point_count;
}

/* Returns the number of vertices to draw: corners of faces, ends of lines, points. */
static inline uint64_t zr_mesh_corners(const struct zr_mesh *mesh)
{
    return mesh->face_offsets[mesh->face_count] + 2 * (uint64_t)mesh->line_count + mesh->point_count;
}

/* A mesh with its place in the world. */
struct zr_instance {
    uint32_t mesh;
    zr_mat4 object_to_world;
    const char *node; /* name of the node that placed it, UTF-8; NULL: none */
};

enum { ZR_LIGHTS_MAX = 1024 };

/* Largest magnitude of an entry of a given or resolved matrix. The product of two entries and a coordinate then fits a
 * float. With three entries it may not: geometry/ drops primitives with infinities and NaN. */
#define ZR_MATRIX_MAX 1e15f

/* Shadings that a light affects. A look's ZR_LIT_CLASSIC lights replace its environment in flat, gouraud and phong. */
enum zr_lit { ZR_LIT_ALL, ZR_LIT_CLASSIC /* flat, gouraud, phong */, ZR_LIT_PBR };

struct zr_light {
    zr_vec3 direction; /* unit vector along which light travels; spot: its axis; hemisphere: towards the sky */
    zr_vec3 color;     /* times intensity; hemisphere: colour of the sky */
    bool camera_frame; /* direction and position are in eye space and move with the camera; else in world space */
    enum zr_light_type type;
    zr_vec3 ground; /* hemisphere: colour of the ground, times intensity */
    bool has_shadows;
    enum zr_lit lit;
    bool environment_frame; /* direction is in the frame of picture.environment and turns with it, even if that is none
                             */

    /* Point and spot lights. `color` is the light at a distance of 1 scene unit; it falls off by the square of the
     * distance. */
    zr_vec3 position;
    float range;                         /* distance from which on there is no light, scene units; 0: no limit */
    double inner_degrees, outer_degrees; /* spot: angles from its axis, 0 <= inner < outer <= 90 */
};

/* True if the light needs a shadow map. */
static inline bool zr_light_casts_shadows(const struct zr_light *light)
{
    return light->has_shadows && ZR_LIGHT_SET_SHADOWED >> light->type & 1;
}

static inline bool zr_light_has_place(const struct zr_light *light)
{
    return ZR_LIGHT_SET_PLACED >> light->type & 1;
}

/* Depth cueing: the share of the fog's colour rises from 0 at depth `near` to 1 at depth `far`. Both are depths along
 * the view axis, in scene units. The background has no fog. */
struct zr_fog {
    bool is_on;
    zr_vec3 color;
    float near, far; /* 0 <= near < far */
};

/* Compression of PNGs: fast, or smaller files for much more time (output/images/png.h). */
enum zr_compress { ZR_COMPRESS_FAST, ZR_COMPRESS_SMALL, ZR_COMPRESS_COUNT };

/* An existing picture, from zraster or elsewhere, that the scene is drawn into: arrays of width * height, row 0 on top.
 * NULL stands for an uncovered array; zr_scene_validate refuses it if an output needs that channel. */
struct zr_base {
    const uint8_t *color; /* RGBA, 4 bytes per pixel */
    const float
        *window_depth;  /* the z-buffer, 0..1, 1 if uncovered; NULL: made from depth (scene/camera/resolved_view.h) */
    const float *depth; /* eye-space depth, scene units, +inf if uncovered */
    const uint32_t *face_id; /* 0 if uncovered */
    bool scene_wins_ties;    /* at equal depth the scene is visible, else the base */
    uint32_t first_face_id;  /* of the scene's geometry; at least 1 */
    uint64_t clamped_depths; /* values of a window_depth made from depth that were in front of near or beyond far */
};

enum { ZR_VIEWS_MOST = 1 };

/* A colour scale with numbers, drawn over the output color (overlay/color_bar.h). */
struct zr_color_bar {
    bool is_on;
    bool is_left;      /* at the left edge, else at the right edge */
    bool has_mesh;     /* scale of `mesh`, else of the first drawn mesh with a scale */
    uint32_t mesh;     /* number in the scene */
    const char *title; /* above the bar, UTF-8; NULL: none */
};

struct zr_look;        /* scene/looks.h */
struct zr_picture;     /* scene/picture.h */
struct zr_view_set;    /* scene/camera/view_set.h */
struct zr_mesh_tables; /* mesh/mesh_tables.h */
struct zr_known_parts; /* render/frame_parts.h */

/* Counts of input that readers left out or replaced. */
struct zr_read_counts {
    uint64_t normals, zero_normals; /* given normals, and zero ones among them, which are computed instead */
    uint32_t zero_normals_mesh;     /* the first mesh with a zero normal */
    uint64_t left_out_cells;        /* cells of height grids beside a hole */
};

/* Facts about a bare mesh's file, for the channel info. All texts are literals. */
struct zr_file_facts {
    const char *unit;      /* unit of its lengths: "millimetre"; NULL: unknown */
    const char *up;        /* its axis that points up: "z"; NULL: not a bare mesh */
    const char *up_source; /* "format", "parameter" or "auto" */
};

struct zr_scene {
    const struct zr_look *look; /* its values are already merged into the other members */
    bool has_open_look;         /* the version of the look is not named */
    zr_vec4 background;
    zr_vec3 ambient;
    struct zr_fog fog;
    const struct zr_picture *picture;
    struct zr_color_bar color_bar;
    struct zr_part_keys parts; /* as read; input/query/part_select.h changes the scene by them */
    const struct zr_csg *csg;  /* solids combined from parts; NULL: none */
    struct zr_sections sections;
    enum zr_algorithm algorithm;
    uint32_t material_count, mesh_count, instance_count, light_count, warning_count;
    const struct zr_material *materials;
    const struct zr_mesh *meshes;
    const struct zr_instance *instances;
    const uint32_t *mesh_owners; /* by mesh: the first mesh of its model file, or itself. NULL: each mesh is its own */
    const struct zr_light *lights;
    enum zr_compress compress;   /* of all PNG outputs */
    const char *const *warnings; /* of input/ and scene/ */
    bool is_strict;              /* warnings are errors */
    bool is_undrawn;             /* nothing is drawn, and all outputs are info */
    uint32_t distance_count;     /* of pairs of parts whose distance info lists */
    const struct zr_part_pair *distances;
    bool has_features;           /* info lists holes and other features of parts */
    struct zr_read_counts counts;
    struct zr_file_facts file;
    const double *origin; /* three numbers that the reader subtracted from all positions; NULL: none */
    bool adds_origin;     /* outputs add it again: a scene in JSON, which gives its places, too */
    struct zr_view views[ZR_VIEWS_MOST];
    struct zr_sheet sheet;                    /* one picture of all views */
    const struct zr_view_set *view_set;       /* several views, made from this scene by views/; NULL: one */
    const struct zr_flow *flow;               /* target of the channel flow; NULL: the scene's own view */
    const struct zr_mesh_tables *tables;      /* shared by several views; NULL: none */
    const struct zr_known_parts *known_parts; /* likewise; NULL: none */
    bool
        has_box; /* a reader has found the bounds, box_min and box_max; zr_bounds_of (scene/camera/camera.h) returns them */
    zr_vec3 box_min, box_max;
    const struct zr_base *base; /* NULL: none */
    uint32_t image_count;
    const struct zr_image *images; /* no two have the same bytes */
    uint32_t texture_count;
    const struct zr_texture *textures;
};

/* Returns 1 + the number of the part of a combined solid that a face belongs to, or 0. */
static inline uint32_t zr_csg_part_of(const struct zr_csg *csg, uint32_t instance, const struct zr_mesh *mesh,
                                      uint32_t face)
{
    return csg->parts[csg->first_parts[instance] + (mesh->face_parts ? mesh->face_parts[face] : 0)];
}

static inline const struct zr_material *zr_material_of_face(const struct zr_scene *scene, const struct zr_mesh *mesh,
                                                            uint32_t face)
{
    return &scene->materials[mesh->face_materials ? mesh->face_materials[face] : mesh->material];
}

/* True if the channel color may show surfaces behind it. */
static inline bool zr_material_is_layered(const struct zr_material *material)
{
    return material->alpha_mode != ZR_ALPHA_OPAQUE || zr_shading_is_layered(material->shading) ||
           zr_material_is_glass(material);
}

static inline bool zr_any_is_xray(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (zr_shading_is_layered(materials[i].shading)) return true;
    return false;
}

static inline bool zr_any_is_glass(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (zr_material_is_glass(&materials[i])) return true;
    return false;
}

static inline bool zr_any_refracts(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (zr_material_refracts(&materials[i])) return true;
    return false;
}

static inline bool zr_any_is_see_through(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (materials[i].alpha_mode != ZR_ALPHA_OPAQUE) return true;
    return false;
}

/* True if the coverage of a material depends on its alpha. */
static inline bool zr_any_is_masked(const struct zr_material *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (materials[i].alpha_mode == ZR_ALPHA_MASK) return true;
    return false;
}

#endif
