#include "shade/eye/eye_depth.h"

#include <math.h>

#include "shade/eye/eye_planes_simd.h"

/* ---- many triangles ---- */

/* Computes the values of corners. Differences are taken in object space, where they are exact or nearly so: a triangle
 * may be small and far from the origin. */
static inline void place_corners(const struct zr_source_instance *instance, const struct zr_eye_corner_points *points,
                                 int first, struct zr_eye_corners *c)
{
    zr_vd p[3][4];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 4; i++)
            p[k][i] = zr_vd_widen(points->at[k][i] + first);
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 4; i++)
            p[k][i] = p[k][i] - p[0][i];
    zr_eye_place(instance, p[0], c->first);
    zr_eye_place(instance, p[1], c->d1);
    zr_eye_place(instance, p[2], c->d2);
}

/* Makes the planes of row `r`. */
static inline struct zr_eye_planes planes_of_row(const struct zr_eye_corners *c, const zr_vd normal[3], int r,
                                                 double width, double height)
{
    const zr_vd values[3] = {c->first[r], c->d1[r], c->d2[r]};
    return zr_eye_value_planes(c, normal, values, width, height);
}

/* Computes the values of row `r` at the three corners. */
static inline void corner_values(const struct zr_eye_corners *c, int r, zr_vd out[3])
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

/* Makes the depths of ZR_DOUBLES triangles of the mesh. Clipped triangles count as a whole, since a sample may lie
 * slightly beyond the piece that is left. `fronts`: least w and eye w of the corners. If one is not positive, a corner
 * is behind the eye or at infinity, and the range is invalid. */
static inline void make_some(const struct zr_source_instance *instance, const struct zr_eye_corner_points *points,
                             int first, double width, double height, double out[ZR_EYE_DEPTH_DOUBLES][ZR_DOUBLES],
                             double fronts[2][ZR_DOUBLES])
{
    struct zr_eye_corners c;
    zr_vd normal[3], w[3], eye_w[3], depths[3];
    place_corners(instance, points, first, &c);
    zr_eye_cross(c.d1, c.d2, normal);
    const struct zr_eye_planes depth = planes_of_row(&c, normal, ZR_SOURCE_EYE_DEPTH, width, height);
    const struct zr_eye_planes one = planes_of_row(&c, normal, ZR_SOURCE_EYE_W, width, height);
    corner_values(&c, ZR_SOURCE_W, w);
    corner_values(&c, ZR_SOURCE_EYE_W, eye_w);
    corner_values(&c, ZR_SOURCE_EYE_DEPTH, depths);
    for (int k = 0; k < 3; k++)
        depths[k] = depths[k] / eye_w[k];
    const zr_vd all[ZR_EYE_DEPTH_DOUBLES] = {depth.a0, depth.dadx, depth.dady,    one.a0,
                                             one.dadx, one.dady,   least(depths), most(depths)};
    for (int i = 0; i < ZR_EYE_DEPTH_DOUBLES; i++)
        zr_vd_store(out[i], all[i]);
    zr_vd_store(fronts[0], least(w));
    zr_vd_store(fronts[1], least(eye_w));
}

/* Computes the depth of one triangle. Corners are divided by their w first, which leaves depths unchanged. */
static void make_one_scaled(const struct zr_source_instance *instance, const zr_vec4 *const corners[3], double width,
                            double height, double each[ZR_EYE_DEPTH_DOUBLES], double fronts[2])
{
    double some[ZR_EYE_DEPTH_DOUBLES][ZR_DOUBLES], all_fronts[2][ZR_DOUBLES];
    struct zr_eye_corner_points points;
    for (int k = 0; k < 3; k++) {
        const zr_vec4 p = *corners[k];
        const float scaled[4] = {p.x / p.w, p.y / p.w, p.z / p.w, 1.0f};
        for (int i = 0; i < 4; i++)
            for (uint32_t lane = 0; lane < ZR_LANES; lane++)
                points.at[k][i][lane] = scaled[i];
    }
    make_some(instance, &points, 0, width, height, some, all_fronts);
    for (int d = 0; d < ZR_EYE_DEPTH_DOUBLES; d++)
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
        struct zr_eye_corner_points points;
        zr_eye_load_points(corners + group, &points);
        for (uint32_t first = 0; first < ZR_LANES && group + first < count; first += ZR_DOUBLES) {
            double some[ZR_EYE_DEPTH_DOUBLES][ZR_DOUBLES], fronts[2][ZR_DOUBLES];
            make_some(instance, &points, (int)first, (double)width, (double)height, some, fronts);
            for (uint32_t i = 0; i < ZR_DOUBLES && group + first + i < count; i++) {
                struct zr_eye_depth *depth = &out[group + first + i];
                double each[ZR_EYE_DEPTH_DOUBLES], front[2] = {fronts[0][i], fronts[1][i]};
                for (int d = 0; d < ZR_EYE_DEPTH_DOUBLES; d++)
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
                zr_vd_narrow(out + i + k,
                             zr_eye_depths_at(depths, places + i + k, zr_vd_widen(columns + k), (double)y, true));
            else
                zr_vd_narrow(out + i + k,
                             zr_eye_depths_at(depths, places + i + k, zr_vd_widen(columns + k), (double)y, false));
    }
}

static float fill(const struct zr_eye_depth *depths, const struct zr_eye_runs *runs, int32_t rows, int32_t x, int32_t y,
                  float *out)
{
    struct zr_eye_places places;
    for (int32_t row = 0; row < rows; row++)
        zr_eye_spread_runs(&runs[row], ZR_EYE_DEPTH_DOUBLES, places.at[row]);
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
