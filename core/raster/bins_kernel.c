#include "raster/bins.h"

#include "base/fast.h"
#include "base/prefetch.h"
#include "raster/tiny_simd.h"

/* Triangles classified before the tiny and small ones among them are processed. That processing depends on their
 * positions, which causes branch mispredictions; separating the steps keeps these from waiting for corners (a fifth of
 * binning the bunny). Queues have room for a vector after their ends. */
enum { PART = ZR_TINY_ROOM, QUEUE = PART + ZR_LANES };

/* Small triangles of a part, by number: those that touch one tile, and those that touch several. Separate queues avoid
 * mispredicted branches (1 to 3 % of the bunny at 512x512). */
struct in_one_tile {
    uint32_t count, numbers[QUEUE], tiles[QUEUE];
};
struct in_several_tiles {
    uint32_t count, numbers[QUEUE];
    uint32_t low[QUEUE], high[QUEUE]; /* tiles, row << 16 | column */
};

struct sorter {
    struct zr_binner *binner;
    const struct zr_draw *draw;
    const struct zr_prepaint *prepaint;
    struct zr_corners corners;
    zr_vp last; /* last pixel of the window */
    /* Per triangle of a part, pairs as in zr_vp on the snapped grid: the pixel of corner 0, its offset from that
     * pixel's centre, and the vectors from corner 0 to corners 1 and 2. */
    uint32_t pixel[PART], beyond[PART], to1[PART], to2[PART];
    struct zr_tiny tiny;
    struct in_one_tile in_one;
    struct in_several_tiles in_several;
};
_Static_assert(PART % ZR_LANES == 0, "a part's arrays have room for its last group");

/* ---- small triangles ---- */

static inline void list_in(struct zr_binner *binner, uint32_t tile, uint32_t number)
{
    struct zr_bin_numbers *block = zr_binner_numbers(binner, &binner->tiles[tile].small);
    if (block) block->numbers[block->head.used++] = number;
}

static void list_small_ones(struct sorter *s)
{
    const struct in_one_tile *one = &s->in_one;
    const struct in_several_tiles *several = &s->in_several;
    for (uint32_t i = 0; i < one->count; i++)
        list_in(s->binner, one->tiles[i], one->numbers[i]);
    for (uint32_t i = 0; i < several->count; i++) {
        const uint32_t low = several->low[i], high = several->high[i], columns = s->binner->bins->columns;
        for (uint32_t y = low >> 16; y <= high >> 16; y++)
            for (uint32_t x = low & 0xffff; x <= (high & 0xffff); x++)
                list_in(s->binner, y * columns + x, several->numbers[i]);
    }
    s->in_one.count = s->in_several.count = 0;
}

static inline void add_small(struct sorter *s, zr_vm listed, zr_vp first, zr_vp last, zr_vi numbers)
{
    struct in_one_tile *one = &s->in_one;
    struct in_several_tiles *several = &s->in_several;
    const uint32_t one_count = one->count, several_count = several->count;
    const zr_vi low = (zr_vi)(first >> 6), high = (zr_vi)(last >> 6);
    const zr_vi tile = (low >> 16) * zr_vi_set((int32_t)s->binner->bins->columns) + (low & zr_vi_set(0xffff));
    const zr_vm same = zr_vi_eq(low, high), in_one = zr_vm_and(listed, same), in_several = zr_vm_andnot(listed, same);
    zr_vi_compress(one->tiles + one_count, in_one, tile);
    one->count += zr_vi_compress(one->numbers + one_count, in_one, numbers);
    zr_vi_compress(several->low + several_count, in_several, low);
    zr_vi_compress(several->high + several_count, in_several, high);
    several->count += zr_vi_compress(several->numbers + several_count, in_several, numbers);
}
_Static_assert(ZR_TILE_SIZE == 1 << 6, "columns and rows of tiles are shifts");

/* ---- parts ---- */

/* Snapped corners of a group, in the layout of zr_load_corners. */
struct snapped {
    zr_vi low[3], high[3];
};

/* Returns the vector from corner 0 to corner k. One that exceeds 16 bits saturates, which is far too long for a small
 * triangle. */
static inline zr_vi vector_to(const struct snapped *c, int k)
{
    return (zr_vi)zr_vp_pack(c->low[k] - c->low[0], c->high[k] - c->high[0]);
}

/* Snaps ZR_LANES triangles with the corner numbers `corners`, for index `at` of the part. */
static inline void snap_group(struct sorter *s, const uint32_t *corners, uint32_t at)
{
    zr_vf low[3], high[3];
    struct snapped c;
    zr_load_corners(s->corners.vertices, corners, low, high);
    for (int k = 0; k < 3; k++) {
        c.low[k] = zr_snap_v(low[k]);
        c.high[k] = zr_snap_v(high[k]);
    }
    const zr_vi in_pixel = zr_vi_set(ZR_SUBPIXELS - 1);
    zr_vi_store(s->pixel + at, (zr_vi)zr_vp_pack(c.low[0] >> ZR_SUBPIXEL_BITS, c.high[0] >> ZR_SUBPIXEL_BITS));
    zr_vi_store(s->beyond + at, (zr_vi)zr_vp_pack(c.low[0] & in_pixel, c.high[0] & in_pixel));
    zr_vi_store(s->to1 + at, vector_to(&c, 1));
    zr_vi_store(s->to2 + at, vector_to(&c, 2));
}

/* Returns true if corners i and j have the same window position, a precondition for the same position in the mesh. */
static inline bool are_twins(const struct sorter *s, uint32_t t, size_t i, size_t j)
{
    const float *a = zr_corner_at(&s->corners, t, i), *b = zr_corner_at(&s->corners, t, j);
    return a[0] == b[0] && a[1] == b[1];
}

/* Processes the triangles without area, and those that are not small, of a group numbered from `first`. */
static void add_others(struct sorter *s, uint32_t flat, uint32_t spanning, uint32_t first)
{
    for (uint32_t bits = spanning; bits; bits &= bits - 1)
        zr_binner_add_spanning(s->binner, s->draw, first + (uint32_t)zr_lowest_bit(bits));
    for (uint32_t bits = flat; bits; bits &= bits - 1) {
        const uint32_t number = first + (uint32_t)zr_lowest_bit(bits), t = number - s->draw->first;
        if (are_twins(s, t, 0, 1) || are_twins(s, t, 1, 2) || are_twins(s, t, 2, 0))
            zr_binner_add_flat(s->binner, s->draw, number);
        else if (!s->draw->counted)
            s->binner->counts.zero_area++;
    }
}

/* Returns the small triangles with an area that show a drawn side (rule 6), and counts them. */
static inline zr_vm shown_of(struct sorter *s, zr_vm small, zr_vi area)
{
    if (s->draw->counted) return small;
    zr_vm shown = small;
    if (!s->draw->material->double_sided) {
        const zr_vm turned = zr_vi_lt(area, zr_vi_set(0));
        shown = s->draw->mirrored ? zr_vm_andnot(small, turned) : zr_vm_and(small, turned);
        s->binner->counts.culled += (uint64_t)__builtin_popcount(zr_vm_bits(zr_vm_andnot(small, shown)));
    }
    s->binner->counts.drawn_whole += (uint64_t)__builtin_popcount(zr_vm_bits(shown));
    return shown;
}

/* Records backs, since shading would have to load the corners of visible triangles to find them. With packed colours,
 * this saves half the tile time of a million lit triangles, and a third of the bunny's at 1920x1080. */
static inline void note_backs(const struct sorter *s, zr_vm small, zr_vi area, uint32_t first)
{
    const zr_vm backs = zr_backs_v(zr_vi_lt(area, zr_vi_set(0)), s->draw->mirrored);
    zr_prepaint_add_backs(s->prepaint, first - s->draw->first, zr_vm_bits(zr_vm_and(small, backs)));
}
_Static_assert(PART % 32 == 0, "the lanes of a group have their bits in one word");

/* Returns `half` in both halves of each lane's word. */
static inline zr_vp pairs_of(uint16_t half)
{
    return (zr_vp)zr_vi_set((int32_t)((uint32_t)half << 16 | half));
}

/* Returns the lanes of which neither half has any of these bits. */
static inline zr_vm has_none(zr_vp pairs, uint16_t bits)
{
    return zr_vi_eq((zr_vi)(pairs & pairs_of(bits)), zr_vi_set(0));
}

/* Classifies ZR_LANES triangles from index `at` of the part on, numbered from `first`. */
static inline void sort_group(struct sorter *s, uint32_t at, zr_vm valid, uint32_t first)
{
    const zr_vi zero = zr_vi_set(0);
    const zr_vp none = (zr_vp)zero, to1 = (zr_vp)zr_vi_load(s->to1 + at), to2 = (zr_vp)zr_vi_load(s->to2 + at);
    const zr_vp least = zr_vp_min(zr_vp_min(to1, to2), none), most = zr_vp_max(zr_vp_max(to1, to2), none);
    const zr_vm small = zr_vm_and(valid, has_none(most - least, (uint16_t)-ZR_BIN_SMALL_SPAN));
    const zr_vi area = zr_vp_cross(to2, to1); /* undefined if a vector saturated: then the triangle is not small */
    if (s->prepaint && s->prepaint->backs) note_backs(s, small, area, first);
    const zr_vm spanning = zr_vm_andnot(valid, small), flat = zr_vm_and(small, zr_vi_eq(area, zero));
    const zr_vm shown = shown_of(s, zr_vm_andnot(small, flat), area);
    if (zr_vm_any(zr_vm_or(flat, spanning))) add_others(s, zr_vm_bits(flat), zr_vm_bits(spanning), first);
    /* Neighbours mostly show the same side (3 % of a million triangles). */
    if (!zr_vm_any(shown)) return;
    const zr_vp pixel = (zr_vp)zr_vi_load(s->pixel + at), beyond = (zr_vp)zr_vi_load(s->beyond + at);
    const zr_vp ahead = (beyond + least + pairs_of(ZR_SUBPIXELS - 1)) >> ZR_SUBPIXEL_BITS;
    const zr_vp first_place = zr_vp_max(pixel + ahead, none);
    const zr_vp last_place = zr_vp_min(pixel + ((beyond + most) >> ZR_SUBPIXEL_BITS), s->last);
    const zr_vp more = last_place - first_place; /* negative: no pixel centre */
    const zr_vm drawn = zr_vm_and(shown, has_none(more, 1u << 15));
    const zr_vm is_tiny = zr_vm_and(drawn, has_none(more, (uint16_t)-2));
    const zr_vm tiny = ZR_FAST(tiny_fragments, zr_vm_any(is_tiny)) ? is_tiny : zr_vm_of(0);
    const zr_vm listed = zr_vm_andnot(drawn, tiny);
    const zr_vi numbers = zr_vi_set((int32_t)first) + zr_vi_ramp();
    zr_tiny_add(&s->tiny, tiny, numbers, first_place, beyond + ((pixel - first_place) << ZR_SUBPIXEL_BITS), to1, to2);
    if (zr_vm_any(listed)) add_small(s, listed, first_place, last_place, numbers);
}
_Static_assert((ZR_BIN_SMALL_SPAN & (ZR_BIN_SMALL_SPAN - 1)) == 0,
               "larger spans have one of the bits from this one on");

/* Prefetches every second corner of later triangles (without vectors, the first and the last): neighbours share the
 * others. This saves a seventh of the time of a million triangles. Prefetching the first corner of each triangle takes
 * 4 to 8 % longer; prefetching all takes as long, and 3 % longer if the caches hold the mesh. Groups of 16 prefetch
 * all, since none may wait for a corner: half of them took 7 % longer on a Zen 5, a quarter 40 %. The distance is what
 * a first-level cache of 32 KB holds: with 48 KB, 80 took 7 % longer, 224 2 % less, and 320 18 % longer. */
enum { PREFETCH_AHEAD = 128 /* triangles */, PREFETCH_STEP = (int)ZR_LANES > 8 ? 1 : 2 /* corners */ };

/* Prefetches corners of ZR_LANES triangles with the numbers `corners`. */
static inline void prefetch_group(const struct sorter *s, const uint32_t *corners)
{
#pragma GCC unroll 16 /* 5 % of a million triangles */
    for (uint32_t i = 0; i < 3 * ZR_LANES; i += PREFETCH_STEP)
        __builtin_prefetch(s->corners.vertices + 4 * (size_t)corners[i]);
}

/* Snaps triangles begin .. end - 1. The prefetched ones may belong to another range, mostly the next one (1 % of a
 * million triangles). */
static void snap_part(struct sorter *s, uint32_t begin, uint32_t end)
{
    const struct zr_corners *all = &s->corners;
    uint32_t t = begin;
    for (; t + ZR_LANES <= end; t += ZR_LANES) {
        const uint32_t *corners = all->corners + 3 * (size_t)t;
        if (t + PREFETCH_AHEAD + ZR_LANES <= s->draw->count) prefetch_group(s, corners + 3 * PREFETCH_AHEAD);
        zr_prefetch(corners, ZR_PAGE, 3 * ZR_LANES * sizeof *corners); /* 4 % of binning */
        snap_group(s, corners, t - begin);
    }
    if (t == end) return;
    uint32_t corners[3 * ZR_LANES]; /* pads the last group with its first triangle */
    for (uint32_t i = 0; i < ZR_LANES; i++)
        memcpy(corners + 3 * (size_t)i, all->corners + 3 * (size_t)(t + (i < end - t ? i : 0)), 3 * sizeof *corners);
    snap_group(s, corners, t - begin);
}

static void sort_part(struct sorter *s, uint32_t begin, uint32_t end)
{
    for (uint32_t t = begin; t < end; t += ZR_LANES)
        sort_group(s, t - begin, zr_vm_first(end - t), s->draw->first + t);
}

void ZR_KERNEL(zr_binning)(struct zr_binner *binner, const struct zr_draw *draw, uint32_t begin, uint32_t end)
{
    struct sorter s; /* not cleared, since a draw may be a single triangle */
    s.binner = binner;
    s.draw = draw;
    s.prepaint = zr_binner_prepaint(binner, draw);
    s.corners = (struct zr_corners){&binner->bins->geometry->vertices[draw->first_vertex].x, draw->corners};
    s.last = (zr_vp)zr_vi_set((int32_t)((binner->bins->height - 1) << 16 | (binner->bins->width - 1)));
    s.tiny.count = s.tiny.sample_count = s.in_one.count = s.in_several.count = 0;
    const struct zr_tiny_target target = {
        draw, s.prepaint, &s.corners, binner, draw->first + begin + 1, draw->first + end};
    for (uint32_t part = begin; part < end; part += PART) {
        const uint32_t part_end = end - part < PART ? end : part + PART;
        snap_part(&s, part, part_end);
        sort_part(&s, part, part_end);
        zr_tiny_cover(&s.tiny, (zr_vi)s.last);
        zr_tiny_draw(&s.tiny, part_end == end, &target);
        list_small_ones(&s);
    }
}
