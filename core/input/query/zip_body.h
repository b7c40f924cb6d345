/* zip_body.h - input: a ZIP archive as a body: one model and the files that it refers to.
 *
 * Model:  the only member with the ending of a format (format_rows.h), or the one that the parameter `member` names.
 *         Dot files and the folder __MACOSX are ignored.
 * Assets: all other members. An asset has the member's path relative to the model's folder as its name, and is also
 *         found by its path in the archive. A member is unpacked when it is first found.
 * Safe:   zip_read.h checks the archive; the arena's ceiling and limits.unpacked_bytes_max limit the unpacked bytes.
 */
#ifndef ZR_ZIP_BODY_H
#define ZR_ZIP_BODY_H

#include "core.h"
#include "input/zip/zip_read.h"
#include "scene/scene_builder.h"

/* Replaces the format, the bytes and the assets of a ZR_FORMAT_ZIP request by those of the model in the archive. Leaves
 * other requests unchanged, but refuses their parameter `member`. Sets *model to the path of the model, else to NULL.
 * Fails with ZR_BAD_SYNTAX, ZR_BAD_REQUEST, ZR_BAD_SCENE, ZR_NO_MEMORY or ZR_CANCELLED (arena->cancel). */
enum zr_status zr_zip_body_open(struct zr_arena *arena, struct zr_request *request, const struct zr_limits *limits,
                                const char **model, struct zr_error *error);

/* Warns of unused members that a model could use: images, materials and buffers. */
void zr_zip_body_warn(struct zr_scene_builder *builder, const struct zr_request *request);

/* Returns the status of reading, or the status of a member that could not be unpacked.
 * Adds the model's path to faults of the body. */
enum zr_status zr_zip_body_check(const struct zr_request *request, const char *model, enum zr_status status,
                                 struct zr_error *error);

/* Makes the used members independent of the request's bytes, for a kept scene. False without memory. */
bool zr_zip_body_keep(struct zr_arena *arena, const struct zr_request *request);

#endif
