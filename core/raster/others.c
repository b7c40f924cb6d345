#include "raster/others.h"

#include "raster/line_draw.h"
#include "raster/primitive.h"

enum { PRIMITIVES_A_CANCEL_CHECK = 4096 };

/* Two passes: without `entries` they are counted, with them they are filled in. */
struct binning {
    const struct zr_geometry *geometry;
    uint32_t width, height, columns;
    size_t *offsets;                  /* by tile: so many entries, or where the next one goes */
    struct zr_other *entries, *large; /* or NULL */
    uint32_t large_count, count;
    struct zr_other other; /* under way */
};

static void add_to_tile(void *context, uint32_t column, uint32_t row)
{
    struct binning *b = context;
    size_t *offset = &b->offsets[(size_t)row * b->columns + column];
    if (b->entries) b->entries[*offset] = b->other;
    ++*offset;
}

static void add_large(struct binning *b)
{
    if (b->large) b->large[b->large_count] = b->other;
    b->large_count++;
}

static void add_box(struct binning *b)
{
    int32_t box[4];
    zr_primitive_box(b->geometry, b->other.first, box);
    /* Clipping leaves rounding: a vertex may stand a hair outside the window. */
    if (box[0] < 0) box[0] = 0;
    if (box[1] < 0) box[1] = 0;
    if (box[2] >= (int32_t)b->width) box[2] = (int32_t)b->width - 1;
    if (box[3] >= (int32_t)b->height) box[3] = (int32_t)b->height - 1;
    if (box[0] > box[2] || box[1] > box[3]) return;
    for (int k = 0; k < 4; k++)
        box[k] /= ZR_TILE_SIZE;
    if ((box[2] - box[0] + 1) * (box[3] - box[1] + 1) > ZR_OTHERS_TILES) {
        add_large(b);
        return;
    }
    for (int32_t y = box[1]; y <= box[3]; y++)
        for (int32_t x = box[0]; x <= box[2]; x++)
            add_to_tile(b, (uint32_t)x, (uint32_t)y);
}

/* A line touches few of the tiles in its box, so it is never large. */
static void add_line(struct binning *b, const struct zr_triangle *record)
{
    struct zr_line_corners line;
    if (zr_line_corners_make(&b->geometry->vertices[record->v[0]], &b->geometry->vertices[record->v[1]], &line))
        zr_line_tiles(&line, b->width, b->height, add_to_tile, b);
}

/* False where it was cancelled. */
static bool add_all(struct binning *b, const struct zr_cancel *cancel)
{
    const struct zr_geometry *geometry = b->geometry;
    b->count = 0;
    for (uint32_t i = 0; i < geometry->batch_count; i++) {
        const struct zr_batch *batch = &geometry->batches[i];
        if (batch->plain) continue;
        uint32_t end = batch->first_record + batch->count;
        b->other = (struct zr_other){batch->first_record, batch->first - batch->first_record};
        for (; b->other.first < end; b->other.first += zr_primitive_count(geometry, b->other.first)) {
            const struct zr_triangle *record = &geometry->triangles[b->other.first];
            if (b->count++ % PRIMITIVES_A_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
            if (record->line)
                add_line(b, record);
            else
                add_box(b);
        }
    }
    return true;
}

/* A counting sort: counts, then offsets, then entries, each in the order of the records. */
enum zr_status zr_others_build(struct zr_arena *arena, const struct zr_geometry *geometry, uint32_t width,
                               uint32_t height, const struct zr_cancel *cancel, struct zr_others *others)
{
    bool any = false;
    for (uint32_t i = 0; i < geometry->batch_count && !any; i++)
        any = !geometry->batches[i].plain;
    *others = (struct zr_others){.count = 0};
    if (!any) return ZR_OK;
    uint32_t columns = zr_tile_across(width);
    size_t tiles = zr_tile_count(width, height), total = 0;
    struct binning binning = {.geometry = geometry, .width = width, .height = height, .columns = columns};
    binning.offsets = zr_arena_zero(arena, tiles + 1, sizeof *binning.offsets);
    if (!binning.offsets) return ZR_NO_MEMORY;
    if (!add_all(&binning, cancel)) return ZR_CANCELLED;
    for (size_t i = 0; i <= tiles; i++) {
        size_t count = binning.offsets[i];
        binning.offsets[i] = total;
        total += count;
    }
    binning.entries = zr_arena_alloc(arena, total, sizeof *binning.entries);
    binning.large = zr_arena_alloc(arena, binning.large_count, sizeof *binning.large);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    binning.large_count = 0;
    if (!add_all(&binning, cancel)) return ZR_CANCELLED;
    /* Each offset has moved to the end of its tile, which is the begin of the next. */
    for (size_t i = tiles; i > 0; i--)
        binning.offsets[i] = binning.offsets[i - 1];
    binning.offsets[0] = 0;
    *others = (struct zr_others){binning.count, binning.offsets, binning.entries, binning.large, binning.large_count};
    return ZR_OK;
}
