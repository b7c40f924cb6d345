/* header.h - mcp: values of headers that repeat what is in the body. */
#ifndef MCP_HEADER_H
#define MCP_HEADER_H

#include <stdbool.h>

/* Compares the value of a header with a text. A value "=?base64?...?=" is decoded first. */
bool mcp_header_is(const char *value, const char *text);

#endif
