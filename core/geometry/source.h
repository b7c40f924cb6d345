/* source.h - geometry: transforms from object to clip and eye space in double, one set per instance.
 *
 * Why:    window vertices are rounded to float, clipped ones more than once. A value that must be correct to the last
 *         bits of a float (shade/eye_depth.h) is computed again from the mesh triangle (zr_source_of) that contains the
 *         primitive. */
#ifndef ZR_SOURCE_H
#define ZR_SOURCE_H

#include <stdint.h>

#include "base/matrix.h"
#include "scene/camera.h"

/* Results of the transform: x, y, w of clip space, -z and w of eye space. */
enum { ZR_SOURCE_X, ZR_SOURCE_Y, ZR_SOURCE_W, ZR_SOURCE_EYE_DEPTH, ZR_SOURCE_EYE_W, ZR_SOURCE_ROWS };

struct zr_source_instance {
    uint32_t first_vertex;
    const struct zr_mesh *mesh;
    double columns[4][ZR_SOURCE_ROWS]; /* matrix columns, of ZR_SOURCE_ROWS rows */
    struct zr_matrix object_to_eye;
    zr_mat4 to_eye; /* object_to_eye in float, as used for vertices */
};

/* Multiplies the float matrices of scene and camera in double. */
struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex);

#endif
