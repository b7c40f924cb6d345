/* file_parts.h - input: files that a model file refers to, among the assets of the request.
 *
 * A reference is compared with the names of the assets in this order:
 *     1. as written;
 *     2. as a path: escapes such as %20 decoded, backslashes as slashes, parts "." and "x/.." removed;
 *     3. as in 2, but without regard to ASCII case;
 *     4. the last part of the path with the last parts of the names, then without regard to case.
 * For a model file in a scene, such as {"asset": "arm/robot.obj"}, steps 1 to 3 are first tried in its folder "arm".
 * Steps 3 and 4 require exactly one match. Nothing is fetched.
 */
#ifndef ZR_FILE_PARTS_H
#define ZR_FILE_PARTS_H

#include <stddef.h>

#include "base/arena.h"

struct zr_asset;         /* core.h */
struct zr_parsed_assets; /* assets.h */

/* Returns the asset that a file refers to by `name`, or NULL. Marks it as used. Members of a ZIP body are unpacked at
 * their first use. NULL also after a fault there, which zr_zip_body_check reports, and without memory. */
const struct zr_asset *zr_file_part_find(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name);

/* Returns the asset with exactly this name, or NULL. `use`: bits to set in assets->uses. */
const struct zr_asset *zr_file_part_named(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name,
                                          unsigned use);

/* Writes the path of step 2 with a final zero, and returns its length. `out` has length + 1 bytes. */
size_t zr_file_path_clean(const char *name, size_t length, char *out);

#endif
