#include "shade/eye/eye_points.h"

#include "base/inlined.h"
#include "shade/eye/eye_planes_simd.h"

/* ---- many triangles ---- */

/* Doubles in a zr_eye_shares. */
enum { SHARE_DOUBLES = 12 };
_Static_assert(sizeof(struct zr_eye_shares) == SHARE_DOUBLES * sizeof(double), "nothing but doubles");

static inline void widen_point(const struct zr_eye_corner_points *points, int corner, int first, zr_vd out[4])
{
    for (int i = 0; i < 4; i++)
        out[i] = zr_vd_widen(points->at[corner][i] + first);
}

/* Subtracts corner 0 from the others, in floats. */
static inline void subtract_first(struct zr_eye_corner_points *points)
{
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 4; i++)
            zr_vf_store(points->at[k][i], zr_vf_load(points->at[k][i]) - zr_vf_load(points->at[0][i]));
}

/* Makes the shares of ZR_DOUBLES triangles. `sides`: the points after subtract_first. */
static inline void make_some(const struct zr_source_instance *instance, const struct zr_eye_corner_points *points,
                             const struct zr_eye_corner_points *sides, int first, const struct zr_eye_rays *rays,
                             double out[SHARE_DOUBLES][ZR_DOUBLES])
{
    static const double values[3][3] = {{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
    struct zr_eye_corners c;
    zr_vd p[4], normal[3], placed[ZR_SOURCE_ROWS];
    zr_vd *const to[3] = {c.first, c.d1, c.d2};
    for (int k = 0; k < 3; k++) {
        widen_point(sides, k, first, p);
        zr_eye_place(instance, p, to[k]);
    }
    zr_eye_cross(c.d1, c.d2, normal);
    for (int k = 0; k < 3; k++) {
        const zr_vd value[3] = {zr_vd_set(values[k][0]), zr_vd_set(values[k][1]), zr_vd_set(values[k][2])};
        const struct zr_eye_planes plane = zr_eye_value_planes(&c, normal, value, rays->width, rays->height);
        zr_vd_store(out[3 * k], plane.a0);
        zr_vd_store(out[3 * k + 1], plane.dadx);
        zr_vd_store(out[3 * k + 2], plane.dady);
    }
    for (int k = 0; k < 3; k++) {
        widen_point(points, k, first, p);
        zr_eye_place(instance, p, placed);
        zr_vd_store(out[9 + k], placed[ZR_SOURCE_EYE_W]);
    }
}

static void make(const struct zr_source_instance *instance, const zr_vec4 *(*corners)[3], uint32_t count,
                 const struct zr_eye_rays *rays, struct zr_eye_shares *out)
{
    for (uint32_t i = count; count > 0 && i < count + ZR_LANES - 1; i++)
        memcpy(corners[i], corners[0], sizeof corners[i]);
    for (uint32_t group = 0; group < count; group += ZR_LANES) {
        struct zr_eye_corner_points points, sides;
        zr_eye_load_points(corners + group, &points);
        sides = points;
        subtract_first(&sides);
        for (uint32_t first = 0; first < ZR_LANES && group + first < count; first += ZR_DOUBLES) {
            double some[SHARE_DOUBLES][ZR_DOUBLES];
            make_some(instance, &points, &sides, (int)first, rays, some);
            for (uint32_t i = 0; i < ZR_DOUBLES && group + first + i < count; i++) {
                double each[SHARE_DOUBLES];
                for (int d = 0; d < SHARE_DOUBLES; d++)
                    each[d] = some[d][i];
                memcpy(&out[group + first + i], each, sizeof each);
            }
        }
    }
}

/* ---- points ---- */

struct point {
    zr_vd x, y, z;
};

/* The two equations of a ray, in eye space: window x and y are linear in the point's x and y. */
struct ray {
    zr_vd row0[4];
    double row1[4];
    zr_vd determinant;
};

static inline struct ray ray_of(const struct zr_eye_rays *rays, zr_vd x, double y)
{
    const double *m = rays->projection.m, ny = (2.0 * y + 1.0) / rays->height - 1.0;
    const zr_vd nx = (zr_vd_set(2.0) * x + zr_vd_set(1.0)) / zr_vd_set(rays->width) - zr_vd_set(1.0);
    struct ray ray;
    for (int k = 0; k < 4; k++) {
        ray.row0[k] = zr_vd_set(m[4 * k]) - nx * zr_vd_set(m[4 * k + 3]);
        ray.row1[k] = m[4 * k + 1] - ny * m[4 * k + 3];
    }
    ray.determinant = ray.row0[0] * zr_vd_set(ray.row1[1]) - ray.row0[1] * zr_vd_set(ray.row1[0]);
    return ray;
}

static inline struct point point_of(const struct ray *ray, zr_vd depth)
{
    const zr_vd z = -depth, r0 = -(ray->row0[2] * z + ray->row0[3]);
    const zr_vd r1 = -(zr_vd_set(ray->row1[2]) * z + zr_vd_set(ray->row1[3]));
    return (struct point){(r0 * zr_vd_set(ray->row1[1]) - ray->row0[1] * r1) / ray->determinant,
                          (ray->row0[0] * r1 - r0 * zr_vd_set(ray->row1[0])) / ray->determinant, z};
}

static inline zr_vd distance_of(const struct zr_eye_rays *rays, const struct point *point)
{
    const zr_vd x = point->x - zr_vd_set(rays->eye[0]), y = point->y - zr_vd_set(rays->eye[1]);
    const zr_vd z = point->z - zr_vd_set(rays->eye[2]);
    return zr_vd_sqrt((x * x + y * y) + z * z);
}

/* Computes row `r` of the point in world space, times its w. */
static inline zr_vd world_row(const struct zr_matrix *m, const struct point *p, int r)
{
    return ((zr_vd_set(m->m[r]) * p->x + zr_vd_set(m->m[4 + r]) * p->y) + zr_vd_set(m->m[8 + r]) * p->z) +
           zr_vd_set(m->m[12 + r]);
}

static inline struct point placed(const struct zr_eye_rays *rays, const struct point *point)
{
    if (rays->is_in_camera) return *point;
    const zr_vd unit = zr_vd_set(1.0), own = world_row(&rays->to_world, point, 3);
    const zr_vd w = zr_vd_select_zero(own, unit, own);
    struct point out = {world_row(&rays->to_world, point, 0) / w, world_row(&rays->to_world, point, 1) / w,
                        world_row(&rays->to_world, point, 2) / w};
    if (!rays->has_origin) return out;
    out.x = out.x + zr_vd_set(rays->origin[0]);
    out.y = out.y + zr_vd_set(rays->origin[1]);
    out.z = out.z + zr_vd_set(rays->origin[2]);
    return out;
}

/* ---- shares ---- */

/* Computes the barycentrics of ZR_DOUBLES samples. */
ZR_INLINED void shares_at(const struct zr_eye_shares *shares, const int32_t *places, zr_vd x, double y, bool alone,
                          zr_vd out[3])
{
    const zr_vd zero = zr_vd_set(0.0), unit = zr_vd_set(1.0), up = zr_vd_set(y);
    zr_vd v[SHARE_DOUBLES], plane[3];
    zr_eye_load(shares, places, SHARE_DOUBLES, alone, v);
    for (int k = 0; k < 3; k++)
        plane[k] = (v[3 * k] + v[3 * k + 2] * up) + v[3 * k + 1] * x;
    const zr_vd second = zr_vd_min(zr_vd_max(plane[0] / plane[2], zero), unit);
    const zr_vd third = zr_vd_min(zr_vd_max(plane[1] / plane[2], zero), unit - second);
    const zr_vd parts[3] = {unit - second - third, second, third};
    const zr_vd all = (parts[0] * v[9] + parts[1] * v[10]) + parts[2] * v[11];
    for (int k = 0; k < 3; k++)
        out[k] = zr_vd_select_zero(all, zero, parts[k] * v[9 + k] / all);
}

/* ---- rows ---- */

/* Writes the first `count` of ZR_LANES pixels of three floats. */
static inline void put_threes(float (*in)[ZR_LANES], zr_vm uncovered, int32_t count, float *out)
{
    float fours[4 * ZR_LANES];
    const zr_vf zero = zr_vf_set(0.0f);
    zr_vf v[3];
    for (int k = 0; k < 3; k++)
        v[k] = zr_vf_select(uncovered, zero, zr_vf_load(in[k]));
    zr_vf_store4(fours, v[0], v[1], v[2], zero);
    int32_t i = 0;
    for (; i + 1 < count; i++) /* the fourth is overwritten by the next pixel */
        memcpy(out + 3 * i, fours + 4 * i, 4 * sizeof *out);
    memcpy(out + 3 * i, fours + 4 * i, 3 * sizeof *out);
}

static inline void put_ones(const float *in, zr_vm uncovered, int32_t count, float *out)
{
    zr_vi_store_first(out, zr_vi_bits_of(zr_vf_select(uncovered, zr_vf_set((float)INFINITY), zr_vf_load(in))),
                      (uint32_t)count);
}

/* A row of a band. */
struct row {
    const int32_t *depths, *shares; /* places of each pixel */
    int32_t x, y;
};

/* Computes the channels of ZR_LANES pixels from column i on. */
ZR_INLINED void fill_some(const struct zr_eye_rays *rays, const struct zr_eye_band *band, const struct row *row,
                          int32_t i, bool alone, const struct zr_eye_targets *to)
{
    float columns[ZR_LANES], distance[ZR_LANES] = {0}, position[3][ZR_LANES] = {{0}}, shares[3][ZR_LANES] = {{0}};
    const double y = (double)row->y;
    zr_vf_store(columns, zr_vf_of(zr_vi_set(row->x + i) + zr_vi_ramp()));
    for (int k = 0; k < ZR_LANES; k += ZR_DOUBLES) {
        const zr_vd x = zr_vd_widen(columns + k);
        if (to->distance || to->position) {
            const zr_vd depth = zr_eye_depths_at(band->depths, row->depths + i + k, x, y, alone);
            const struct ray ray = ray_of(rays, x, y);
            const struct point point = point_of(&ray, depth), place = placed(rays, &point);
            zr_vd_narrow(distance + k, rays->is_parallel ? depth : distance_of(rays, &point));
            zr_vd_narrow(position[0] + k, place.x);
            zr_vd_narrow(position[1] + k, place.y);
            zr_vd_narrow(position[2] + k, place.z);
        }
        if (to->barycentrics) {
            zr_vd each[3];
            shares_at(band->shares, row->shares + i + k, x, y, alone, each);
            for (int c = 0; c < 3; c++)
                zr_vd_narrow(shares[c] + k, each[c]);
        }
    }
    const zr_vm uncovered = zr_vi_eq(zr_vi_load(row->depths + i), zr_vi_set(0));
    const int32_t rest = band->width - i, count = rest < ZR_LANES ? rest : ZR_LANES;
    if (to->distance) put_ones(distance, uncovered, count, to->distance + i);
    if (to->position) put_threes(position, uncovered, count, to->position + 3 * i);
    if (to->barycentrics) put_threes(shares, uncovered, count, to->barycentrics + 3 * i);
}

static inline void clear_some(const struct zr_eye_band *band, int32_t i, const struct zr_eye_targets *to)
{
    const int32_t rest = band->width - i, count = rest < ZR_LANES ? rest : ZR_LANES;
    const float nothing[ZR_LANES] = {0};
    if (to->distance) put_ones(nothing, ZR_ALL_LANES, count, to->distance + i);
    if (to->position) memset(to->position + 3 * i, 0, 3 * (size_t)count * sizeof *to->position);
    if (to->barycentrics) memset(to->barycentrics + 3 * i, 0, 3 * (size_t)count * sizeof *to->barycentrics);
}

static void fill_row(const struct zr_eye_rays *rays, const struct zr_eye_band *band, const struct row *row,
                     const struct zr_eye_targets *to)
{
    for (int32_t i = 0; i < band->width; i += ZR_LANES) {
        const int32_t *places = row->depths + i;
        const bool alone = zr_vm_bits(zr_vi_eq(zr_vi_load(places), zr_vi_set(*places))) == ZR_ALL_BITS;
        if (alone && *places == 0)
            clear_some(band, i, to);
        else if (alone)
            fill_some(rays, band, row, i, true, to);
        else
            fill_some(rays, band, row, i, false, to);
    }
}

static void fill(const struct zr_eye_rays *rays, const struct zr_eye_band *band, const struct zr_eye_targets *to,
                 int32_t first)
{
    struct zr_eye_places depths, shares;
    for (int32_t i = 0; i < band->rows; i++) {
        zr_eye_spread_runs(&band->runs[i], ZR_EYE_DEPTH_DOUBLES, depths.at[i]);
        if (to->barycentrics) zr_eye_spread_runs(&band->runs[i], SHARE_DOUBLES, shares.at[i]);
    }
    for (int32_t i = 0; i < band->rows; i++) {
        const ptrdiff_t at = (first + i) * to->stride;
        const struct row row = {depths.at[i], shares.at[i], band->x, band->y + i};
        const struct zr_eye_targets here = {to->distance ? to->distance + at : NULL,
                                            to->position ? to->position + 3 * at : NULL,
                                            to->barycentrics ? to->barycentrics + 3 * at : NULL, 0};
        fill_row(rays, band, &row, &here);
    }
}

const struct zr_eye_points ZR_KERNEL(zr_eye_points) = {make, fill};
