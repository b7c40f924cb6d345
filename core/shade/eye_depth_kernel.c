#include "shade/eye_depth.h"

#include <math.h>

#include "base/simd/simd.h"

/* ---- many triangles ---- */

enum { ROWS = ZR_SOURCE_ROWS };

/* Corners of ZR_LANES triangles, in object space: [corner][x, y, z, w][triangle]. */
struct points {
    float at[3][4][ZR_LANES];
};

static inline void load_points(const zr_vec4 *(*corners)[3], struct points *out)
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
struct corners {
    zr_vd first[ROWS], d1[ROWS], d2[ROWS];
};

struct planes {
    zr_vd a0, dadx, dady;
};

static inline void place(const struct zr_source_instance *instance, const zr_vd p[4], zr_vd out[ROWS])
{
    const double(*m)[ROWS] = instance->columns;
    for (int r = 0; r < ROWS; r++)
        out[r] = ((p[0] * zr_vd_set(m[0][r]) + p[1] * zr_vd_set(m[1][r])) + p[2] * zr_vd_set(m[2][r])) +
                 p[3] * zr_vd_set(m[3][r]);
}

/* Computes the values of corners. Differences are taken in object space, where they are exact or nearly so: a triangle
 * may be small and far from the origin. */
static inline void place_corners(const struct zr_source_instance *instance, const struct points *points, int first,
                                 struct corners *c)
{
    zr_vd p[3][4];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 4; i++)
            p[k][i] = zr_vd_widen(points->at[k][i] + first);
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 4; i++)
            p[k][i] = p[k][i] - p[0][i];
    place(instance, p[0], c->first);
    place(instance, p[1], c->d1);
    place(instance, p[2], c->d2);
}

static inline void cross(const zr_vd a[3], const zr_vd b[3], zr_vd out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Makes planes over the window of the values in row `r`, times a factor common to all rows. With c the corners in x, y,
 * w of clip space, p their values, and s = (x, y, 1) the sample, -1 to 1 over the window, such a plane is the sum of
 * p_i (c_j x c_k), times s. That cancels if a triangle is small, so it is computed by differences: p0 (d1 x d2) + c0 x
 * (p2 d1 - p1 d2). It is multiplied by width and height, which makes s whole numbers. `normal` is d1 x d2. */
static inline struct planes value_planes(const struct corners *c, const zr_vd normal[3], int r, double width,
                                         double height)
{
    const zr_vd p0 = c->first[r], p1 = c->d1[r], p2 = c->d2[r], two = zr_vd_set(2.0);
    zr_vd u[3], a[3];
    for (int k = 0; k < 3; k++)
        u[k] = p2 * c->d1[k] - p1 * c->d2[k];
    cross(c->first, u, a);
    const zr_vd x = (a[0] + p0 * normal[0]) * zr_vd_set(height), y = (a[1] + p0 * normal[1]) * zr_vd_set(width);
    const zr_vd one = (a[2] + p0 * normal[2]) * zr_vd_set(width * height);
    return (struct planes){(one + x * zr_vd_set(1.0 - width)) + y * zr_vd_set(1.0 - height), two * x, two * y};
}

/* Computes the values of row `r` at the three corners. */
static inline void corner_values(const struct corners *c, int r, zr_vd out[3])
{
    out[0] = c->first[r];
    out[1] = c->first[r] + c->d1[r];
    out[2] = c->first[r] + c->d2[r];
}

static inline zr_vd least(const zr_vd v[3])
{
    return zr_vd_min(zr_vd_min(v[0], v[1]), v[2]);
}

static inline zr_vd most(const zr_vd v[3])
{
    return zr_vd_max(zr_vd_max(v[0], v[1]), v[2]);
}

/* Doubles in a zr_eye_depth. */
enum { DEPTH_DOUBLES = 8 };
_Static_assert(sizeof(struct zr_eye_depth) == DEPTH_DOUBLES * sizeof(double), "nothing but doubles");

/* Makes the depths of ZR_DOUBLES triangles of the mesh. Clipped triangles count as a whole, since a sample may lie
 * slightly beyond the piece that is left. `fronts`: least w and eye w of the corners. If one is not positive, a corner
 * is behind the eye or at infinity, and the range is invalid. */
static inline void make_some(const struct zr_source_instance *instance, const struct points *points, int first,
                             double width, double height, double out[DEPTH_DOUBLES][ZR_DOUBLES],
                             double fronts[2][ZR_DOUBLES])
{
    struct corners c;
    zr_vd normal[3], w[3], eye_w[3], depths[3];
    place_corners(instance, points, first, &c);
    cross(c.d1, c.d2, normal);
    const struct planes depth = value_planes(&c, normal, ZR_SOURCE_EYE_DEPTH, width, height);
    const struct planes one = value_planes(&c, normal, ZR_SOURCE_EYE_W, width, height);
    corner_values(&c, ZR_SOURCE_W, w);
    corner_values(&c, ZR_SOURCE_EYE_W, eye_w);
    corner_values(&c, ZR_SOURCE_EYE_DEPTH, depths);
    for (int k = 0; k < 3; k++)
        depths[k] = depths[k] / eye_w[k];
    const zr_vd all[DEPTH_DOUBLES] = {depth.a0, depth.dadx, depth.dady,    one.a0,
                                      one.dadx, one.dady,   least(depths), most(depths)};
    for (int i = 0; i < DEPTH_DOUBLES; i++)
        zr_vd_store(out[i], all[i]);
    zr_vd_store(fronts[0], least(w));
    zr_vd_store(fronts[1], least(eye_w));
}

/* Computes the depth of one triangle. Corners are divided by their w first, which leaves depths unchanged. */
static void make_one_scaled(const struct zr_source_instance *instance, const zr_vec4 *const corners[3], double width,
                            double height, double each[DEPTH_DOUBLES], double fronts[2])
{
    double some[DEPTH_DOUBLES][ZR_DOUBLES], all_fronts[2][ZR_DOUBLES];
    struct points points;
    for (int k = 0; k < 3; k++) {
        const zr_vec4 p = *corners[k];
        const float scaled[4] = {p.x / p.w, p.y / p.w, p.z / p.w, 1.0f};
        for (int i = 0; i < 4; i++)
            for (uint32_t lane = 0; lane < ZR_LANES; lane++)
                points.at[k][i][lane] = scaled[i];
    }
    make_some(instance, &points, 0, width, height, some, all_fronts);
    for (int d = 0; d < DEPTH_DOUBLES; d++)
        each[d] = some[d][0];
    for (int i = 0; i < 2; i++)
        fronts[i] = all_fronts[i][0];
}

/* Returns true if all corners are finite points with w > 0, even if their differences lost a tiny w. */
static bool have_places(const zr_vec4 *const corners[3])
{
    bool all = true;
    for (int k = 0; k < 3; k++) {
        const zr_vec4 *p = corners[k];
        const float largest = fmaxf(fabsf(p->x / p->w), fmaxf(fabsf(p->y / p->w), fabsf(p->z / p->w)));
        all = all && p->w > 0.0f && largest < INFINITY;
    }
    return all;
}

static uint32_t make(const struct zr_source_instance *instance, const zr_vec4 *(*corners)[3], uint32_t count,
                     uint32_t width, uint32_t height, struct zr_eye_depth *out)
{
    uint32_t behind = 0;
    for (uint32_t i = count; count > 0 && i < count + ZR_LANES - 1; i++)
        memcpy(corners[i], corners[0], sizeof corners[i]);
    for (uint32_t group = 0; group < count; group += ZR_LANES) {
        struct points points;
        load_points(corners + group, &points);
        for (uint32_t first = 0; first < ZR_LANES && group + first < count; first += ZR_DOUBLES) {
            double some[DEPTH_DOUBLES][ZR_DOUBLES], fronts[2][ZR_DOUBLES];
            make_some(instance, &points, (int)first, (double)width, (double)height, some, fronts);
            for (uint32_t i = 0; i < ZR_DOUBLES && group + first + i < count; i++) {
                struct zr_eye_depth *depth = &out[group + first + i];
                double each[DEPTH_DOUBLES], front[2] = {fronts[0][i], fronts[1][i]};
                for (int d = 0; d < DEPTH_DOUBLES; d++)
                    each[d] = some[d][i];
                if (!(front[1] > 0.0) && have_places(corners[group + first + i]))
                    make_one_scaled(instance, corners[group + first + i], (double)width, (double)height, each, front);
                memcpy(depth, each, sizeof each);
                if (front[0] > 0.0 && front[1] > 0.0) continue;
                zr_eye_depth_widen(depth);
                behind++;
            }
        }
    }
    return behind;
}
_Static_assert((int)ZR_LANES <= (int)ZR_EYE_ROOM, "a group has room");

/* ---- many samples ---- */

/* Returns value `k` of ZR_DOUBLES depths; all lanes are the same if `alone`. */
static inline zr_vd value_of(const struct zr_eye_depth *depths, const int32_t *places, int k, bool alone)
{
    const double *values = (const double *)depths + k;
    return alone ? zr_vd_set(values[places[0]]) : zr_vd_gather(values, places);
}

static inline void depths_at(const struct zr_eye_depth *depths, const int32_t *places, zr_vd x, double y, bool alone,
                             float *out)
{
    zr_vd v[DEPTH_DOUBLES];
    for (int k = 0; k < DEPTH_DOUBLES; k++)
        v[k] = value_of(depths, places, k, alone);
    const zr_vd up = zr_vd_set(y), above = (v[0] + v[2] * up) + v[1] * x, below = (v[3] + v[5] * up) + v[4] * x;
    zr_vd_narrow(out, zr_vd_min(zr_vd_max(above / below, v[6]), v[7]));
}

/* Offset of each pixel's depth, in doubles. Rows are loaded long after their stores, which avoids store-forwarding
 * stalls. */
struct places {
    int32_t at[ZR_EYE_BAND][ZR_TILE_SIZE + ZR_LANES];
};

static inline void spread_runs(const struct zr_eye_runs *runs, int32_t *out)
{
    const int32_t *number = runs->numbers;
    int32_t begin = 0;
    for (uint64_t ends = runs->ends; ends; ends &= ends - 1) {
        const int32_t end = __builtin_ctzll(ends) + 1;
        const zr_vi place = zr_vi_set(*number++ * DEPTH_DOUBLES);
        for (; begin < end; begin += ZR_LANES)
            zr_vi_store(out + begin, place);
        begin = end;
    }
    for (; begin < ZR_TILE_SIZE; begin += ZR_LANES)
        zr_vi_store(out + begin, zr_vi_set(0));
}

static inline void fill_row(const struct zr_eye_depth *depths, const int32_t *places, int32_t x, int32_t y, float *out)
{
    for (int32_t i = 0; i < ZR_TILE_SIZE; i += ZR_LANES) {
        const zr_vm same = zr_vi_eq(zr_vi_load(places + i), zr_vi_set(places[i]));
        const bool alone = zr_vm_bits(same) == ZR_ALL_BITS;
        float columns[ZR_LANES];
        if (alone && places[i] == 0) { /* uncovered: no division */
            zr_vf_store(out + i, zr_vf_set(INFINITY));
            continue;
        }
        zr_vf_store(columns, zr_vf_of(zr_vi_set(x + i) + zr_vi_ramp()));
        for (int k = 0; k < ZR_LANES; k += ZR_DOUBLES)
            if (alone)
                depths_at(depths, places + i + k, zr_vd_widen(columns + k), (double)y, true, out + i + k);
            else
                depths_at(depths, places + i + k, zr_vd_widen(columns + k), (double)y, false, out + i + k);
    }
}

static float fill(const struct zr_eye_depth *depths, const struct zr_eye_runs *runs, int32_t rows, int32_t x, int32_t y,
                  float *out)
{
    struct places places;
    for (int32_t row = 0; row < rows; row++)
        spread_runs(&runs[row], places.at[row]);
    for (int32_t row = 0; row < rows; row++)
        fill_row(depths, places.at[row], x, y + row, out + row * ZR_TILE_STRIDE);
    const zr_vf infinite = zr_vf_set(INFINITY), zero = zr_vf_set(0.0f);
    zr_vf deepest = zero;
    for (int32_t row = 0; row < rows; row++)
        for (int32_t i = 0; i < ZR_TILE_SIZE; i += ZR_LANES) {
            const zr_vf depth = zr_vf_load(out + row * ZR_TILE_STRIDE + i);
            deepest = zr_vf_max(zr_vf_select(zr_vf_lt(depth, infinite), depth, zero), deepest);
        }
    float each[ZR_LANES], most_deep = 0.0f;
    zr_vf_store(each, deepest);
    for (int i = 0; i < ZR_LANES; i++)
        most_deep = each[i] > most_deep ? each[i] : most_deep;
    return most_deep;
}

const struct zr_eye_depths ZR_KERNEL(zr_eye_depths) = {make, fill};
