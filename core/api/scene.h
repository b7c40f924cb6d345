/* scene.h - api: a scene that is kept in an arena of its own. */
#ifndef ZR_LIBRARY_SCENE_H
#define ZR_LIBRARY_SCENE_H

#include "api/renderer.h"
#include "request/change.h"

struct zraster_scene {
    zraster *renderer;
    struct zr_arena *arena;
    const struct zr_kept *kept;
};

#endif
