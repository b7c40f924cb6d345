/* data_uri.h - input: decodes "data:image/png;base64,iVBO...".
 *
 * Source: RFC 2397. ";base64" is required. The media type and its parameters are ignored: the bytes decide the format.
 */
#ifndef ZR_DATA_URI_H
#define ZR_DATA_URI_H

#include "base/arena.h"
#include "base/status.h"
#include "input/text.h"

/* Decodes into the arena. ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_data_uri_read(struct zr_arena *arena, const char *text, const void **bytes, size_t *size,
                                struct zr_reason *reason);

#endif
