/* batches_builder.h - reference: batches on their way: corners and states, one behind the other; for batches*.c. */
#ifndef ZR_TEST_BATCHES_BUILDER_H
#define ZR_TEST_BATCHES_BUILDER_H

#include "reference/generate/batches.h"
#include "scene/scene.h"

struct batches_builder {
    struct zr_arena *arena;
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    struct batches_options options;
    struct batches *out;
    zr_vec4 *positions, *front;
    zr_vec3 *normals, *unit_normals, *light_points;
    zr_vec4 *texcoords, *tangents;
    struct reference_batch *batches;
    uint32_t corner_count, corner_room, batch_room, thin_room;
    uint32_t owner;       /* of the first face of the instance under way */
    zr_mat4 *clip_to_eye; /* outlives this */
};

/* One instance of a mesh on its way, and one of its faces. */
struct batches_source {
    const struct zr_mesh *mesh;
    const struct zr_instance *instance;
    const zr_mat4 *modelview;
    const zr_vec3 *normal_rows; /* as struct reference_batch has them */
    const zr_mat4 *object_to_eye;
    const zr_vec4 *computed;                 /* normals of vertices; NULL: none were needed so far */
    const struct zr_crease_normals *creases; /* likewise, for BATCHES_LIGHT */
    bool mirrored;
    const struct zr_material *material; /* of the face under way */
    bool smooth;                        /* what the purpose wants to vary does so over the face */
    bool has_vertex_normals;
    zr_vec3 face_normal; /* where it has none of vertices: the face's own, or 0 */
    uint32_t face;
};

/* Room for so many corners more. False where there is none. */
bool batches_reserve_corners(struct batches_builder *b, uint64_t more);

/* Joins the batch before, where the mode allows it and the state is the same. */
bool batches_append(struct batches_builder *b, const struct reference_batch *batch);

/* A corner at a vertex of the mesh, for which room was reserved. */
void batches_append_vertex(struct batches_builder *b, const struct batches_source *s, uint32_t vertex, zr_vec4 color,
                           zr_vec3 normal);

/* batches_lines.c: lines of the mesh, in the colours of their ends, and points, in their own; unlit both. */
bool batches_append_lines(struct batches_builder *b, const struct batches_source *s, uint32_t begin, uint32_t end);
bool batches_append_points(struct batches_builder *b, const struct batches_source *s, uint32_t begin, uint32_t end);

#endif
