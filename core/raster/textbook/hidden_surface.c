#include "raster/textbook/hidden_surface.h"

#include "raster/binned_scene.h"
#include "raster/textbook/whole_window.h"

enum zr_status zr_visibility_make(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                                  enum zr_algorithm algorithm, const struct zr_prepaint *prepaints,
                                  const bool listed[ZR_ALPHA_COUNT], const struct zr_base *base,
                                  const struct zr_cancel *cancel, const struct zr_visibility **visibility)
{
    zr_visibility_fn *window_at_once = zr_visibility_of(algorithm);
    if (window_at_once) {
        struct zr_whole_window *window = zr_arena_alloc(arena, 1, sizeof *window);
        if (!window) return ZR_NO_MEMORY;
        *visibility = &window->visibility;
        return zr_whole_window_make(arena, geometry, window_at_once, listed, base, cancel, window);
    }
    struct zr_binned_scene *binned = zr_arena_alloc(arena, 1, sizeof *binned);
    if (!binned) return ZR_NO_MEMORY;
    *visibility = &binned->visibility;
    return zr_binned_scene_make(arena, team, geometry, prepaints, geometry->window.width, geometry->window.height, base,
                                cancel, binned);
}
