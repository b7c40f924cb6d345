/* weld_input.h - mesh: where the positions of a mesh are, for what compares and multiplies lengths.
 *
 * Space:  object space.
 */
#ifndef ZR_WELD_INPUT_H
#define ZR_WELD_INPUT_H

#include "base/team.h"
#include "scene/scene.h"

/* Where the positions of a mesh are, w being 1: those of the mesh, or, where some have another w or all is so large or
 * so small that products of lengths leave the range of float, a copy. */
struct zr_weld_input {
    const zr_vec4 *at;
    uint32_t count;
    zr_vec3 low; /* of the bounds; what is at infinity is not in them */
    float diagonal;
};

/* What a copy is made with; a scale of 1 and no w: none is needed. */
struct zr_mesh_extent {
    double low[3], diagonal; /* before they are scaled */
    float scale;             /* a power of two */
    bool needs_copy;
};

struct zr_mesh_extent zr_mesh_extent_of(struct zr_team *team, const struct zr_mesh *mesh);

/* `room` is for mesh->position_count where a copy is needed, and has to last as long as the places do. */
struct zr_weld_input zr_weld_input_make(struct zr_team *team, const struct zr_mesh *mesh,
                                        const struct zr_mesh_extent *extent, zr_vec4 *room);

#endif
