/* source.h - geometry: how positions of an instance get to clip and eye space, in double.
 *
 * Why:    window vertices are rounded to float, those that clipping makes more than once.
 *         What has to be right to the last bits of a float (shade/eye_depth.h) starts
 *         again from the mesh (zr_source_of), of which a primitive is never more than a part.
 */
#ifndef ZR_SOURCE_H
#define ZR_SOURCE_H

#include <stdint.h>

#include "base/matrix.h"
#include "scene/camera.h"

/* What a position is brought to: x, y, w of clip space, -z and w of eye space. */
enum { ZR_SOURCE_X, ZR_SOURCE_Y, ZR_SOURCE_W, ZR_SOURCE_EYE_DEPTH, ZR_SOURCE_EYE_W, ZR_SOURCE_ROWS };

struct zr_source_instance {
    uint32_t first_vertex;
    const struct zr_mesh *mesh;
    double columns[4][ZR_SOURCE_ROWS]; /* of the matrix that does it */
    struct zr_matrix object_to_eye;
    zr_mat4 to_eye; /* the same in floats, as vertices have it */
};

/* The floats of scene and camera, multiplied in double. */
struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex);

#endif
