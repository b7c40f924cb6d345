/* openapi_texts.h - parts of the OpenAPI description that follow from no table. */
#ifndef ZRASTERD_OPENAPI_TEXTS_H
#define ZRASTERD_OPENAPI_TEXTS_H

/* Members of `paths`, for all paths but /v1/render; NULL at the end. */
extern const char *const openapi_paths[];

/* Members of `components`, and of its `schemas`: the page's lists; an error. */
extern const char openapi_components[], openapi_page_schemas[], openapi_problem[];

#endif
