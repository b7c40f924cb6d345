#include "geometry/viewport.h"

#include "base/mutant.h"

struct zr_viewport zr_viewport_make(uint32_t width, uint32_t height)
{
    float half_width = (float)width * 0.5f, half_height = (float)height * 0.5f;
    return (struct zr_viewport){half_width, half_height, half_width, half_height};
}

/* Divides a clip-space coordinate by w, multiplying by its reciprocal. */
static float over_w(float value, float w, float oow)
{
    return ZR_MUTANT(divided_by_w, value * oow, value / w);
}

bool zr_viewport_apply(const struct zr_viewport *viewport, zr_vec4 clip, struct zr_window_vertex *out)
{
    out->oow = 1.0f / clip.w;
    out->x = over_w(clip.x, clip.w, out->oow) * viewport->scale_x + viewport->trans_x;
    out->y = over_w(clip.y, clip.w, out->oow) * viewport->scale_y + viewport->trans_y;
    out->z = over_w(clip.z, clip.w, out->oow) * 0.5f + 0.5f;
    return fabsf(zr_viewport_snap(out->x)) < (float)ZR_SNAP_MAX && fabsf(zr_viewport_snap(out->y)) < (float)ZR_SNAP_MAX;
}
