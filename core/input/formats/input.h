/* input.h - input: readers of all formats, which turn a request's bytes into a scene.
 *
 * All hostile input is checked here. Each reader checks syntax, types, finite values, magnitudes and index ranges,
 * since only it has the place of a fault. scene/validate.h then checks the scene as a whole. Readers never write to the
 * input and never read at or after bytes + size; no terminating zero is needed.
 */
#ifndef ZR_INPUT_H
#define ZR_INPUT_H

#include "core.h"
#include "format_rows.h"
#include "scene/scene_builder.h"

/* Reads request->bytes into the builder. When cancelled, it returns ZR_CANCELLED or another failure. */
typedef enum zr_status zr_format_read_fn(struct zr_scene_builder *builder, const struct zr_request *request,
                                         const struct zr_limits *limits, struct zr_error *error);

/* True if the bytes look like the format. */
typedef bool zr_looks_so_fn(const char *bytes, size_t size);

/* zr_looks_so_OBJ and zr_read_OBJ for the row OBJ, and so on, each in the file of its format. Readers of bare meshes
 * use only the bytes and the cancel flag of the request; look and view come from the query. Errors name the line, the
 * triangle or the byte in `detail`. */
#define READER(ID, ...)                                                                                                \
    zr_looks_so_fn zr_looks_so_##ID;                                                                                   \
    zr_format_read_fn zr_read_##ID;
ZR_FORMAT_ROWS(READER)
#undef READER

/* True for binary STL that has fewer triangles than its header counts. Its reader names both numbers. */
bool zr_stl_is_cut(const char *bytes, size_t size);

/* True if JSON text has the key of a scene's geometry at its root, near its beginning. */
bool zr_has_geometry_key(const char *bytes, size_t size);

#endif
