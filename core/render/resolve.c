#include "render/resolve.h"

#include <assert.h>
#include <string.h>

#include "base/fast.h"
#include "base/rgba.h"
#include "raster/halfspace.h"
#include "scene/output.h"
#include "shade/depths.h"
#include "shade/paint.h"
#include "shade/visible_points.h"

/* Copies the base to `count` uncovered pixels, starting at index `pixel`. The base's depths in the tile serve only the
 * depth test. Returns the greatest finite depth copied. */
static float resolve_base(const struct zr_frame *frame, size_t pixel, int32_t count)
{
    const struct zr_base *base = frame->base;
    const size_t bytes = (size_t)count * 4;
    float deepest = 0.0f;
    for (size_t i = pixel; frame->depth && base->depth && i < pixel + (size_t)count; i++) {
        const float depth = frame->depth[i] = base->depth[i];
        if (depth > deepest && depth < INFINITY) deepest = depth;
    }
    if (frame->face_id && base->face_id) memcpy(frame->face_id + pixel, base->face_id + pixel, bytes);
    if (frame->window_depth && base->window_depth)
        memcpy(frame->window_depth + pixel, base->window_depth + pixel, bytes);
    return deepest;
}

static float resolve_base_runs(const struct zr_paint *paint, const struct zr_tile *tile, const struct zr_frame *frame,
                               size_t pixel)
{
    float deepest = 0.0f;
    for (int32_t y = 0; y < tile->height; y++, pixel -= frame->width) {
        const uint32_t *owners = &tile->owner[y * ZR_TILE_STRIDE];
        int32_t begin = 0, end;
        for (uint64_t ends = paint->ends(owners, tile->width); ends; ends &= ends - 1, begin = end) {
            end = __builtin_ctzll(ends) + 1;
            if (owners[begin] != 0) continue;
            const float depth = resolve_base(frame, pixel + (size_t)begin, end - begin);
            if (depth > deepest) deepest = depth;
        }
    }
    return deepest;
}

/* Frames of at least this size exceed the caches, so streaming stores bypass them. The bunny takes 0.4 ms less at
 * 512x512 and 0.5 ms at 1920x1080, a mesh of a million triangles 4 ms. Frames drawn to the same memory and read at once
 * get 3 % slower. */
enum { STREAMED_PIXELS = 1 << 18 };

/* Returns true if the tile's rows are whole cache lines and the frame is large. */
static bool is_streamed(const struct zr_frame *frame, const struct zr_tile *tile)
{
    const uint32_t line = 64 / 4;
    return ZR_FAST(streamed, (uint64_t)frame->width * frame->height >= STREAMED_PIXELS && frame->width % line == 0 &&
                                 tile->width == ZR_TILE_SIZE);
}
_Static_assert(ZR_ARENA_ALIGN == 64, "so are those of the first row");

/* Returns the index of the tile's lowest left pixel in a channel. */
static size_t lowest_pixel_of(const struct zr_frame *frame, const struct zr_tile *tile)
{
    /* Window space has y up, pictures have row 0 on top. */
    const uint32_t row = ZR_MUTANT(upside_down, frame->height - 1 - (uint32_t)tile->y, (uint32_t)tile->y);
    return (size_t)row * frame->width + (size_t)tile->x;
}

/* Returns the tile's rows in an array of `words` words per pixel. `array` NULL: `first` is NULL. */
static struct zr_pixel_rows rows_in(const struct zr_frame *frame, const struct zr_tile *tile, void *array,
                                    uint32_t words)
{
    const ptrdiff_t stride = (ptrdiff_t)frame->width * (ptrdiff_t)words;
    return (struct zr_pixel_rows){.first = array ? (uint32_t *)array + lowest_pixel_of(frame, tile) * words : NULL,
                                  .stride = ZR_MUTANT(upside_down, -stride, stride),
                                  .streamed = is_streamed(frame, tile)};
}

struct zr_pixel_rows zr_resolve_rows(const struct zr_frame *frame, const struct zr_tile *tile, enum zr_channel channel)
{
    return rows_in(frame, tile, frame->channels[channel], zr_channel_rows[channel].words);
}

/* Fills the tile with the clear value of each channel. */
static void fill_all(const struct zr_paint *paint, const struct zr_frame *frame, const struct zr_tile *tile,
                     uint32_t background)
{
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        const struct zr_channel_row *row = &zr_channel_rows[c];
        const struct zr_pixel_rows rows = zr_resolve_rows(frame, tile, (enum zr_channel)c);
        const uint32_t clear_value = c == ZR_CHANNEL_COLOR ? background : row->clear_value;
        if (rows.first) paint->fill(&rows, tile->width * (int32_t)row->words, tile->height, clear_value);
    }
}

static void copy_owners(const struct zr_tile *tile, const struct zr_frame *frame)
{
    uint32_t *out = frame->owners + lowest_pixel_of(frame, tile);
    for (int32_t y = 0; y < tile->height; y++)
        memcpy(out - (ptrdiff_t)y * (ptrdiff_t)frame->width, tile->owner + (ptrdiff_t)y * ZR_TILE_STRIDE,
               (size_t)tile->width * sizeof *out);
}

static float resolve_depth(const struct zr_geometry *geometry, enum zr_isa isa, struct zr_tile *tile,
                           const struct zr_frame *frame)
{
    const struct zr_paint *paint = zr_paint_of(isa);
    const struct zr_pixel_rows rows = zr_resolve_rows(frame, tile, ZR_CHANNEL_DEPTH);
    const float deepest =
        zr_depths_tile(geometry, zr_eye_depths_of(isa), paint->ends, frame->width, frame->height, tile);
    paint->copy(&rows, tile->width, tile->height, tile->depth);
    return deepest;
}

/* Fills the rows of the matrix from eye space to `space`, for normals. For the world, they are the columns of
 * world_to_eye. */
static void normals_to_space(const zr_mat4 *world_to_eye, enum zr_space space, float rows[3][3])
{
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            rows[row][column] = space == ZR_SPACE_WORLD ? world_to_eye->m[4 * row + column]
                                : row == column         ? 1.0f
                                                        : 0.0f;
}

static void shade(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                  const struct zr_paint *paint, uint32_t clear_value, const struct zr_tile *tile,
                  const struct zr_frame *frame)
{
    const struct zr_base *base = frame->base;
    struct zr_tile_targets to = {.clear_value = clear_value};
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        to.channels[c] = zr_resolve_rows(frame, tile, (enum zr_channel)c);
    if (base) to.behind = rows_in(frame, tile, (void *)(uintptr_t)base->color, 1);
    normals_to_space(&frame->camera.world_to_eye, zr_view_space(frame->view, ZR_CHANNEL_NORMALS), to.normals_to_space);
    paint->shade(geometry, attributes, tile, &to);
    const struct zr_pixel_rows *faces = &to.channels[ZR_CHANNEL_FACE_ID];
    for (int32_t y = 0; frame->face_id && base && y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++)
            if (tile->owner[y * ZR_TILE_STRIDE + x] > 0) faces->first[y * faces->stride + x] += base->first_face_id - 1;
}

struct zr_resolved zr_resolve_tile(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                                   enum zr_isa isa, const struct zr_scene *scene, struct zr_tile *tile,
                                   const struct zr_frame *frame)
{
    const struct zr_paint *paint = zr_paint_of(isa);
    const uint32_t clear_value = zr_rgba_make(scene->background);
    struct zr_resolved resolved = {0, 0.0f};
    /* Shortcuts for whole tiles and blocks ignore a base: its pixels and its first_face_id. zr_tile_begin disables
     * them. */
    assert(!frame->base || (!tile->is_empty && !tile->has_block_owners));
    if (tile->is_empty) {
        fill_all(paint, frame, tile, clear_value);
        return resolved;
    }
    /* Depths come last: streaming stores delay the loads that follow (fills take 7 % longer). */
    shade(geometry, attributes, paint, clear_value, tile, frame);
    if (frame->window_depth) {
        const struct zr_pixel_rows rows = zr_resolve_rows(frame, tile, ZR_CHANNEL_WINDOW_DEPTH);
        paint->depths(tile, &rows);
    }
    const bool points = zr_visible_points_are_wanted(frame);
    if (frame->depth || frame->owners || points) zr_halfspace_of(isa)->flush(tile); /* these read every sample */
    if (frame->owners) copy_owners(tile, frame);
    if (points) {
        const struct zr_depths_of of = {geometry, zr_eye_depths_of(isa), zr_eye_points_of(isa), paint->ends};
        zr_visible_points_tile(&of, zr_view_space(frame->view, ZR_CHANNEL_POSITION), tile, frame);
    }
    if (frame->depth) resolved.deepest = resolve_depth(geometry, isa, tile, frame);
    if (frame->base) {
        const float deepest = resolve_base_runs(paint, tile, frame, lowest_pixel_of(frame, tile));
        if (deepest > resolved.deepest) resolved.deepest = deepest;
    }
    resolved.covered = paint->count(tile);
    return resolved;
}
