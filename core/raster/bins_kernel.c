#include "raster/bins.h"

#include "raster/triangle_simd.h"

/* Numbers wait here until there are enough to be set up at once; room for a group more than that. The oldest go
 * first: their stores are done by then, which loads would wait for. */
enum { QUEUE = 4 * ZR_LANES };

struct sorter {
    struct zr_binner *binner;
    const struct zr_batch *batch;
    const float *vertices;  /* of position 0 */
    const uint32_t *corners; /* of record 0 of the batch */
    size_t stride;          /* words from one record's corners to the next */
    zr_vi last_x, last_y;   /* of the window */
    uint32_t tiny[QUEUE + ZR_LANES];
    uint32_t tiny_count;
};

static inline const float *corner_of(const struct sorter *s, uint32_t t, size_t k)
{
    return s->vertices + 4 * (size_t)s->corners[t * s->stride + k];
}

static inline zr_vi centre_behind(zr_vi snapped)
{
    return (snapped + zr_vi_set(ZR_SUBPIXELS - 1)) >> ZR_SUBPIXEL_BITS;
}

/* Pixel centres of triangles, cut to the window. */
struct box {
    zr_vi x0, y0, x1, y1;
};

static inline zr_vi least(const zr_vi v0, const zr_vi v1, const zr_vi v2)
{
    return zr_vi_min(zr_vi_min(v0, v1), v2);
}

static inline zr_vi most(const zr_vi v0, const zr_vi v1, const zr_vi v2)
{
    return zr_vi_max(zr_vi_max(v0, v1), v2);
}

static inline struct box box_of(const struct sorter *s, const struct zr_grid_v g[3], zr_vm *small)
{
    const zr_vi min_x = least(g[0].x, g[1].x, g[2].x), max_x = most(g[0].x, g[1].x, g[2].x);
    const zr_vi min_y = least(g[0].y, g[1].y, g[2].y), max_y = most(g[0].y, g[1].y, g[2].y);
    const zr_vi zero = zr_vi_set(0);
    *small = zr_vi_lt(zr_vi_max(max_x - min_x, max_y - min_y), zr_vi_set(ZR_BIN_SMALL_SPAN));
    return (struct box){zr_vi_max(centre_behind(min_x), zero), zr_vi_max(centre_behind(min_y), zero),
                        zr_vi_min(max_x >> ZR_SUBPIXEL_BITS, s->last_x),
                        zr_vi_min(max_y >> ZR_SUBPIXEL_BITS, s->last_y)};
}

/* ---- tiny triangles ---- */

/* The four samples that a tiny triangle may cover, of each lane: [sample * ZR_LANES + lane]. */
struct samples {
    uint32_t pixels[4 * ZR_LANES], tiles[4 * ZR_LANES];
    float depths[4 * ZR_LANES];
    uint64_t seen;
};

/* Each into the tile that it lies in. All in one loop: one end for the processor to guess, not four. */
static inline void put_fragments(struct zr_binner *binner, const struct samples *samples, const uint32_t *numbers)
{
    for (uint64_t bits = samples->seen; bits; bits &= bits - 1) {
        const int i = __builtin_ctzll(bits);
        struct zr_bin *bin = zr_binner_bin(binner, samples->tiles[i], ZR_BIN_FRAGMENTS);
        const struct zr_fragment fragment = {samples->pixels[i], samples->depths[i], numbers[i % ZR_LANES] + 1};
        uint32_t *room = zr_binner_room(binner, bin, ZR_FRAGMENT_WORDS);
        if (room) memcpy(room, &fragment, sizeof fragment);
    }
}
_Static_assert(4 * ZR_LANES <= 64, "a bit a sample");
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
    for (int k = 0; k < 3; k++)
        g[k] = zr_grid_of(c[k].x, c[k].y);
    const zr_vm turned = zr_vi_lt(zr_area_v(g), zr_vi_set(0));
    const struct box box = box_of(s, g, &small);
    zr_swap_vi(turned, &g[0].x, &g[1].x);
    zr_swap_vi(turned, &g[0].y, &g[1].y);
    zr_swap_vf(turned, &c[0].x, &c[1].x);
    zr_swap_vf(turned, &c[0].y, &c[1].y);
    zr_swap_vf(turned, &c[0].z, &c[1].z);
    for (int k = 0; k < 3; k++) {
        g[k].x -= box.x0 * zr_vi_set(ZR_SUBPIXELS);
        g[k].y -= box.y0 * zr_vi_set(ZR_SUBPIXELS);
    }
    const struct zr_edge_v e[3] = {zr_edge_make_v(g[0], g[1]), zr_edge_make_v(g[1], g[2]), zr_edge_make_v(g[2], g[0])};
    const struct zr_basis_v basis = zr_basis_make_v(c);
    const struct zr_plane_v plane = zr_plane_make_v(&basis, c[0].z, c[1].z, c[2].z);
    const zr_vi one = zr_vi_set(1), below_zero = zr_vi_set(-1), in_tile = zr_vi_set(ZR_TILE_SIZE - 1);
    const zr_vi columns = zr_vi_set((int32_t)s->binner->bins->columns);
    struct samples samples;
    samples.seen = 0;
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
        seen = zr_vf_lt_where(seen, z, zr_vf_set(1.0f));
        samples.seen |= (uint64_t)zr_vm_bits(seen) << (sample * ZR_LANES);
        zr_vf_store(samples.depths + sample * ZR_LANES, z);
        zr_vi_store(samples.pixels + sample * ZR_LANES, (y & in_tile) * zr_vi_set(ZR_TILE_STRIDE) + (x & in_tile));
        zr_vi_store(samples.tiles + sample * ZR_LANES, (y >> 6) * columns + (x >> 6));
    }
    put_fragments(s->binner, &samples, numbers);
}

static void flush_tiny(struct sorter *s)
{
    uint32_t done = 0;
    for (; s->tiny_count - done >= ZR_LANES; done += ZR_LANES)
        draw_tiny(s, s->tiny + done, ZR_ALL_LANES);
    uint32_t left = s->tiny_count - done;
    s->tiny_count = 0;
    if (left == 0) return;
    uint32_t rest[ZR_LANES];
    for (uint32_t i = 0; i < ZR_LANES; i++)
        rest[i] = s->tiny[done + (i < left ? i : 0)];
    draw_tiny(s, rest, zr_vm_of((1u << left) - 1u));
}

/* ---- small triangles ---- */

static inline void list_small(struct sorter *s, uint32_t bits, const struct box *box, uint32_t first)
{
    int32_t x0[ZR_LANES], y0[ZR_LANES], x1[ZR_LANES], y1[ZR_LANES];
    const uint32_t columns = s->binner->bins->columns;
    zr_vi_store(x0, box->x0 >> 6);
    zr_vi_store(y0, box->y0 >> 6);
    zr_vi_store(x1, box->x1 >> 6);
    zr_vi_store(y1, box->y1 >> 6);
    for (; bits; bits &= bits - 1) {
        int i = zr_lowest_bit(bits);
        for (int32_t y = y0[i]; y <= y1[i]; y++)
            for (int32_t x = x0[i]; x <= x1[i]; x++) {
                size_t tile = (size_t)y * columns + (size_t)x;
                zr_binner_add(s->binner, zr_binner_bin(s->binner, tile, ZR_BIN_SMALL), first + (uint32_t)i);
            }
    }
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
    if (!s->batch->written) s->binner->counts.zero_area += (uint64_t)__builtin_popcount(zr_vm_bits(zr_vm_andnot(flat, twins)));
    for (uint32_t bits = zr_vm_bits(twins); bits; bits &= bits - 1)
        zr_binner_add_flat(s->binner, s->batch, first + (uint32_t)zr_lowest_bit(bits));
}

/* ZR_LANES triangles whose corners begin at `corners`, numbered from `first`. */
static inline void sort_group(struct sorter *s, const uint32_t *corners, size_t stride, zr_vm valid, uint32_t first)
{
    zr_vf x[3], y[3];
    struct zr_grid_v g[3];
    zr_vm small;
#define CORNER(i) (s->vertices + 4 * (size_t)corners[(i)*stride])
    for (int k = 0; k < 3; k++, corners++) {
        ZR_LOAD2(x[k], y[k], CORNER);
        g[k] = zr_grid_of(x[k], y[k]);
    }
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
    for (uint32_t bits = zr_vm_bits(tiny); bits; bits &= bits - 1)
        s->tiny[s->tiny_count++] = first + (uint32_t)zr_lowest_bit(bits);
    const uint32_t listed = zr_vm_bits(zr_vm_andnot(drawn, tiny));
    if (listed) list_small(s, listed, &box, first);
    if (s->tiny_count >= QUEUE) flush_tiny(s);
}

void ZR_KERNEL(zr_binning)(struct zr_binner *binner, const struct zr_batch *batch, uint32_t begin, uint32_t end)
{
    const struct zr_geometry *geometry = binner->geometry;
    struct sorter s = {.binner = binner,
                       .batch = batch,
                       .vertices = &geometry->vertices[0].x,
                       .corners = batch->corners,
                       .stride = 3,
                       .last_x = zr_vi_set((int32_t)binner->bins->width - 1),
                       .last_y = zr_vi_set((int32_t)binner->bins->height - 1)};
    if (batch->written) {
        s.corners = geometry->triangles[batch->first_record].v;
        s.stride = sizeof(struct zr_triangle) / sizeof(uint32_t);
    } else {
        s.vertices = &geometry->vertices[batch->first_vertex].x;
    }
    const zr_vm all = ZR_ALL_LANES;
    uint32_t t = begin;
    if (s.stride == 3)
        for (; t + ZR_LANES <= end; t += ZR_LANES)
            sort_group(&s, s.corners + 3 * (size_t)t, 3, all, batch->first + t);
    for (; t < end; t += ZR_LANES) {
        /* What is left of a group, or records that stand apart. */
        uint32_t corners[3 * ZR_LANES], left = end - t < ZR_LANES ? end - t : ZR_LANES;
        for (uint32_t i = 0; i < ZR_LANES; i++)
            memcpy(corners + 3 * (size_t)i, s.corners + (t + (i < left ? i : 0)) * s.stride, 3 * sizeof *corners);
        sort_group(&s, corners, 3, zr_vm_of((1u << (left - 1) << 1) - 1u), batch->first + t);
    }
    flush_tiny(&s);
}
