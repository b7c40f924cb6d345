/* openapi.h - OpenAPI 3.1 of the daemon, from the rows of parameters, formats and channels, and the schema of scenes.
 */
#ifndef ZRASTERD_OPENAPI_H
#define ZRASTERD_OPENAPI_H

#include "core.h"
#include "output/bytes/buffer.h"

void openapi_print(struct zr_buffer *out, const struct zr_limits *limits);

#endif
