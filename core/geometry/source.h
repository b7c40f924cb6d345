/* source.h - geometry: from a record back to the triangle of a mesh that it shows.
 *
 * Space:  object space, and matrices in double from there to clip and eye space.
 * Why:    window vertices are rounded to float, those that clipping makes more than once.
 *         What has to be right to the last bits of a float (shade/eye_depth.h) starts
 *         again from the mesh, of which a record is never more than a part.
 * How:    the number of a window vertex tells. Those of an instance's positions come first,
 *         in their order, and behind them those that clipping makes. So there is one entry
 *         for each instance, and one for each triangle that was cut; none for the others.
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
};

/* A triangle that was cut. */
struct zr_source_cut {
    uint32_t first_vertex; /* of its pieces */
    uint32_t corners[3];   /* positions of its mesh */
};

/* Both in the order of first_vertex. */
struct zr_sources {
    uint32_t instance_count, cut_count;
    struct zr_source_instance *instances;
    struct zr_source_cut *cuts;
};

struct zr_source {
    const struct zr_source_instance *instance;
    const zr_vec4 *corners[3]; /* object space */
    bool is_cut;               /* the record is a piece of the triangle */
};

/* The floats of scene and camera, multiplied in double. */
struct zr_source_instance zr_source_instance_make(const struct zr_camera *camera, const zr_mat4 *object_to_world,
                                                  const struct zr_mesh *mesh, uint32_t first_vertex);

/* The instance of a window vertex. Takes the logarithm of how many there are. */
const struct zr_source_instance *zr_source_instance_of(const struct zr_sources *sources, uint32_t vertex);

/* Of a record that is a triangle, by its window vertices. Takes the logarithm of what the tables hold. */
struct zr_source zr_source_of(const struct zr_sources *sources, const uint32_t vertices[3]);

#endif
