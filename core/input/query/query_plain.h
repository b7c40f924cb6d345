/* query_plain.h - input: the parameters of a request in one spelling.
 *
 *     zr_query_plain    "width=800&color=%23F00&look=studio"  ->  {"look":"studio@1","width":800,"color":[1,0,0,1]}
 *
 * Equal texts draw equal pictures of a file. The order of parameters, their escapes and the spelling of numbers, flags
 * and colours do not matter. A look has its version. Parameters at some defaults are left out.
 */
#ifndef ZR_QUERY_PLAIN_H
#define ZR_QUERY_PLAIN_H

#include "core.h"

/* Returns the bytes that zr_query_plain needs. */
size_t zr_query_plain_room(const struct zr_request *request);

/* Writes the parameters as JSON, with a final zero. A wrong value stays as it is, as a string. */
void zr_query_plain(const struct zr_request *request, const struct zr_limits *limits, char *room);

#endif
