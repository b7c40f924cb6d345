#include "render/tiles.h"

#include <stdatomic.h>
#include <string.h>

#include "base/run.h"
#include "render/layers/layers.h"
#include "render/layers/solid_walk.h"
#include "render/resolve.h"

/* Tiles per claim. A claim waits for all earlier stores, so claims of single tiles take longer (3 % of the bunny at
 * 512x512 on two threads). */
enum { TILES_PER_RANGE = 2 };

/* Up to this many tiles, one thread draws all: waking a helper takes longer than it saves. */
enum { TILES_ALONE = 16 };

/* State shared by the threads. */
struct drawing {
    const struct zr_tile_source *tiles;
    enum zr_isa isa;
    const struct zr_frame *frame;
    const struct zr_cancel *cancel;
    uint8_t *occupied;            /* 1 per tile that has a covered pixel */
    atomic_uint_fast64_t covered; /* pixels */
    atomic_uint deepest;          /* bits of a float >= 0, ordered like the float */
};

static void raise_to(atomic_uint *most, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    unsigned old = atomic_load_explicit(most, memory_order_relaxed);
    while (bits > old &&
           !atomic_compare_exchange_weak_explicit(most, &old, bits, memory_order_relaxed, memory_order_relaxed))
        ;
}

bool zr_tile_find_visible(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                          struct zr_tile *tile)
{
    return zr_visibility_tile(tiles->visibility, number, cancel, tile) && zr_solids_put(tiles, number, cancel, tile) &&
           zr_layers_mask(tiles, number, cancel, tile);
}

/* Draws one tile. Returns false if cancelled or out of memory. */
static bool draw_tile(const struct drawing *d, uint32_t number, struct zr_tile *tile, struct zr_resolved *resolved)
{
    const struct zr_tile_source *from = d->tiles;
    struct zr_frame frame = *d->frame;
    struct zr_layers *blended;
    if (!zr_tile_find_visible(from, number, d->cancel, tile) ||
        !zr_layers_blend(from, number, d->cancel, tile, true, &blended))
        return false;
    if (blended) frame.color = NULL; /* zr_layers_put writes it, from the same values */
    *resolved = zr_resolve_tile(from->geometry, from->attributes, d->isa, from->scene, tile, &frame);
    if (!blended) return true;
    const struct zr_pixel_rows colors = zr_resolve_rows(d->frame, tile, ZR_CHANNEL_COLOR);
    resolved->covered += zr_layers_put(from, blended, tile, &colors);
    return true;
}

static void draw_range(void *context, size_t begin, size_t end)
{
    struct drawing *d = context;
    struct zr_tile tile;
    struct zr_resolved resolved;
    uint64_t covered = 0;
    float deepest = 0.0f;
    for (size_t number = begin; number < end; number++) {
        if (!draw_tile(d, (uint32_t)number, &tile, &resolved)) return;
        d->occupied[number] = !tile.is_empty;
        covered += resolved.covered;
        if (resolved.deepest > deepest) deepest = resolved.deepest;
    }
    atomic_fetch_add_explicit(&d->covered, covered, memory_order_relaxed);
    raise_to(&d->deepest, deepest);
}

enum zr_status zr_tiles_draw(const struct zr_run *run, const struct zr_tile_source *tiles, struct zr_frame *frame)
{
    const size_t count = zr_tile_count(frame->width, frame->height);
    struct drawing drawing = {.tiles = tiles,
                              .isa = zr_team_isa(run->team),
                              .frame = frame,
                              .cancel = run->cancel,
                              .occupied = zr_arena_alloc(run->arena, count, 1)};
    if (!drawing.occupied) return ZR_NO_MEMORY;
    zr_team_ranges(count > TILES_ALONE ? run->team : NULL, count, TILES_PER_RANGE, draw_range, &drawing);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    zr_frame_find_spans(frame, drawing.occupied);
    frame->covered_pixels = drawing.covered;
    const unsigned deepest = drawing.deepest;
    memcpy(&frame->deepest, &deepest, sizeof frame->deepest);
    return ZR_OK;
}
