/* strict.h - core: refuses a strict request that has warnings. */
#ifndef ZR_STRICT_H
#define ZR_STRICT_H

#include "base/status.h"
#include "scene/scene.h"

/* Returns ZR_BAD_SCENE if the scene is strict and count > 0, and adds each text as an item of *error; else ZR_OK. */
enum zr_status zr_strict_check(const struct zr_scene *scene, const char *const *texts, size_t count,
                               struct zr_error *error);

#endif
