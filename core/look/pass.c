#include "look/pass.h"

#include "geometry/build.h"
#include "shade/paint.h"

/* Goes on only where the stage before went well. */
#define STAGE(call)                                                                                                    \
    if (status == ZR_OK) status = (call)

enum zr_status zr_pass_make(struct zr_arena *arena, struct zr_team *team, const struct zr_pass_of *of,
                            const struct zr_cancel *cancel, struct zr_pass *pass)
{
    const struct zr_scene *scene = of->scene;
    const uint32_t width = of->window.width, height = of->window.height;
    zr_visibility_fn *window_at_once = zr_visibility_of(scene->algorithm); /* else tile by tile */
    const struct zr_payload *payloads = NULL;
    enum zr_status status = ZR_OK;
    STAGE(zr_geometry_build(arena, team, scene, of->camera, &of->window, cancel, window_at_once, &pass->geometry));
    STAGE(zr_surfaces_make(arena, team, scene, of->camera, &pass->geometry, &of->wants, cancel, &pass->surfaces));
    if (window_at_once) {
        STAGE(zr_visibility_window(arena, &pass->geometry, window_at_once, width, height, of->base, cancel,
                                   &pass->samples));
    } else {
        if (of->wants.colors)
            STAGE(zr_paint_prepare(arena, team, &pass->geometry, &pass->surfaces, (uint64_t)width * height, &payloads));
        STAGE(zr_visible_make(arena, team, &pass->geometry, payloads, width, height, cancel, &pass->visible));
    }
    pass->tiles = (struct zr_tiles){scene, &pass->geometry, &pass->surfaces, window_at_once ? NULL : &pass->visible,
                                    window_at_once ? &pass->samples : NULL};
    return status;
}

struct zr_counts zr_pass_counts(const struct zr_pass *pass)
{
    struct zr_counts counts = pass->geometry.counts;
    if (pass->tiles.visible) zr_counts_add(&counts, &pass->visible.bins.counts);
    return counts;
}
