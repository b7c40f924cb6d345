/* span.h - mcp: a piece of a text, such as a value of JSON as it is written. */
#ifndef MCP_SPAN_H
#define MCP_SPAN_H

#include <string.h>

#include "input/json/json.h"

struct mcp_span {
    const char *at, *end; /* NULL: there is none */
};

static inline bool mcp_span_is(struct mcp_span span, const char *text)
{
    const size_t length = strlen(text);
    return span.at && (size_t)(span.end - span.at) == length && memcmp(span.at, text, length) == 0;
}

/* Skips the next value and returns its place; none if the text is broken. */
static inline struct mcp_span mcp_span_skip(struct zr_json *json)
{
    zr_json_type(json); /* passes white space */
    const char *at = json->at;
    return zr_json_skip(json) ? (struct mcp_span){at, json->at} : (struct mcp_span){NULL, NULL};
}

#endif
