/* part_edit.h - scene: hides, recolours and moves parts of a scene.
 *
 *     part_edit.c   scene         -> instances, each with a mesh for the style of its parts
 *     part_mesh.c   mesh, styles  -> mesh with other materials, colours, positions
 *
 * Ids:    instances, faces, lines and points keep their numbers, and therefore their ids. Hidden elements have a
 *         material with is_hidden.
 * Meshes: the first changed copy of a mesh replaces the mesh if no instance uses it unchanged. Further copies are added
 *         after all meshes. Instances with equal styles share a copy, unless their parts move within it.
 */
#ifndef ZR_PART_EDIT_H
#define ZR_PART_EDIT_H

#include "scene/parts/part_list.h"
#include "scene/parts/part_mesh.h"
#include "scene/parts/part_offsets.h"
#include "scene/scene_builder.h"

struct zr_part_edit {
    const struct zr_part_list *list;      /* all parts of the scene */
    const uint32_t *styles;               /* one per part */
    const zr_vec4 *colors;                /* colours that styles refer to */
    bool hides_rest;                      /* lines and points that belong to no part are hidden */
    const struct zr_part_offset *offsets; /* one per part; NULL: nothing moves */
};

enum zr_part_edit_result {
    ZR_PART_EDIT_DONE,
    ZR_PART_EDIT_FAILED, /* no memory, or arena->cancel is raised */
    ZR_PART_EDIT_FLAT    /* the matrix of *instance has no inverse, so the parts of its mesh cannot move */
};

/* Edits the scene of a closed builder. Sets *instance to the refused instance for ZR_PART_EDIT_FLAT. */
enum zr_part_edit_result zr_part_edit(struct zr_scene_builder *builder, const struct zr_part_edit *edit,
                                      uint32_t *instance);

#endif
