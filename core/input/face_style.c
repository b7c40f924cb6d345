#include "input/face_style.h"

#include "input/defaults.h"

const struct zr_face_style zr_face_style_unset = {ZR_UNSET, ZR_UNSET, ZR_UNSET, ZR_UNSET, {0, 0, 0, 1}};

static int said(int first, int second)
{
    return first != ZR_UNSET ? first : second;
}

struct zr_face_style zr_face_style_merge(const struct zr_face_style *first, const struct zr_face_style *second)
{
    const struct zr_face_style *outlined = first->outline != ZR_UNSET ? first : second;
    return (struct zr_face_style){.shading = said(first->shading, second->shading),
                                  .double_sided = said(first->double_sided, second->double_sided),
                                  .fill = said(first->fill, second->fill),
                                  .outline = outlined->outline,
                                  .outline_color = outlined->outline_color};
}

/* Outlines on faces would not be seen in the faces' own colours: they are black unless told otherwise. */
struct zr_material zr_face_style_material(const struct zr_face_style *faces, const struct zr_look *look,
                                          zr_vec4 base_color, bool smooth)
{
    struct zr_material material = look->material;
    material.base_color = base_color;
    material.shading = faces->shading == ZR_UNSET ? zr_default_shading(look, smooth) : (enum zr_shading)faces->shading;
    material.double_sided = faces->double_sided == 1;
    material.unfilled = faces->fill == 0;
    material.outline_color = faces->outline == ZR_OUTLINE_SET_COLOR ? faces->outline_color : (zr_vec4){0, 0, 0, 1};
    if (faces->outline == ZR_OUTLINE_SET_ON) material.outline = material.unfilled ? ZR_OUTLINE_OWN : ZR_OUTLINE_COLORED;
    if (faces->outline == ZR_OUTLINE_SET_COLOR) material.outline = ZR_OUTLINE_COLORED;
    return material;
}
