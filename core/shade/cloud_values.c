#include "shade/cloud_values.h"

zr_vec4 zr_cloud_color(const struct zr_draw_attributes *of_draw, uint32_t number)
{
    const struct zr_draw *draw = of_draw->draw;
    const struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    if (color->rate == ZR_RATE_DRAW) return color->values[0];
    return zr_vec4_mul(draw->material->base_color, color->values[zr_cloud_position(draw, number)]);
}

zr_vec4 zr_cloud_point(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, uint32_t number)
{
    const struct zr_draw *draw = of_draw->draw;
    const zr_vec4 *positions = of_draw->attributes[ZR_ATTRIBUTE_POINT].values;
    return zr_eye_point(&geometry->instances[draw->instance].to_eye, of_draw->eye,
                        positions[zr_cloud_position(draw, number)]);
}
