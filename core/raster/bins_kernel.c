#include "raster/bins.h"

#include "base/expect.h"
#include "raster/triangle_simd.h"

/* So many triangles are looked at before those of them that are tiny or small are drawn or listed. What is done with
 * these depends on where they lie, which the processor cannot guess: so it need not wait for corners to know it (a
 * fifth of sorting the bunny). A queue has room for what is left of the part before, and for a vector behind its end.
 */
enum { PART = 512, QUEUE = PART + 2 * ZR_LANES };

struct sorter {
    struct zr_binner *binner;
    const struct zr_batch *batch;
    const float *vertices;   /* of position 0 */
    const uint32_t *corners; /* of record 0 of the batch */
    size_t stride;           /* words from one record's corners to the next */
    zr_vi last_x, last_y;    /* of the window */
    uint32_t tiny_count, small_count;
    uint32_t tiny[QUEUE], small[QUEUE];           /* by their numbers */
    uint32_t small_low[QUEUE], small_high[QUEUE]; /* tiles that they touch: row << 16 | column */
};

static inline const float *corner_of(const struct sorter *s, uint32_t t, size_t k)
{
    return s->vertices + 4 * (size_t)s->corners[t * s->stride + k];
}

/* Pixel centres of triangles, cut to the window. */
struct box {
    zr_vi x0, y0, x1, y1;
};

static inline struct box box_of(const struct sorter *s, const struct zr_grid_v g[3], zr_vm *small)
{
    const zr_vi min_x = zr_least_v(g[0].x, g[1].x, g[2].x), max_x = zr_most_v(g[0].x, g[1].x, g[2].x);
    const zr_vi min_y = zr_least_v(g[0].y, g[1].y, g[2].y), max_y = zr_most_v(g[0].y, g[1].y, g[2].y);
    const zr_vi zero = zr_vi_set(0);
    *small = zr_vi_lt(zr_vi_max(max_x - min_x, max_y - min_y), zr_vi_set(ZR_BIN_SMALL_SPAN));
    return (struct box){zr_vi_max(zr_centre_behind_v(min_x), zero), zr_vi_max(zr_centre_behind_v(min_y), zero),
                        zr_vi_min(max_x >> ZR_SUBPIXEL_BITS, s->last_x),
                        zr_vi_min(max_y >> ZR_SUBPIXEL_BITS, s->last_y)};
}

/* ---- tiny triangles ---- */

/* One sample of each lane. */
struct samples {
    zr_vm seen;
    zr_vi tile, pixel; /* pixel: in its upper bits, as in zr_bin_fragments */
    zr_vf depth;
};

/* Of a group of triangles. */
struct owners {
    zr_vi all;
    uint32_t first, last;
};

static inline void put_there(struct zr_bin_fragments *block, zr_vm put, const struct samples *samples,
                             const struct owners *owners)
{
    const zr_vi owner = owners->all - zr_vi_set((int32_t)block->first_owner);
    zr_vi_compress(block->places + block->head.used, put, samples->pixel | owner);
    block->head.used += zr_vi_compress(block->depths + block->head.used, put, zr_vi_bits_of(samples->depth));
}

static inline struct zr_bin_fragments *block_of(struct zr_binner *binner, uint32_t tile, const struct owners *owners)
{
    return zr_binner_fragments(binner, &binner->tiles[tile].fragments, owners->first, owners->last);
}

/* Into the tiles that they lie in, one after the other. */
static inline void put_apart(struct zr_binner *binner, const struct samples *samples, const struct owners *owners)
{
    uint32_t tiles[ZR_LANES];
    zr_vi_store(tiles, samples->tile);
    for (uint32_t bits = zr_vm_bits(samples->seen); bits;) {
        const uint32_t number = tiles[zr_lowest_bit(bits)];
        const zr_vm here = zr_vi_eq(samples->tile, zr_vi_set((int32_t)number));
        struct zr_bin_fragments *block = block_of(binner, number, owners);
        if (!block) return;
        put_there(block, zr_vm_and(here, zr_vm_of(bits)), samples, owners);
        bits &= ~zr_vm_bits(here);
    }
}

/* The samples of a group. Mostly its triangles are neighbours, and all lie in one tile: that is asked once (a
 * seventh of a million triangles). `inner`: the lanes whose samples share a tile. */
static inline void put_fragments(struct zr_binner *binner, const struct samples samples[4], zr_vm valid, zr_vm inner,
                                 const struct owners *owners)
{
    uint32_t tiles[ZR_LANES];
    zr_vi_store(tiles, samples[0].tile);
    const uint32_t number = tiles[zr_lowest_bit(zr_vm_bits(valid))];
    const zr_vm here = zr_vm_and(inner, zr_vi_eq(samples[0].tile, zr_vi_set((int32_t)number)));
    if (zr_vm_any(zr_vm_andnot(valid, here))) {
        for (int i = 0; i < 4; i++)
            put_apart(binner, &samples[i], owners);
        return;
    }
    struct zr_bin_fragments *block = block_of(binner, number, owners);
    if (!block) return;
    for (int i = 0; i < 4; i++)
        put_there(block, samples[i].seen, &samples[i], owners);
}
_Static_assert((int)ZR_LANES <= (int)ZR_BIN_VECTOR, "a block has room for a vector");
_Static_assert(ZR_TILE_SIZE == 1 << 6, "columns and rows of tiles are shifts");

/* Draws ZR_LANES of them; of numbers that are not `valid` nothing is seen. */
static inline void draw_tiny(struct sorter *s, const uint32_t *numbers, zr_vm valid)
{
    struct zr_corner_v c[3];
#define CORNER_0(i) corner_of(s, numbers[i] - s->batch->first, 0)
#define CORNER_1(i) corner_of(s, numbers[i] - s->batch->first, 1)
#define CORNER_2(i) corner_of(s, numbers[i] - s->batch->first, 2)
    ZR_LOAD4(c[0].x, c[0].y, c[0].z, c[0].oow, CORNER_0);
    ZR_LOAD4(c[1].x, c[1].y, c[1].z, c[1].oow, CORNER_1);
    ZR_LOAD4(c[2].x, c[2].y, c[2].z, c[2].oow, CORNER_2);
    struct zr_grid_v g[3];
    zr_vm small;
    zr_corners_orient_v(c, g);
    const struct box box = box_of(s, g, &small);
    for (int k = 0; k < 3; k++) {
        g[k].x -= box.x0 * zr_vi_set(ZR_SUBPIXELS);
        g[k].y -= box.y0 * zr_vi_set(ZR_SUBPIXELS);
    }
    const struct zr_edge_v e[3] = {zr_edge_make_v(g[0], g[1]), zr_edge_make_v(g[1], g[2]), zr_edge_make_v(g[2], g[0])};
    const struct zr_basis_v basis = zr_basis_make_v(c);
    const struct zr_plane_v plane = zr_plane_make_v(&basis, c[0].z, c[1].z, c[2].z);
    const zr_vi one = zr_vi_set(1), below_zero = zr_vi_set(-1), in_tile = zr_vi_set(ZR_TILE_SIZE - 1);
    const zr_vi columns = zr_vi_set((int32_t)s->binner->bins->columns);
    struct owners owners = {.all = zr_vi_load(numbers) + one, .first = numbers[0] + 1};
    owners.last = numbers[zr_highest_bit(zr_vm_bits(valid))] + 1;
    struct samples samples[4];
    for (int sample = 0; sample < 4; sample++) {
        const zr_vi x = sample & 1 ? box.x0 + one : box.x0, y = sample & 2 ? box.y0 + one : box.y0;
        zr_vi inside = zr_vi_set(0);
        for (int k = 0; k < 3; k++) {
            zr_vi at = e[k].at;
            if (sample & 1) at += e[k].right;
            if (sample & 2) at += e[k].up;
            inside |= at;
        }
        zr_vm seen = zr_vi_lt_where(valid, below_zero, inside);
        if (sample & 1) seen = zr_vm_andnot(seen, zr_vi_lt(box.x1, x));
        if (sample & 2) seen = zr_vm_andnot(seen, zr_vi_lt(box.y1, y));
        const zr_vf z = zr_depth_clamp_v(zr_plane_at_v(&plane, zr_vf_of(x), zr_vf_of(y)));
        samples[sample].seen = zr_vf_lt_where(seen, z, zr_vf_set(1.0f));
        samples[sample].depth = z;
        samples[sample].tile = (y >> 6) * columns + (x >> 6);
        samples[sample].pixel = ((y & in_tile) * zr_vi_set(ZR_TILE_STRIDE) + (x & in_tile)) << ZR_BIN_OWNER_BITS;
    }
    const zr_vi apart = ((box.x0 ^ box.x1) | (box.y0 ^ box.y1)) >> 6;
    put_fragments(s->binner, samples, valid, zr_vi_eq(apart, zr_vi_set(0)), &owners);
}

/* Full groups. The rest waits for more. */
static void draw_tiny_ones(struct sorter *s)
{
    uint32_t done = 0;
    for (; s->tiny_count - done >= ZR_LANES; done += ZR_LANES)
        draw_tiny(s, s->tiny + done, ZR_ALL_LANES);
    s->tiny_count -= done;
    memmove(s->tiny, s->tiny + done, s->tiny_count * sizeof *s->tiny);
}

/* At the end. */
static void draw_last_tiny_ones(struct sorter *s)
{
    const uint32_t left = s->tiny_count;
    if (left == 0) return;
    for (uint32_t i = left; i < ZR_LANES; i++)
        s->tiny[i] = s->tiny[0];
    draw_tiny(s, s->tiny, zr_vm_of((1u << left) - 1u));
}

/* ---- small triangles ---- */

static inline void list_in(struct zr_binner *binner, uint32_t tile, uint32_t number)
{
    struct zr_bin_numbers *block = zr_binner_numbers(binner, &binner->tiles[tile].small);
    if (block) block->numbers[block->head.used++] = number;
}

static void list_small_ones(struct sorter *s)
{
    const uint32_t columns = s->binner->bins->columns;
    for (uint32_t i = 0; i < s->small_count; i++) {
        const uint32_t low = s->small_low[i], high = s->small_high[i];
        if (__builtin_expect(low == high, 1)) {
            list_in(s->binner, (low >> 16) * columns + (low & 0xffff), s->small[i]);
            continue;
        }
        for (uint32_t y = low >> 16; y <= high >> 16; y++)
            for (uint32_t x = low & 0xffff; x <= (high & 0xffff); x++)
                list_in(s->binner, y * columns + x, s->small[i]);
    }
    s->small_count = 0;
}

static inline void add_small(struct sorter *s, zr_vm listed, const struct box *box, uint32_t first)
{
    const uint32_t count = s->small_count;
    zr_vi_compress(s->small_low + count, listed, (box->y0 >> 6) << 16 | box->x0 >> 6);
    zr_vi_compress(s->small_high + count, listed, (box->y1 >> 6) << 16 | box->x1 >> 6);
    s->small_count += zr_vi_compress(s->small + count, listed, zr_vi_set((int32_t)first) + zr_vi_ramp());
}

/* ---- all of a group ---- */

/* True where two corners are the same place in the window: only these can be the same place of the mesh. */
static inline zr_vm has_twins(const zr_vf x[3], const zr_vf y[3])
{
    const zr_vm twins01 = zr_vm_and(zr_vf_eq(x[0], x[1]), zr_vf_eq(y[0], y[1]));
    const zr_vm twins12 = zr_vm_and(zr_vf_eq(x[1], x[2]), zr_vf_eq(y[1], y[2]));
    const zr_vm twins20 = zr_vm_and(zr_vf_eq(x[2], x[0]), zr_vf_eq(y[2], y[0]));
    return zr_vm_or(twins01, zr_vm_or(twins12, twins20));
}

static inline void count_flat(struct sorter *s, zr_vm flat, const zr_vf x[3], const zr_vf y[3], uint32_t first)
{
    const zr_vm twins = zr_vm_and(flat, has_twins(x, y));
    if (!s->batch->written)
        s->binner->counts.zero_area += (uint64_t)__builtin_popcount(zr_vm_bits(zr_vm_andnot(flat, twins)));
    for (uint32_t bits = zr_vm_bits(twins); bits; bits &= bits - 1)
        zr_binner_add_flat(s->binner, s->batch, first + (uint32_t)zr_lowest_bit(bits));
}

/* ZR_LANES triangles whose corners begin at `corners`, numbered from `first`. */
static inline void sort_group(struct sorter *s, const uint32_t *corners, zr_vm valid, uint32_t first)
{
    zr_vf x[3], y[3];
    struct zr_grid_v g[3];
    zr_vm small;
    zr_load_corners(s->vertices, corners, x, y);
    for (int k = 0; k < 3; k++)
        g[k] = zr_grid_of(x[k], y[k]);
    const struct box box = box_of(s, g, &small);
    const zr_vi area = zr_area_v(g), zero = zr_vi_set(0);
    const zr_vm spanning = zr_vm_andnot(valid, small), flat = zr_vm_and(zr_vm_and(valid, small), zr_vi_eq(area, zero));
    zr_vm drawn = zr_vm_andnot(zr_vm_and(valid, small), flat);
    if (!s->batch->written) {
        if (!s->batch->double_sided) {
            const zr_vm turned = zr_vi_lt(area, zero);
            const zr_vm away = s->batch->mirrored ? zr_vm_and(drawn, turned) : zr_vm_andnot(drawn, turned);
            drawn = zr_vm_andnot(drawn, away);
            s->binner->counts.culled += (uint64_t)__builtin_popcount(zr_vm_bits(away));
        }
        s->binner->counts.drawn_whole += (uint64_t)__builtin_popcount(zr_vm_bits(drawn));
    }
    if (zr_vm_any(flat)) count_flat(s, flat, x, y, first);
    for (uint32_t bits = zr_vm_bits(spanning); bits; bits &= bits - 1)
        zr_binner_add_spanning(s->binner, s->batch, first + (uint32_t)zr_lowest_bit(bits));
    const zr_vi width = box.x1 - box.x0, height = box.y1 - box.y0;
    drawn = zr_vm_andnot(drawn, zr_vi_lt(width | height, zero)); /* without a pixel centre */
    const zr_vm tiny = zr_vm_and(drawn, zr_vi_lt(zr_vi_max(width, height), zr_vi_set(2)));
    s->tiny_count += zr_vi_compress(s->tiny + s->tiny_count, tiny, zr_vi_set((int32_t)first) + zr_vi_ramp());
    const zr_vm listed = zr_vm_andnot(drawn, tiny);
    if (zr_vm_any(listed)) add_small(s, listed, &box, first);
}

/* A corner of each triangle of a group to come is asked for: its neighbours have the others. 6 % of a million
 * triangles. */
static inline void expect_group(const struct sorter *s, uint32_t t)
{
    for (uint32_t i = 0; i < ZR_LANES; i++)
        __builtin_prefetch(corner_of(s, t + i, 0));
}

/* Records begin .. end - 1, of a range that ends at `last`. */
static void sort_part(struct sorter *s, uint32_t begin, uint32_t end, uint32_t last)
{
    uint32_t t = begin;
    if (s->stride == 3)
        for (; t + ZR_LANES <= end; t += ZR_LANES) {
            if (t + 4 * ZR_LANES <= last) expect_group(s, t + 3 * ZR_LANES);
            const uint32_t *corners = s->corners + 3 * (size_t)t;
            zr_expect(corners, ZR_PAGE, 3 * ZR_LANES * sizeof *corners); /* 4 % of sorting */
            sort_group(s, corners, ZR_ALL_LANES, s->batch->first + t);
        }
    for (; t < end; t += ZR_LANES) {
        /* What is left of a group, or records that stand apart. */
        uint32_t corners[3 * ZR_LANES], left = end - t < ZR_LANES ? end - t : ZR_LANES;
        for (uint32_t i = 0; i < ZR_LANES; i++)
            memcpy(corners + 3 * (size_t)i, s->corners + (t + (i < left ? i : 0)) * s->stride, 3 * sizeof *corners);
        sort_group(s, corners, zr_vm_of((1u << (left - 1) << 1) - 1u), s->batch->first + t);
    }
}

void ZR_KERNEL(zr_binning)(struct zr_binner *binner, const struct zr_batch *batch, uint32_t begin, uint32_t end)
{
    const struct zr_geometry *geometry = binner->geometry;
    struct sorter s; /* its queues are not cleared: a batch may be a single triangle */
    s.binner = binner;
    s.batch = batch;
    s.vertices = &geometry->vertices[0].x;
    s.corners = batch->corners;
    s.stride = 3;
    s.last_x = zr_vi_set((int32_t)binner->bins->width - 1);
    s.last_y = zr_vi_set((int32_t)binner->bins->height - 1);
    s.tiny_count = s.small_count = 0;
    if (batch->written) {
        s.corners = geometry->triangles[batch->first_record].v;
        s.stride = sizeof(struct zr_triangle) / sizeof(uint32_t);
    } else {
        s.vertices = &geometry->vertices[batch->first_vertex].x;
    }
    for (uint32_t part = begin; part < end; part += PART) {
        sort_part(&s, part, end - part < PART ? end : part + PART, end);
        draw_tiny_ones(&s);
        list_small_ones(&s);
    }
    draw_last_tiny_ones(&s);
}
