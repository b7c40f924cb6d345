/* far_scene.h - input: files with nodes that are far from the origin (far.h), such as 3MF and glTF.
 *
 *     read each mesh; if one of its coordinates is beyond the limit, subtract their middle from all of them: its move
 *     place the meshes; if zr_far_instances_needed, place them again with matrices in double (scene/nodes.h)
 *     zr_far_instances subtracts the middle of the scene in double, and rounds the matrices
 *
 * A scene within the limit keeps its matrices.
 */
#ifndef ZR_FAR_SCENE_H
#define ZR_FAR_SCENE_H

#include "base/matrix.h"
#include "input/far.h"
#include "scene/scene.h"

/* The point that was subtracted from the positions of a mesh, and their bounds before. */
struct zr_far_move {
    const double *by;
    struct zr_box box; /* of the positions that are drawn */
};

struct zr_far_scene {
    uint32_t count;
    struct zr_instance *instances;
    const struct zr_matrix *exact;          /* one per instance: object to world, before the subtraction */
    const struct zr_mesh *meshes;           /* of the instances; meshes without positions do not count */
    const struct zr_far_move *const *moves; /* one per mesh; NULL: its positions were not moved */
};

/* True if a mesh was moved, or if a matrix moves it beyond the limit. Ignores `exact`. */
bool zr_far_instances_needed(const struct zr_far_scene *scene, const struct zr_limits *limits);

/* Subtracts the middle of positions that are floats in the file, if they are far. *move: NULL, or in the arena. */
enum zr_status zr_far_move_floats(struct zr_arena *arena, const struct zr_cancel *cancel,
                                  const struct zr_limits *limits, zr_vec4 *positions, size_t count,
                                  const struct zr_far_move **move, struct zr_error *error);

/* Sets *origin, or NULL if none is subtracted, and the matrices of the instances. Refuses a scene of moved meshes that
 * is too large. */
enum zr_status zr_far_instances(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_limits *limits,
                                const struct zr_far_scene *scene, const double **origin, struct zr_error *error);

#endif
