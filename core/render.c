/* render.c - the pipeline, from top to bottom. */
#include "zraster.h"

#include <string.h>

#include "geometry/build.h"
#include "raster/visibility.h"
#include "scene/base_depth.h"
#include "scene/scene.h"
#include "scene/sight.h"
#include "shade/frame.h"
#include "shade/paint.h"
#include "shade/resolve.h"

/* Each claim waits for all that was stored before to be written; of single tiles there are too many at the end (3 % of
 * the bunny at 512x512 on two threads). */
enum { TILES_A_RANGE = 2 };

/* Up to so many tiles, waking a helper takes longer than it saves. */
enum { TILES_ALONE = 16 };

/* What the threads share while they draw. */
struct drawing {
    const struct zr_scene *scene;
    const struct zr_geometry *geometry;
    const struct zr_visible *visible; /* of production */
    const struct zr_samples *samples; /* of the other algorithms, else NULL */
    enum zr_isa isa;
    const struct zr_frame *frame;
    const struct zr_cancel *cancel;
    uint8_t *occupied;            /* tiles that show anything */
    atomic_uint_fast64_t covered; /* pixels */
    atomic_uint deepest;          /* the bits of a float that is not negative, which are as great as it is */
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

static void draw_tiles(void *context, size_t begin, size_t end)
{
    struct drawing *d = context;
    struct zr_tile tile;
    uint64_t covered = 0;
    float deepest = 0.0f;
    for (size_t number = begin; number < end; number++) {
        if (d->samples)
            zr_visibility_load(d->samples, (uint32_t)number, &tile);
        else if (!zr_visibility_tile(d->visible, (uint32_t)number, d->frame->base, d->cancel, &tile))
            return;
        const struct zr_resolved resolved = zr_resolve_tile(d->geometry, d->isa, d->scene, &tile, d->frame);
        d->occupied[number] = !tile.is_empty;
        covered += resolved.covered;
        if (resolved.deepest > deepest) deepest = resolved.deepest;
    }
    atomic_fetch_add_explicit(&d->covered, covered, memory_order_relaxed);
    raise_to(&d->deepest, deepest);
}

/* The channels that the outputs are made of. */
static enum zr_status make_frame(struct zr_arena *arena, const struct zr_scene *scene, struct zr_frame *frame)
{
    size_t pixels = (size_t)scene->width * scene->height;
    frame->width = scene->width;
    frame->height = scene->height;
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        const bool counted = c == ZR_CHANNEL_FACE_ID && zr_scene_wants(scene, ZR_CHANNEL_INFO);
        const size_t words = zr_channel_rows[c].words;
        if (words > 0 && (counted || zr_scene_wants(scene, (enum zr_channel)c)))
            frame->channels[c] = zr_arena_alloc(arena, pixels, 4 * words);
    }
    frame->reaches = zr_arena_alloc(arena, frame->height, sizeof *frame->reaches);
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

static enum zr_status run_pipeline(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                   const struct zr_sight *sight, const struct zr_cancel *cancel, struct zr_frame *frame,
                                   struct zr_error *error)
{
    enum zr_status status;
    struct zr_geometry geometry;
    struct zr_visible visible;
    struct zr_samples samples;
    zr_visibility_fn *window_at_once = zr_visibility_of(scene->algorithm);

    if (!sight && (status = zr_sight_find(arena, team, scene, cancel, &sight, error)) != ZR_OK) return status;
    frame->bounds = sight->bounds;
    frame->camera = sight->camera;
    if ((status = make_frame(arena, scene, frame)) != ZR_OK) return status;
    if ((status = zr_base_place(arena, scene, &frame->camera, &frame->base, error)) != ZR_OK) return status;
    status = zr_geometry_build(arena, team, scene, &frame->camera, cancel, window_at_once != NULL, &geometry);
    if (status != ZR_OK) return status;
    const size_t pixels = (size_t)scene->width * scene->height;
    if (frame->color && (status = zr_paint_prepare(arena, team, &geometry, pixels)) != ZR_OK) return status;
    if (window_at_once)
        status = zr_visibility_window(arena, &geometry, window_at_once, scene->width, scene->height, frame->base,
                                      cancel, &samples);
    else
        status = zr_visible_make(arena, team, &geometry, scene->width, scene->height, cancel, &visible);
    if (status != ZR_OK) return status;
    const size_t tiles = zr_tile_count(scene->width, scene->height);
    uint8_t *occupied = zr_arena_alloc(arena, tiles, 1);
    if (!occupied) return ZR_NO_MEMORY;
    struct drawing drawing = {.scene = scene,
                              .geometry = &geometry,
                              .visible = &visible,
                              .samples = window_at_once ? &samples : NULL,
                              .isa = zr_team_isa(team),
                              .frame = frame,
                              .cancel = cancel,
                              .occupied = occupied};
    zr_team_ranges(tiles > TILES_ALONE ? team : NULL, tiles, TILES_A_RANGE, draw_tiles, &drawing);
    if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
    zr_frame_find_reaches(frame, occupied);
    frame->counts = geometry.counts;
    frame->covered_pixels = drawing.covered;
    const unsigned deepest = drawing.deepest;
    memcpy(&frame->deepest, &deepest, sizeof frame->deepest);
    return ZR_OK;
}

enum zr_status zr_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                         const struct zr_sight *sight, const struct zr_cancel *cancel, const struct zr_frame **out,
                         struct zr_error *error)
{
    struct zr_frame *frame = zr_arena_zero(arena, 1, sizeof *frame);
    enum zr_status status = frame ? run_pipeline(arena, team, scene, sight, cancel, frame, error) : ZR_NO_MEMORY;
    if (status == ZR_NO_MEMORY)
        zr_error_add(error, status, NULL, "rendering needs more than the %zu bytes a request may use", arena->ceiling);
    if (status == ZR_CANCELLED) zr_error_add(error, status, NULL, "rendering was stopped before it was done");
    if (status == ZR_INTERNAL) zr_error_add(error, status, NULL, "it could not be decided who is seen");
    *out = frame;
    return status;
}
