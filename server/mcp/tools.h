/* tools.h - mcp: the descriptions of the tools, as tools/list answers them. */
#ifndef MCP_TOOLS_H
#define MCP_TOOLS_H

#include "arguments.h"

/* Names of the tools, in the order of enum mcp_tool. */
struct mcp_words mcp_tool_names(void);

/* Adds the list of tools, JSON. Every call adds the same bytes. */
void mcp_tools_list(struct mcp_text *text, const struct mcp_host *host);

/* Instructions of the server for a client's model. */
extern const char mcp_instructions[];

#endif
