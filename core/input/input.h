/* input.h - input: bytes of each format -> zr_scene.
 *
 * The room where hostile bytes are stopped. Each reader checks syntax, types,
 * finiteness, magnitude and index range itself, because it alone can say where
 * in the input the fault is; what concerns the scene as a whole is checked
 * afterwards by scene/validate.h. Readers never write to the input, and never
 * read past bytes + size (no terminating zero is promised).
 */
#ifndef ZR_INPUT_H
#define ZR_INPUT_H

#include "base/warning_list.h"
#include "scene/scene.h"
#include "zraster.h"

/* A scene in JSON (the contract: server/api/v1.md). `team` may be NULL. */
enum zr_status zr_json_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                            const struct zr_limits *limits, struct zr_scene *scene, struct zr_error *error);

/* Bare meshes: fill *mesh, and add to *warnings. Errors name the line, the triangle or the byte in `detail`. `team` may
 * be NULL. Of the request, only its bytes and its cancel are looked at; cancelled, they return ZR_CANCELLED or another
 * failure. */
enum zr_status zr_obj_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_mesh *mesh, struct zr_warning_list *warnings,
                           struct zr_error *error);
enum zr_status zr_stl_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_mesh *mesh, struct zr_warning_list *warnings,
                           struct zr_error *error);

/* Whether bytes look like STL, text or binary. */
bool zr_stl_looks_so(const char *bytes, size_t size);

#endif
