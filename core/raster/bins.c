#include "raster/bins.h"

#include "raster/primitive.h"

/* Inclusive; empty where x0 > x1 or y0 > y1. */
struct tile_range {
    int32_t x0, y0, x1, y1;
};

static struct tile_range tiles_of(const struct zr_geometry *geometry, uint32_t first, uint32_t width, uint32_t height)
{
    int32_t box[4];
    zr_primitive_box(geometry, first, box);
    /* Clipping leaves rounding: a vertex may stand a hair outside the window. */
    if (box[0] < 0) box[0] = 0;
    if (box[1] < 0) box[1] = 0;
    if (box[2] >= (int32_t)width) box[2] = (int32_t)width - 1;
    if (box[3] >= (int32_t)height) box[3] = (int32_t)height - 1;
    if (box[0] > box[2] || box[1] > box[3]) return (struct tile_range){0, 0, -1, -1};
    return (struct tile_range){box[0] / ZR_TILE_SIZE, box[1] / ZR_TILE_SIZE, box[2] / ZR_TILE_SIZE,
                               box[3] / ZR_TILE_SIZE};
}

static bool is_large(struct tile_range r)
{
    return (r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1) > ZR_BIN_TILES;
}

/* A counting sort: counts, then offsets, then entries, each in the order of the triangles. */
enum zr_status zr_bins_build(struct zr_arena *arena, const struct zr_geometry *geometry, uint32_t width,
                             uint32_t height, struct zr_bins *bins)
{
    uint32_t columns = (width + ZR_TILE_SIZE - 1) / ZR_TILE_SIZE, rows = (height + ZR_TILE_SIZE - 1) / ZR_TILE_SIZE;
    uint32_t *offsets = zr_arena_zero(arena, (size_t)columns * rows + 1, sizeof *offsets);
    if (!offsets) return ZR_NO_MEMORY;
    uint32_t large_count = 0;
    for (uint32_t i = 0; i < geometry->triangle_count; i += zr_primitive_count(geometry, i)) {
        struct tile_range r = tiles_of(geometry, i, width, height);
        if (is_large(r)) {
            large_count++;
            continue;
        }
        for (int32_t y = r.y0; y <= r.y1; y++)
            for (int32_t x = r.x0; x <= r.x1; x++)
                offsets[(uint32_t)y * columns + (uint32_t)x]++;
    }
    uint32_t total = 0;
    for (uint32_t i = 0; i <= columns * rows; i++) {
        uint32_t count = offsets[i];
        offsets[i] = total; /* where the next entry of this tile goes */
        total += count;
    }
    uint32_t *entries = zr_arena_alloc(arena, total, sizeof *entries);
    uint32_t *large = zr_arena_alloc(arena, large_count, sizeof *large);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    large_count = 0;
    for (uint32_t i = 0; i < geometry->triangle_count; i += zr_primitive_count(geometry, i)) {
        struct tile_range r = tiles_of(geometry, i, width, height);
        if (is_large(r)) {
            large[large_count++] = i;
            continue;
        }
        for (int32_t y = r.y0; y <= r.y1; y++)
            for (int32_t x = r.x0; x <= r.x1; x++)
                entries[offsets[(uint32_t)y * columns + (uint32_t)x]++] = i;
    }
    /* Each offset has moved to the end of its tile, which is the begin of the next. */
    for (uint32_t i = columns * rows; i > 0; i--)
        offsets[i] = offsets[i - 1];
    offsets[0] = 0;
    *bins = (struct zr_bins){columns, rows, offsets, entries, large, large_count};
    return ZR_OK;
}
