/* look.h - support: a scene seen from another place. */
#ifndef ZR_TEST_LOOK_H
#define ZR_TEST_LOOK_H

#include "scene/scene.h"

/* Window and outputs stay as they are. */
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
