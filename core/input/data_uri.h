/* data_uri.h - input: "data:image/png;base64,iVBO..." -> bytes.
 *
 * Source: RFC 2397. The media type and its parameters are passed over, since the bytes
 *         themselves say what they are; ";base64" is needed.
 */
#ifndef ZR_DATA_URI_H
#define ZR_DATA_URI_H

#include "base/arena.h"
#include "base/status.h"
#include "input/text.h"

/* Bytes in the arena. ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_data_uri_read(struct zr_arena *arena, const char *text, const void **bytes, size_t *size,
                                struct zr_reason *reason);

#endif
