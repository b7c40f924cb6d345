/* look.h - support: replaces the view of a scene. */
#ifndef ZR_TEST_LOOK_H
#define ZR_TEST_LOOK_H

#include "scene/scene.h"

/* Sets pose and projection; keeps window and outputs. */
static inline void scene_look(struct zr_scene *scene, struct zr_view look)
{
    struct zr_view *view = &scene->views[0];
    look.width = view->width;
    look.height = view->height;
    look.output_count = view->output_count;
    look.outputs = view->outputs;
    *view = look;
}

#endif
