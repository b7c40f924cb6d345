/* query_text.h - input: splits the text of a query, "look=technical&width=800", into the parameters of a request. */
#ifndef ZR_QUERY_TEXT_H
#define ZR_QUERY_TEXT_H

#include "core.h"

/* Decodes %XX and '+' in `length` bytes, into length + 1 bytes at `out`. False: an escape is broken or gives a zero
 * byte. */
bool zr_percent_decode(char *out, const char *source, size_t length);

/* Returns the bytes that zr_query_split needs. */
size_t zr_query_room(const char *query);

/* Sets the parameters of *request to their texts, decoded into `room`. Fails with ZR_BAD_REQUEST for a broken escape
 * and for an unknown or repeated parameter. */
enum zr_status zr_query_split(const char *query, char *room, struct zr_request *request, struct zr_error *error);

#endif
