/* tools.h - mcp: the descriptions of the tools, as tools/list answers them. */
#ifndef MCP_TOOLS_H
#define MCP_TOOLS_H

#include "job.h"

extern const char *const mcp_tool_names[MCP_TOOLS + 1];

/* Adds the list of tools, JSON. Every call adds the same bytes. */
void mcp_tools_list(struct mcp_text *text, const struct mcp_host *host);

/* Instructions of the server for a client's model. */
extern const char mcp_instructions[];

#endif
