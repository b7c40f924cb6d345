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
#include "zraster.h"

/* cJSON copies a number to a buffer of 64 bytes and fails on longer ones. */
enum { ZR_JSON_NUMBER_MAX = 63 };

/* ZR_BAD_SYNTAX where the text is malformed; ZR_BAD_SCENE where it is well-formed
 * throughout, but too deep, has too many values, a number too long or U+0000 in
 * a string; ZR_NO_MEMORY. Details name line and column. On success *values is
 * the count of values in the text. */
enum zr_status zr_json_scan(struct zr_arena *arena, const char *bytes, size_t size, const struct zr_limits *limits,
                            size_t *values, struct zr_error *error);

#endif
