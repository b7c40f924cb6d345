/* triangle_simd.h - raster: corners, orientation and planes of ZR_LANES triangles, for kernels.
 *
 * Exact:  the reference's rules 5 (snapping), 6 (area and corner order) and 8 (planes), equal to the scalar code of
 *         viewport.h, place.c and plane.h. */
#ifndef ZR_TRIANGLE_SIMD_H
#define ZR_TRIANGLE_SIMD_H

#include "base/simd/simd.h"
#include "geometry/viewport.h"
#include "raster/bins.h"

struct zr_corner_v {
    zr_vf x, y, z, oow;
};

/* Loads the four floats at AT_k(i) into lane i of corner k, as ZR_LOAD4. */
#define ZR_LOAD_CORNERS(c, AT_0, AT_1, AT_2)                                                                           \
    do {                                                                                                               \
        ZR_LOAD4((c)[0].x, (c)[0].y, (c)[0].z, (c)[0].oow, AT_0);                                                      \
        ZR_LOAD4((c)[1].x, (c)[1].y, (c)[1].z, (c)[1].oow, AT_1);                                                      \
        ZR_LOAD4((c)[2].x, (c)[2].y, (c)[2].z, (c)[2].oow, AT_2);                                                      \
    } while (0)

/* Stores corners in the layout of zr_prepaint_fn. */
static inline void zr_corners_store(const struct zr_corner_v c[3], float out[3][3][ZR_LANES])
{
    for (int k = 0; k < 3; k++) {
        zr_vf_store(out[k][0], c[k].x);
        zr_vf_store(out[k][1], c[k].y);
        zr_vf_store(out[k][2], c[k].oow);
    }
}

/* Snapped coordinates. */
struct zr_grid_v {
    zr_vi x, y;
};

static inline zr_vi zr_snap_v(zr_vf window)
{
    const zr_vf subpixels = (window - zr_vf_set(0.5f)) * zr_vf_set((float)ZR_SUBPIXELS);
    return zr_vi_round(ZR_MUTANT(ties_up, subpixels, subpixels + zr_vf_set(0.01f)));
}

static inline struct zr_grid_v zr_grid_of(zr_vf x, zr_vf y)
{
    return (struct zr_grid_v){zr_snap_v(x), zr_snap_v(y)};
}

static inline void zr_corners_snap_v(const struct zr_corner_v c[3], struct zr_grid_v g[3])
{
    for (int k = 0; k < 3; k++)
        g[k] = zr_grid_of(c[k].x, c[k].y);
}

static inline zr_vi zr_least_v(zr_vi a, zr_vi b, zr_vi c)
{
    return zr_vi_min(zr_vi_min(a, b), c);
}

static inline zr_vi zr_most_v(zr_vi a, zr_vi b, zr_vi c)
{
    return zr_vi_max(zr_vi_max(a, b), c);
}

/* Returns the area by rule 6; undefined if corners are more than ZR_BIN_SMALL_SPAN apart. */
static inline zr_vi zr_area_v(const struct zr_grid_v g[3])
{
    return (g[0].x - g[1].x) * (g[2].y - g[0].y) - (g[2].x - g[0].x) * (g[0].y - g[1].y);
}

/* Returns the difference of the greatest and the least of three. */
static inline zr_vi zr_span_v(zr_vi a, zr_vi b, zr_vi c)
{
    return zr_most_v(a, b, c) - zr_least_v(a, b, c);
}

/* Returns the lanes whose number equals that of lane i. */
static inline uint32_t zr_lanes_with(const int32_t *numbers, int i)
{
    return zr_vm_bits(zr_vi_eq(zr_vi_load(numbers), zr_vi_set(numbers[i])));
}

/* Returns the counter-clockwise triangles, of any size: their corners 0 and 1 must be swapped (rule 6). c: the contents
 * of `vertices` at ZR_LANES numbers n0, n1 and n2 each. The areas of long triangles are computed one by one, in 64
 * bits; equal lanes share one computation. */
static inline zr_vm zr_turned_v(const struct zr_window_vertex *vertices, const int32_t *n0, const int32_t *n1,
                                const int32_t *n2, const struct zr_corner_v c[3])
{
    struct zr_grid_v g[3];
    zr_corners_snap_v(c, g);
    const zr_vi area = zr_area_v(g), span = zr_vi_set(ZR_BIN_SMALL_SPAN);
    const zr_vm are_long =
        zr_vm_or(zr_vi_lt(span, zr_span_v(g[0].x, g[1].x, g[2].x)), zr_vi_lt(span, zr_span_v(g[0].y, g[1].y, g[2].y)));
    uint32_t turned = zr_vm_bits(zr_vi_lt(area, zr_vi_set(0)));
    for (uint32_t bits = ZR_MUTANT(areas_in_32_bits, zr_vm_bits(are_long), 0u); bits;) {
        const int i = zr_lowest_bit(bits);
        const uint32_t same = bits & zr_lanes_with(n0, i) & zr_lanes_with(n1, i) & zr_lanes_with(n2, i);
        const bool negative = zr_window_area(&vertices[n0[i]], &vertices[n1[i]], &vertices[n2[i]]) < 0;
        turned = negative ? turned | same : turned & ~same;
        bits &= ~same;
    }
    return zr_vm_of(turned);
}

/* Returns the triangles that show their backs: a front is counter-clockwise (`turned`) unless mirrored. */
static inline zr_vm zr_backs_v(zr_vm turned, bool mirrored)
{
    return mirrored ? turned : zr_vm_andnot(ZR_ALL_LANES, turned);
}

static inline void zr_swap_vf(zr_vm where, zr_vf *a, zr_vf *b)
{
    const zr_vf old = *a;
    *a = zr_vf_select(where, *b, *a);
    *b = zr_vf_select(where, old, *b);
}

static inline void zr_swap_vi(zr_vm where, zr_vi *a, zr_vi *b)
{
    const zr_vi old = *a;
    *a = zr_vi_select(where, *b, *a);
    *b = zr_vi_select(where, old, *b);
}

/* Rule 6: swaps two corners except for their 1/w, which depth does not use. */
static inline void zr_corners_swap_v(zr_vm where, struct zr_corner_v c[3])
{
    const int k = zr_swapped_corner();
    zr_swap_vf(where, &c[0].x, &c[k].x);
    zr_swap_vf(where, &c[0].y, &c[k].y);
    zr_swap_vf(where, &c[0].z, &c[k].z);
}

/* Rules 5 and 6: snaps the corners, and swaps those of triangles with negative area. Returns these lanes. */
static inline zr_vm zr_corners_orient_v(struct zr_corner_v c[3], struct zr_grid_v g[3])
{
    zr_corners_snap_v(c, g);
    const zr_vm turned = zr_vi_lt(zr_area_v(g), zr_vi_set(0));
    const int k = zr_swapped_corner();
    zr_swap_vi(turned, &g[0].x, &g[k].x);
    zr_swap_vi(turned, &g[0].y, &g[k].y);
    zr_corners_swap_v(turned, c);
    return turned;
}

/* Returns the first pixel centre at or after a snapped coordinate. */
static inline zr_vi zr_centre_behind_v(zr_vi snapped)
{
    return (snapped + zr_vi_set(ZR_SUBPIXELS - 1)) >> ZR_SUBPIXEL_BITS;
}

/* Rule 8: common terms of a triangle's planes. */
struct zr_basis_v {
    zr_vf dx01, dy01, dx20, dy20, x0, y0;
};

struct zr_plane_v {
    zr_vf a0, dadx, dady;
};

/* Equals zr_from_centre. */
static inline zr_vf zr_from_centre_v(zr_vf window)
{
    return ZR_MUTANT(planes_from_the_grid, window - zr_vf_set(0.5f),
                     zr_vf_of(zr_snap_v(window)) * zr_vf_set(1.0f / ZR_SUBPIXELS));
}

static inline struct zr_basis_v zr_basis_make_v(const struct zr_corner_v c[3])
{
    const zr_vf dx01 = c[0].x - c[1].x, dy01 = c[0].y - c[1].y, dx20 = c[2].x - c[0].x, dy20 = c[2].y - c[0].y;
    const zr_vf ooa = zr_vf_set(1.0f) / (dx01 * dy20 - dy01 * dx20);
    return (struct zr_basis_v){
        dx01 * ooa, dy01 * ooa, dx20 * ooa, dy20 * ooa, zr_from_centre_v(c[0].x), zr_from_centre_v(c[0].y)};
}

static inline struct zr_plane_v zr_plane_make_v(const struct zr_basis_v *b, zr_vf p0, zr_vf p1, zr_vf p2)
{
    const zr_vf d01 = p0 - p1, d20 = p2 - p0;
    const zr_vf dadx = d01 * b->dy20 - d20 * b->dy01, dady = d20 * b->dx01 - d01 * b->dx20;
    return (struct zr_plane_v){p0 - (dadx * b->x0 + dady * b->y0), dadx, dady};
}

static inline zr_vf zr_plane_at_v(const struct zr_plane_v *p, zr_vf x, zr_vf y)
{
    return (p->a0 + p->dadx * x) + p->dady * y;
}

/* Returns, for each lane, the plane of the lane given by `lane`. */
static inline struct zr_plane_v zr_plane_pick(const struct zr_plane_v *p, zr_vi lane)
{
    return (struct zr_plane_v){zr_vf_pick(p->a0, lane), zr_vf_pick(p->dadx, lane), zr_vf_pick(p->dady, lane)};
}

/* Least and greatest value at samples x0..x1, y0..y1. Both are values at corners, since rounding is monotone. NaN if
 * some corner is. */
struct zr_range_v {
    zr_vf near, far;
};

static inline struct zr_range_v zr_plane_range_v(const struct zr_plane_v *p, zr_vf x0, zr_vf y0, zr_vf x1, zr_vf y1)
{
    const zr_vf zero = zr_vf_set(0.0f);
    const zr_vm right = zr_vf_lt(zero, p->dadx), up = zr_vf_lt(zero, p->dady);
    return (struct zr_range_v){zr_plane_at_v(p, zr_vf_select(right, x0, x1), zr_vf_select(up, y0, y1)),
                               zr_plane_at_v(p, zr_vf_select(right, x1, x0), zr_vf_select(up, y1, y0))};
}

/* Equals zr_depth_clamp. */
static inline zr_vf zr_depth_clamp_v(zr_vf z)
{
    const zr_vf not_beyond_1 = zr_vf_min(z, zr_vf_set(1.0f));
    return ZR_MUTANT(depth_below_0, zr_vf_max(not_beyond_1, zr_vf_set(0.0f)), not_beyond_1);
}

/* Rule 7: an edge function: its step per pixel to the right, its step per pixel up, and its value at a sample, less 1,
 * so that it is not negative inside. */
struct zr_edge_v {
    zr_vi right, up, at;
};

/* Makes the edge from i to j, in coordinates relative to the sample. */
static inline struct zr_edge_v zr_edge_make_v(struct zr_grid_v i, struct zr_grid_v j)
{
    const zr_vi zero = zr_vi_set(0), a = i.y - j.y, b = i.x - j.x;
    const zr_vm keeps =
        zr_vm_or(zr_vi_lt(a, zero), zr_vm_and(zr_vi_eq(a, zero), zr_vi_lt(zero, ZR_MUTANT(top_edges_kept, b, -b))));
    const zr_vi less = zr_vi_select(keeps, zero, zr_vi_set(ZR_MUTANT(all_edges_kept, -1, 0)));
    const zr_vi subpixels = zr_vi_set(ZR_SUBPIXELS);
    return (struct zr_edge_v){(j.y - i.y) * subpixels, b * subpixels, a * i.x - b * i.y + less};
}

#endif
