/* openapi.h - OpenAPI 3.1 of the daemon, from the rows of parameters, formats and channels, and the schema of scenes.
 */
#ifndef ZRASTERD_OPENAPI_H
#define ZRASTERD_OPENAPI_H

#include "core.h"
#include "output/bytes/buffer.h"

void openapi_print(struct zr_buffer *out, const struct zr_limits *limits);

/* Parts that follow from no table. Members of `paths`, for all paths but /v1/render; NULL at the end. */
extern const char *const openapi_paths[];

/* Members of `components`, and of its `schemas`: the page's lists; an error. */
extern const char openapi_components[], openapi_page_schemas[], openapi_problem[];

#endif
