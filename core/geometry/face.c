#include "geometry/face.h"

#include "geometry/normals.h"

static bool same_place(const struct zr_mesh *mesh, uint32_t a, uint32_t b)
{
    const zr_vec4 *p = &mesh->positions[a], *q = &mesh->positions[b];
    return a == b || (p->x == q->x && p->y == q->y && p->z == q->z && p->w == q->w);
}

bool zr_face_is_degenerate(const struct zr_mesh *mesh, uint32_t face)
{
    const uint32_t *indices = mesh->indices + mesh->face_offsets[face];
    uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
    uint32_t second = 1;
    while (second < count && same_place(mesh, indices[0], indices[second]))
        second++;
    for (uint32_t i = second + 1; i < count; i++)
        if (!same_place(mesh, indices[0], indices[i]) && !same_place(mesh, indices[second], indices[i])) return false;
    return true;
}

bool zr_face_is_shape(const struct zr_mesh *mesh, uint32_t face)
{
    if (mesh->faces_are_fans) return false;
    uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
    return zr_mesh_rings(mesh, face).count > 1 || (count > 3 && zr_face_is_concave(mesh, face));
}
