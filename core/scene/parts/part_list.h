/* part_list.h - scene: the parts of a scene by name: each placed mesh, or each part of its mesh (zr_mesh.face_parts).
 *
 * Order:  by instance, then by number within the mesh. Without face_parts, this is the order of the channel instanceId.
 * Names:  a part of a mesh has its own name, else the name of the node that placed the mesh, else the mesh's name, else
 *         "part". A name that an earlier part has gets the first free number from 2: "wheel", "wheel.2". Names are
 *         therefore unique, and do not depend on later parts.
 */
#ifndef ZR_PART_LIST_H
#define ZR_PART_LIST_H

#include "base/arena.h"
#include "scene/scene.h"

struct zr_part {
    const char *name; /* UTF-8, unique in the list */
    uint32_t instance, mesh;
    uint32_t number; /* within the mesh; 0 if that is one part */
};

struct zr_part_list {
    uint32_t count; /* listed parts, the first ones of the scene */
    uint64_t total; /* all parts of the scene */
    const struct zr_part *at;
    uint32_t slot_count; /* hash table of names: 1 + number of a part; 0: empty */
    const uint32_t *slots;
};

/* Returns the number of parts of a mesh: 1 without face_parts. */
static inline uint32_t zr_mesh_part_count(const struct zr_mesh *mesh)
{
    return mesh->face_parts ? mesh->part_count : 1;
}

/* True if the mesh has lines or points that belong to no part. */
static inline bool zr_mesh_has_rest(const struct zr_mesh *mesh)
{
    return mesh->face_parts && (mesh->line_count > 0 || mesh->point_count > 0);
}

/* Lists the first `most` parts. Names with a number are made in the arena; the others belong to the scene. The list
 * is empty after a failed allocation, which the arena records, or if arena->cancel is raised. */
struct zr_part_list zr_part_list_make(struct zr_arena *arena, const struct zr_scene *scene, uint32_t most);

/* Returns the part of this name, or NULL. */
const struct zr_part *zr_part_list_find(const struct zr_part_list *list, const char *name);

#endif
