#include "shade/frame.h"

#include "raster/tile.h"
#include "scene/camera/resolved_view.h"
#include "scene/output.h"

void zr_frame_open(const struct zr_resolved_view *resolved, struct zr_frame *frame)
{
    const struct zr_view *view = resolved->view;
    frame->view = view;
    frame->width = view->width;
    frame->height = view->height;
    frame->bounds = resolved->bounds;
    frame->camera = resolved->camera;
    frame->flow_camera = resolved->flow_camera;
}

enum zr_status zr_frame_make(struct zr_arena *arena, const struct zr_resolved_view *resolved, struct zr_frame *frame)
{
    const struct zr_view *view = resolved->view;
    const size_t pixels = (size_t)view->width * view->height;
    zr_frame_open(resolved, frame);
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        const size_t words = zr_channel_rows[c].words;
        if (words > 0 && zr_view_needs(view, (enum zr_channel)c))
            frame->channels[c] = zr_arena_alloc(arena, pixels, 4 * words);
    }
    frame->spans = zr_arena_alloc(arena, frame->height, sizeof *frame->spans);
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* Returns the span of one row of tiles. */
static struct zr_column_span span_of(const uint8_t *occupied, uint32_t columns, uint32_t width)
{
    uint32_t begin = 0, end = columns;
    while (begin < end && !occupied[begin])
        begin++;
    while (end > begin && !occupied[end - 1])
        end--;
    if (begin == end) return (struct zr_column_span){0, 0};
    return (struct zr_column_span){begin * ZR_TILE_SIZE, end < columns ? end * ZR_TILE_SIZE : width};
}

void zr_frame_find_spans(const struct zr_frame *frame, const uint8_t *occupied)
{
    const uint32_t columns = zr_tile_across(frame->width);
    struct zr_column_span span = {0, 0};
    for (uint32_t y = 0; y < frame->height; y++) {
        if (y % ZR_TILE_SIZE == 0)
            span = span_of(occupied + (size_t)(y / ZR_TILE_SIZE) * columns, columns, frame->width);
        frame->spans[frame->height - 1 - y] = span;
    }
}
