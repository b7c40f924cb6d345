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

/* How bytes of a format are known and read: zr_reader_OBJ for the row OBJ, and so on, each in the file of its format.
 * Of a bare mesh the query says how it looks and where it is; of the request, only its bytes and its cancel are looked
 * at. Errors name the line, the triangle or the byte in `detail`. */
struct zr_format_reader {
    bool (*looks_so)(const char *bytes, size_t size);
    zr_format_read_fn *read;
    bool is_soup; /* triangles share no corners */
    bool z_is_up; /* of bare meshes, where nobody says so: else y */
};

#define READER(ID, suffix, media_types, has_view) extern const struct zr_format_reader zr_reader_##ID;
ZR_FORMAT_ROWS(READER)
#undef READER

void zr_warn_of_unused_asset(struct zr_scene_builder *builder, const struct zr_asset *asset);

#endif
