/* recenter_scene.h - input: files with nodes that are far from the origin (recenter.h), such as 3MF and glTF.
 *
 *     read each mesh; if a coordinate is beyond the limit, subtract the mesh's middle: struct zr_recenter_move
 *     place the meshes; if zr_recenter_instances_needed, place them again with matrices in double (scene/parts/nodes.h)
 *     zr_recenter_instances subtracts the middle of the scene in double, and rounds the matrices
 *
 * A scene within the limit keeps its matrices.
 */
#ifndef ZR_RECENTER_SCENE_H
#define ZR_RECENTER_SCENE_H

#include "base/matrix.h"
#include "input/text/recenter.h"
#include "scene/scene.h"

/* The point that was subtracted from the positions of a mesh. */
struct zr_recenter_move {
    const double *by;
    struct zr_box box; /* bounds of the drawn positions before the subtraction */
};

struct zr_recenter_scene {
    uint32_t count;
    struct zr_instance *instances;
    const struct zr_matrix *exact;               /* one per instance: object to world, before the subtraction */
    const struct zr_mesh *meshes;                /* meshes of the instances; those without positions are ignored */
    const struct zr_recenter_move *const *moves; /* one per mesh; NULL: its positions were not moved */
};

/* True if a mesh was moved, if a matrix moves it beyond the limit, or if the scene may be remote. Ignores `exact`. */
bool zr_recenter_instances_needed(const struct zr_recenter_scene *scene, const struct zr_limits *limits);

/* Subtracts the middle of positions that are floats in the file, if they are far. *move: NULL, or in the arena. */
enum zr_status zr_recenter_move_floats(const struct zr_run *run, const struct zr_limits *limits, zr_vec4 *positions,
                                       size_t count, const struct zr_recenter_move **move);

/* Sets the matrices of the instances, and *origin, which is NULL if nothing is subtracted. Refuses a scene that has
 * moved meshes and is too large. */
enum zr_status zr_recenter_instances(const struct zr_run *run, const struct zr_limits *limits,
                                     const struct zr_recenter_scene *scene, const double **origin);

#endif
