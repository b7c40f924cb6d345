#include "shade/cloud_values.h"

zr_vec4 zr_cloud_color(const struct zr_draw_attributes *of_draw, uint32_t number)
{
    const struct zr_draw *draw = of_draw->draw;
    const struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    if (color->rate == ZR_RATE_DRAW) return color->values[0];
    return zr_vec4_mul(draw->material->base_color, color->values[zr_cloud_position(draw, number)]);
}
