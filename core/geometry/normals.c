#include "geometry/normals.h"

static zr_vec3 corner(const struct zr_mesh *mesh, uint32_t slot)
{
    zr_vec4 p = mesh->positions[mesh->indices[slot]];
    if (p.w == 1.0f || p.w == 0.0f) return (zr_vec3){p.x, p.y, p.z};
    return (zr_vec3){p.x / p.w, p.y / p.w, p.z / p.w};
}

/* Cross products are taken from the first corner, so that a small face far from
 * the origin loses nothing. */
zr_vec3 zr_normal_of_face(const struct zr_mesh *mesh, uint32_t face)
{
    uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    zr_vec3 origin = corner(mesh, begin), sum = {0, 0, 0};
    zr_vec3 previous = zr_vec3_sub(corner(mesh, begin + 1), origin);
    for (uint32_t slot = begin + 2; slot < end; slot++) {
        zr_vec3 current = zr_vec3_sub(corner(mesh, slot), origin);
        sum = zr_vec3_add(sum, zr_vec3_cross(previous, current));
        previous = current;
    }
    return sum;
}

zr_vec3 *zr_normals_of_vertices(struct zr_arena *arena, const struct zr_mesh *mesh)
{
    zr_vec3 *normals = zr_arena_zero(arena, mesh->position_count, sizeof *normals);
    if (!normals) return NULL;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        zr_vec3 normal = zr_normal_of_face(mesh, face);
        for (uint32_t slot = mesh->face_offsets[face]; slot < mesh->face_offsets[face + 1]; slot++) {
            uint32_t vertex = mesh->indices[slot];
            normals[vertex] = zr_vec3_add(normals[vertex], normal);
        }
    }
    for (uint32_t i = 0; i < mesh->position_count; i++)
        normals[i] = zr_vec3_normalize(normals[i]);
    return normals;
}

bool zr_face_is_concave(const struct zr_mesh *mesh, uint32_t face, zr_vec3 normal)
{
    uint32_t begin = mesh->face_offsets[face], count = mesh->face_offsets[face + 1] - begin;
    if (count < 4) return false;
    /* Turns against the winding by less than this are rounding, not shape. */
    float tolerance = -1e-5f * zr_vec3_dot(normal, normal);
    zr_vec3 previous = corner(mesh, begin + count - 1), current = corner(mesh, begin);
    for (uint32_t i = 0; i < count; i++) {
        zr_vec3 next = corner(mesh, begin + (i + 1 == count ? 0 : i + 1));
        zr_vec3 turn = zr_vec3_cross(zr_vec3_sub(current, previous), zr_vec3_sub(next, current));
        if (zr_vec3_dot(turn, normal) < tolerance) return true;
        previous = current;
        current = next;
    }
    return false;
}
