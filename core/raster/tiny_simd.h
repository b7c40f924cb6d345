/* tiny_simd.h - raster: rasterizes triangles with at most 2x2 pixel centres of the window, many at once, for the
 * binning kernel.
 *
 * How:    four steps, each with a queue for the next: find tiny triangles (zr_tiny_add), find covered samples
 *         (zr_tiny_cover), compute their depths, and store them in their tiles (both zr_tiny_draw). So vectors are
 *         full. Most samples of a box are not covered; for these, no corner is loaded and no depth computed (a tenth of
 *         the time of a million triangles). The loop over a vector's tiles causes branch
 *         mispredictions. It runs last, when no corners or depths are pending (3 %).
 * Space:  a queued triangle is on the snapped grid, relative to the pixel centre of its lower left sample in the
 *         window. It is small (ZR_BIN_SMALL_SPAN), possibly cut by the window's border: its coordinates fit 16 bits, so
 *         that x and y share one word.
 * Exact:  the reference's rules 6 (area and corner order), 7 (edges) and 8 (depth). */
#ifndef ZR_TINY_SIMD_H
#define ZR_TINY_SIMD_H

#include "raster/bins.h"
#include "raster/triangle_simd.h"

/* Capacity of the queues, which zr_tiny_draw empties. */
enum { ZR_TINY_ROOM = 512 };

/* Corners of a draw. */
struct zr_corners {
    const float *vertices;   /* vertex of position 0 */
    const uint32_t *corners; /* corners of triangle 0 of the draw */
};

static inline const float *zr_corner_at(const struct zr_corners *c, uint32_t t, size_t k)
{
    return c->vertices + 4 * (size_t)c->corners[3 * (size_t)t + k];
}

/* Input and output of one range of a draw. */
struct zr_tiny_target {
    const struct zr_draw *draw;
    const struct zr_prepaint *prepaint; /* NULL: none */
    const struct zr_corners *corners;
    struct zr_binner *binner;
    uint32_t first_owner, last_owner; /* range of owner ids */
};

/* Four per triangle, those left from before, and a vector after the end. */
enum { ZR_TINY_SAMPLES_ROOM = 4 * ZR_TINY_ROOM + 2 * ZR_LANES };

/* Queues. Whole vectors are written beyond their ends. */
struct zr_tiny {
    uint32_t count, sample_count;
    uint32_t numbers[ZR_TINY_ROOM + ZR_LANES];
    uint32_t places[ZR_TINY_ROOM + ZR_LANES]; /* of the lower left sample: y << 16 | x */
    /* Pairs of 16 bits, as zr_vp: corner 0, and the vectors from it to corners 1 and 2. */
    uint32_t corner[ZR_TINY_ROOM + ZR_LANES], to1[ZR_TINY_ROOM + ZR_LANES], to2[ZR_TINY_ROOM + ZR_LANES];
    /* Covered samples; the upper bit of a place means that corners 0 and 1 are swapped. */
    uint32_t sample_numbers[ZR_TINY_SAMPLES_ROOM], sample_places[ZR_TINY_SAMPLES_ROOM];
    /* The same samples with depths, as zr_tiny_samples; one word of visibility bits per group. */
    uint32_t seen_bits[ZR_TINY_SAMPLES_ROOM / ZR_LANES];
    uint32_t tiles[ZR_TINY_SAMPLES_ROOM], words[ZR_TINY_SAMPLES_ROOM], early_colors[ZR_TINY_SAMPLES_ROOM];
    float depths[ZR_TINY_SAMPLES_ROOM];
};

/* ---- coverage ---- */

static inline void zr_tiny_add(struct zr_tiny *tiny, zr_vm which, zr_vi numbers, zr_vp place, zr_vp corner, zr_vp to1,
                               zr_vp to2)
{
    const uint32_t count = tiny->count;
    zr_vi_compress(tiny->places + count, which, (zr_vi)place);
    zr_vi_compress(tiny->corner + count, which, (zr_vi)corner);
    zr_vi_compress(tiny->to1 + count, which, (zr_vi)to1);
    zr_vi_compress(tiny->to2 + count, which, (zr_vi)to2);
    tiny->count += zr_vi_compress(tiny->numbers + count, which, numbers);
}

/* Rule 7, as zr_edge_make_v. The vector of an edge has b in the lower half of a word and a in the upper. Edges that
 * include their samples (a < 0, or a = 0 and b > 0) are those up to INT16_MAX. */
static inline struct zr_edge_v zr_tiny_edge(zr_vp i, zr_vp j)
{
    const zr_vi edge = (zr_vi)(i - j), less = (zr_vi_set(INT16_MAX) - edge) >> 31;
    return (struct zr_edge_v){(zr_vi_set(0) - (edge >> 16)) << ZR_SUBPIXEL_BITS, edge << 16 >> (16 - ZR_SUBPIXEL_BITS),
                              zr_vp_cross(j, i) + ZR_MUTANT(all_edges_kept, less, zr_vi_set(0))};
}

/* ZR_LANES triangles. */
struct zr_tiny_group {
    struct zr_edge_v edges[3];
    zr_vi numbers, places; /* of the lower left samples, as queued */
};

/* Queues the covered ones among the samples at offset (right, up) from the lower left ones, for lanes in `there`. */
static inline void zr_tiny_add_samples(struct zr_tiny *tiny, const struct zr_tiny_group *group, zr_vm there, int right,
                                       int up)
{
    const uint32_t count = tiny->sample_count;
    zr_vi inside = zr_vi_set(0);
    for (int k = 0; k < 3; k++) {
        zr_vi at = group->edges[k].at;
        if (right) at += group->edges[k].right;
        if (up) at += group->edges[k].up;
        inside |= at;
    }
    const zr_vm covered = zr_vi_lt_where(there, zr_vi_set(-1), inside);
    zr_vi_compress(tiny->sample_places + count, covered, group->places + zr_vi_set(up << 16 | right));
    tiny->sample_count += zr_vi_compress(tiny->sample_numbers + count, covered, group->numbers);
}

/* Processes ZR_LANES triangles from `from` on, of which `valid` exist. `last`: the window's last place. */
static inline void zr_tiny_cover_group(struct zr_tiny *tiny, uint32_t from, zr_vm valid, zr_vi last)
{
    const zr_vi zero = zr_vi_set(0), place = zr_vi_load(tiny->places + from), beyond = last - place;
    const zr_vp to1 = (zr_vp)zr_vi_load(tiny->to1 + from), to2 = (zr_vp)zr_vi_load(tiny->to2 + from);
    const zr_vm turned = zr_vi_lt(zr_vp_cross(to2, to1), zero);
    zr_vi corner0 = zr_vi_load(tiny->corner + from), corner1 = (zr_vi)((zr_vp)corner0 + to1);
    const zr_vp c2 = (zr_vp)corner0 + to2;
    zr_swap_vi(turned, &corner0, &corner1);
    const zr_vp c0 = (zr_vp)corner0, c1 = (zr_vp)corner1;
    const struct zr_tiny_group group = {.edges = {zr_tiny_edge(c0, c1), zr_tiny_edge(c1, c2), zr_tiny_edge(c2, c0)},
                                        .numbers = zr_vi_load(tiny->numbers + from),
                                        .places = place | zr_vi_select(turned, zr_vi_set(INT32_MIN), zero)};
    const zr_vm to_right = zr_vm_andnot(valid, zr_vi_eq(beyond & zr_vi_set(0xffff), zero));
    const zr_vm upwards = zr_vi_lt(zr_vi_set(0xffff), beyond);
    zr_tiny_add_samples(tiny, &group, valid, 0, 0);
    zr_tiny_add_samples(tiny, &group, to_right, 1, 0);
    zr_tiny_add_samples(tiny, &group, zr_vm_and(valid, upwards), 0, 1);
    zr_tiny_add_samples(tiny, &group, zr_vm_and(to_right, upwards), 1, 1);
}

static inline void zr_tiny_cover(struct zr_tiny *tiny, zr_vi last)
{
    for (uint32_t from = 0; from < tiny->count; from += ZR_LANES)
        zr_tiny_cover_group(tiny, from, zr_vm_first(tiny->count - from), last);
    tiny->count = 0;
}

/* ---- depth and output ---- */

/* One sample per lane. */
struct zr_tiny_samples {
    zr_vm seen;
    zr_vi tile, word; /* word: as in zr_bin_fragments.places, before first_owner is subtracted */
    zr_vf depth;
    zr_vi early_color; /* RGBA; 0: none */
};

static inline void zr_tiny_put(struct zr_bin_fragments *block, zr_vm put, const struct zr_tiny_samples *samples,
                               bool with_early_color)
{
    const zr_vi words = samples->word - zr_vi_set((int32_t)block->first_owner);
    zr_vi_compress(block->places + block->head.used, put, words);
    if (with_early_color) zr_vi_compress(block->words + block->head.used, put, samples->early_color);
    block->head.used += zr_vi_compress(block->depths + block->head.used, put, zr_vi_bits_of(samples->depth));
}

/* Stores the samples in their tiles; mostly all lie in one. */
static inline void zr_tiny_put_all(const struct zr_tiny_target *target, const struct zr_tiny_samples *samples)
{
    struct zr_binner *binner = target->binner;
    uint32_t tiles[ZR_LANES];
    zr_vi_store(tiles, samples->tile);
    for (uint32_t bits = zr_vm_bits(samples->seen); bits;) {
        const uint32_t number = tiles[zr_lowest_bit(bits)];
        const zr_vm here = zr_vm_and(zr_vm_of(bits), zr_vi_eq(samples->tile, zr_vi_set((int32_t)number)));
        struct zr_bin_fragments *block =
            zr_binner_fragments(binner, &binner->tiles[number].fragments, target->first_owner, target->last_owner);
        if (!block) return;
        zr_tiny_put(block, here, samples, binner->bins->has_words);
        bits &= ~zr_vm_bits(here);
    }
}

static inline struct zr_tiny_samples zr_tiny_draw_group(const uint32_t *numbers, const uint32_t *places, zr_vm valid,
                                                        const struct zr_tiny_target *target)
{
    const struct zr_corners *corners = target->corners;
    const struct zr_draw *draw = target->draw;
    const struct zr_prepaint *prepaint = target->prepaint;
    struct zr_corner_v c[3];
#define ZR_TINY_CORNER_0(i) zr_corner_at(corners, numbers[i] - draw->first, 0)
#define ZR_TINY_CORNER_1(i) zr_corner_at(corners, numbers[i] - draw->first, 1)
#define ZR_TINY_CORNER_2(i) zr_corner_at(corners, numbers[i] - draw->first, 2)
    ZR_LOAD_CORNERS(c, ZR_TINY_CORNER_0, ZR_TINY_CORNER_1, ZR_TINY_CORNER_2);
#undef ZR_TINY_CORNER_0
#undef ZR_TINY_CORNER_1
#undef ZR_TINY_CORNER_2
    const zr_vi place = zr_vi_load(places), in_tile = zr_vi_set(ZR_TILE_SIZE - 1);
    const zr_vi column = place & zr_vi_set(0xffff), row = place >> 16 & zr_vi_set(INT16_MAX);
    const zr_vf x = zr_vf_of(column), y = zr_vf_of(row);
    const zr_vm turned = zr_vi_lt(place, zr_vi_set(0));
    struct zr_tiny_samples samples = {.early_color = zr_vi_set(0)};
    if (prepaint && prepaint->make) {
        float loaded[3][3][ZR_LANES], xs[ZR_LANES], ys[ZR_LANES];
        uint32_t words[ZR_LANES];
        zr_corners_store(c, loaded);
        zr_vf_store(xs, x);
        zr_vf_store(ys, y);
        prepaint->make(prepaint, numbers, zr_vm_bits(turned), loaded[0][0], NULL, xs, ys, ZR_LANES, words);
        samples.early_color = zr_vi_load(words);
    }
    zr_corners_swap_v(turned, c);
    const struct zr_basis_v basis = zr_basis_make_v(c);
    const struct zr_plane_v plane = zr_plane_make_v(&basis, c[0].z, c[1].z, c[2].z);
    samples.depth = zr_depth_clamp_v(zr_plane_at_v(&plane, x, y));
    samples.seen = zr_vf_lt_where(valid, samples.depth, zr_vf_set(1.0f));
    samples.tile = (row >> 6) * zr_vi_set((int32_t)target->binner->bins->columns) + (column >> 6);
    samples.word = (((row & in_tile) * zr_vi_set(ZR_TILE_STRIDE) + (column & in_tile)) << ZR_BIN_OWNER_BITS) +
                   zr_vi_load(numbers) + zr_vi_set(1);
    return samples;
}
_Static_assert((int)ZR_LANES <= (int)ZR_BIN_VECTOR, "a block has room for a vector");
_Static_assert(ZR_SNAP_MAX / ZR_SUBPIXELS < INT16_MAX, "a place in the window, and a bit, fit a word");
_Static_assert(ZR_TILE_SIZE == 1 << 6, "columns and rows of tiles are shifts");

static inline void zr_tiny_keep(struct zr_tiny *tiny, uint32_t from, const struct zr_tiny_samples *samples)
{
    tiny->seen_bits[from / ZR_LANES] = zr_vm_bits(samples->seen);
    zr_vi_store(tiny->tiles + from, samples->tile);
    zr_vi_store(tiny->words + from, samples->word);
    zr_vi_store(tiny->early_colors + from, samples->early_color);
    zr_vf_store(tiny->depths + from, samples->depth);
}

static inline struct zr_tiny_samples zr_tiny_kept(const struct zr_tiny *tiny, uint32_t from)
{
    return (struct zr_tiny_samples){.seen = zr_vm_of(tiny->seen_bits[from / ZR_LANES]),
                                    .tile = zr_vi_load(tiny->tiles + from),
                                    .word = zr_vi_load(tiny->words + from),
                                    .depth = zr_vf_load(tiny->depths + from),
                                    .early_color = zr_vi_load(tiny->early_colors + from)};
}

/* Processes full groups; the rest stays queued, unless `is_end`. */
static inline void zr_tiny_draw(struct zr_tiny *tiny, bool is_end, const struct zr_tiny_target *target)
{
    uint32_t *numbers = tiny->sample_numbers, *places = tiny->sample_places;
    const uint32_t count = tiny->sample_count, left = is_end ? 0 : count % ZR_LANES, end = count - left;
    for (uint32_t i = count; i % ZR_LANES != 0; i++) { /* pads the last group with the first sample */
        numbers[i] = numbers[0];
        places[i] = places[0];
    }
    for (uint32_t from = 0; from < end; from += ZR_LANES) {
        const struct zr_tiny_samples samples =
            zr_tiny_draw_group(numbers + from, places + from, zr_vm_first(end - from), target);
        zr_tiny_keep(tiny, from, &samples);
    }
    for (uint32_t from = 0; from < end; from += ZR_LANES) {
        const struct zr_tiny_samples samples = zr_tiny_kept(tiny, from);
        zr_tiny_put_all(target, &samples);
    }
    for (uint32_t i = 0; i < left; i++) {
        numbers[i] = numbers[end + i];
        places[i] = places[end + i];
    }
    tiny->sample_count = left;
}

#endif
