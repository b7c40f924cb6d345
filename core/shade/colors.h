/* colors.h - shade: the colours of one mesh's faces, vertices or corners.
 *
 * Each colour is lit once, at the lowest rate that keeps all of them distinct.
 */
#ifndef ZR_COLORS_H
#define ZR_COLORS_H

#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "shade/attribute.h"
#include "shade/lights/light.h"

struct zr_colors {
    enum zr_rate rate;           /* with ZR_RATE_CORNER, flat faces take the colour of their first corner */
    bool two_sided_colors;       /* true if front and back colours may differ */
    const zr_vec4 *front, *back; /* colours of the two sides; one array if they do not differ */
    const uint32_t *packed;      /* replaces `front` and `back` at ZR_RATE_FACE: zr_rgba_opaque of fronts, followed by
                                  * those of backs if two_sided_colors; or NULL */
    uint32_t count;              /* colours per side */
};

/* Returns true if colours vary over a face of this material. */
bool zr_material_is_smooth(const struct zr_mesh *mesh, const struct zr_material *material);

/* Returns true if the material is lit per vertex or face, before visibility. Others are unlit or lit per pixel. */
static inline bool zr_material_is_lit_before(const struct zr_material *material)
{
    return zr_shading_is_at(material->shading, ZR_SHADED_PER_FACE) ||
           zr_shading_is_at(material->shading, ZR_SHADED_PER_VERTEX);
}

/* Returns true if the material is shaded per pixel, other than in linear light. */
static inline bool zr_material_is_per_pixel(const struct zr_material *material)
{
    return zr_shading_is_at(material->shading, ZR_SHADED_PER_PIXEL) && !zr_shading_is_linear(material->shading);
}

/* Return the rate and the number of the colours that zr_colors_make writes. */
enum zr_rate zr_colors_rate(const struct zr_scene *scene, const struct zr_mesh *mesh);
uint32_t zr_colors_count(const struct zr_scene *scene, const struct zr_mesh *mesh);

/* Returns true if the mesh's own colours can be used unchanged: unlit, with one material whose colour is white. *colors
 * points to them. A mesh of a million triangles has 18 MB of them, which are not copied. */
bool zr_colors_are_given(const struct zr_scene *scene, const struct zr_mesh *mesh, struct zr_colors *colors);

/* Returns true if every face is flat: 4 bytes per side then replace 16. */
bool zr_colors_can_be_packed(const struct zr_scene *scene, const struct zr_mesh *mesh);

/* Writes packed colours of such a mesh to out[], which has room for one per face, or two if `two_sided_colors`. Returns
 * early if cancelled. */
struct zr_colors zr_colors_make_packed(const struct zr_run *run, const struct zr_scene *scene,
                                       const struct zr_mesh *mesh, const struct zr_lights *lighting,
                                       const zr_mat4 *object_to_eye, bool two_sided_colors, uint32_t *out);

/* Writes colours to front[] and back[], which the caller allocates. *normals: the mesh's vertex normals
 * (vertex_normals.h), or NULL. If NULL and needed, they are made and returned for other instances of the mesh. Fails
 * only with the arena. Returns early if cancelled. */
struct zr_colors zr_colors_make(const struct zr_run *run, const struct zr_scene *scene, const struct zr_mesh *mesh,
                                const struct zr_lights *lighting, const zr_mat4 *object_to_eye, const zr_vec4 **normals,
                                zr_vec4 *front, zr_vec4 *back);

#endif
