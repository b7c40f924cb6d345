/* draw_attributes.h - shade: what each draw shows: its colours, and whatever else its shading and the channels want.
 *
 * Values are made before it is known what is seen: vertices are lit once. Where clipping made vertices, what varies is
 * cut as they were (geometry/cut.h), after it was lit and kept within 0..1.
 */
#ifndef ZR_DRAW_ATTRIBUTES_H
#define ZR_DRAW_ATTRIBUTES_H

#include "base/team.h"
#include "geometry/geometry.h"
#include "shade/attribute.h"
#include "shade/lights/light.h"
#include "shade/texture_maps.h"

enum {
    ZR_ATTRIBUTE_COLOR,
    ZR_ATTRIBUTE_BACK_COLOR, /* at the same rate; where backs are not drawn in colours of their own, there are none */
    ZR_ATTRIBUTE_NORMAL,     /* of fronts, in eye space (eye_normals.h) */
    ZR_ATTRIBUTE_POINT,      /* xyz: the way from the eye, times w: that is linear over a face, as the quotient is not;
                                w: how deep the vertex lies along the view axis, for fog */
    ZR_ATTRIBUTE_TEXCOORD,   /* x, y: where the base colour's texture is looked at, transformed; of samples: those that
                                the mesh has, 0 in x, y and 1 in z, w */
    ZR_ATTRIBUTE_TANGENT,    /* of samples: of fronts, in eye space, unit, and the sign of the bitangent; or none */
    ZR_ATTRIBUTE_COUNT
};

/* Of one draw. */
struct zr_draw_attributes {
    const struct zr_draw *draw;
    struct zr_attribute attributes[ZR_ATTRIBUTE_COUNT];
    const uint32_t *packed; /* colours of faces, as zr_rgba_opaque, fronts and, where there are backs, those behind
                               them: instead of values, or beside them; NULL: not made */
    uint32_t color_count;   /* fronts, without those that clipping made */
    uint32_t material;      /* its number in the scene */
    bool sided;             /* backs are drawn, in colours of their own */
    bool is_per_pixel;      /* zr_material_is_shaded_late, or in fog, or textured */
    const uint32_t *backs;  /* those of its zr_prepaint (zr_paint_prepare), which sorting fills in; NULL: it has none */
};

/* What is wanted of surfaces. */
struct zr_attribute_wants {
    bool colors;  /* as pixels show them, lit where that is done before it is known what is seen */
    bool normals; /* of all faces: the channel normals */
    bool layers;  /* lists of what is blended, whether or not colours are wanted */
    /* Of all draws, the surface's own colour, normals and points: what a G-buffer is made of (gbuffer.h). */
    bool samples;
    /* Then: of each mesh, one a corner, in object space (crease_normals.h), where it has none of its own; NULL: no mesh
     * has any. */
    const zr_vec4 *const *crease_normals;
    struct zr_texture_maps textures; /* of colours and samples; none: those are without */
};

struct zr_scene_attributes {
    struct zr_draw_attributes *of_draw; /* one a draw */
    bool any_late, any_textured;
    bool texcoords_as_given; /* else they are places in the image of the base colour */
    struct zr_texture_maps textures;
    struct zr_fog fog;
    zr_vec4 eye; /* zr_camera_eye */
    struct zr_lights lighting;
};

/* By the team's threads and instruction set. Everything points into the arena, to the scene and to the geometry. ZR_OK,
 * ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_scene_attributes_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                        const struct zr_camera *camera, const struct zr_geometry *geometry,
                                        const struct zr_attribute_wants *wants, const struct zr_cancel *cancel,
                                        struct zr_scene_attributes *surfaces);

static inline bool zr_draw_is_smooth(const struct zr_draw_attributes *surface)
{
    const struct zr_attribute *color = &surface->attributes[ZR_ATTRIBUTE_COLOR];
    return color->values && !zr_rate_is_flat(color->rate);
}

#endif
