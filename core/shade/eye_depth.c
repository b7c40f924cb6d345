#include "shade/eye_depth.h"

const struct zr_eye_depths *zr_eye_depths_of(enum zr_isa isa)
{
    static const struct zr_eye_depths *const table[ZR_ISA_COUNT] = ZR_KERNELS(&zr_eye_depths);
    return table[isa];
}

/* ---- depths of corners ---- */

static double least(const double v[3])
{
    double low = v[0] < v[1] ? v[0] : v[1];
    return low < v[2] ? low : v[2];
}

static double most(const double v[3])
{
    double high = v[0] > v[1] ? v[0] : v[1];
    return high > v[2] ? high : v[2];
}

static void eye_depths(const struct zr_eye eyes[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = -(double)eyes[k].z / (double)eyes[k].w;
}

/* ---- lines ---- */

/* Values vary along the major axis alone (raster/line.h). */
static struct zr_eye_plane line_plane(const struct zr_window_vertex *const v[3], double p0, double p1)
{
    double x0 = (double)v[0]->x, y0 = (double)v[0]->y, dx = x0 - (double)v[1]->x, dy = y0 - (double)v[1]->y;
    bool along_x = fabs(dx) >= fabs(dy);
    double dadx = along_x ? (p0 - p1) / dx : 0.0, dady = along_x ? 0.0 : (p0 - p1) / dy;
    return (struct zr_eye_plane){p0 - (dadx * (x0 - 0.5) + dady * (y0 - 0.5)), dadx, dady};
}

static struct zr_eye_depth line_depth(const struct zr_window_vertex *const v[3], const struct zr_eye eyes[3])
{
    double z[2], w[2], depths[3];
    for (int k = 0; k < 2; k++) {
        z[k] = -(double)eyes[k].z * (double)v[k]->oow;
        w[k] = (double)eyes[k].w * (double)v[k]->oow;
    }
    eye_depths(eyes, depths);
    return (struct zr_eye_depth){line_plane(v, z[0], z[1]), line_plane(v, w[0], w[1]), least(depths), most(depths)};
}

/* ---- triangles ---- */

/* In the rows of zr_source_instance: one corner of the triangle, and the ways from there to the others. */
struct corners {
    double first[ZR_SOURCE_ROWS], d1[ZR_SOURCE_ROWS], d2[ZR_SOURCE_ROWS];
};

/* Ways are taken in object space, where differences are exact or nearly so: a triangle may be
 * small and far from everything's origin. */
static inline void place(const struct zr_source_instance *instance, const zr_vec4 *to, zr_vec4 from,
                         double out[ZR_SOURCE_ROWS])
{
    const double(*m)[ZR_SOURCE_ROWS] = instance->columns;
    double x = (double)to->x - (double)from.x, y = (double)to->y - (double)from.y;
    double z = (double)to->z - (double)from.z, w = (double)to->w - (double)from.w;
    for (int r = 0; r < ZR_SOURCE_ROWS; r++)
        out[r] = ((x * m[0][r] + y * m[1][r]) + z * m[2][r]) + w * m[3][r];
}

static inline void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* The value in row `r` as a plane over the window, times what is the same for all rows. With c the corners in
 * x, y, w of clip space, p their values, and s = (x, y, 1) the sample, -1 to 1 over the window, it is
 * the sum of p_i (c_j x c_k), times s. That cancels where a triangle is small, and is written here by
 * differences: p0 (d1 x d2) + c0 x (p2 d1 - p1 d2). And it is multiplied by width and height, which
 * makes s whole numbers. `normal` is d1 x d2. */
static inline struct zr_eye_plane value_plane(const struct corners *c, const double normal[3], int r, double width,
                                              double height)
{
    double p0 = c->first[r], p1 = c->d1[r], p2 = c->d2[r], u[3], a[3];
    for (int k = 0; k < 3; k++)
        u[k] = p2 * c->d1[k] - p1 * c->d2[k];
    cross(c->first, u, a);
    double x = (a[0] + p0 * normal[0]) * height, y = (a[1] + p0 * normal[1]) * width;
    double one = (a[2] + p0 * normal[2]) * (width * height);
    return (struct zr_eye_plane){(one + x * (1.0 - width)) + y * (1.0 - height), 2.0 * x, 2.0 * y};
}

/* What the ray can meet: all of the mesh's triangle, and not only the piece of it that clipping left, for a
 * sample may lie a hair beyond that. Corners behind the eye or at infinity give no range; then those of the
 * piece do, where there is one, with so much room that only what is seen from its edge could be kept from its depth. */
static inline void make_range(const struct corners *c, const struct zr_eye eyes[3], struct zr_eye_depth *out)
{
    enum { W = ZR_SOURCE_W, DEPTH = ZR_SOURCE_EYE_DEPTH, EYE_W = ZR_SOURCE_EYE_W };
    const double w[3] = {c->first[W], c->first[W] + c->d1[W], c->first[W] + c->d2[W]};
    const double eye_w[3] = {c->first[EYE_W], c->first[EYE_W] + c->d1[EYE_W], c->first[EYE_W] + c->d2[EYE_W]};
    double depths[3] = {c->first[DEPTH] / eye_w[0], (c->first[DEPTH] + c->d1[DEPTH]) / eye_w[1],
                        (c->first[DEPTH] + c->d2[DEPTH]) / eye_w[2]};
    bool in_front = least(w) > 0.0 && least(eye_w) > 0.0;
    if (!in_front && eyes) eye_depths(eyes, depths);
    out->min = least(depths);
    out->max = most(depths);
    if (in_front) return;
    out->min *= out->min > 0.0 ? 0.5 : 1.5;
    out->max *= out->max > 0.0 ? 1.5 : 0.5;
}

/* Of a line, or of a piece: others have none. */
static void eyes_of(const struct zr_geometry *geometry, const struct zr_triangle *record, struct zr_eye out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = geometry->eyes[record->v[k]];
}

/* `eyes`: NULL where the triangle was not cut. */
static void triangle_depth(const struct zr_source_instance *instance, const zr_vec4 *const corners[3],
                           const struct zr_eye *eyes, uint32_t width, uint32_t height, struct zr_eye_depth *out)
{
    struct corners c;
    double normal[3];
    place(instance, corners[0], (zr_vec4){0, 0, 0, 0}, c.first);
    place(instance, corners[1], *corners[0], c.d1);
    place(instance, corners[2], *corners[0], c.d2);
    cross(c.d1, c.d2, normal);
    out->depth = value_plane(&c, normal, ZR_SOURCE_EYE_DEPTH, (double)width, (double)height);
    out->one = value_plane(&c, normal, ZR_SOURCE_EYE_W, (double)width, (double)height);
    make_range(&c, eyes, out);
}

void zr_eye_depth_of_corners(const struct zr_source_instance *instance, const zr_vec4 *const corners[3], uint32_t width,
                             uint32_t height, struct zr_eye_depth *out)
{
    triangle_depth(instance, corners, NULL, width, height, out);
}

void zr_eye_depth_make(const struct zr_geometry *geometry, const struct zr_triangle *record, uint32_t width,
                       uint32_t height, struct zr_eye_depth *out)
{
    const struct zr_window_vertex *const v[3] = {&geometry->vertices[record->v[0]], &geometry->vertices[record->v[1]],
                                                 &geometry->vertices[record->v[2]]};
    struct zr_eye eyes[3];
    if (record->line) {
        eyes_of(geometry, record, eyes);
        *out = line_depth(v, eyes);
        return;
    }
    const struct zr_source source = zr_source_of(&geometry->sources, record->v);
    if (source.is_cut) eyes_of(geometry, record, eyes);
    triangle_depth(source.instance, source.corners, source.is_cut ? eyes : NULL, width, height, out);
}
