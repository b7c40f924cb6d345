/* draw_attributes.h - shade: the vertex attributes of each draw: colours, and the inputs of its shading and channels.
 *
 * All values are made before visibility, so vertices are lit once. Points and normals of large meshes are the
 * exception: they are made when they are loaded, as most of their triangles are hidden or cover a few samples, and
 * arrays would take up to 96 bytes per triangle. Vertices that clipping made get interpolated values (geometry/cut.h),
 * from colours that are lit and clamped to 0..1.
 */
#ifndef ZR_DRAW_ATTRIBUTES_H
#define ZR_DRAW_ATTRIBUTES_H

#include "base/run.h"
#include "base/team.h"
#include "geometry/geometry.h"
#include "shade/attribute.h"
#include "shade/eye_normals.h"
#include "shade/eye_vectors.h"
#include "shade/lights/light.h"
#include "shade/texture_maps.h"

enum {
    ZR_ATTRIBUTE_COLOR,
    ZR_ATTRIBUTE_BACK_COLOR, /* at the same rate; only if backs are drawn in colours of their own */
    ZR_ATTRIBUTE_NORMAL,     /* of the front side, in eye space (eye_normals.h) */
    ZR_ATTRIBUTE_POINT,      /* xyz: vector from the eye, times w, which is linear over a face; w: distance along the
                              * view axis, for fog */
    ZR_ATTRIBUTE_TEXCOORD,   /* x, y: transformed coordinates in the base colour's texture; with `samples`: the mesh's
                              * own, set 0 in x, y and set 1 in z, w */
    ZR_ATTRIBUTE_TANGENT,    /* with `samples`: along u on the front side, eye space, any length, and the bitangent's
                              * sign; or none */
    ZR_ATTRIBUTE_COUNT
};

/* Vertices of a pass, and of the mesh, from which on points and normals are made when they are loaded. Pixels do not
 * depend on it. Otherwise arrays take less time: a triangle is loaded for each patch of samples that it covers, and few
 * triangles of a small mesh are loaded together. In the look studio, 100 meshes of 2930 vertices take a fifth less time
 * without arrays, 400 of 507 as long, 20 000 of 8 a sixth more, and one of 507 1 to 4 % more. */
enum { ZR_LOADED_VERTICES = 1 << 15, ZR_LOADED_MESH = 1 << 10 };

/* Attributes of one draw. Those of clouds are inputs of cloud_values.h. */
struct zr_draw_attributes {
    const struct zr_draw *draw;
    struct zr_attribute attributes[ZR_ATTRIBUTE_COUNT];
    /* Instead of values of ZR_ATTRIBUTE_POINT and ZR_ATTRIBUTE_NORMAL: they are made when they are loaded
     * (eye_values_simd.h, zr_draw_point). NULL: there are values, or none. */
    const struct zr_eye_vectors *points;
    const struct zr_eye_normals *normals;
    const uint32_t *packed; /* face colours as zr_rgba_opaque, fronts, followed by backs if two_sided_colors; instead of
                             * values, or beside them; NULL: none */
    uint32_t color_count;   /* front colours, without those of clipped vertices */
    uint32_t material;      /* number in the scene */
    bool two_sided_colors;  /* backs are drawn in colours of their own */
    bool is_per_pixel;      /* shaded per pixel: zr_material_is_per_pixel, fog or textures */
    zr_vec4 eye;            /* as in zr_scene_attributes */
    const uint32_t *backs;  /* bits of zr_prepaint.backs, which binning fills in (zr_paint_prepare); NULL: none */
};

/* Attributes to make. */
struct zr_attribute_wants {
    bool colors;  /* colours of pixels, lit per vertex or face where the shading is */
    bool normals; /* normals of all faces, for the channel normals */
    bool layers;  /* lists of blended fragments, even without colours */
    /* Base colours, normals and points of all draws, for a G-buffer (gbuffer.h). */
    bool samples;
    /* With `samples`: crease normals per mesh without normals, in object space (crease_normals.h). NULL: none. */
    const struct zr_crease_normals *const *crease_normals;
    struct zr_texture_maps textures; /* textures of colours and samples; empty: untextured */
};

struct zr_scene_attributes {
    struct zr_draw_attributes *of_draw; /* one per draw */
    bool any_per_pixel, any_textured;
    bool texcoords_as_given; /* G-buffer: texcoords are the mesh's own; else coordinates in the base colour's image */
    struct zr_texture_maps textures;
    struct zr_fog fog;
    zr_vec4 eye; /* zr_camera_eye */
    struct zr_lights lighting;
};

/* Makes the attributes with the team's threads and instruction set. *attributes points into the arena, to the scene and
 * to the geometry. Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_scene_attributes_make(const struct zr_run *run, const struct zr_scene *scene,
                                        const struct zr_camera *camera, const struct zr_geometry *geometry,
                                        const struct zr_attribute_wants *wants, struct zr_scene_attributes *attributes);

/* True if shading needs tangents. */
static inline bool zr_material_has_tangents(const struct zr_material *material)
{
    return material->textures[ZR_TEXTURE_NORMAL] || material->textures[ZR_TEXTURE_COAT_NORMAL] ||
           material->finish.anisotropy > 0.0f;
}

static inline bool zr_draw_has_points(const struct zr_draw_attributes *of_draw)
{
    return of_draw->points || of_draw->attributes[ZR_ATTRIBUTE_POINT].values;
}

static inline bool zr_draw_has_normals(const struct zr_draw_attributes *of_draw)
{
    return of_draw->normals || of_draw->attributes[ZR_ATTRIBUTE_NORMAL].values;
}

/* Returns ZR_ATTRIBUTE_POINT of a vertex. The draw has points. */
static inline zr_vec4 zr_draw_point(const struct zr_draw_attributes *of_draw, uint32_t vertex)
{
    return of_draw->points ? zr_eye_vector(of_draw->points, vertex)
                           : of_draw->attributes[ZR_ATTRIBUTE_POINT].values[vertex];
}

static inline bool zr_draw_is_smooth(const struct zr_draw_attributes *of_draw)
{
    const struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    return color->values && !zr_rate_is_flat(color->rate);
}

#endif
