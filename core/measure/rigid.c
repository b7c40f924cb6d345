#include "measure/rigid.h"

#include <string.h>

#include "base/cancel.h"
#include "measure/solid.h"
#include "mesh/jacobi.h"

enum { TRIANGLES_PER_CANCEL_CHECK = 1 << 12 };

/* ---- motions ---- */

struct zr_world_place zr_rigid_apply(const struct zr_rigid *m, struct zr_world_place p)
{
    return (struct zr_world_place){(m->turn[0][0] * p.x + m->turn[0][1] * p.y) + (m->turn[0][2] * p.z + m->shift[0]),
                                   (m->turn[1][0] * p.x + m->turn[1][1] * p.y) + (m->turn[1][2] * p.z + m->shift[1]),
                                   (m->turn[2][0] * p.x + m->turn[2][1] * p.y) + (m->turn[2][2] * p.z + m->shift[2])};
}

struct zr_rigid zr_rigid_scaling(struct zr_world_place center, double scale)
{
    const double rest = 1.0 - scale;
    return (struct zr_rigid){{{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}},
                             {rest * center.x, rest * center.y, rest * center.z}};
}

double zr_rigid_scale(const struct zr_rigid *motion)
{
    const double *x = motion->turn[0], length = sqrt((x[0] * x[0] + x[1] * x[1]) + x[2] * x[2]);
    return fabs(length - 1.0) < 1e-12 ? 1.0 : length;
}

struct zr_rigid zr_rigid_after(const struct zr_rigid *first, const struct zr_rigid *then)
{
    struct zr_rigid out;
    const struct zr_world_place shift =
        zr_rigid_apply(then, (struct zr_world_place){first->shift[0], first->shift[1], first->shift[2]});
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            out.turn[r][c] = (then->turn[r][0] * first->turn[0][c] + then->turn[r][1] * first->turn[1][c]) +
                             then->turn[r][2] * first->turn[2][c];
    out.shift[0] = shift.x;
    out.shift[1] = shift.y;
    out.shift[2] = shift.z;
    return out;
}

struct zr_rigid zr_rigid_of_step(struct zr_world_place center, const double turn[3], const double shift[3])
{
    double q[4] = {1.0, 0.5 * turn[0], 0.5 * turn[1], 0.5 * turn[2]};
    const double length = sqrt((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]));
    for (int k = 0; k < 4; k++)
        q[k] /= length;
    struct zr_rigid m = {
        {{1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])},
         {2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] - q[0] * q[1])},
         {2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2])}},
        {0, 0, 0}};
    const struct zr_world_place turned = zr_rigid_apply(&m, center);
    m.shift[0] = center.x - turned.x + shift[0];
    m.shift[1] = center.y - turned.y + shift[1];
    m.shift[2] = center.z - turned.z + shift[2];
    return m;
}

/* ---- moments ---- */

/* Adds a triangle of a surface, or the pyramid over it, whose other corner is `apex`. */
static void add(const struct zr_world_place p[3], struct zr_world_place apex, bool is_volume, double *weight,
                double first[3], double second[3][3])
{
    const struct zr_world_place a = zr_world_place_minus(p[0], apex), b = zr_world_place_minus(p[1], apex),
                                c = zr_world_place_minus(p[2], apex),
                                n = zr_world_place_cross(zr_world_place_minus(b, a), zr_world_place_minus(c, a));
    const double own = is_volume ? zr_world_place_dot(a, n) / 6.0 : 0.5 * sqrt(zr_world_place_dot(n, n));
    const double corners[3][3] = {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
    double sum[3];
    for (int k = 0; k < 3; k++)
        sum[k] = corners[0][k] + corners[1][k] + corners[2][k];
    *weight += own;
    for (int k = 0; k < 3; k++) {
        first[k] += own * sum[k] / (is_volume ? 4.0 : 3.0);
        for (int j = 0; j < 3; j++) {
            const double products =
                corners[0][k] * corners[0][j] + corners[1][k] * corners[1][j] + corners[2][k] * corners[2][j];
            second[k][j] += own * (sum[k] * sum[j] + products) / (is_volume ? 20.0 : 12.0);
        }
    }
}

struct zr_moments zr_moments_of(const struct zr_solid *solid, const struct zr_cancel *cancel)
{
    struct zr_moments out = {.center = {0, 0, 0}};
    double weight = 0.0, first[3] = {0, 0, 0};
    if (solid->count == 0) return out;
    const struct zr_world_place apex = solid->places[solid->corners[0][0]];
    for (uint32_t t = 0; t < solid->count; t++) {
        struct zr_world_place p[3];
        if (t % TRIANGLES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) break;
        zr_solid_places(solid, t, p);
        add(p, apex, solid->is_closed, &weight, first, out.second);
    }
    if (weight == 0.0) return (struct zr_moments){.center = apex};
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            out.second[k][j] = out.second[k][j] / weight - first[k] / weight * (first[j] / weight);
    out.center =
        (struct zr_world_place){apex.x + first[0] / weight, apex.y + first[1] / weight, apex.z + first[2] / weight};
    return out;
}

/* ---- eigenvectors ---- */

void zr_eigen_find(const double matrix[3][3], double values[3], double vectors[3][3])
{
    enum { SWEEPS = 30 };
    double a[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int order[3] = {0, 1, 2};
    memcpy(a, matrix, sizeof a);
    for (int i = 0; i < SWEEPS; i++) {
        zr_jacobi_turn(a, v, 0, 1);
        zr_jacobi_turn(a, v, 0, 2);
        zr_jacobi_turn(a, v, 1, 2);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (a[order[k]][order[k]] > a[order[k + 1]][order[k + 1]]) {
                const int other = order[k];
                order[k] = order[k + 1];
                order[k + 1] = other;
            }
    for (int i = 0; i < 3; i++) {
        values[i] = a[order[i]][order[i]];
        for (int k = 0; k < 3; k++)
            vectors[k][i] = v[k][order[i]];
    }
    for (int k = 0; k < 3; k++) { /* the third one completes a rotation */
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        vectors[k][2] = vectors[next][0] * vectors[last][1] - vectors[last][0] * vectors[next][1];
    }
}
