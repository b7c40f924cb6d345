/* face_area.h - scene: the area of a face as a vector along its normal, in object space. */
#ifndef ZR_FACE_AREA_H
#define ZR_FACE_AREA_H

#include "scene/scene.h"

/* Components along x, y and z; the length is the area, if the face is flat. */
struct zr_face_area {
    double along[3];
};

/* Sums the triangles of a fan over the face's outer ring. Positions have w = 1. */
static inline struct zr_face_area zr_face_area_of(const struct zr_mesh *mesh, uint32_t face)
{
    const uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    const zr_vec4 *first = &mesh->positions[mesh->indices[begin]];
    struct zr_face_area area = {{0, 0, 0}};
    for (uint32_t i = begin + 1; i + 1 < end; i++) {
        const zr_vec4 *p = &mesh->positions[mesh->indices[i]], *q = &mesh->positions[mesh->indices[i + 1]];
        const double u[3] = {(double)p->x - (double)first->x, (double)p->y - (double)first->y,
                             (double)p->z - (double)first->z};
        const double v[3] = {(double)q->x - (double)first->x, (double)q->y - (double)first->y,
                             (double)q->z - (double)first->z};
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            area.along[a] += 0.5 * (u[b] * v[c] - u[c] * v[b]);
        }
    }
    return area;
}

#endif
