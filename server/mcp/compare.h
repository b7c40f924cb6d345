/* compare.h - mcp: the tool compare. */
#ifndef MCP_COMPARE_H
#define MCP_COMPARE_H

#include "host.h"
#include "message.h"

/* Compares two models, and adds the members of the result. MCP_REFUSED: `faults` has the reasons, or there is no
 * memory. */
enum mcp_draw_status mcp_compare_call(const struct mcp_host *host, const struct mcp_message *message,
                                      struct mcp_faults *faults, struct mcp_text *result);

#endif
