/* handler.h - mcp: the Model Context Protocol: a message in, an answer out. Revisions 2026-07-28 and, by each request's
 * own shape, 2025-11-25 and 2025-06-18. Messages share no state.
 *
 * Thread-safe, as far as the host is. No I/O. */
#ifndef MCP_HANDLER_H
#define MCP_HANDLER_H

#include "host.h"
#include "text.h"

/* Headers of a request over HTTP; NULL: not sent. */
struct mcp_headers {
    const char *version, *method, *name; /* MCP-Protocol-Version, Mcp-Method, Mcp-Name */
};

struct mcp_reply {
    struct mcp_text text; /* empty: no answer, as to a notification */
    int http_status;
};

/* Handles a message. `headers` is NULL without HTTP. Returns MCP_DRAWN with an answer, which the caller frees; or
 * MCP_LATER or MCP_CANCELLED without one. */
enum mcp_draw_status mcp_handle(const struct mcp_host *host, struct mcp_span message, const struct mcp_headers *headers,
                                struct mcp_reply *reply);

#endif
