#include "geometry/viewport.h"

struct zr_viewport zr_viewport_make(uint32_t width, uint32_t height)
{
    float half_width = (float)width * 0.5f, half_height = (float)height * 0.5f;
    return (struct zr_viewport){half_width, half_height, half_width, half_height};
}

bool zr_viewport_apply(const struct zr_viewport *viewport, zr_vec4 clip, struct zr_window_vertex *out)
{
    out->oow = 1.0f / clip.w;
    out->x = clip.x * out->oow * viewport->scale_x + viewport->trans_x;
    out->y = clip.y * out->oow * viewport->scale_y + viewport->trans_y;
    out->z = clip.z * out->oow * 0.5f + 0.5f;
    return fabsf(zr_viewport_snap(out->x)) < (float)ZR_SNAP_MAX && fabsf(zr_viewport_snap(out->y)) < (float)ZR_SNAP_MAX;
}
