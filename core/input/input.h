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

#include "format_rows.h"
#include "scene/scene_builder.h"
#include "zraster.h"

/* Reads request->bytes into what the builder makes. Cancelled, it returns ZR_CANCELLED or another failure. */
typedef enum zr_status zr_format_read_fn(struct zr_scene_builder *builder, const struct zr_request *request,
                                         const struct zr_limits *limits, struct zr_error *error);

/* Whether bytes look like those of a format. */
typedef bool zr_looks_so_fn(const char *bytes, size_t size);

/* zr_looks_so_OBJ and zr_read_OBJ of the row OBJ, and so on, each in the file of its format. Of a bare mesh the query
 * says how it looks and where it is; of the request, only its bytes and its cancel are looked at. Errors name the line,
 * the triangle or the byte in `detail`. */
#define READER(ID, ...)                                                                                                \
    zr_looks_so_fn zr_looks_so_##ID;                                                                                   \
    zr_format_read_fn zr_read_##ID;
ZR_FORMAT_ROWS(READER)
#undef READER

void zr_warn_of_unused_asset(struct zr_scene_builder *builder, const struct zr_asset *asset);

#endif
