/* strict.h - the core: warnings of a strict request, which is refused for them. */
#ifndef ZR_STRICT_H
#define ZR_STRICT_H

#include "base/status.h"
#include "scene/scene.h"

/* ZR_BAD_SCENE where the scene is strict and there are texts, each of which becomes an item of *error; else ZR_OK. */
enum zr_status zr_strict_check(const struct zr_scene *scene, const char *const *texts, size_t count,
                               struct zr_error *error);

#endif
