/* ray_check.h - tests: points of faces at pixels, in doubles. */
#ifndef ZR_TESTS_RAY_CHECK_H
#define ZR_TESTS_RAY_CHECK_H

#include "base/matrix.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Solves a x + b y + c z = r by Cramer's rule. */
static inline void solve(const double a[3], const double b[3], const double c[3], const double r[3], double out[3])
{
    double determinants[4];
    for (int i = 0; i < 4; i++) {
        const double *m[3] = {i == 0 ? r : a, i == 1 ? r : b, i == 2 ? r : c};
        determinants[i] = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                          m[1][0] * (m[0][1] * m[2][2] - m[0][2] * m[2][1]) +
                          m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]);
    }
    for (int i = 0; i < 3; i++)
        out[i] = determinants[i] / determinants[3];
}

/* Finds the shares of the corners at a pixel's centre: clip coordinates are linear in them. */
static inline void find_shares(const struct zr_frame *frame, const struct zr_scene *scene, uint32_t instance,
                               uint32_t face, double x, double y, double shares[3])
{
    const struct zr_mesh *mesh = &scene->meshes[scene->instances[instance].mesh];
    const struct zr_matrix world = zr_matrix_of(&scene->instances[instance].object_to_world),
                           eye = zr_matrix_of(&frame->camera.world_to_eye),
                           projection = zr_matrix_of(&frame->camera.projection);
    double rows[3][3], sum = 0.0; /* by corner: clip x, y and w */
    for (int i = 0; i < 3; i++) {
        const zr_vec4 *p = &mesh->positions[mesh->indices[mesh->face_offsets[face] + (uint32_t)i]];
        const double at[4] = {(double)p->x, (double)p->y, (double)p->z, (double)p->w};
        double w[4], e[4], c[4];
        zr_matrix_apply(&world, at, w);
        zr_matrix_apply(&eye, w, e);
        zr_matrix_apply(&projection, e, c);
        rows[i][0] = c[0], rows[i][1] = c[1], rows[i][2] = c[3];
    }
    const double ray[3] = {2.0 * (x + 0.5) / frame->width - 1.0, 1.0 - 2.0 * (y + 0.5) / frame->height, 1.0};
    solve(rows[0], rows[1], rows[2], ray, shares);
    for (int i = 0; i < 3; i++)
        sum += shares[i];
    for (int i = 0; i < 3; i++)
        shares[i] /= sum;
}

#endif
