#include "scene/doubled_faces.h"

#include <inttypes.h>
#include <stdio.h>

#include "scene/mesh_label.h"

/* Hashes corners from `first` on, by steps of `step` modulo `count`. Source: FNV-1a, by words. The final mix keeps sums
 * of unrelated hashes from being 0. */
static uint64_t hash_corners(const uint32_t *corners, uint32_t count, uint32_t first, uint32_t step)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (uint32_t i = 0, k = first; i < count; i++, k = (k + step) % count)
        hash = (hash ^ corners[k]) * UINT64_C(1099511628211);
    hash = (hash ^ hash >> 31) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ hash >> 29;
}

/* Returns hashes that add up to 0 for a face and its reverse. The hash starts at the least corner, number `least`, and
 * runs towards the lesser of its neighbours; its sign is the direction. */
static uint64_t signed_hash(const uint32_t *corners, uint32_t count, uint32_t least)
{
    const uint32_t next = corners[(least + 1) % count], last = corners[(least + count - 1) % count];
    return next < last ? hash_corners(corners, count, least, 1) : 0 - hash_corners(corners, count, least, count - 1);
}

static uint64_t hash_of_face(const struct zr_mesh *mesh, uint32_t face)
{
    const uint32_t first = mesh->face_offsets[face], count = mesh->face_offsets[face + 1] - first;
    const uint32_t *corners = mesh->indices + first;
    uint32_t least = 0;
    for (uint32_t i = 1; i < count; i++)
        if (corners[i] < corners[least]) least = i;
    return signed_hash(corners, count, least);
}

/* Finds the face of an entry of `indices`, by bisection. */
static uint32_t face_at(const struct zr_mesh *mesh, uint32_t slot)
{
    uint32_t low = 0, high = mesh->face_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        *(mesh->face_offsets[middle] <= slot ? &low : &high) = middle;
    }
    return low;
}

/* True if the mesh contains the reverse of its first face; most meshes do not, and need no further test. Searches the
 * first corner in blocks that compilers vectorise. */
static bool first_is_doubled(const struct zr_mesh *mesh)
{
    enum { AT_ONCE = 64 };
    const uint32_t *indices = mesh->indices, wanted = indices[0], end = mesh->face_offsets[mesh->face_count];
    const uint64_t reversed = 0 - hash_of_face(mesh, 0);
    for (uint32_t slot = mesh->face_offsets[1]; slot < end; slot += AT_ONCE) {
        const uint32_t behind = end - slot < AT_ONCE ? end : slot + AT_ONCE;
        uint32_t found = 0;
        for (uint32_t i = slot; i < behind; i++)
            found |= indices[i] == wanted;
        for (uint32_t i = slot; found && i < behind; i++)
            if (indices[i] == wanted && hash_of_face(mesh, face_at(mesh, i)) == reversed) return true;
    }
    return false;
}

bool zr_faces_are_doubled(const struct zr_mesh *mesh)
{
    uint64_t sum = 0;
    if (mesh->face_count == 0 || mesh->face_count % 2 != 0 || mesh->face_rings || !first_is_doubled(mesh)) return false;
    for (uint32_t face = 0; face < mesh->face_count; face++)
        sum += hash_of_face(mesh, face);
    return sum == 0;
}

/* True if the mesh has no normals and a shading that sums face normals. */
static bool sums_normals(const struct zr_scene *scene, const struct zr_mesh *mesh)
{
    if (mesh->face_count == 0 || mesh->normal_count > 0) return false;
    const enum zr_shading shading = zr_material_of_face(scene, mesh, 0)->shading;
    return (shading == ZR_SHADING_GOURAUD || shading == ZR_SHADING_PHONG || shading == ZR_SHADING_NORMALS);
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
