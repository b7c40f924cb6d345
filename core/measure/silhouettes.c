#include "measure/silhouettes.h"

#include "base/arena.h"
#include "base/cancel.h"
#include "measure/ray_lists.h"

enum { RAYS_PER_CANCEL_CHECK = 1 << 16 };

/* Returns the share of rays that meet both solids among those that meet one. */
static double share_of(const struct zr_run *run, const struct zr_ray_hits *seen)
{
    const uint32_t rays = seen->grid.columns * seen->grid.rows;
    uint32_t both = 0, any = 0;
    for (uint32_t i = 0; i < rays; i++) {
        if (i % RAYS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel)) break;
        both += seen->hits[i] == 3;
        any += seen->hits[i] != 0;
    }
    return any > 0 ? (double)both / (double)any : 0.0;
}

enum zr_status zr_silhouettes_find(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                   uint32_t rays, double iou[3])
{
    enum zr_status status = ZR_OK;
    for (int axis = 0; axis < 3 && status == ZR_OK; axis++) {
        struct zr_arena scratch = zr_arena_open_scratch(run->arena);
        const struct zr_run inner = zr_run_in(run, &scratch);
        struct zr_ray_hits hits;
        status = zr_ray_hits_make(&inner, a, b, ZR_RAY_ALONG_X + axis, rays, &hits);
        if (status == ZR_OK) iou[axis] = share_of(run, &hits);
        zr_arena_close_scratch(&scratch, run->arena);
    }
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : status;
}
