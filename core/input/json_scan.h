/* json_scan.h - input, first step for JSON: is it JSON, and of a size to parse?
 *
 * Why:    cJSON takes trailing commas, raw control characters, bad numbers and
 *         invalid UTF-8, recurses as deep as the text does, and needs about 40
 *         times the memory of the text. All this is decided here, in one pass
 *         without recursion, before it sees a byte.
 * Source: RFC 8259, and RFC 3629 for UTF-8. Stricter in one point: an escaped
 *         surrogate without its partner is refused, since it is no character.
 */
#ifndef ZR_JSON_SCAN_H
#define ZR_JSON_SCAN_H

#include "base/arena.h"
#include "base/status.h"
#include "input/json_list.h"
#include "zraster.h"

/* ZR_BAD_SYNTAX where the text is malformed; ZR_BAD_SCENE where it is well-formed
 * throughout, but too deep, has too many values, a number of more than ZR_NUMBER_JSON_MAX characters or U+0000
 * in a string; ZR_NO_MEMORY. Details name line and column. On success *values is
 * the count of values in the text. */
enum zr_status zr_json_scan(struct zr_arena *arena, const char *bytes, size_t size, const struct zr_limits *limits,
                            size_t *values, struct zr_error *error);

/* The same for a scene, of which the values in these lists do not count, since cJSON never sees them: /polygons,
 * and of /meshes/N: positions, faces, normals, colors, faceColors, lines, heights or heights/values. */
enum zr_status zr_json_scan_scene(struct zr_arena *arena, const char *bytes, size_t size,
                                  const struct zr_limits *limits, struct zr_error *error);

/* The same without a look at what is in these lists, which become *lists, in the order of the text. ZR_OK means
 * that the text is well-formed if all of them are. */
enum zr_status zr_json_scan_around_lists(struct zr_arena *arena, const char *bytes, size_t size,
                                         const struct zr_limits *limits, struct zr_json_lists *lists, size_t *values,
                                         struct zr_error *error);

#endif
