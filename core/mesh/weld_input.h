/* weld_input.h - mesh: positions of a mesh, scaled so that products of lengths stay within float.
 *
 * Space:  object space. */
#ifndef ZR_WELD_INPUT_H
#define ZR_WELD_INPUT_H

#include "base/team.h"
#include "scene/scene.h"

/* Positions with w = 1: the mesh's own array, or a copy if some have another w or products of lengths would leave the
 * range of float. */
struct zr_weld_input {
    const zr_vec4 *at;
    uint32_t count;
    zr_vec3 low; /* lower corner of the bounds of all finite positions */
    float diagonal;
};

/* Bounds of a mesh, and how to copy it. Without a copy, scale is 1 and every w is 1. */
struct zr_mesh_extent {
    double low[3], diagonal; /* before scaling */
    float scale;             /* a power of two */
    bool needs_copy;
};

struct zr_mesh_extent zr_mesh_extent_of(struct zr_team *team, const struct zr_mesh *mesh);

/* Makes the input. `room` holds mesh->position_count positions if a copy is needed, and must outlive the result. */
struct zr_weld_input zr_weld_input_make(struct zr_team *team, const struct zr_mesh *mesh,
                                        const struct zr_mesh_extent *extent, zr_vec4 *room);

#endif
