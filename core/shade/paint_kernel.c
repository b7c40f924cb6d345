#include "shade/paint.h"

#include "base/expect.h"
#include "raster/tile_simd.h"
#include "shade/paint_blocks_simd.h"
#include "shade/paint_faces_simd.h"
#include "shade/paint_flat_simd.h"
#include "shade/paint_patches_simd.h"

/* Rows whose runs have so many pixels on average are painted run by run. */
enum { LONG_RUN = 16 };

struct painter {
    struct zr_canvas canvas;
    struct zr_surfaces surfaces;
    struct zr_flat_rows flat;
    struct zr_smooth_queue smooth;
    struct zr_patches patches;
};

/* ---- run by run ---- */

static inline struct zr_plane_v spread_plane(const struct zr_plane *plane)
{
    return (struct zr_plane_v){zr_vf_set(plane->a0), zr_vf_set(plane->dadx), zr_vf_set(plane->dady)};
}

static void paint_long(const struct zr_surface *surface, int32_t first_x, int32_t first_y, uint32_t *pixels,
                       uint32_t count)
{
    const struct zr_color_planes planes = {spread_plane(&surface->oow), spread_plane(&surface->red),
                                           spread_plane(&surface->green), spread_plane(&surface->blue)};
    const zr_vf y = zr_vf_set((float)first_y);
    zr_vf x = zr_vf_set((float)first_x) + zr_vf_ramp();
    for (; count > ZR_LANES; count -= ZR_LANES, pixels += ZR_LANES, x = x + zr_vf_set((float)ZR_LANES))
        zr_vi_store(pixels, zr_color_at(&planes, x, y));
    zr_vi_store_first(pixels, zr_color_at(&planes, x, y), count);
}

static void paint_surface(const struct painter *p, const struct zr_surface *surface, int32_t at, int32_t length)
{
    uint32_t *pixels = p->canvas.colors + at;
    if (surface->flat)
        zr_fill_run(pixels, (uint32_t)length, zr_vi_set((int32_t)surface->color));
    else
        paint_long(surface, p->canvas.x + at % ZR_TILE_STRIDE, p->canvas.y + at / ZR_TILE_STRIDE, pixels,
                   (uint32_t)length);
}

static void add_run(struct painter *p, uint32_t owner, int32_t at, int32_t length)
{
    const struct zr_geometry *geometry = p->canvas.geometry;
    const struct zr_surface *known = zr_surfaces_known(&p->surfaces, owner);
    if (known && (known->flat || length > ZR_SHORT_RUN)) {
        paint_surface(p, known, at, length);
        return;
    }
    const struct zr_batch *batch = zr_surfaces_batch(&p->surfaces, owner);
    const uint32_t t = owner - 1 - batch->first;
    const struct zr_triangle *record = batch->written ? &geometry->triangles[batch->first_record + t] : NULL;
    const bool smooth = record ? !record->line && (record->c[0] != record->c[1] || record->c[1] != record->c[2])
                               : zr_batch_is_smooth(batch);
    if (!smooth || length > ZR_SHORT_RUN) {
        paint_surface(p, zr_surfaces_of(&p->surfaces, owner), at, length);
    } else if (record) {
        const zr_vec4 *colors = record->back ? geometry->back_colors : geometry->front_colors;
        const struct zr_smooth_sides sides = {colors, colors, false};
        zr_smooth_add(&p->smooth, &p->canvas, at, length, 0, record->v, sides, record->c);
    } else {
        const uint32_t colors[3] = {zr_batch_color(batch, t, 0), zr_batch_color(batch, t, 1),
                                    zr_batch_color(batch, t, 2)};
        zr_smooth_add(&p->smooth, &p->canvas, at, length, batch->first_vertex, batch->corners + 3 * (size_t)t,
                      zr_smooth_sides_of(batch), colors);
    }
}

/* ---- rows ---- */

/* A row has room behind its end, so that the last vector may look one owner farther. */
static inline uint64_t find_ends(const uint32_t *owners, int32_t width)
{
    uint64_t out = 0;
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vm same = zr_vi_eq(zr_vi_load(owners + x), zr_vi_load(owners + x + 1));
        out |= (uint64_t)(zr_vm_bits(same) ^ ZR_ALL_BITS) << x;
    }
    const uint64_t last = UINT64_C(1) << (width - 1);
    return (out & (last - 1)) | last;
}

static uint64_t ends(const uint32_t *owners, int32_t width)
{
    return find_ends(owners, width);
}

static inline void paint_backdrop(const struct zr_backdrop *backdrop, uint32_t *owners, int32_t begin, int32_t end)
{
    if (backdrop->row)
        memcpy(owners + begin, backdrop->row + begin, 4 * (size_t)(end - begin));
    else
        zr_fill_run(owners + begin, (uint32_t)(end - begin), backdrop->nothing);
}

/* A row of any owners, whose runs end where `ends` says. All owners are loaded before any run is painted: a load waits
 * long for a store that left out some lanes of what it loads. */
static uint32_t paint_row(struct painter *p, int32_t first, uint64_t ends, const struct zr_backdrop *backdrop)
{
    uint32_t *owners = p->canvas.colors + first, run_owners[ZR_TILE_SIZE], covered = 0, run = 0;
    int32_t begin = 0, end;
    for (uint64_t bits = ends; bits; bits &= bits - 1)
        run_owners[run++] = owners[__builtin_ctzll(bits)];
    run = 0;
    for (uint64_t bits = ends; bits; bits &= bits - 1, begin = end) {
        const uint32_t owner = run_owners[run++];
        end = __builtin_ctzll(bits) + 1;
        if (owner == 0) {
            paint_backdrop(backdrop, owners, begin, end);
            continue;
        }
        add_run(p, owner, first + begin, end - begin);
        covered += (uint32_t)(end - begin);
    }
    if (p->smooth.runs.count > ZR_PAINT_RUNS - ZR_TILE_SIZE) zr_smooth_paint(&p->smooth, &p->canvas, false);
    return covered;
}

/* Whether all owners of the rows are the batch's, or nobody. */
static bool is_alone(const struct painter *p, const struct zr_batch *batch, const uint32_t *owners, int32_t width,
                     int32_t rows)
{
    if (!zr_batch_is_gathered(batch)) return false;
    if (p->canvas.geometry->batch_count == 1) return true;
    for (int32_t row = 0; row < rows; row++)
        if (!zr_row_is_of(batch, owners + row * ZR_TILE_STRIDE, width)) return false;
    return true;
}

/* `rows` rows from `y` on, no more than a patch has. */
static uint32_t paint_rows(struct painter *p, int32_t y, int32_t rows, int32_t width,
                           const struct zr_backdrop *backdrop)
{
    const int32_t first = y * ZR_TILE_STRIDE;
    const struct zr_batch *batch = p->surfaces.batch; /* it may well be the only one here, too */
    uint32_t *owners = p->canvas.colors + first;
    const bool alone = is_alone(p, batch, owners, width, rows), smooth = zr_batch_is_smooth(batch);
    if (alone && !smooth && !backdrop->row) {
        for (int32_t row = 0; row < rows; row++)
            zr_flat_add(&p->flat, batch, owners + row * ZR_TILE_STRIDE);
        return 0; /* counted when they are painted */
    }
    uint64_t ends[ZR_PATCH_ROWS] = {0}; /* gcc 16 does not see that all that are read are set */
    int32_t runs = 0;
    for (int32_t row = 0; row < rows; row++) {
        ends[row] = find_ends(owners + row * ZR_TILE_STRIDE, width);
        runs += __builtin_popcountll(ends[row]);
    }
    if (alone && smooth && runs * LONG_RUN > rows * width)
        return zr_patches_add_rows(&p->patches, &p->canvas, batch, first, width, rows, backdrop);
    struct zr_backdrop here = *backdrop;
    uint32_t covered = 0;
    for (int32_t row = 0; row < rows; row++) {
        covered += paint_row(p, first + row * ZR_TILE_STRIDE, ends[row], &here);
        if (here.row) here.row += here.stride;
    }
    return covered;
}

/* ---- the tile ---- */

static uint32_t paint_all_rows(struct painter *p, const struct zr_tile *tile, struct zr_backdrop backdrop)
{
    uint32_t covered = 0;
    for (int32_t y = 0; y < tile->height; y += ZR_PATCH_ROWS) {
        const int32_t rows = tile->height - y < ZR_PATCH_ROWS ? tile->height - y : ZR_PATCH_ROWS;
        covered += paint_rows(p, y, rows, tile->width, &backdrop);
        if (backdrop.row) backdrop.row += backdrop.stride * rows;
    }
    covered += zr_flat_end(&p->flat);
    zr_patches_end(&p->patches, &p->canvas);
    zr_smooth_paint(&p->smooth, &p->canvas, true);
    return covered;
}

/* Takes pixels whose colours are known out of the owners, so that they are painted as if they were nobody's. Returns
 * how many there are. */
static uint32_t take_known(struct zr_tile *tile)
{
    uint32_t known = 0;
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x += ZR_LANES) {
            const int32_t at = y * ZR_TILE_STRIDE + x;
            const zr_vm unknown = zr_vi_eq(zr_vi_load(tile->color + at), zr_vi_set(0));
            const uint32_t bits = zr_vm_bits(unknown) ^ ZR_ALL_BITS;
            if (!bits) continue;
            known += (uint32_t)__builtin_popcount(bits);
            zr_vi_store(tile->owner + at, zr_vi_select(unknown, zr_vi_load(tile->owner + at), zr_vi_set(0)));
        }
    return known;
}

/* Puts their colours over what was painted there instead. */
static void put_known(struct zr_tile *tile)
{
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x += ZR_LANES) {
            const int32_t at = y * ZR_TILE_STRIDE + x;
            const zr_vi color = zr_vi_load(tile->color + at);
            const zr_vm unknown = zr_vi_eq(color, zr_vi_set(0));
            zr_vi_store(tile->owner + at, zr_vi_select(unknown, zr_vi_load(tile->owner + at), color));
        }
}

static uint32_t paint_tile(const struct zr_geometry *geometry, struct zr_tile *tile, uint32_t nothing,
                           const void *behind, ptrdiff_t stride)
{
    struct painter p;
    const struct zr_backdrop backdrop = {zr_vi_set((int32_t)nothing), behind, stride};
    p.canvas = (struct zr_canvas){geometry, tile->x, tile->y, tile->owner}; /* rows are read before they are painted */
    zr_flat_begin(&p.flat, tile->width, backdrop.nothing);
    zr_surfaces_begin(&p.surfaces, geometry, zr_surface_make);
    zr_smooth_begin(&p.smooth);
    zr_patches_begin(&p.patches);
    if (!tile->has_colors) return paint_all_rows(&p, tile, backdrop);
    const uint32_t known = take_known(tile), others = paint_all_rows(&p, tile, backdrop);
    put_known(tile);
    return known + others;
}

static uint32_t paint_blocks(struct zr_surfaces *surfaces, const struct zr_tile *tile, uint32_t nothing,
                             const struct zr_pixel_rows *out)
{
    struct zr_neighbors neighbors = zr_neighbors_begin(nothing);
    const uint32_t blocks = zr_tile_blocks(tile);
    uint32_t alike = 0, covered = 0, colors[ZR_BLOCKS];
    for (int first = 0; first < ZR_BLOCKS; first += ZR_LANES)
        alike |= zr_blocks_alike(surfaces, &neighbors, tile, first, colors + first) << first;
    for (uint32_t bits = blocks & alike; bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        const struct zr_pixel_rows rows = zr_pixel_rows_of_block(out, block);
        zr_paint_alike(&rows, zr_vi_set((int32_t)colors[block]));
        covered += tile->block_owner[block] > 0 ? ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT : 0;
    }
    for (uint32_t bits = blocks & ~alike; bits; bits &= bits - 1) {
        const struct zr_pixel_rows rows = zr_pixel_rows_of_block(out, zr_lowest_bit(bits));
        covered += zr_paint_block(surfaces, &neighbors, tile, zr_lowest_bit(bits), &rows);
    }
    return covered;
}

static void paint_faces(const struct zr_geometry *geometry, const struct zr_tile *tile, uint32_t add, void *out)
{
    const struct zr_batch *batch = &geometry->batches[0];
    uint32_t *ids = out;
    for (int32_t y = 0; y < tile->height; y++, ids += ZR_TILE_STRIDE) {
        const uint32_t *owners = &tile->owner[y * ZR_TILE_STRIDE];
        if (!batch->written && zr_row_is_of(batch, owners, tile->width))
            zr_paint_faces_alone(batch, add, owners, tile->width, ids);
        else
            batch = zr_paint_faces_mixed(geometry, batch, add, owners, find_ends(owners, tile->width), ids);
    }
}

static uint32_t count(const struct zr_tile *tile)
{
    uint32_t owned = 0;
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x += ZR_LANES) {
            const zr_vm within = zr_vi_lt(zr_vi_ramp(), zr_vi_set(tile->width - x));
            const zr_vi owners = zr_vi_load(&tile->owner[y * ZR_TILE_STRIDE + x]);
            owned += (uint32_t)__builtin_popcount(zr_vm_bits(zr_vi_lt_where(within, zr_vi_set(0), owners)));
        }
    return owned;
}

/* ---- arrays ---- */

static void fill(const struct zr_pixel_rows *out, int32_t width, int32_t height, uint32_t value)
{
    const zr_vi values = zr_vi_set((int32_t)value);
    uint32_t *to = out->first;
    for (int32_t y = 0; y < height; y++, to += out->stride)
        if (out->streamed)
            for (int32_t x = 0; x < width; x += ZR_LANES)
                zr_vi_stream(to + x, values);
        else
            zr_fill_run(to, (uint32_t)width, values);
}

static void copy(const struct zr_pixel_rows *out, int32_t width, int32_t height, const void *in)
{
    const uint32_t *from = in;
    uint32_t *to = out->first;
    for (int32_t y = 0; y < height; y++, from += ZR_TILE_STRIDE, to += out->stride) {
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            zr_vi_put(to + x, zr_vi_load(from + x), out->streamed);
        if (x < width) zr_vi_store_first(to + x, zr_vi_load(from + x), (uint32_t)(width - x));
    }
}

static void depths(const struct zr_tile *tile, const struct zr_pixel_rows *out)
{
    if (tile->unwritten == 0) {
        copy(out, tile->width, tile->height, tile->depth);
        return;
    }
    for (uint32_t bits = zr_tile_blocks(tile); bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        const struct zr_pixel_rows to = zr_pixel_rows_of_block(out, block);
        if (tile->unwritten >> block & 1)
            zr_block_write_depths(tile, block, (float *)to.first, to.stride, to.streamed);
        else
            copy(&to, ZR_BLOCK_WIDTH, ZR_BLOCK_HEIGHT, tile->depth + zr_block_first(block));
    }
}

const struct zr_paint ZR_KERNEL(zr_paint) = {paint_tile, paint_blocks, paint_faces, depths, count, ends, fill, copy};
