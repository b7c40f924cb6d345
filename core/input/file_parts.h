/* file_parts.h - input: files that a model file refers to, among the assets of the request. */
#ifndef ZR_FILE_PARTS_H
#define ZR_FILE_PARTS_H

#include "base/arena.h"

struct zr_asset;         /* core.h */
struct zr_parsed_assets; /* json_scene.h */

/* Returns the asset that a file refers to by `name`, or NULL. Notes its use. */
const struct zr_asset *zr_file_part_find(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name);

#endif
