/* validate.h - scene, first step: what concerns a scene as a whole, whatever
 * format it came in.
 *
 * Readers have checked each value by itself; here are the window against its
 * limits, that there is something to draw, that counts fit their types in
 * every later stage, and that a base has what the outputs ask for.
 */
#ifndef ZR_VALIDATE_H
#define ZR_VALIDATE_H

#include "base/status.h"
#include "scene/scene.h"
#include "zraster.h"

/* Corners over all instances. Triangles are fewer, but for faces with holes, which have less than 5/3 as many
 * (triangulate.h): both fit 32 bits. */
#define ZR_SCENE_CORNERS_MAX (UINT64_C(1) << 31)

/* ZR_OK, or ZR_BAD_SCENE with every fault found. */
enum zr_status zr_scene_validate(const struct zr_scene *scene, const struct zr_limits *limits, struct zr_error *error);

#endif
