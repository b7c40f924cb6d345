/* part_mesh.h - scene: edits the parts of one mesh. */
#ifndef ZR_PART_MESH_H
#define ZR_PART_MESH_H

#include "scene/parts/part_offsets.h"
#include "scene/scene_builder.h"

/* The style of a part: flags, and above them 1 + the number of its colour, or 0 if the part keeps its colours. Operands
 * are those of combined solids (scene/csg.h); views do not fit tools. */
enum { ZR_PART_HIDDEN = 1, ZR_PART_GHOST = 2, ZR_PART_OPERAND = 4, ZR_PART_TOOL = 8, ZR_PART_COLOR_SHIFT = 4 };

/* The edit of one mesh. */
struct zr_part_mesh_edit {
    const uint32_t *styles; /* one per part of the mesh */
    const zr_vec4 *colors;
    bool hides_rest;
    const struct zr_part_offset *offsets; /* one per part of the mesh, in object space; or NULL */
};

/* Makes *out from the mesh. False without memory, or if arena->cancel is raised. */
bool zr_part_mesh_make(struct zr_scene_builder *builder, const struct zr_mesh *mesh,
                       const struct zr_part_mesh_edit *edit, struct zr_mesh *out);

#endif
