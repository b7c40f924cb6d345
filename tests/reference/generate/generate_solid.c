/* Generators of polygons, of coplanar duplicates, and of scenes behind matrices. */
#include <math.h>

#include "reference/generate/generate.h"

enum { CORNERS_MAX = 12 };

/* ---- equal depths ---- */

/* The same corners again: in the same order, which gives equal depths and must
 * not replace what is there (LESS); turned; and the other way round. */
void fill_coplanar(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 20; i++) {
        double x = random_range(r, -1, 1), y = random_range(r, -1, 1), reach = random_power(r, -4, -1);
        double w = random_below(r, 2) ? 1.0 : random_range(r, 0.25, 4);
        const double low[3] = {fmax(x - reach, -1), fmax(y - reach, -1), -0.9};
        const double high[3] = {fmin(x + reach, 1), fmin(y + reach, 1), 0.9};
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = random_vertex_in(drawing, r, low, high, w);
        drawing_triangle(drawing, v[0], v[1], v[2]);
        drawing_triangle(drawing, v[0], v[1], v[2]);
        drawing_triangle(drawing, v[1], v[2], v[0]);
        drawing_triangle(drawing, v[2], v[0], v[1]);
        drawing_triangle(drawing, v[2], v[1], v[0]);
    }
}

/* ---- polygons ---- */

/* `count` points on the unit circle, counter-clockwise: the rational
 * parametrization, so that no function of libm is needed. */
static void circle_points(struct random *r, int count, double (*out)[2])
{
    for (int i = 0; i < count; i++) {
        double t = -4.0 + 8.0 * (i + random_range(r, 0.1, 0.9)) / count;
        out[i][0] = (1 - t * t) / (1 + t * t);
        out[i][1] = 2 * t / (1 + t * t);
    }
}

static double clamped(double x, double limit)
{
    return fmax(-limit, fmin(limit, x));
}

/* Convex and planar: an ellipse's points under an affine map into the box. */
static void add_polygon(struct drawing *drawing, struct random *r, double radius, double limit)
{
    int count = 3 + (int)random_below(r, CORNERS_MAX - 2);
    double circle[CORNERS_MAX][2], map[3][3];
    uint32_t corners[CORNERS_MAX];
    circle_points(r, count, circle);
    for (int row = 0; row < 3; row++) {
        double reach = row < 2 ? radius : fmin(radius, 0.4);
        map[row][0] = random_range(r, -reach, reach);
        map[row][1] = random_range(r, -reach, reach);
        double most = fabs(map[row][0]) + fabs(map[row][1]);
        map[row][2] = clamped(random_range(r, -1, 1), fmax(limit - most, 0.1));
    }
    for (int i = 0; i < count; i++) {
        double place[3];
        for (int row = 0; row < 3; row++)
            place[row] = map[row][0] * circle[i][0] + map[row][1] * circle[i][1] + map[row][2];
        corners[i] = random_vertex(drawing, r, place[0], place[1], place[2], 1);
    }
    drawing_face(drawing, corners, (uint32_t)count);
}

/* The third row of z and w: w varies over the picture, and planes stay planes. */
static zr_mat4 tilt(struct random *r)
{
    zr_mat4 m = zr_mat4_identity();
    m.m[3] = (float)random_range(r, -0.3, 0.3);
    m.m[7] = (float)random_range(r, -0.3, 0.3);
    m.m[11] = (float)random_range(r, -0.3, 0.3);
    return m;
}

void fill_polygons(struct drawing *drawing, struct random *r)
{
    bool perspective = random_below(r, 2);
    for (int i = 0; i < 40; i++)
        add_polygon(drawing, r, random_power(r, -5, -2), 0.99);
    if (!perspective) return;
    drawing->projection = tilt(r);
    /* w is now 0.1 .. 1.9: shrunk, all but a few stay inside. */
    for (int i = 0; i < 3; i++)
        drawing->projection.m[i * 5] = 0.4f;
}

void fill_polygons_clipped(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 12; i++)
        add_polygon(drawing, r, random_power(r, -2, 1), 2);
    if (random_below(r, 2)) drawing->projection = tilt(r);
}

/* ---- scenes behind matrices ---- */

/* A random rotation, from a quaternion in the unit ball, and a move. */
static zr_mat4 placement(struct random *r, double scale, double x, double y, double z)
{
    double q[4], length;
    do {
        length = 0;
        for (int i = 0; i < 4; i++) {
            q[i] = random_range(r, -1, 1);
            length += q[i] * q[i];
        }
    } while (length > 1.0 || length < 0.01);
    double s = 2.0 / length, a = q[0], b = q[1], c = q[2], d = q[3];
    double m[16] = {1 - s * (c * c + d * d),
                    s * (b * c + a * d),
                    s * (b * d - a * c),
                    0,
                    s * (b * c - a * d),
                    1 - s * (b * b + d * d),
                    s * (c * d + a * b),
                    0,
                    s * (b * d + a * c),
                    s * (c * d - a * b),
                    1 - s * (b * b + c * c),
                    0,
                    x,
                    y,
                    z,
                    1};
    zr_mat4 out;
    for (int i = 0; i < 16; i++)
        out.m[i] = (float)(i < 12 ? m[i] * scale : m[i]);
    return out;
}

/* A soup of triangles and quads in the unit cube, small ones and large ones. */
static void add_soup(struct drawing *drawing, struct random *r)
{
    for (int i = 0; i < 120; i++) {
        double reach = random_power(r, -5, random_below(r, 8) ? -2 : 0);
        double x = random_range(r, -1, 1), y = random_range(r, -1, 1), z = random_range(r, -1, 1);
        double p[3][3];
        uint32_t v[4];
        for (int k = 0; k < 3; k++) {
            p[k][0] = x + random_range(r, -reach, reach);
            p[k][1] = y + random_range(r, -reach, reach);
            p[k][2] = z + random_range(r, -reach, reach);
            v[k] = random_vertex(drawing, r, p[k][0], p[k][1], p[k][2], 1);
        }
        if (random_below(r, 3)) {
            drawing_triangle(drawing, v[0], v[1], v[2]);
            continue;
        }
        v[3] = random_vertex(drawing, r, p[0][0] + p[2][0] - p[1][0], p[0][1] + p[2][1] - p[1][1],
                             p[0][2] + p[2][2] - p[1][2], 1);
        drawing_face(drawing, v, 4);
    }
}

void fill_matrix_orthographic(struct drawing *drawing, struct random *r)
{
    add_soup(drawing, r);
    double scale = random_power(r, -2, 2), x = random_range(r, -0.3, 0.3), y = random_range(r, -0.3, 0.3);
    drawing->modelview = placement(r, scale, scale * x, scale * y, -scale * random_range(r, 1, 3));
    /* glOrtho's matrix (OpenGL 2.1 specification, section 2.11.2). */
    double half_width = scale * random_range(r, 0.8, 1.6), half_height = scale * random_range(r, 0.8, 1.6);
    double n = scale * random_range(r, 0.1, 1), f = scale * random_range(r, 2, 5);
    zr_mat4 m = zr_mat4_identity();
    m.m[0] = (float)(1 / half_width);
    m.m[5] = (float)(1 / half_height);
    m.m[10] = (float)(-2 / (f - n));
    m.m[14] = (float)(-(f + n) / (f - n));
    drawing->projection = m;
}

void fill_matrix_perspective(struct drawing *drawing, struct random *r)
{
    add_soup(drawing, r);
    double scale = random_power(r, -2, 2), x = random_range(r, -0.5, 0.5), y = random_range(r, -0.5, 0.5);
    drawing->modelview = placement(r, scale, scale * x, scale * y, -scale * random_range(r, 0.2, 3));
    /* glFrustum's matrix (OpenGL 2.1 specification, section 2.11.2). */
    double focal = random_range(r, 0.7, 2.5), aspect = (double)drawing->width / drawing->height;
    double n = scale * random_power(r, -6, -2), f = scale * random_range(r, 2, 6);
    zr_mat4 m = {{0}};
    m.m[0] = (float)(focal / aspect);
    m.m[5] = (float)focal;
    m.m[8] = random_below(r, 2) ? 0.0f : (float)random_range(r, -0.3, 0.3);
    m.m[10] = (float)(-(f + n) / (f - n));
    m.m[11] = -1.0f;
    m.m[14] = (float)(-2 * f * n / (f - n));
    drawing->projection = m;
}

/* No zeros and no structure anywhere, so that the order of each sum shows. */
static zr_mat4 dense_matrix(struct random *r, double reach)
{
    zr_mat4 m;
    for (int i = 0; i < 16; i++) {
        double entry = random_range(r, -reach, reach);
        m.m[i] = (float)(i % 5 == 0 ? entry + (random_below(r, 2) ? 0.5 : -0.5) : entry);
    }
    return m;
}

void fill_matrix_any(struct drawing *drawing, struct random *r)
{
    add_soup(drawing, r);
    drawing->modelview = dense_matrix(r, 0.6);
    drawing->projection = dense_matrix(r, 0.4);
    drawing->projection.m[15] = (float)random_range(r, 1, 2);
}
