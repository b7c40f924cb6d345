/* input.h - input: bytes of each format -> a scene.
 *
 * The room where hostile bytes are stopped. Each reader checks syntax, types,
 * finiteness, magnitude and index range itself, because it alone can say where
 * in the input the fault is; what concerns the scene as a whole is checked
 * afterwards by scene/validate.h. Readers never write to the input, and never
 * read past bytes + size (no terminating zero is promised).
 */
#ifndef ZR_INPUT_H
#define ZR_INPUT_H

#include "scene/scene_builder.h"
#include "zraster.h"

/* Reads request->bytes into what the builder makes. Cancelled, it returns ZR_CANCELLED or another failure. */
typedef enum zr_status zr_format_read_fn(struct zr_scene_builder *builder, const struct zr_request *request,
                                         const struct zr_limits *limits, struct zr_error *error);

/* A scene (the contract: server/api/v1.md). */
zr_format_read_fn zr_json_read;

/* Bare meshes: how they look and where they are is for the query to say. Of the request only its bytes and its cancel
 * are looked at. Errors name the line, the triangle or the byte in `detail`. */
zr_format_read_fn zr_obj_read, zr_stl_read;

void zr_warn_of_unused_asset(struct zr_scene_builder *builder, const struct zr_asset *asset);

/* Whether bytes look like STL, text or binary. */
bool zr_stl_looks_so(const char *bytes, size_t size);

#endif
