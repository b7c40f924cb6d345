/* span.h - mcp: a piece of a text. */
#ifndef MCP_SPAN_H
#define MCP_SPAN_H

struct mcp_span {
    const char *at, *end; /* NULL: there is none */
};

#endif
