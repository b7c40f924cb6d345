#include "base/fast.h"
#include "geometry/geometry.h"
#include "raster/small.h"
#include "raster/tile_simd.h"
#include "raster/triangle_simd.h"

/* Coverage of 4x4 samples by one triangle per lane.
 *
 * Space:  a stamp is 4x4 samples: the coverage of a triangle of a fine mesh mostly fits in one. Its samples are bits,
 *         ZR_STAMP * row + column.
 * Exact:  the reference's rule 7. */
enum { ZR_STAMP = 4, ZR_STAMP_SAMPLES = ZR_STAMP * ZR_STAMP };
enum { ZR_HAS_STAMPS = (int)ZR_LANES >= (int)ZR_STAMP }; /* no gain with one sample at a time */
_Static_assert((int)ZR_STAMP_SAMPLES <= 31, "one bit per sample");

/* Returns the covered samples, one bit each. Edges are those at the stamp's first sample. */
static inline zr_vi zr_stamp_covered(const struct zr_edge_v edges[3])
{
    zr_vi row[3], outside = zr_vi_set(0);
    for (int k = 0; k < 3; k++)
        row[k] = edges[k].at + (edges[k].right + edges[k].up) * zr_vi_set(ZR_STAMP - 1);
    for (int y = 0; y < ZR_STAMP; y++) { /* from the last sample to the first */
        zr_vi at[3] = {row[0], row[1], row[2]};
        for (int x = 0; x < ZR_STAMP; x++) {
            outside = outside + outside - ((at[0] | at[1] | at[2]) >> 31);
            for (int k = 0; k < 3; k++)
                at[k] -= edges[k].right;
        }
        for (int k = 0; k < 3; k++)
            row[k] -= edges[k].up;
    }
    return ~outside & zr_vi_set((1 << ZR_STAMP_SAMPLES) - 1);
}

/* Lists the covered samples of ZR_LANES triangles as triangle * ZR_STAMP_SAMPLES + sample, and returns their number.
 * Pads the list to a whole vector with its last entry. */
enum { ZR_STAMP_LIST = ZR_STAMP_SAMPLES * ZR_LANES + ZR_LANES };
static inline uint32_t zr_stamp_list(const uint32_t covered[ZR_LANES], uint32_t samples[ZR_STAMP_LIST])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < ZR_LANES; i++)
        for (uint32_t s = 0; s < ZR_STAMP_SAMPLES; s += ZR_LANES)
            count +=
                zr_vi_list_bits(samples + count, covered[i] >> s & ZR_ALL_BITS, (int32_t)(i * ZR_STAMP_SAMPLES + s));
    if (count > 0) zr_vi_store(samples + count, zr_vi_set((int32_t)samples[count - 1]));
    return count;
}

/* ---- setup of many triangles ---- */

/* Setup of ZR_LANES triangles. */
struct group {
    _Alignas(64) int32_t at[3][ZR_LANES], right[3][ZR_LANES], up[3][ZR_LANES]; /* edge functions at x0, y0, and their
                                                                                * steps */
    float a0[ZR_LANES], dadx[ZR_LANES], dady[ZR_LANES];
    int32_t x0[ZR_LANES], y0[ZR_LANES], x1[ZR_LANES], y1[ZR_LANES]; /* covered box; a stamp begins at x0, y0 */

    uint32_t covered[ZR_LANES]; /* samples covered by triangles in stamps, 0 for others; valid if in_stamp is not 0 */

    /* One bit per triangle. */
    uint32_t turned;   /* corners 0 and 1 are swapped (rule 6) */
    uint32_t in_stamp; /* the box fits in a stamp and the depth stays within 0..1; 0 if few triangles qualify */
};

/* Sets up a group. v: the corners in the order of the mesh. */
static inline void set_up(const struct zr_tile *tile, const struct zr_corner_v v[3], struct group *out)
{
    struct zr_corner_v c[3] = {v[0], v[1], v[2]};
    struct zr_grid_v g[3];
    out->turned = zr_vm_bits(zr_corners_orient_v(c, g));

    const zr_vi last_x = zr_vi_set(tile->x + tile->width - 1), last_y = zr_vi_set(tile->y + tile->height - 1);
    zr_vi x0 = zr_vi_max(zr_centre_behind_v(zr_least_v(g[0].x, g[1].x, g[2].x)), zr_vi_set(tile->x));
    zr_vi y0 = zr_vi_max(zr_centre_behind_v(zr_least_v(g[0].y, g[1].y, g[2].y)), zr_vi_set(tile->y));
    const zr_vi x1 = zr_vi_min(zr_most_v(g[0].x, g[1].x, g[2].x) >> ZR_SUBPIXEL_BITS, last_x);
    const zr_vi y1 = zr_vi_min(zr_most_v(g[0].y, g[1].y, g[2].y) >> ZR_SUBPIXEL_BITS, last_y);
    const bool has_stamps = ZR_HAS_STAMPS && tile->width >= ZR_STAMP && tile->height >= ZR_STAMP;
    if (has_stamps) { /* keep stamps within the tile */
        x0 = zr_vi_min(x0, last_x - zr_vi_set(ZR_STAMP - 1));
        y0 = zr_vi_min(y0, last_y - zr_vi_set(ZR_STAMP - 1));
    }
    zr_vi_store(out->x0, x0);
    zr_vi_store(out->y0, y0);
    zr_vi_store(out->x1, x1);
    zr_vi_store(out->y1, y1);
    for (int k = 0; k < 3; k++) {
        g[k].x -= x0 * zr_vi_set(ZR_SUBPIXELS);
        g[k].y -= y0 * zr_vi_set(ZR_SUBPIXELS);
    }
    struct zr_edge_v edges[3];
    for (int k = 0; k < 3; k++) {
        edges[k] = zr_edge_make_v(g[k], g[(k + 1) % 3]);
        zr_vi_store(out->at[k], edges[k].at);
        zr_vi_store(out->right[k], edges[k].right);
        zr_vi_store(out->up[k], edges[k].up);
    }
    const struct zr_basis_v basis = zr_basis_make_v(c);
    const struct zr_plane_v plane = zr_plane_make_v(&basis, c[0].z, c[1].z, c[2].z);
    zr_vf_store(out->a0, plane.a0);
    zr_vf_store(out->dadx, plane.dadx);
    zr_vf_store(out->dady, plane.dady);
    const struct zr_range_v range = zr_plane_range_v(&plane, zr_vf_of(x0), zr_vf_of(y0), zr_vf_of(x1), zr_vf_of(y1));
    const zr_vm within = zr_vm_and(zr_vf_le(zr_vf_set(0.0f), range.near), zr_vf_le(range.far, zr_vf_set(1.0f)));
    const zr_vm spans = zr_vi_lt(zr_vi_set(ZR_STAMP - 1), zr_vi_max(x1 - x0, y1 - y0));
    const zr_vm in_stamp = zr_vm_andnot(within, spans);
    out->in_stamp = has_stamps ? zr_vm_bits(in_stamp) : 0;
    /* With few stamps, drawing them separately costs more than it saves (4 % of the bunny at 1920x1080). */
    if (4 * __builtin_popcount(out->in_stamp) < 3 * (int)ZR_LANES) out->in_stamp = 0;
    if (!ZR_FAST(stamps, out->in_stamp != 0)) out->in_stamp = 0;
    if (out->in_stamp) zr_vi_store(out->covered, zr_vi_select(in_stamp, zr_stamp_covered(edges), zr_vi_set(0)));
}

/* Returns true if the draw contains all ZR_LANES numbers. */
static inline bool holds_all(const struct zr_draw *draw, const uint32_t *numbers)
{
    const zr_vi t = zr_vi_load(numbers) - zr_vi_set((int32_t)draw->first);
    const zr_vm within = zr_vi_lt_where(zr_vi_lt(zr_vi_set(-1), t), t, zr_vi_set((int32_t)draw->count));
    return zr_vm_bits(within) == ZR_ALL_BITS;
}

/* Loads the corners of ZR_LANES triangles of a draw. */
static inline void load_corners(const struct zr_geometry *geometry, const struct zr_draw *draw, const uint32_t *numbers,
                                struct zr_corner_v v[3])
{
    const float *vertices = &geometry->vertices[draw->first_vertex].x;
#define CORNER(i, k) (vertices + 4 * (size_t)draw->corners[3 * (size_t)(numbers[i] - draw->first) + (k)])
#define CORNER_0(i)  CORNER(i, 0)
#define CORNER_1(i)  CORNER(i, 1)
#define CORNER_2(i)  CORNER(i, 2)
    ZR_LOAD_CORNERS(v, CORNER_0, CORNER_1, CORNER_2);
#undef CORNER_0
#undef CORNER_1
#undef CORNER_2
#undef CORNER
}

/* Prefetch distance in triangles. Since binning, the corner numbers were evicted from the nearer caches. With whole
 * groups of one array (binned_scene.c), this saves 3 to 9 % of the bunny at 512x512. */
enum { PREFETCH_AHEAD = 48 };

/* Prefetches corner numbers; `left` numbers remain. Does nothing unless all ZR_LANES numbers at that distance exist and
 * belong to the draw. */
static inline void prefetch_corners(const struct zr_draw *draw, const uint32_t *numbers, uint32_t left)
{
    const uint32_t *later = numbers + PREFETCH_AHEAD;
    if (left < PREFETCH_AHEAD + ZR_LANES || !holds_all(draw, later)) return;
    for (uint32_t i = 0; i < ZR_LANES; i++)
        __builtin_prefetch(draw->corners + 3 * (size_t)(later[i] - draw->first));
}

/* Loads the corners of triangles of any draws. Returns the draw of the last one. */
static inline const struct zr_draw *load_mixed_corners(const struct zr_geometry *geometry, const struct zr_draw *draw,
                                                       const uint32_t *numbers, struct zr_corner_v v[3])
{
    const float *places[3][ZR_LANES];
    for (uint32_t i = 0; i < ZR_LANES; i++) {
        draw = zr_draw_next(geometry, draw, numbers[i]);
        for (uint32_t k = 0; k < 3; k++)
            places[k][i] =
                &geometry->vertices[draw->first_vertex + zr_draw_corner(draw, numbers[i] - draw->first, k)].x;
    }
#define CORNER_0(i) places[0][i]
#define CORNER_1(i) places[1][i]
#define CORNER_2(i) places[2][i]
    ZR_LOAD_CORNERS(v, CORNER_0, CORNER_1, CORNER_2);
#undef CORNER_0
#undef CORNER_1
#undef CORNER_2
    return draw;
}

/* ---- one triangle ---- */

/* Operation on a sample: z-test, z-test with early colours, or adding to the lists. */
enum operation { SEEN, SEEN_WITH_WORDS, LISTED };

/* Draws ZR_LANES columns of triangle i from x on, a multiple of ZR_LANES. Its edges exclude samples outside of it, and
 * columns beyond the window, since it lies in the view volume. Setup values are broadcast when they are loaded (a tenth
 * of the time). Such triangles have no early colours. */
static inline void draw_columns(struct zr_tile *tile, const struct group *g, uint32_t i, int32_t x, uint32_t owner,
                                enum operation op)
{
    const zr_vi below_zero = zr_vi_set(-1), ramp = zr_vi_ramp(), skip = zr_vi_set(x - g->x0[i]) + ramp;
    zr_vi e0 = zr_vi_set(g->at[0][i]) + zr_vi_set(g->right[0][i]) * skip;
    zr_vi e1 = zr_vi_set(g->at[1][i]) + zr_vi_set(g->right[1][i]) * skip;
    zr_vi e2 = zr_vi_set(g->at[2][i]) + zr_vi_set(g->right[2][i]) * skip;
    const zr_vi up0 = zr_vi_set(g->up[0][i]), up1 = zr_vi_set(g->up[1][i]), up2 = zr_vi_set(g->up[2][i]);
    const zr_vf column = zr_vf_set(g->a0[i]) + zr_vf_set(g->dadx[i]) * zr_vf_of(zr_vi_set(x) + ramp);
    const zr_vf dady = zr_vf_set(g->dady[i]);
    zr_vf fy = zr_vf_set((float)g->y0[i]);
    size_t at = (size_t)(g->y0[i] - tile->y) * ZR_TILE_STRIDE + (size_t)(x - tile->x);
    for (int32_t y = g->y0[i]; y <= g->y1[i]; y++, at += ZR_TILE_STRIDE, fy = fy + zr_vf_set(1.0f)) {
        const zr_vm inside = zr_vi_lt(below_zero, e0 | e1 | e2);
        const zr_vf z = zr_depth_clamp_v(column + dady * fy);
        if (op == LISTED) {
            zr_tile_list_v(tile, at, inside, z, owner);
        } else {
            const zr_vi owners = zr_vi_set((int32_t)owner);
            const struct zr_put_v put = zr_tile_put_v(&tile->depth[at], &tile->owner[at], inside, z, owners);
            if (op == SEEN_WITH_WORDS) zr_vi_store_where(&tile->early_color[at], put.seen, zr_vi_set(0));
        }
        e0 += up0;
        e1 += up1;
        e2 += up2;
    }
}

static inline void draw_triangle(struct zr_tile *tile, const struct group *g, uint32_t i, uint32_t owner,
                                 enum operation op)
{
    for (int32_t x = g->x0[i] & ~(ZR_LANES - 1); x <= g->x1[i]; x += ZR_LANES)
        draw_columns(tile, g, i, x, owner, op);
}

/* ---- a group ---- */

/* Draws those of the first `count` triangles that are not in stamps. */
static inline void draw_one_by_one(struct zr_tile *tile, const struct group *g, const uint32_t *numbers, uint32_t count,
                                   enum operation op)
{
    for (uint32_t bits = ZR_ALL_BITS >> (ZR_LANES - count) & ~g->in_stamp; bits; bits &= bits - 1) {
        const uint32_t i = (uint32_t)zr_lowest_bit(bits);
        draw_triangle(tile, g, i, numbers[i] + 1, op);
    }
}

/* Window positions of samples in stamps. */
struct places {
    zr_vi lane; /* of the triangle */
    zr_vf x, y;
};

static inline struct places places_of(const struct group *g, const uint32_t *samples)
{
    const zr_vi sample = zr_vi_load(samples), lane = sample >> 4;
    const zr_vi column = sample & zr_vi_set(ZR_STAMP - 1), row = sample >> 2 & zr_vi_set(ZR_STAMP - 1);
    const zr_vf left = zr_vf_of(zr_vi_load(g->x0)), low = zr_vf_of(zr_vi_load(g->y0));
    return (struct places){lane, zr_vf_pick(left, lane) + zr_vf_of(column), zr_vf_pick(low, lane) + zr_vf_of(row)};
}

/* Input of a group's early colours. */
struct worded {
    const struct zr_prepaint *prepaint;
    float corners[3][3][ZR_LANES];
};

/* Computes the words of all samples at once. */
__attribute__((noinline)) static void find_words(const struct worded *of, const struct group *g,
                                                 const uint32_t *numbers, const uint32_t *samples, uint32_t count,
                                                 uint32_t *words)
{
    uint32_t triangles[ZR_STAMP_LIST];
    float x[ZR_STAMP_LIST], y[ZR_STAMP_LIST];
    for (uint32_t i = 0; i < count; i += ZR_LANES) {
        const struct places places = places_of(g, samples + i);
        zr_vi_store(triangles + i, places.lane);
        zr_vf_store(x + i, places.x);
        zr_vf_store(y + i, places.y);
    }
    of->prepaint->make(of->prepaint, numbers, g->turned, of->corners[0][0], triangles, x, y, count, words);
}

/* Draws triangles in stamps sample by sample: most cover two or three samples. The inputs of many samples are computed
 * at once. No loop depends on the rows or columns of a triangle, which would cause branch mispredictions. This saves a
 * fifth of the time of small triangles of the bunny at 512x512. SEEN_WITH_WORDS: visible samples get their word, or 0
 * if there is none. */
static inline void draw_stamps(struct zr_tile *tile, const struct group *g, const uint32_t *numbers,
                               const struct worded *of, enum operation op)
{
    uint32_t samples[ZR_STAMP_LIST], at[ZR_LANES], owners[ZR_LANES], words[ZR_STAMP_LIST];
    float depths[ZR_LANES];
    const uint32_t count = zr_stamp_list(g->covered, samples);
    const zr_vf tile_x = zr_vf_set((float)tile->x), tile_y = zr_vf_set((float)tile->y);
    const zr_vf owner = zr_vf_bits(zr_vi_load(numbers) + zr_vi_set(1));
    const struct zr_plane_v depth = {zr_vf_load(g->a0), zr_vf_load(g->dadx), zr_vf_load(g->dady)};
    if (of) find_words(of, g, numbers, samples, count, words);
    for (uint32_t i = 0; i < count; i += ZR_LANES) {
        const struct places places = places_of(g, samples + i);
        const struct zr_plane_v plane = zr_plane_pick(&depth, places.lane);
        zr_vf_store(depths, zr_plane_at_v(&plane, places.x, places.y));
        zr_vi_store(at, zr_vi_round((places.y - tile_y) * zr_vf_set(ZR_TILE_STRIDE) + (places.x - tile_x)));
        zr_vi_store(owners, zr_vi_bits_of(zr_vf_pick(owner, places.lane)));
        const uint32_t some = count - i < ZR_LANES ? count - i : ZR_LANES;
        for (uint32_t k = 0; k < some; k++) {
            if (op == LISTED) {
                zr_tile_list_at(tile, at[k], depths[k], owners[k]);
                continue;
            }
            const bool seen = zr_tile_put_at(tile, at[k], depths[k], owners[k]);
            if (op == SEEN_WITH_WORDS && seen) tile->early_color[at[k]] = of ? words[i + k] : 0;
        }
    }
}
_Static_assert(ZR_STAMP == 1 << 2 && ZR_STAMP_SAMPLES == 1 << 4, "rows and triangles are shifts");

/* A function of its own, since inlining it would cost the main path registers (a fiftieth of the bunny's time). of:
 * words of the group, or NULL. */
__attribute__((noinline)) static void draw_worded_group(struct zr_tile *tile, const struct group *g,
                                                        const uint32_t *numbers, uint32_t count,
                                                        const struct worded *of)
{
    draw_one_by_one(tile, g, numbers, count, SEEN_WITH_WORDS);
    if (!g->in_stamp) return;
    if (of)
        draw_stamps(tile, g, numbers, of, SEEN_WITH_WORDS);
    else
        draw_stamps(tile, g, numbers, NULL, SEEN_WITH_WORDS);
}

__attribute__((noinline)) static void list_group(struct zr_tile *tile, const struct group *g, const uint32_t *numbers,
                                                 uint32_t count)
{
    draw_one_by_one(tile, g, numbers, count, LISTED);
    if (g->in_stamp) draw_stamps(tile, g, numbers, NULL, LISTED);
}

static inline void draw_group(struct zr_tile *tile, const struct group *g, const uint32_t *numbers, uint32_t count)
{
    draw_one_by_one(tile, g, numbers, count, SEEN);
    if (g->in_stamp) draw_stamps(tile, g, numbers, NULL, SEEN);
}

void ZR_KERNEL(zr_small)(struct zr_tile *tile, const struct zr_geometry *geometry, const struct zr_prepaint *prepaints,
                         const uint32_t *numbers, uint32_t count)
{
    const struct zr_draw *draw = &geometry->draws[0];
    for (uint32_t done = 0; done < count; done += ZR_LANES) {
        const uint32_t some = count - done < ZR_LANES ? count - done : ZR_LANES, *here = numbers + done;
        uint32_t last[ZR_LANES];
        struct zr_corner_v v[3];
        struct group group;
        if (some < ZR_LANES) { /* pads the group with the first triangle */
            for (uint32_t i = 0; i < ZR_LANES; i++)
                last[i] = here[i < some ? i : 0];
            here = last;
        }
        const struct zr_prepaint *prepaint = NULL;
        if (holds_all(draw, here)) {
            load_corners(geometry, draw, here, v);
            if (tile->has_early_color && prepaints) prepaint = &prepaints[draw - geometry->draws];
        } else {
            draw = load_mixed_corners(geometry, draw, here, v);
        }
        prefetch_corners(draw, numbers + done, count - done);
        set_up(tile, v, &group);
        if (group.in_stamp) /* skips the padding */
            for (uint32_t i = some; i < ZR_LANES; i++)
                group.covered[i] = 0;
        if (tile->fragments) {
            list_group(tile, &group, here, some);
        } else if (prepaint && prepaint->make && group.in_stamp) {
            struct worded worded = {.prepaint = prepaint};
            zr_corners_store(v, worded.corners);
            draw_worded_group(tile, &group, here, some, &worded);
        } else if (tile->has_early_color) {
            draw_worded_group(tile, &group, here, some, NULL);
        } else {
            draw_group(tile, &group, here, some);
        }
    }
}
