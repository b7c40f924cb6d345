/* call.h - mcp: calls of the tools. */
#ifndef MCP_CALL_H
#define MCP_CALL_H

#include "job.h"

/* Runs a tool and adds the members of its result, from "content" on. MCP_DRAWN: the result is complete, and may be a
 * list of faults that the caller can mend. */
enum mcp_draw_status mcp_call(const struct mcp_host *host, const struct mcp_message *message, enum mcp_tool tool,
                              struct mcp_text *result);

#endif
