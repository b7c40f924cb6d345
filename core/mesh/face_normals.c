#include "mesh/face_normals.h"

#include "geometry/face.h"

static zr_vec3 corner(const struct zr_mesh *mesh, uint32_t slot)
{
    return zr_vec4_over_w(mesh->positions[mesh->indices[slot]]);
}

/* Cross products are relative to the first corner, so that a small face far from the origin keeps its precision. */
zr_vec3 zr_normal_of_face(const struct zr_mesh *mesh, uint32_t face)
{
    uint32_t begin = mesh->face_offsets[face], end = zr_mesh_rings(mesh, face).offsets[1];
    zr_vec3 origin = corner(mesh, begin), sum = {0, 0, 0};
    zr_vec3 previous = zr_vec3_sub(corner(mesh, begin + 1), origin);
    for (uint32_t slot = begin + 2; slot < end; slot++) {
        zr_vec3 current = zr_vec3_sub(corner(mesh, slot), origin);
        sum = zr_vec3_add(sum, zr_vec3_cross(previous, current));
        previous = current;
    }
    return sum;
}

void zr_face_normals_begin(struct zr_face_normals *normals, enum zr_isa isa, const struct zr_mesh *mesh)
{
    normals->mesh = mesh;
    normals->make_many = zr_mesh_is_of_triangles(mesh) ? zr_triangle_normals_of(isa) : NULL;
    normals->first = normals->count = 0;
}

void zr_face_normals_make(struct zr_face_normals *normals, uint32_t face)
{
    const uint32_t left = normals->mesh->face_count - face;
    normals->first = face;
    normals->count = left < ZR_NORMALS_AT_ONCE ? left : ZR_NORMALS_AT_ONCE;
    normals->make_many(normals->mesh, face, normals->count, normals->normals);
}

zr_vec3 zr_corner_normal(const struct zr_mesh *mesh, const zr_vec4 *computed, uint32_t vertex, uint32_t slot)
{
    zr_vec3 normal = {0, 0, 0};
    if (mesh->normal_count > 0) normal = mesh->normals[mesh->normal_indices ? mesh->normal_indices[slot] : vertex];
    if (!zr_normal_is_zero(normal) || !computed) return normal;
    return (zr_vec3){computed[vertex].x, computed[vertex].y, computed[vertex].z};
}

bool zr_mesh_lacks_normals(const struct zr_mesh *mesh)
{
    if (mesh->normal_count == 0) return true;
    for (uint32_t n = 0; n < mesh->normal_count; n++)
        if (zr_normal_is_zero(mesh->normals[n])) return true;
    return false;
}

bool zr_mesh_is_lit_by_computed_normals(const struct zr_scene *scene, const struct zr_mesh *mesh)
{
    const uint32_t count = mesh->face_materials ? mesh->face_count : 1;
    bool found = false;
    for (uint32_t f = 0; f < count && !found; f++)
        found = zr_shading_is_at(zr_material_of_face(scene, mesh, f)->shading, ZR_SHADED_PER_VERTEX);
    return found && zr_mesh_lacks_normals(mesh);
}
