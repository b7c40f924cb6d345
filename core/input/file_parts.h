/* file_parts.h - input: files that a model file refers to, among the assets of the request.
 *
 * A reference is compared with the names of the assets in this order:
 *     1. as written;
 *     2. as a path: escapes such as %20 decoded, backslashes as slashes, parts "." and "x/.." removed;
 *     3. the same without regard to ASCII case;
 *     4. the last part of the path with the last parts of the names, then without regard to case.
 * A file in a scene, such as {"asset": "arm/robot.obj"}, has the folder of its name: steps 1 to 3 are tried there first.
 * Steps 3 and 4 need exactly one asset that fits. Nothing is fetched.
 */
#ifndef ZR_FILE_PARTS_H
#define ZR_FILE_PARTS_H

#include <stddef.h>

#include "base/arena.h"

struct zr_asset;         /* core.h */
struct zr_parsed_assets; /* json_scene.h */

/* Returns the asset that a file refers to by `name`, or NULL. Notes its use. Members of a ZIP body are unpacked at
 * their first use. NULL also after a fault there, which zr_zip_body_check reports, and without memory. */
const struct zr_asset *zr_file_part_find(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name);

/* The same for the exact name alone. `use`: bits for assets->uses. */
const struct zr_asset *zr_file_part_named(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name,
                                          unsigned use);

/* Writes a path as step 2 has it, with its final zero; returns its length. `out` has length + 1 bytes. */
size_t zr_file_path_clean(const char *name, size_t length, char *out);

#endif
