#include "raster/misc_bins.h"

#include "base/run.h"
#include "raster/line_draw.h"
#include "raster/primitive.h"

enum { PRIMITIVES_PER_CANCEL_CHECK = 4096 };

/* State of two passes: without `entries` they are counted, with `entries` stored. */
struct binning {
    const struct zr_geometry *geometry;
    enum zr_alpha_mode mode;
    uint32_t width, height, columns;
    size_t *offsets;           /* per tile: number of entries, or index of the next one */
    uint32_t *entries, *large; /* NULL in the first pass */
    uint32_t large_count, count;
    const struct zr_draw *draw; /* draw of the current primitive */
    uint32_t number;            /* first number of the current primitive */
};

static void add_to_tile(void *context, uint32_t column, uint32_t row)
{
    struct binning *b = context;
    size_t *offset = &b->offsets[(size_t)row * b->columns + column];
    if (b->entries) b->entries[*offset] = b->number;
    ++*offset;
}

static void add_large(struct binning *b)
{
    if (b->large) b->large[b->large_count] = b->number;
    b->large_count++;
}

static void add_box(struct binning *b)
{
    int32_t box[4];
    zr_primitive_box(b->geometry, b->draw, b->number, box);
    /* Clipping rounds: a vertex may lie slightly outside the window. */
    if (box[0] < 0) box[0] = 0;
    if (box[1] < 0) box[1] = 0;
    if (box[2] >= (int32_t)b->width) box[2] = (int32_t)b->width - 1;
    if (box[3] >= (int32_t)b->height) box[3] = (int32_t)b->height - 1;
    if (box[0] > box[2] || box[1] > box[3]) return;
    for (int k = 0; k < 4; k++)
        box[k] /= ZR_TILE_SIZE;
    if (b->draw->kind != ZR_DRAW_POINTS && (box[2] - box[0] + 1) * (box[3] - box[1] + 1) > ZR_MISC_BINS_TILES) {
        add_large(b);
        return;
    }
    for (int32_t y = box[1]; y <= box[3]; y++)
        for (int32_t x = box[0]; x <= box[2]; x++)
            add_to_tile(b, (uint32_t)x, (uint32_t)y);
}

/* Lists a line in its tiles. It is never large, since it touches few of the tiles in its box. */
static void add_line(struct binning *b)
{
    const struct zr_triangle line = zr_triangle_of(b->geometry, b->draw, b->number);
    struct zr_line_corners corners;
    if (zr_line_corners_make(&b->geometry->vertices[line.v[0]], &b->geometry->vertices[line.v[1]],
                             b->geometry->window.line_width, &corners))
        zr_line_tiles(&corners, b->width, b->height, add_to_tile, b);
}

static bool is_wanted(const struct zr_draw *draw, enum zr_alpha_mode mode)
{
    return !zr_draw_is_plain(draw) && !zr_draw_is_cloud(draw) && zr_draw_mode(draw) == mode;
}

/* Returns false if cancelled. */
static bool add_all(struct binning *b, const struct zr_cancel *cancel)
{
    const struct zr_geometry *geometry = b->geometry;
    b->count = 0;
    b->draw = &geometry->draws[0];
    for (b->number = 0; b->number < geometry->primitive_count;) {
        b->draw = zr_draw_next(geometry, b->draw, b->number);
        if (!is_wanted(b->draw, b->mode)) {
            b->number = b->draw->first + b->draw->count;
            continue;
        }
        if (b->count++ % PRIMITIVES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        if (zr_draw_is_of_lines(b->draw))
            add_line(b);
        else
            add_box(b);
        b->number += zr_primitive_count(geometry, b->draw, b->number);
    }
    return true;
}

/* Counting sort: counts, then offsets, then entries, each in the order of the scene. */
enum zr_status zr_misc_bins_build(const struct zr_run *run, const struct zr_geometry *geometry, enum zr_alpha_mode mode,
                                  uint32_t width, uint32_t height, struct zr_misc_bins *bins)
{
    bool any = false;
    for (uint32_t i = 0; i < geometry->draw_count && !any; i++)
        any = is_wanted(&geometry->draws[i], mode);
    *bins = (struct zr_misc_bins){.count = 0};
    if (!any) return ZR_OK;
    uint32_t columns = zr_tile_across(width);
    size_t tiles = zr_tile_count(width, height), total = 0;
    struct binning binning = {.geometry = geometry, .mode = mode, .width = width, .height = height, .columns = columns};
    binning.offsets = zr_arena_zero(run->arena, tiles + 1, sizeof *binning.offsets);
    if (!binning.offsets) return ZR_NO_MEMORY;
    if (!add_all(&binning, run->cancel)) return ZR_CANCELLED;
    for (size_t i = 0; i <= tiles; i++) {
        size_t count = binning.offsets[i];
        binning.offsets[i] = total;
        total += count;
    }
    binning.entries = zr_arena_alloc(run->arena, total, sizeof *binning.entries);
    binning.large = zr_arena_alloc(run->arena, binning.large_count, sizeof *binning.large);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    binning.large_count = 0;
    if (!add_all(&binning, run->cancel)) return ZR_CANCELLED;
    /* Each offset has advanced to the end of its tile, the start of the next one. */
    for (size_t i = tiles; i > 0; i--)
        binning.offsets[i] = binning.offsets[i - 1];
    binning.offsets[0] = 0;
    *bins = (struct zr_misc_bins){binning.count, binning.offsets, binning.entries, binning.large, binning.large_count};
    return ZR_OK;
}
