/* mesh_up.h - scene: the axis of a bare mesh that points up, and its rotation to the y axis of the world. */
#ifndef ZR_MESH_UP_H
#define ZR_MESH_UP_H

#include "base/cancel.h"
#include "base/matrix.h"
#include "base/team.h"
#include "scene/scene.h"

enum zr_mesh_up {
    ZR_MESH_UP_X,
    ZR_MESH_UP_MINUS_X,
    ZR_MESH_UP_Y,
    ZR_MESH_UP_MINUS_Y,
    ZR_MESH_UP_Z,
    ZR_MESH_UP_MINUS_Z,
    ZR_MESH_UP_AUTO, /* found by zr_mesh_up_find */
    ZR_MESH_UP_COUNT
};

/* Returns the rotation of the axis to y. The front is the mesh's +z, or its -y if z or -z is up. `up` is not
 * ZR_MESH_UP_AUTO. */
zr_mat4 zr_mesh_up_turn(enum zr_mesh_up up);

/* Finds x, y or z from the flat ends of the scene's box, in object space. The support of an axis is the area of the
 * faces that lie in one end of the box, as a share of that end. The larger one of both ends counts. The axis with the
 * largest support replaces `usual` if its support is at least 1/4 and at least twice that of `usual`. If cancelled,
 * returns any axis. */
enum zr_mesh_up zr_mesh_up_find(const struct zr_scene *scene, enum zr_mesh_up usual, struct zr_team *team,
                                const struct zr_cancel *cancel);

#endif
