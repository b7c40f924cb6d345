#include "scene/face_style.h"

#include "scene/defaults.h"

struct zr_alpha_range zr_alpha_range_of(const zr_vec4 *colors, size_t count)
{
    if (!colors || count == 0) return zr_alpha_opaque;
    struct zr_alpha_range range = {colors[0].w, colors[0].w};
    for (size_t i = 1; i < count; i++) {
        range.least = colors[i].w < range.least ? colors[i].w : range.least;
        range.most = colors[i].w > range.most ? colors[i].w : range.most;
    }
    return range;
}

struct zr_alpha_range zr_alpha_range_times(struct zr_alpha_range a, struct zr_alpha_range b)
{
    return (struct zr_alpha_range){a.least * b.least, a.most * b.most};
}

/* Default of glTF. */
#define ALPHA_CUTOFF 0.5f

const struct zr_face_style zr_face_style_unset = {ZR_UNSET,     ZR_UNSET, ZR_UNSET, ZR_UNSET,
                                                  {0, 0, 0, 1}, ZR_UNSET, ZR_UNSET};

static int first_set(int first, int second)
{
    return first != ZR_UNSET ? first : second;
}

struct zr_face_style zr_face_style_merge(const struct zr_face_style *first, const struct zr_face_style *second)
{
    const struct zr_face_style *outlined = first->outline != ZR_UNSET ? first : second;
    return (struct zr_face_style){.shading = first_set(first->shading, second->shading),
                                  .double_sided = first_set(first->double_sided, second->double_sided),
                                  .fill = first_set(first->fill, second->fill),
                                  .outline = outlined->outline,
                                  .outline_color = outlined->outline_color,
                                  .alpha_mode = first_set(first->alpha_mode, second->alpha_mode),
                                  .alpha_cutoff =
                                      first->alpha_cutoff >= 0.0f ? first->alpha_cutoff : second->alpha_cutoff};
}

/* Outlines of filled faces are black unless the style has a colour: in the faces' colours they would not show. */
struct zr_material zr_face_style_material(const struct zr_face_style *faces, const struct zr_look *look,
                                          zr_vec4 base_color, bool smooth)
{
    struct zr_material material = look->material;
    material.base_color = base_color;
    material.shading = faces->shading == ZR_UNSET ? zr_default_shading(look, smooth) : (enum zr_shading)faces->shading;
    material.double_sided = faces->double_sided == 1;
    material.unfilled = faces->fill == 0;
    if (faces->alpha_mode != ZR_UNSET) material.alpha_mode = (enum zr_alpha_mode)faces->alpha_mode;
    if (material.alpha_mode == ZR_ALPHA_MASK)
        material.alpha_cutoff = faces->alpha_cutoff >= 0.0f ? faces->alpha_cutoff : ALPHA_CUTOFF;
    material.outline_color = faces->outline == ZR_OUTLINE_SET_COLOR ? faces->outline_color : (zr_vec4){0, 0, 0, 1};
    if (faces->outline == ZR_OUTLINE_SET_ON) material.outline = material.unfilled ? ZR_OUTLINE_OWN : ZR_OUTLINE_COLORED;
    if (faces->outline == ZR_OUTLINE_SET_COLOR) material.outline = ZR_OUTLINE_COLORED;
    return material;
}
