/* validate.h - scene, first step: checks of a scene as a whole, for all input formats; refuses a strict request that
 * has warnings.
 *
 * Readers check single values. This step checks the window and its limits, that there is geometry, that counts fit the
 * types of later stages, and that a base has the requested channels.
 */
#ifndef ZR_VALIDATE_H
#define ZR_VALIDATE_H

#include "base/status.h"
#include "core.h"
#include "scene/scene.h"

/* Most corners over all instances. Faces have fewer triangles than corners, and faces with holes less than 5/3 as many
 * (geometry/triangulate.h), so that both counts fit 32 bits. */
#define ZR_SCENE_CORNERS_MAX (UINT64_C(1) << 31)

/* Returns ZR_OK, or ZR_BAD_SCENE with all faults in `error`. */
enum zr_status zr_scene_validate(const struct zr_scene *scene, const struct zr_limits *limits, struct zr_error *error);

/* Returns ZR_BAD_SCENE if the scene is strict and count > 0, and adds each text as an item of *error; else ZR_OK. */
enum zr_status zr_strict_check(const struct zr_scene *scene, const char *const *texts, size_t count,
                               struct zr_error *error);

#endif
