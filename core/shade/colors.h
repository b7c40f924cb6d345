/* colors.h - shade: the colours of one mesh's faces, vertices or corners.
 *
 * Each colour is lit here, once, at the lowest rate that tells all of them apart.
 */
#ifndef ZR_COLORS_H
#define ZR_COLORS_H

#include "base/team.h"
#include "shade/attribute.h"
#include "shade/lights/light.h"
#include "zraster.h"

struct zr_colors {
    enum zr_rate rate;           /* with ZR_RATE_CORNER, flat faces have that of their first corner */
    bool sided;                  /* the two sides differ, or may */
    const zr_vec4 *front, *back; /* seen from the two sides; one array where they do not differ */
    const uint32_t *packed;      /* or, with ZR_RATE_FACE, these instead, as zr_rgba_opaque: fronts and, where sides
                                    differ, backs behind them */
    uint32_t count;              /* of each side */
};

/* True where the colour varies over a face of this material. */
bool zr_material_is_smooth(const struct zr_mesh *mesh, const struct zr_material *material);

/* Lit at vertices or faces, before it is known what is seen; else unlit, or lit pixel by pixel. */
static inline bool zr_material_is_lit_before(const struct zr_material *material)
{
    return zr_shading_is_at(material->shading, ZR_SHADED_PER_FACE) ||
           zr_shading_is_at(material->shading, ZR_SHADED_PER_VERTEX);
}

/* From its normals, pixel by pixel. */
static inline bool zr_material_is_shaded_late(const struct zr_material *material)
{
    return zr_shading_is_at(material->shading, ZR_SHADED_PER_PIXEL) && !zr_shading_is_linear(material->shading);
}

/* At which rate zr_colors_make will write, and how many colours. */
enum zr_rate zr_colors_rate(const struct zr_scene *scene, const struct zr_mesh *mesh);
uint32_t zr_colors_count(const struct zr_scene *scene, const struct zr_mesh *mesh);

/* True where the mesh has the colours as they are to be seen, unlit and of one material that changes nothing: then
 * *colors says where. A mesh of a million triangles has 18 MB of them, not to be copied. */
bool zr_colors_are_given(const struct zr_scene *scene, const struct zr_mesh *mesh, struct zr_colors *colors);

/* True where every face is flat: four bytes a side, which is what is seen, will do then, and not sixteen. */
bool zr_colors_can_be_packed(const struct zr_scene *scene, const struct zr_mesh *mesh);

/* Packed ones, of such a mesh, to out[], which the caller gives room for: one a face, or two where sides differ.
 * Cancelled, it returns early. */
struct zr_colors zr_colors_make_packed(struct zr_team *team, const struct zr_cancel *cancel,
                                       const struct zr_scene *scene, const struct zr_mesh *mesh,
                                       const struct zr_lights *lighting, const zr_mat4 *object_to_eye, bool sided,
                                       uint32_t *out);

/* Writes them to front[] and back[], which the caller gives room for. *normals are those of the mesh's vertices
 * (vertex_normals.h), or NULL: then they are made where they are needed, and handed out, for other instances of the
 * mesh. Fails only with the arena, which they are taken from. Cancelled, it returns early. */
struct zr_colors zr_colors_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                const struct zr_scene *scene, const struct zr_mesh *mesh,
                                const struct zr_lights *lighting, const zr_mat4 *object_to_eye, const zr_vec4 **normals,
                                zr_vec4 *front, zr_vec4 *back);

#endif
