/* upright.h - scene: conversion of a y-up view to a z-up scene. */
#ifndef ZR_UPRIGHT_H
#define ZR_UPRIGHT_H

#include "scene/scene.h"

/* Returns the viewing direction of a pose that gives it as a vector: `direction`, or from `eye` to `target`. 0 for
 * other poses. */
static inline zr_vec3 zr_view_looks_along(const struct zr_view *view)
{
    const zr_vec3 from = view->eye, to = view->target;
    if (view->pose == ZR_POSE_DIRECTION) return view->direction;
    return view->pose == ZR_POSE_LOOK_AT ? (zr_vec3){to.x - from.x, to.y - from.y, to.z - from.z} : (zr_vec3){0, 0, 0};
}

/* Converts a y-up view to z-up. A preset becomes an orbit, whose front is on -y, as in CAD. Unless the view gives its
 * own up (has_up), z is up. */
void zr_view_put_z_up(struct zr_view *view, bool has_up);

#endif
