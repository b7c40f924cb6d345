/* tools.h - mcp: the descriptions of the tools, as tools/list answers them (tools.c), and their calls (call.c). */
#ifndef MCP_TOOLS_H
#define MCP_TOOLS_H

#include "arguments.h"
#include "message.h"

/* Names of the tools, in the order of enum mcp_tool. */
struct mcp_words mcp_tool_names(void);

/* Adds the list of tools, JSON. Every call adds the same bytes. */
void mcp_tools_list(struct mcp_text *text, const struct mcp_host *host);

/* Runs a tool and adds the members of its result, from "content" on. MCP_DRAWN: the result is complete, and may be a
 * list of faults that the caller can mend. */
enum mcp_draw_status mcp_call(const struct mcp_host *host, const struct mcp_message *message, enum mcp_tool tool,
                              struct mcp_text *result);

/* Instructions of the server for a client's model. */
extern const char mcp_instructions[];

#endif
