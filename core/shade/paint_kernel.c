#include "shade/paint.h"

#include "shade/paint_flat_simd.h"
#include "shade/paint_smooth_simd.h"

/* Records of long runs come back in the rows that follow: this many are remembered. */
enum { SURFACES = 64 };

struct painter {
    struct zr_canvas canvas;
    const struct zr_batch *batch;    /* of the last record */
    struct zr_runs runs;             /* of `batch`, */
    int32_t numbers[ZR_PAINT_QUEUE]; /* and their records' numbers in it */
    struct zr_smooth_queue smooth;
    struct zr_surface surfaces[SURFACES];
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

static struct zr_surface *surface_of(struct painter *p, uint32_t number)
{
    return &p->surfaces[number % SURFACES];
}

static void paint_surface(struct painter *p, uint32_t number, int32_t at, int32_t length)
{
    struct zr_surface *surface = surface_of(p, number);
    uint32_t *pixels = p->canvas.colors + at;
    if (surface->owner != number + 1) *surface = zr_surface_make(p->canvas.geometry, p->batch, number);
    if (surface->flat)
        zr_fill_run(pixels, (uint32_t)length, zr_vi_set((int32_t)surface->color));
    else
        paint_long(surface, p->canvas.x + at % ZR_TILE_STRIDE, p->canvas.y + at / ZR_TILE_STRIDE, pixels,
                   (uint32_t)length);
}

static void add_run(struct painter *p, uint32_t number, int32_t at, int32_t length)
{
    const struct zr_geometry *geometry = p->canvas.geometry;
    const struct zr_surface *known = surface_of(p, number);
    if (known->owner == number + 1 && (known->flat || length > ZR_SHORT_RUN)) {
        paint_surface(p, number, at, length);
        return;
    }
    if (!zr_batch_holds(p->batch, number)) p->batch = zr_batch_of(geometry, number);
    const struct zr_batch *batch = p->batch;
    const uint32_t t = number - batch->first;
    const struct zr_triangle *record = batch->written ? &geometry->triangles[batch->first_record + t] : NULL;
    const bool sided = !record && batch->front != batch->back; /* its side must be known to know its colours */
    const bool smooth = record ? !record->line && (record->c[0] != record->c[1] || record->c[1] != record->c[2])
                               : zr_batch_is_smooth(batch);
    if (!smooth || length > ZR_SHORT_RUN) {
        paint_surface(p, number, at, length);
    } else if (record) {
        zr_smooth_add(&p->smooth, &p->canvas, at, length, 0, record->v,
                      record->back ? geometry->back_colors : geometry->front_colors, record->c);
    } else if (sided) {
        const struct zr_record turned = zr_record_of(geometry, batch, number);
        zr_smooth_add(&p->smooth, &p->canvas, at, length, 0, turned.triangle.v, turned.colors, turned.triangle.c);
    } else {
        const uint32_t colors[3] = {zr_batch_color(batch, t, 0), zr_batch_color(batch, t, 1),
                                    zr_batch_color(batch, t, 2)};
        zr_smooth_add(&p->smooth, &p->canvas, at, length, batch->first_vertex, batch->corners + 3 * (size_t)t,
                      batch->front, colors);
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

/* What is seen where there is no record. */
struct backdrop {
    zr_vi nothing;
    const uint32_t *row; /* NULL: nothing */
};

static inline void paint_backdrop(const struct backdrop *backdrop, uint32_t *owners, int32_t begin, int32_t end)
{
    if (backdrop->row)
        memcpy(owners + begin, backdrop->row + begin, 4 * (size_t)(end - begin));
    else
        zr_fill_run(owners + begin, (uint32_t)(end - begin), backdrop->nothing);
}

/* A row of a smooth batch alone: its runs are listed, to be looked up many at once. */
static inline uint32_t list_row(struct painter *p, uint32_t *owners, int32_t y, int32_t width,
                                const struct backdrop *backdrop)
{
    const uint32_t first = p->batch->first + 1;
    uint32_t count = p->runs.count, covered = 0;
    int32_t begin = 0, end;
    for (uint64_t bits = find_ends(owners, width); bits; bits &= bits - 1, begin = end) {
        end = __builtin_ctzll(bits) + 1;
        if (owners[begin] == 0) {
            paint_backdrop(backdrop, owners, begin, end);
            continue;
        }
        covered += (uint32_t)(end - begin);
        if (end - begin > ZR_SHORT_RUN) {
            paint_surface(p, owners[begin] - 1, y * ZR_TILE_STRIDE + begin, end - begin);
            continue;
        }
        p->numbers[count] = (int32_t)(owners[begin] - first);
        p->runs.at[count] = y * ZR_TILE_STRIDE + begin;
        p->runs.length[count++] = end - begin;
    }
    p->runs.count = count;
    return covered;
}

static void paint_listed(struct painter *p)
{
    if (p->runs.count == 0) return;
    zr_smooth_add_runs(&p->smooth, &p->canvas, p->batch, &p->runs, p->numbers);
    p->runs.count = 0;
    zr_smooth_paint(&p->smooth, &p->canvas, false);
}

/* A row of any owners. */
static uint32_t paint_row(struct painter *p, uint32_t *owners, int32_t y, int32_t width,
                          const struct backdrop *backdrop)
{
    uint32_t covered = 0;
    int32_t begin = 0, end;
    paint_listed(p);
    for (uint64_t bits = find_ends(owners, width); bits; bits &= bits - 1, begin = end) {
        end = __builtin_ctzll(bits) + 1;
        if (owners[begin] == 0) {
            paint_backdrop(backdrop, owners, begin, end);
            continue;
        }
        add_run(p, owners[begin] - 1, y * ZR_TILE_STRIDE + begin, end - begin);
        covered += (uint32_t)(end - begin);
    }
    if (p->smooth.runs.count > ZR_PAINT_RUNS - ZR_TILE_SIZE) zr_smooth_paint(&p->smooth, &p->canvas, false);
    return covered;
}

static uint32_t paint_tile(const struct zr_geometry *geometry, struct zr_tile *tile, uint32_t nothing,
                           const void *behind, ptrdiff_t stride)
{
    struct painter p;
    p.canvas = (struct zr_canvas){geometry, tile->x, tile->y, tile->owner}; /* rows are read before they are painted */
    p.batch = &geometry->batches[0];
    p.runs.count = p.smooth.runs.count = 0;
    for (int i = 0; i < SURFACES; i++)
        p.surfaces[i].owner = 0;
    p.smooth.colors = NULL;
    struct backdrop backdrop = {.nothing = zr_vi_set((int32_t)nothing)};
    const bool only_one = geometry->batch_count == 1; /* 8 us of a picture of 256 x 256 */
    struct zr_flat_memory memory = {zr_vi_set(0), zr_vi_set(0)};
    uint32_t covered = 0;
    for (int32_t y = 0; y < tile->height; y++) {
        uint32_t *owners = &tile->owner[y * ZR_TILE_STRIDE];
        const bool alone = zr_batch_is_gathered(p.batch) && (only_one || zr_row_is_of(p.batch, owners, tile->width));
        if (behind) backdrop.row = (const uint32_t *)behind + y * stride;
        if (alone && zr_batch_is_smooth(p.batch)) {
            covered += list_row(&p, owners, y, tile->width, &backdrop);
            if (p.runs.count > ZR_PAINT_RUNS - ZR_TILE_SIZE) paint_listed(&p);
        } else if (alone && !behind) {
            covered += zr_paint_flat_row(p.batch, &memory, owners, tile->width, backdrop.nothing);
        } else {
            covered += paint_row(&p, owners, y, tile->width, &backdrop);
        }
    }
    paint_listed(&p);
    zr_smooth_paint(&p.smooth, &p.canvas, true);
    return covered;
}

/* ---- arrays ---- */

static void fill(void *out, ptrdiff_t stride, int32_t width, int32_t rows, uint32_t value, bool streamed)
{
    const zr_vi values = zr_vi_set((int32_t)value);
    for (int32_t row = 0; row < rows; row++) {
        uint32_t *to = (uint32_t *)out + row * stride;
        if (streamed)
            for (int32_t x = 0; x < width; x += ZR_LANES)
                zr_vi_stream(to + x, values);
        else
            zr_fill_run(to, (uint32_t)width, values);
    }
}

static void copy(void *out, ptrdiff_t stride, int32_t width, int32_t rows, const void *in, bool streamed)
{
    for (int32_t row = 0; row < rows; row++) {
        const uint32_t *from = (const uint32_t *)in + row * ZR_TILE_STRIDE;
        uint32_t *to = (uint32_t *)out + row * stride;
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            if (streamed)
                zr_vi_stream(to + x, zr_vi_load(from + x));
            else
                zr_vi_store(to + x, zr_vi_load(from + x));
        if (x < width) zr_vi_store_first(to + x, zr_vi_load(from + x), (uint32_t)(width - x));
    }
}

const struct zr_paint ZR_KERNEL(zr_paint) = {paint_tile, ends, fill, copy, zr_stream_end};
