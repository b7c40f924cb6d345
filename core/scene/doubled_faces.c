#include "scene/doubled_faces.h"

#include <inttypes.h>
#include <stdio.h>

#include "scene/mesh_label.h"

/* Source: FNV-1a, by words, and a last mix, so that sums of such numbers are 0 by their terms alone. */
static uint64_t hash_corners(const uint32_t *corners, uint32_t count, uint32_t first, uint32_t step)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (uint32_t i = 0, k = first; i < count; i++, k = (k + step) % count)
        hash = (hash ^ corners[k]) * UINT64_C(1099511628211);
    hash = (hash ^ hash >> 31) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ hash >> 29;
}

/* A face and the one that goes the other way around have numbers that add up to 0: from the least corner on, in the
 * direction of the lesser of its neighbours. */
static uint64_t signed_hash(const uint32_t *corners, uint32_t count)
{
    uint32_t least = 0;
    for (uint32_t i = 1; i < count; i++)
        if (corners[i] < corners[least]) least = i;
    const uint32_t next = corners[(least + 1) % count], last = corners[(least + count - 1) % count];
    return next < last ? hash_corners(corners, count, least, 1) : 0 - hash_corners(corners, count, least, count - 1);
}

bool zr_faces_are_doubled(const struct zr_mesh *mesh)
{
    uint64_t sum = 0;
    if (mesh->face_count == 0 || mesh->face_count % 2 != 0 || mesh->face_rings) return false;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t first = mesh->face_offsets[face];
        sum += signed_hash(mesh->indices + first, mesh->face_offsets[face + 1] - first);
    }
    return sum == 0;
}

/* Its normals are sums: by the shading's choice, and since none are given. */
static bool sums_normals(const struct zr_scene *scene, const struct zr_mesh *mesh)
{
    const enum zr_shading shading = zr_material_of_face(scene, mesh, 0)->shading;
    return mesh->face_count > 0 && mesh->normal_count == 0 &&
           (shading == ZR_SHADING_GOURAUD || shading == ZR_SHADING_PHONG || shading == ZR_SHADING_NORMALS);
}

void zr_doubled_faces_warn(struct zr_arena *arena, const struct zr_scene *scene, struct zr_warning_list *warnings)
{
    uint32_t count = 0, first = 0;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        if (sums_normals(scene, &scene->meshes[i]) && zr_faces_are_doubled(&scene->meshes[i]) && count++ == 0)
            first = i;
    if (count == 0) return;
    char more[32] = "";
    if (count > 1) snprintf(more, sizeof more, " and %" PRIu32 " more", count - 1);
    zr_warning_list_add(
        arena, warnings,
        "%s%s: each face is there twice, once with each winding, so that the normals of vertices add up "
        "to 0; \"shading\": \"flat\" lights them, and so does each face once with \"doubleSided\"",
        zr_mesh_label_of(first, scene->meshes[first].name).text, more);
}
