/* eye_planes_simd.h - shade: planes of the mesh's own triangles in double, made for many triangles and evaluated at
 * many samples, for kernels.
 *
 * Source: as eye_depth.h.
 */
#ifndef ZR_EYE_PLANES_SIMD_H
#define ZR_EYE_PLANES_SIMD_H

#include "base/inlined.h"
#include "base/simd/fours_simd.h"
#include "base/simd/simd.h"
#include "shade/eye/eye_depth.h"

/* ---- many triangles ---- */

/* Corners of ZR_LANES triangles, in object space: [corner][x, y, z, w][triangle]. */
struct zr_eye_corner_points {
    float at[3][4][ZR_LANES];
};

static inline void zr_eye_load_points(const zr_vec4 *(*corners)[3], struct zr_eye_corner_points *out)
{
    zr_vf x, y, z, w;
#define CORNER(i) (&corners[i][k]->x)
    for (int k = 0; k < 3; k++) {
        ZR_LOAD4(x, y, z, w, CORNER);
        zr_vf_store(out->at[k][0], x);
        zr_vf_store(out->at[k][1], y);
        zr_vf_store(out->at[k][2], z);
        zr_vf_store(out->at[k][3], w);
    }
#undef CORNER
}

/* Values of ZR_DOUBLES triangles, in the rows of zr_source_instance: those of corner 0, and the differences of the
 * others. */
struct zr_eye_corners {
    zr_vd first[ZR_SOURCE_ROWS], d1[ZR_SOURCE_ROWS], d2[ZR_SOURCE_ROWS];
};

struct zr_eye_planes {
    zr_vd a0, dadx, dady;
};

static inline void zr_eye_place(const struct zr_source_instance *instance, const zr_vd p[4], zr_vd out[ZR_SOURCE_ROWS])
{
    const double(*m)[ZR_SOURCE_ROWS] = instance->columns;
    for (int r = 0; r < ZR_SOURCE_ROWS; r++)
        out[r] = ((p[0] * zr_vd_set(m[0][r]) + p[1] * zr_vd_set(m[1][r])) + p[2] * zr_vd_set(m[2][r])) +
                 p[3] * zr_vd_set(m[3][r]);
}

static inline void zr_eye_cross(const zr_vd a[3], const zr_vd b[3], zr_vd out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Makes planes over the window of values, times a factor common to all values. `p` is the value at corner 0, and the
 * differences of the others. With c the corners in x, y, w of clip space, p their values, and s = (x, y, 1) the sample,
 * -1 to 1 over the window, such a plane is the sum of p_i (c_j x c_k), times s. That cancels if a triangle is small, so
 * it is computed by differences: p0 (d1 x d2) + c0 x (p2 d1 - p1 d2). It is multiplied by width and height, which makes
 * s whole numbers. `normal` is d1 x d2. */
static inline struct zr_eye_planes zr_eye_value_planes(const struct zr_eye_corners *c, const zr_vd normal[3],
                                                       const zr_vd p[3], double width, double height)
{
    const zr_vd p0 = p[0], p1 = p[1], p2 = p[2], two = zr_vd_set(2.0);
    zr_vd u[3], a[3];
    for (int k = 0; k < 3; k++)
        u[k] = p2 * c->d1[k] - p1 * c->d2[k];
    zr_eye_cross(c->first, u, a);
    const zr_vd x = (a[0] + p0 * normal[0]) * zr_vd_set(height), y = (a[1] + p0 * normal[1]) * zr_vd_set(width);
    const zr_vd one = (a[2] + p0 * normal[2]) * zr_vd_set(width * height);
    return (struct zr_eye_planes){(one + x * zr_vd_set(1.0 - width)) + y * zr_vd_set(1.0 - height), two * x, two * y};
}

/* ---- many samples ---- */

/* Doubles in a zr_eye_depth. */
enum { ZR_EYE_DEPTH_DOUBLES = 8 };
_Static_assert(sizeof(struct zr_eye_depth) == ZR_EYE_DEPTH_DOUBLES * sizeof(double), "nothing but doubles");

/* Loads the first `count` values of ZR_DOUBLES structures of doubles, a multiple of four; all lanes are the same if
 * `alone`. */
ZR_INLINED void zr_eye_load(const void *structures, const int32_t *places, int count, bool alone, zr_vd *out)
{
    const double *values = structures;
    for (int k = 0; k < count; k += alone ? 1 : 4)
        if (alone)
            out[k] = zr_vd_set(values[places[0] + k]);
        else
            zr_vd_load_fours(values + k, places, out + k);
}

/* Computes the depths of ZR_DOUBLES samples. */
static inline zr_vd zr_eye_depths_at(const struct zr_eye_depth *depths, const int32_t *places, zr_vd x, double y,
                                     bool alone)
{
    zr_vd v[ZR_EYE_DEPTH_DOUBLES];
    zr_eye_load(depths, places, ZR_EYE_DEPTH_DOUBLES, alone, v);
    const zr_vd up = zr_vd_set(y), above = (v[0] + v[2] * up) + v[1] * x, below = (v[3] + v[5] * up) + v[4] * x;
    return zr_vd_min(zr_vd_max(above / below, v[6]), v[7]);
}

/* Offset of each pixel's structure, in doubles. Rows are loaded long after their stores, which avoids store-forwarding
 * stalls. */
struct zr_eye_places {
    int32_t at[ZR_EYE_BAND][ZR_TILE_SIZE + ZR_LANES];
};

/* Fills in the offsets of a row. `doubles`: those of a structure. */
static inline void zr_eye_spread_runs(const struct zr_eye_runs *runs, int32_t doubles, int32_t *out)
{
    const int32_t *number = runs->numbers;
    int32_t begin = 0;
    for (uint64_t ends = runs->ends; ends; ends &= ends - 1) {
        const int32_t end = __builtin_ctzll(ends) + 1;
        const zr_vi place = zr_vi_set(*number++ * doubles);
        for (; begin < end; begin += ZR_LANES)
            zr_vi_store(out + begin, place);
        begin = end;
    }
    for (; begin < ZR_TILE_SIZE; begin += ZR_LANES)
        zr_vi_store(out + begin, zr_vi_set(0));
}

#endif
