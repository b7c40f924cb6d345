#include "raster/textbook/algorithms.h"

enum { PRIMITIVES_PER_CANCEL_CHECK = 1024 };

zr_visibility_fn *zr_visibility_of(enum zr_algorithm algorithm)
{
    static zr_visibility_fn *const table[ZR_ALGORITHM_COUNT] = {
        [ZR_ALGORITHM_HALFSPACE] = NULL,         [ZR_ALGORITHM_EDGELIST] = zr_edgelist,
        [ZR_ALGORITHM_TRAPEZOID] = zr_trapezoid, [ZR_ALGORITHM_SCANLINE] = zr_scanline,
        [ZR_ALGORITHM_PAINTER] = zr_painter,
    };
    return table[algorithm];
}

enum zr_status zr_primitives_make(struct zr_arena *arena, const struct zr_geometry *geometry,
                                  const struct zr_samples *samples, const struct zr_cancel *cancel,
                                  struct zr_primitives *primitives)
{
    const struct zr_draw *draw = &geometry->draws[0];
    uint32_t room = 0, step, visited = 0;
    for (uint32_t first = 0; first < geometry->primitive_count; first += step, room++) {
        draw = zr_draw_next(geometry, draw, first);
        step = zr_primitive_count(geometry, draw, first);
    }
    *primitives = (struct zr_primitives){0, zr_arena_alloc(arena, room, sizeof *primitives->items)};
    if (!primitives->items) return ZR_NO_MEMORY;
    for (uint32_t first = 0; first < geometry->primitive_count; first += step) {
        if (visited++ % PRIMITIVES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return ZR_CANCELLED;
        struct zr_primitive *primitive = &primitives->items[primitives->count];
        draw = zr_draw_next(geometry, draw, first);
        step = zr_primitive_count(geometry, draw, first);
        if (!zr_samples_take(samples, draw)) continue;
        zr_primitive_make(geometry, draw, first, samples->width, samples->height, primitive);
        if (!zr_primitive_is_empty(primitive)) primitives->count++;
    }
    return ZR_OK;
}
