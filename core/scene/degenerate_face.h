/* degenerate_face.h - scene: faces and lines that are never drawn, since corners share their places.
 *
 * Space:  object space. Faces without area are left to the subpixel grid, as in the reference.
 */
#ifndef ZR_DEGENERATE_FACE_H
#define ZR_DEGENERATE_FACE_H

#include "scene/scene.h"

static inline bool zr_is_same_place(const struct zr_mesh *mesh, uint32_t a, uint32_t b)
{
    const zr_vec4 *p = &mesh->positions[a], *q = &mesh->positions[b];
    return a == b || (p->x == q->x && p->y == q->y && p->z == q->z && p->w == q->w);
}

/* Returns true if the face has fewer than three distinct corners. */
static inline bool zr_face_is_degenerate(const struct zr_mesh *mesh, uint32_t face)
{
    const uint32_t *indices = mesh->indices + mesh->face_offsets[face];
    const uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
    uint32_t second = 1;
    while (second < count && zr_is_same_place(mesh, indices[0], indices[second]))
        second++;
    for (uint32_t i = second + 1; i < count; i++)
        if (!zr_is_same_place(mesh, indices[0], indices[i]) && !zr_is_same_place(mesh, indices[second], indices[i]))
            return false;
    return true;
}

#endif
